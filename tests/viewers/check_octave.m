% octave check_octave.m RUN.h5: suture_read against what suture itself computed.
file = argv(){1};
addpath(fullfile(fileparts(mfilename('fullpath')), '..', '..', 'matlab'));
run = suture_read(file);
assert(strcmp(run.summary.status, 'closed'));
assert(numel(run.frames) > 2);
assert(all(diff([run.frames.time]) > 0));
cells = numel(run.first_vertex) - 1;
assert(cells, numel(run.material.tau));
for frame = run.frames
  for i = 1:cells
    xy = frame.position(run.first_vertex(i):run.first_vertex(i + 1) - 1, :);
    next = xy([2:end, 1], :);
    area = 0.5 * sum(xy(:, 1) .* next(:, 2) - next(:, 1) .* xy(:, 2));
    perimeter = sum(hypot(next(:, 1) - xy(:, 1), next(:, 2) - xy(:, 2)));
    assert(perimeter^2 / (4 * pi * area), frame.cells.shape_parameter(i), 1e-12);
    assert(area / run.material.rest_area(i) - 1, frame.cells.area_strain(i), 1e-12);
  end
  ring = frame.purse_string;
  assert(rows(ring.position), numel(ring.vertex));
  assert(all(ring.vertex >= 1 & ring.vertex < run.first_vertex(end)));
end
assert(run.observables.wound_area.value(1), run.summary.wound_area_initial, 1e-12);
assert(run.length_um^2 * run.summary.wound_area_max, run.summary.wound_area_max_um2, 1e-9);
assert(run.time_min * run.summary.t_closed, run.summary.t_closed_min, 1e-9);
assert(sum(strcmp(run.events.kind, 'closed')), 1);
assert(rows(run.frames(1).wound_outline) > 2);
disp('suture_read: agrees with suture');
