#include <algorithm>
#include <cmath>

#include "suture/errors.hpp"
#include "suture/io/trajectory.hpp"
#include "suture/measure/membrane.hpp"
#include "suture/render/frame.hpp"
#include "suture/simulate/cell_experiment.hpp"
#include "suture/simulate/run.hpp"

namespace suture {

namespace {

constexpr int panel_size = 360;          // pixels
constexpr double arrow_share = 0.2;      // length of a force arrow / diameter of the cell
constexpr double plate_overhang = 1.15;  // length of a plate / greatest width of the cell

void record_series(TrajectoryWriter& writer, const std::vector<CellSample>& samples) {
  struct Column {
    Quantity quantity;
    double CellSample::*value;
  };
  const Column columns[] = {
      {{"shape_parameter", "1", "p^2/(4 pi a) of the cell"}, &CellSample::shape_parameter},
      {{"area", "area", "area of the cell"}, &CellSample::area},
      {{"perimeter", "length", "perimeter of the cell"}, &CellSample::perimeter},
      {{"energy", "energy", "energy of the cell, without the load"}, &CellSample::energy},
      {{"shortest_segment", "1", "smallest length over initial rest length"}, &CellSample::shortest_segment},
  };
  for (const Column& column : columns)
    for (const CellSample& sample : samples) writer.record(column.quantity, sample.time, sample.*column.value);
}

void write_trajectory(const CellExperimentResult& result, const Config& config, const Provenance& provenance,
                      const std::filesystem::path& path) {
  TrajectoryWriter writer(path, provenance);
  for (const TissueState& frame : result.frames)
    writer.write_frame(frame, {.cell_fields = {shape_parameter_field(frame)}, .wound_outline = {}});
  record_series(writer, result.samples);
  if (result.release_sample) writer.record({.time = result.samples[*result.release_sample].time, .kind = "release"});
  writer.write_summary(summarise(result, config));
  writer.publish(/*complete=*/!result.failure);
  writer.discard_journal();
}

// Evenly spread over the frames, first and last included; the interior one next to the release moves there.
std::vector<std::size_t> pictured_frames(const CellExperimentResult& result, int pictures) {
  const std::size_t last = result.frames.size() - 1;
  const std::size_t count = std::min<std::size_t>(std::max(pictures, 2), last + 1);
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(count > 1 ? i * last / (count - 1) : 0);
  if (result.release_frame && *result.release_frame != last && count > 2) {
    const auto distance = [&](std::size_t frame) {
      return std::max(frame, *result.release_frame) - std::min(frame, *result.release_frame);
    };
    *std::min_element(chosen.begin() + 1, chosen.end() - 1,
                      [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); }) = *result.release_frame;
  }
  return chosen;
}

std::vector<Plate> drawn_plates(const std::vector<LoadPhase>& phases, double time, double half_length) {
  for (const LoadPhase& phase : phases)
    if (phase.plates && time >= phase.start && time <= phase.end) {
      const double middle = phase.plates->center_y, half_gap = 0.5 * phase.plates->gap_at(time);
      return {{{-half_length, middle + half_gap}, {half_length, middle + half_gap}},
              {{half_length, middle - half_gap}, {-half_length, middle - half_gap}}};
    }
  return {};
}

std::vector<ForceArrow> drawn_forces(const Config& config, const TissueState& first, const TissueState& state,
                                     double length) {
  std::vector<ForceArrow> arrows;
  if (config.run.protocol != Protocol::dipole || config.dipole.force == 0.0) return arrows;
  const std::vector<double> forces = dipole_forces(config, first);
  for (std::size_t v = 0; v < forces.size(); ++v)
    arrows.push_back({{state.view().x[v], state.view().y[v]}, {std::copysign(length, forces[v]), 0.0}});
  return arrows;
}

std::vector<StripPanel> make_panels(const CellExperimentResult& result, const Config& config) {
  const TissueState& first = result.frames.front();
  const double membrane = make_membrane(config.contact, first.tissue).contact_distance;
  const std::vector<LoadPhase> phases = load_phases(config, first);
  const auto width = [](const TissueState& state) {
    const auto [low, high] = std::minmax_element(state.view().x.begin(), state.view().x.end());
    return *high - *low;
  };
  double widest = 0.0;
  for (const TissueState& frame : result.frames) widest = std::max(widest, width(frame));
  std::vector<StripPanel> panels;
  for (const std::size_t frame : pictured_frames(result, config.output.pictures)) {
    const TissueState& state = result.frames[frame];
    FrameStyle style{.scales = UnitScales(config.units)};
    style.membrane_width = membrane;
    style.plates = drawn_plates(phases, state.time - first.time, 0.5 * plate_overhang * (widest + membrane));
    style.forces = drawn_forces(config, first, state, arrow_share * width(first));
    panels.push_back({state, style});
  }
  return panels;
}

}  // namespace

RunSummary summarise(const CellExperimentResult& result, const Config& config) {
  if (result.samples.empty()) throw InputError("the experiment has no samples to summarise");
  CellOutcome cell{.shape_initial = result.samples.front().shape_parameter,
                   .shape_final = result.samples.back().shape_parameter,
                   .area_final = result.samples.back().area};
  if (result.release_sample) cell.shape_at_release = result.samples[*result.release_sample].shape_parameter;
  return {.status = result.failure ? RunStatus::failed : RunStatus::reached_t_end,
          .seed = config.tissue.seed,
          .k_a = config.area.stiffness,
          .tau = config.plasticity.tau,
          .xi = config.plasticity.memory,
          .cell = cell,
          .solver = result.statistics,
          .wall_s = {{"experiment", result.wall_s}},
          .units = config.units};
}

void write_cell_experiment(const CellExperimentResult& result, const Config& config, const Provenance& provenance,
                           const std::filesystem::path& directory) {
  write_trajectory(result, config, provenance, directory / "run.h5");
  write_summary(summarise(result, config), directory / "summary.json");
  write_cell_csv(result.samples, UnitScales(config.units), directory / "cell.csv");
  remove_pictures(directory);
  if (config.output.pictures == 0) return;
  const std::vector<StripPanel> panels = make_panels(result, config);
  for (const char* name : {"final.png", "final.svg"}) render_cell_experiment(panels, panel_size, directory / name);
}

}  // namespace suture
