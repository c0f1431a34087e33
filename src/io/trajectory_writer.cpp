#include <fmt/format.h>

#include <array>
#include <limits>
#include <map>

#include "io/atomic_file.hpp"
#include "io/hdf5_file.hpp"
#include "io/tissue_state_io.hpp"
#include "suture/errors.hpp"
#include "suture/io/trajectory.hpp"
#include "suture/io/units.hpp"
#include "suture/version.hpp"

namespace suture {
namespace {

void write_header(const Hdf5Group& root, const Provenance& provenance) {
  const BuildInformation& build = build_information();
  const UnitScales scales(provenance.units);
  root.set_attribute("schema", trajectory_schema);
  root.set_attribute("schema_version", std::int64_t{trajectory_schema_version});
  root.set_attribute("code_version", build.version);
  root.set_attribute("code_commit", std::string(build.commit) + (build.dirty ? "-dirty" : ""));
  root.set_attribute("length_um", scales.length_um());
  root.set_attribute("time_min", scales.time_min());
  const Hdf5Group group = root.create_group("provenance");
  group.set_attribute("compiler", build.compiler);
  group.set_attribute("compiler_flags", build.flags);
  group.set_attribute("simd", build.simd);
  group.set_attribute("libraries", build.libraries);
  group.set_attribute("rest_area_um2", provenance.units.rest_area_um2);
  group.set_attribute("unsticking_force_nN", provenance.units.unsticking_force_nN);
  group.set_attribute("constriction_rate_um_per_s", provenance.units.constriction_rate_um_per_s);
  group.set_attribute("start_time", provenance.start_time);
  group.set_attribute("seed", static_cast<std::int64_t>(provenance.seed));
  group.set_attribute("threads", std::int64_t{provenance.threads});
  group.set_attribute("position_tolerance", provenance.position_tolerance);
  group.set_attribute("rest_length_tolerance", provenance.rest_length_tolerance);
  group.write_text("config_text", provenance.config_text, {"1", "configuration as the user wrote it"});
  group.write_text("resolved_config", provenance.resolved_config, {"1", "configuration with every default, TOML"});
  group.write_text("command_line", provenance.command_line, {"1", "the command that started the run"});
  group.write_text("parent", provenance.parent, {"1", "file this run continues; empty if none"});
}

// One growing dataset per column; rows wait here until the next commit.
struct EventColumns {
  std::vector<double> time;
  std::vector<std::string> kind;
  std::vector<int> cell, vertex;
};

}  // namespace

struct TrajectoryWriter::Impl {
  std::filesystem::path path;
  Hdf5File file = Hdf5File::create_in_memory();
  Hdf5Group root = file.root();
  Hdf5Group frames = root.create_group("frames");
  Hdf5Group stages = root.create_group("stages");
  Hdf5Group observables = root.create_group("observables");
  Hdf5Group events = root.create_group("events");
  std::int64_t frame_count = 0;
  double last_time = -std::numeric_limits<double>::infinity();
  Tissue tissue;
  std::vector<double> reference_rest_length;
  std::map<std::string, Series> pending_series;
  EventColumns pending_events;
  bool closed = false;

  void expect_open() const {
    if (closed) throw FileError(fmt::format("{}: already closed", path.string()));
  }

  void begin_frames(const TissueState& state) {
    tissue = state.tissue;
    reference_rest_length = state.reference_rest_length;
    write_tissue(root.create_group("tissue"), tissue, reference_rest_length);
  }

  void expect_same_tissue(const TissueState& state) const {
    bool same =
        state.tissue.cell_count() == tissue.cell_count() && state.reference_rest_length == reference_rest_length;
    for (int cell = 0; same && cell < tissue.cell_count(); ++cell)
      same = state.tissue.vertex_count(cell) == tissue.vertex_count(cell);
    if (!same)
      throw FileError(fmt::format("{}: the frame at time {} belongs to another tissue than the frames before",
                                  path.string(), state.time));
  }

  void flush_series() {
    for (auto& [name, series] : pending_series) {
      const Hdf5Group group = observables.has(name) ? observables.group(name) : observables.create_group(name);
      group.append("time", series.time, {"time", "simulation time"});
      group.append("value", series.value, {series.quantity.unit, series.quantity.description});
      series.time.clear();
      series.value.clear();
    }
  }

