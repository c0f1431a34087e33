function run = suture_read(file)
% SUTURE_READ  reads a run.h5 of suture, in Octave (7 or newer) and MATLAB.
%
%   run = suture_read('out/embryo/run.h5')
%
% Everything is in model units. Indices of cells and vertices count from 1.
%   run.length_um, run.time_min    what one model length and one unit of time are
%   run.config, run.summary        resolved configuration (TOML text); summary.json as a struct
%   run.first_vertex               cell i has the vertices first_vertex(i) : first_vertex(i+1)-1
%   run.initial_rest_length        per segment
%   run.material                   struct, one value per cell
%   run.frames(k)                  time, position [vertices x 2], rest_length, cells (struct), wound_outline [points x 2],
%                                  purse_string (position [ring x 2], vertex, slipped)
%   run.observables.<name>         time, value
%   run.events                     time, kind (cell array of text), cell, vertex; NaN: does not apply
  if exist('OCTAVE_VERSION', 'builtin')
    content = load('-hdf5', file);
  else
    content = read_group(file, h5info(file));
  end
  if ~all(isfield(content, {'provenance', 'frames', 'tissue'}))
    error('suture_read: %s is not a run of suture', file);
  end
  run = struct();
  run.config = text_of(content.provenance.resolved_config);
  % Attributes are out of Octave's reach; the configuration holds the same scales.
  rest_area_um2 = config_number(run.config, 'rest_area');
  run.length_um = sqrt(rest_area_um2);
  run.time_min = run.length_um / config_number(run.config, 'constriction_rate') / 60;
  run.summary = struct();
  if isfield(content, 'summary'), run.summary = jsondecode(text_of(content.summary)); end
  run.first_vertex = double(content.tissue.first_vertex(:)) + 1;
  run.initial_rest_length = content.tissue.initial_rest_length(:);
  run.material = columns(content.tissue.material);
  names = sort(fieldnames(content.frames));
  for k = 1:numel(names)
    run.frames(k) = read_frame(content.frames.(names{k}));
  end
  run.observables = struct();
  names = fieldnames(content.observables);
  for k = 1:numel(names)
    run.observables.(names{k}) = columns(content.observables.(names{k}));
  end
  run.events = read_events(content.events);
end

function frame = read_frame(group)
  frame.time = group.time;
  frame.position = points(group.position);
  frame.rest_length = group.rest_length(:);
  frame.cells = columns(group.cells);
  frame.wound_outline = points(group.wound_outline);
  ring = group.purse_string;
  frame.purse_string = struct('position', points(ring.position), 'vertex', double(ring.vertex(:)) + 1, ...
                              'slipped', ring.mode(:) == 1);
end

function events = read_events(group)
  events = struct('time', group.time(:));
  kind = group.kind;
  if ischar(kind), kind = cellstr(kind); end
  events.kind = cellfun(@text_of, kind(:), 'UniformOutput', false);
  for name = {'cell', 'vertex'}
    index = double(group.(name{1})(:));
    index(index < 0) = NaN;
    events.(name{1}) = index + 1;
  end
end

% HDF5 shows up with its dimensions in reverse: 2 x n.
function xy = points(stored)
  xy = zeros(0, 2);
  if ~isempty(stored), xy = double(stored).'; end
end

function result = columns(group)
  result = struct();
  names = fieldnames(group);
  for k = 1:numel(names), result.(names{k}) = double(group.(names{k})(:)); end
end

function text = text_of(value)
  if iscell(value), value = value{1}; end
  text = char(value);
  text = strtrim(strrep(text(:).', char(0), ''));
end

function number = config_number(config, key)
  found = regexp(config, ['(?<![\w])' key '\s*=\s*([-+0-9.eE]+)'], 'tokens');
  % [purse_string] has a constriction_rate too; [units] comes last.
  number = str2double(found{end}{1});
end

% MATLAB only: everything in a group as a struct. Names of frames start with a digit, hence the x.
function content = read_group(file, info)
  content = struct();
  for k = 1:numel(info.Datasets)
    name = info.Datasets(k).Name;
    path = [strip_root(info.Name) '/' name];
    content.(valid(name)) = h5read(file, path);
  end
  for k = 1:numel(info.Groups)
    parts = strsplit(info.Groups(k).Name, '/');
    content.(valid(parts{end})) = read_group(file, info.Groups(k));
  end
end

function name = strip_root(name)
  if strcmp(name, '/'), name = ''; end
end

function name = valid(name)
  if ~isempty(regexp(name, '^\d', 'once')), name = ['x' name]; end
end
