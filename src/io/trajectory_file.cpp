#include "io/trajectory_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "io/atomic_file.hpp"
#include "io/file_seal.hpp"
#include "io/journal.hpp"
#include "io/tissue_state_io.hpp"
#include "suture/errors.hpp"
#include "suture/io/units.hpp"

namespace suture {
namespace {

constexpr std::size_t rows_per_write = 4096;
constexpr Stage protocol_order[] = {Stage::packing, Stage::anneal, Stage::ablation, Stage::closure};

void set_hash(const Hdf5Group& group, std::uint64_t hash) {
  group.set_attribute("content_hash", static_cast<std::int64_t>(hash));
}

void write_provenance(const Hdf5Group& group, const HeaderItem& header) {
  const Provenance& provenance = header.provenance;
  group.set_attribute("compiler", header.compiler);
  group.set_attribute("compiler_flags", header.compiler_flags);
  group.set_attribute("simd", header.simd);
  group.set_attribute("libraries", header.libraries);
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

/// A file that is gone when it is closed.
Hdf5File create_scratch() {
  std::string name = std::filesystem::temp_directory_path() / "suture-XXXXXX";
  const int descriptor = ::mkstemp(name.data());
  if (descriptor < 0) throw FileError(fmt::format("{}: {}", name, std::strerror(errno)));
  ::close(descriptor);
  Hdf5File file = Hdf5File::create(name);
  ::unlink(name.c_str());
  return file;
}

/// What convert_journal would make of it.
Hdf5File as_hdf5(const std::filesystem::path& journal, std::uintmax_t largest_in_memory) {
  const bool large = std::filesystem::file_size(journal) > largest_in_memory;
  TrajectoryFile trajectory(large ? create_scratch() : Hdf5File::create_in_memory());
  JournalReader reader(journal);
  for (std::string block; reader.next(block);) trajectory.add(block);
  trajectory.mark(/*complete=*/false);
  return std::move(trajectory).release();
}

Hdf5File open_sealed(const std::filesystem::path& path) {
  if (std::filesystem::is_regular_file(path)) expect_unbroken_seal(path);
  return Hdf5File::open(path);
}

}  // namespace

TrajectoryFile::TrajectoryFile(Hdf5File file) : file_(std::move(file)), last_time_(-std::numeric_limits<double>::infinity()) {
  const Hdf5Group root = file_.root();
  groups_.emplace(Groups{file_.root(), root.create_group("frames"), root.create_group("stages"),
                         root.create_group("observables"), root.create_group("events")});
}

void TrajectoryFile::add(std::string_view block) {
  ByteReader reader(block);
  while (!reader.at_end()) {
    TrajectoryItem item;
    reader(item);
    std::visit([this](const auto& part) { add(part); }, item);
  }
}

void TrajectoryFile::add(const HeaderItem& header) {
  const UnitScales scales(header.provenance.units);
  const Hdf5Group& root = groups_->root;
  if (root.has("provenance")) throw FileError("there is a second header");
  root.set_attribute("schema", trajectory_schema);
  root.set_attribute("schema_version", std::int64_t{trajectory_schema_version});
  root.set_attribute("code_version", header.code_version);
  root.set_attribute("code_commit", header.code_commit);
  root.set_attribute("length_um", scales.length_um());
  root.set_attribute("time_min", scales.time_min());
  write_provenance(root.create_group("provenance"), header);
}

/// A tissue that was refused is packed again: its stages and what followed are replaced.
void TrajectoryFile::add(const StageItem& item) {
  for (const Stage stage : protocol_order)
    if (stage >= item.stage && groups_->stages.has(stage_name(stage))) groups_->stages.remove(stage_name(stage));
  const Hdf5Group group = groups_->stages.create_group(stage_name(item.stage));
  write_tissue(group.create_group("tissue"), item.state.tissue, item.state.reference_rest_length);
  write_configuration(group, item.state);
  set_hash(group, stage_hash(item.state));
}

void TrajectoryFile::add(const TissueItem& item) {
  if (frame_count_ > 0) throw FileError("the tissue changes between frames");
  if (groups_->root.has("tissue")) groups_->root.remove("tissue");
  tissue_ = item;
  write_tissue(groups_->root.create_group("tissue"), item.tissue, item.reference_rest_length);
}

void TrajectoryFile::add(const FrameItem& item) {
  const TrajectoryFrame& frame = item.frame;
  TissueState state{.tissue = tissue_.tissue, .purse_string = frame.purse_string, .time = frame.time, .values = frame.values};
  if (state.values.size() != static_cast<std::size_t>(state.layout().size()))
    throw FileError(fmt::format("frame {} does not fit its tissue", frame_count_));
  if (!(frame.time > last_time_)) throw FileError(fmt::format("frame {}: time does not increase", frame_count_));
  const Hdf5Group group = groups_->frames.create_group(fmt::format("{:06}", frame_count_));
  write_configuration(group, state);
  const Hdf5Group cells = group.create_group("cells");
  for (const CellField& field : frame.extras.cell_fields)
    cells.write(field.quantity.name, field.values, {field.quantity.unit, field.quantity.description});
  std::vector<double> x, y;
  for (const Point& point : frame.extras.wound_outline) x.push_back(point.x), y.push_back(point.y);
  const std::array<std::span<const double>, 2> outline{x, y};
  group.write_table("wound_outline", outline, {"length", "boundary of the wound, counter-clockwise: x, y"});
  set_hash(group, frame_hash(frame));
  last_time_ = frame.time;
  ++frame_count_;
}

void TrajectoryFile::add(const QuantityItem& item) { columns_[item.number].series.quantity = item.quantity; }

void TrajectoryFile::add(const ValueItem& item) {
  Column& column = columns_[item.number];
  // The block that named the quantity may have been damaged.
  if (column.series.quantity.name.empty()) column.series.quantity = {fmt::format("unnamed_{}", item.number), "?", "its name is lost"};
  column.series.time.push_back(item.time);
  column.series.value.push_back(item.value);
  column.hash = value_hash(item.time, item.value, column.hash);
  if (column.series.time.size() >= rows_per_write) flush(column);
}

void TrajectoryFile::add(const StoredEvent& event) {
  pending_events_.time.push_back(event.time);
  pending_events_.kind.push_back(event.kind);
  pending_events_.cell.push_back(event.cell.value_or(-1));
  pending_events_.vertex.push_back(event.vertex.value_or(-1));
  pending_events_.hash = event_hash(event, pending_events_.hash);
  if (pending_events_.time.size() >= rows_per_write) flush_events();
}

void TrajectoryFile::add(const SummaryItem& summary) {
  const Hdf5Group& root = groups_->root;
  for (const char* name : {"solver", "summary"})
    if (root.has(name)) root.remove(name);
  const Hdf5Group solver = root.create_group("solver");
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
  root.write_text("summary", summary.json, {"1", "the run's summary.json"});
}

void TrajectoryFile::add(const Continuation& continuation) {
  const Hdf5Group& root = groups_->root;
  const Hdf5Group group = root.has("continuations") ? root.group("continuations") : root.create_group("continuations");
  reproducible_ = reproducible_ && continuation.reproducible;
  group.append("time", std::array{continuation.time}, {"time", "simulation time of the checkpoint the run went on from"});
  group.append("reproducible", std::array{int{continuation.reproducible}},
               {"1", "1: bit-identical to a run that was not interrupted; 0: equal to the tolerances"});
  group.append("started", std::array{continuation.started}, {"1", "when it went on, UTC"});
}

void TrajectoryFile::flush(Column& column) {
  Series& series = column.series;
  const Hdf5Group group = column.started ? groups_->observables.group(series.quantity.name)
                                         : groups_->observables.create_group(series.quantity.name);
  column.started = true;
  group.append("time", series.time, {"time", "simulation time"});
  group.append("value", series.value, {series.quantity.unit, series.quantity.description});
  series.time.clear();
  series.value.clear();
}

void TrajectoryFile::flush_events() {
  EventColumns& pending = pending_events_;
  groups_->events.append("time", pending.time, {"time", "simulation time"});
  groups_->events.append("kind", pending.kind, {"1", "what happened"});
  groups_->events.append("cell", pending.cell, {"1", "cell concerned; -1: none"});
  groups_->events.append("vertex", pending.vertex, {"1", "vertex concerned, counted through the tissue; -1: none"});
  pending = {.hash = pending.hash};
}

bool TrajectoryFile::has_header() const { return groups_->root.has("provenance"); }

void TrajectoryFile::mark(bool complete) {
  for (auto& [number, column] : columns_) {
    if (column.series.quantity.name.empty()) continue;
    flush(column);
    set_hash(groups_->observables.group(column.series.quantity.name), column.hash);
  }
  flush_events();
  set_hash(groups_->events, pending_events_.hash);
  groups_->root.set_attribute("reproducible", std::int64_t{reproducible_});
  groups_->root.set_attribute("frame_count", frame_count_);
  groups_->root.set_attribute("complete", std::int64_t{complete});
}

Hdf5File TrajectoryFile::release() && {
  groups_.reset();
  return std::move(file_);
}

namespace {

/// build: fills the file, which is then marked and published.
template <class Build>
void publish_trajectory(const std::filesystem::path& path, bool complete, Build build) {
  write_file_atomically(path, [&](const std::filesystem::path& temporary) {
    TrajectoryFile trajectory(Hdf5File::create(temporary));
    build(trajectory);
    trajectory.mark(complete);
    std::move(trajectory).release().finish();
    seal_file(temporary);
  });
}

void note_samples(Recovered& recovered, std::string_view block) {
  ByteReader items(block);
  while (!items.at_end()) {
    TrajectoryItem item;
    items(item);
    if (const auto* sample = std::get_if<WoundSample>(&item)) recovered.samples.push_back(*sample);
    if (const auto* header = std::get_if<HeaderItem>(&item)) recovered.units = header->provenance.units;
  }
}

}  // namespace

void convert_journal(const std::filesystem::path& journal, const std::filesystem::path& path, bool complete) {
  publish_trajectory(path, complete, [&journal](TrajectoryFile& trajectory) {
    JournalReader reader(journal);
    for (std::string block; reader.next(block);) trajectory.add(block);
  });
}

Recovered recover_journal(const std::filesystem::path& journal, const std::filesystem::path& path) {
  Recovered recovered;
  publish_trajectory(path, /*complete=*/false, [&](TrajectoryFile& trajectory) {
    JournalReader reader(journal, OnDamage::skip);
    for (std::string block; reader.next(block);) {
      try {
        trajectory.add(block);
        note_samples(recovered, block);
      } catch (const std::runtime_error&) {  // its bytes are right, but what they follow is lost
        recovered.lost_bytes += block.size();
      }
    }
    if (!trajectory.has_header())
      throw InputError(fmt::format("{}: its beginning is lost, and with it the configuration", journal.string()));
    recovered.frames = trajectory.frames();
    recovered.last_time = trajectory.last_time();
    recovered.lost_bytes += reader.damaged();
    recovered.journal_bytes = reader.file_size();
  });
  return recovered;
}

Hdf5File open_trajectory(const std::filesystem::path& path, std::uintmax_t largest_in_memory) {
  const bool unpublished = !std::filesystem::exists(path) && is_journal(journal_path(path));
  Hdf5File file = unpublished        ? as_hdf5(journal_path(path), largest_in_memory)
                  : is_journal(path) ? as_hdf5(path, largest_in_memory)
                                     : open_sealed(path);
  const Hdf5Group root = file.root();
  if (!root.has_attribute("schema") || root.text_attribute("schema") != trajectory_schema)
    throw FileError("it is an HDF5 file, but not a suture trajectory (no schema attribute)");
  const std::int64_t version = root.integer_attribute("schema_version");
  if (version != trajectory_schema_version)
    throw FileError(
        fmt::format("its layout is version {}; this program reads version {}", version, trajectory_schema_version));
  return file;
}

}  // namespace suture