  void flush_events() {
    events.append("time", pending_events.time, {"time", "simulation time"});
    events.append("kind", pending_events.kind, {"1", "what happened"});
    events.append("cell", pending_events.cell, {"1", "cell concerned; -1: none"});
    events.append("vertex", pending_events.vertex, {"1", "vertex concerned, counted through the tissue; -1: none"});
    pending_events = {};
  }

  void publish(bool complete) {
    flush_series();
    flush_events();
    root.set_attribute("frame_count", frame_count);
    root.set_attribute("complete", std::int64_t{complete});
    write_file_atomically(path, file.image());
  }
};

TrajectoryWriter::TrajectoryWriter(std::filesystem::path path, const Provenance& provenance)
    : impl_(std::make_unique<Impl>()) {
  impl_->path = std::move(path);
  write_header(impl_->root, provenance);
}

TrajectoryWriter::~TrajectoryWriter() = default;

void TrajectoryWriter::write_stage(Stage stage, const TissueState& state) {
  impl_->expect_open();
  const Hdf5Group group = impl_->stages.create_group(stage_name(stage));
  write_tissue(group.create_group("tissue"), state.tissue, state.reference_rest_length);
  write_configuration(group, state);
}

void TrajectoryWriter::write_frame(const TissueState& state, const FrameExtras& extras) {
  impl_->expect_open();
  if (!(state.time > impl_->last_time))
    throw FileError(fmt::format("{}: a frame at time {} cannot follow one at {}", impl_->path.string(), state.time,
                                impl_->last_time));
  if (impl_->frame_count == 0)
    impl_->begin_frames(state);
  else
    impl_->expect_same_tissue(state);
  const Hdf5Group group = impl_->frames.create_group(fmt::format("{:06}", impl_->frame_count));
  write_configuration(group, state);
  const Hdf5Group cells = group.create_group("cells");
  for (const CellField& field : extras.cell_fields) {
    SUTURE_EXPECTS(field.values.size() == static_cast<std::size_t>(state.tissue.cell_count()));
    cells.write(field.quantity.name, field.values, {field.quantity.unit, field.quantity.description});
  }
  std::vector<double> x, y;
  for (const Point& point : extras.wound_outline) x.push_back(point.x), y.push_back(point.y);
  const std::array<std::span<const double>, 2> outline{x, y};
  group.write_table("wound_outline", outline, {"length", "boundary of the wound, counter-clockwise: x, y"});
  impl_->last_time = state.time;
  ++impl_->frame_count;
}

void TrajectoryWriter::record(const Quantity& quantity, double time, double value) {
  impl_->expect_open();
  Series& series = impl_->pending_series[quantity.name];
  series.quantity = quantity;
  series.time.push_back(time);
  series.value.push_back(value);
}

void TrajectoryWriter::record(const StoredEvent& event) {
  impl_->expect_open();
  EventColumns& columns = impl_->pending_events;
  columns.time.push_back(event.time);
  columns.kind.push_back(event.kind);
  columns.cell.push_back(event.cell.value_or(-1));
  columns.vertex.push_back(event.vertex.value_or(-1));
}

void TrajectoryWriter::write_summary(const RunSummary& summary) {
  impl_->expect_open();
  for (const char* name : {"solver", "summary"})
    if (impl_->root.has(name)) impl_->root.remove(name);
  const Hdf5Group solver = impl_->root.create_group("solver");
  const Statistics& counts = summary.solver;
  solver.set_attribute("rate_evaluations", counts.rate_evaluations);
  solver.set_attribute("steps", counts.steps);
  solver.set_attribute("newton_iterations", counts.newton_iterations);
  solver.set_attribute("linear_iterations", counts.linear_iterations);
  solver.set_attribute("hessian_builds", counts.hessian_builds);
  solver.set_attribute("preconditioner_setups", counts.preconditioner_setups);
  solver.set_attribute("error_test_failures", counts.error_test_failures);
  solver.set_attribute("convergence_failures", counts.convergence_failures);
  solver.set_attribute("restarts", counts.restarts);
  impl_->root.write_text("summary", to_json(summary), {"1", "the run's summary.json"});
}

void TrajectoryWriter::commit() {
  impl_->expect_open();
  impl_->publish(/*complete=*/false);
}

void TrajectoryWriter::close() {
  impl_->expect_open();
  impl_->publish(/*complete=*/true);
  impl_->closed = true;
}

}  // namespace suture
