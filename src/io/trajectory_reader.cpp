#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "io/hdf5_file.hpp"
#include "io/journal.hpp"
#include "io/tissue_state_io.hpp"
#include "io/trajectory_file.hpp"
#include "io/trajectory_parts.hpp"
#include "suture/errors.hpp"
#include "suture/io/trajectory.hpp"

namespace suture {
namespace {

constexpr Stage protocol_order[] = {Stage::packing, Stage::anneal, Stage::ablation, Stage::closure};

Provenance read_provenance(const Hdf5Group& root) {
  const Hdf5Group group = root.group("provenance");
  return {.config_text = group.text("config_text"),
          .resolved_config = group.text("resolved_config"),
          .command_line = group.text("command_line"),
          .start_time = group.text_attribute("start_time"),
          .parent = group.text("parent"),
          .seed = static_cast<std::uint64_t>(group.integer_attribute("seed")),
          .threads = static_cast<int>(group.integer_attribute("threads")),
          .position_tolerance = group.number_attribute("position_tolerance"),
          .rest_length_tolerance = group.number_attribute("rest_length_tolerance"),
          .units = {.rest_area_um2 = group.number_attribute("rest_area_um2"),
                    .unsticking_force_nN = group.number_attribute("unsticking_force_nN"),
                    .constriction_rate_um_per_s = group.number_attribute("constriction_rate_um_per_s")}};
}

TissueState read_stage(const Hdf5Group& group) {
  StoredTissue stored = read_tissue(group.group("tissue"));
  StoredConfiguration configuration = read_configuration(group, stored.tissue.vertex_count());
  return {.tissue = std::move(stored.tissue),
          .purse_string = std::move(configuration.purse_string),
          .reference_rest_length = std::move(stored.reference_rest_length),
          .time = configuration.time,
          .values = std::move(configuration.values)};
}

TrajectoryFrame read_frame_group(const Hdf5Group& group, const Tissue& tissue) {
  StoredConfiguration configuration = read_configuration(group, tissue.vertex_count());
  TrajectoryFrame frame{.time = configuration.time,
                        .purse_string = std::move(configuration.purse_string),
                        .values = std::move(configuration.values)};
  const Hdf5Group cells = group.group("cells");
  for (const std::string& name : cells.members()) {
    CellField field{{name, cells.unit_of(name), cells.description_of(name)}, cells.doubles(name)};
    if (field.values.size() != static_cast<std::size_t>(tissue.cell_count()))
      throw FileError(
          fmt::format("'cells/{}' has {} entries for {} cells", name, field.values.size(), tissue.cell_count()));
    frame.extras.cell_fields.push_back(std::move(field));
  }
  const std::vector<double> outline = group.pairs("wound_outline");
  const std::size_t points = outline.size() / 2;
  for (std::size_t i = 0; i < points; ++i) frame.extras.wound_outline.push_back({outline[i], outline[points + i]});
  return frame;
}

void read_frame_tissue(const Hdf5Group& root, Trajectory& trajectory) {
  const std::size_t present = root.group("frames").members().size();
  const int marked = marked_frames(root);
  if (present != static_cast<std::size_t>(marked))
    throw FileError(fmt::format("{} frames are there, but the commit mark says {}", present, marked));
  if (marked == 0) return;
  StoredTissue stored = read_tissue(root.group("tissue"));
  trajectory.tissue = std::move(stored.tissue);
  trajectory.reference_rest_length = std::move(stored.reference_rest_length);
}

void read_observables(const Hdf5Group& root, Trajectory& trajectory) {
  const Hdf5Group group = root.group("observables");
  for (const std::string& name : group.members()) {
    const Hdf5Group member = group.group(name);
    Series series{{name, member.unit_of("value"), member.description_of("value")},
                  member.doubles("time"),
                  member.doubles("value")};
    if (series.time.size() != series.value.size())
      throw FileError(
          fmt::format("observable '{}' has {} times for {} values", name, series.time.size(), series.value.size()));
    trajectory.observables.push_back(std::move(series));
  }
}

void read_events(const Hdf5Group& root, Trajectory& trajectory) {
  const Hdf5Group group = root.group("events");
  const std::vector<double> time = group.doubles("time");
  const std::vector<std::string> kind = group.texts("kind");
  const std::vector<int> cell = group.integers("cell"), vertex = group.integers("vertex");
  if (kind.size() != time.size() || cell.size() != time.size() || vertex.size() != time.size())
    throw FileError("the columns of the event table differ in length");
  const auto index = [](int value) { return value < 0 ? std::nullopt : std::optional<int>(value); };
  for (std::size_t i = 0; i < time.size(); ++i)
    trajectory.events.push_back({time[i], kind[i], index(cell[i]), index(vertex[i])});
}

void read_continuations(const Hdf5Group& root, Trajectory& trajectory) {
  if (!root.has("continuations")) return;
  const Hdf5Group group = root.group("continuations");
  const std::vector<double> time = group.doubles("time");
  const std::vector<int> reproducible = group.integers("reproducible");
  const std::vector<std::string> started = group.texts("started");
  if (reproducible.size() != time.size() || started.size() != time.size())
    throw FileError("the columns of the continuations differ in length");
  for (std::size_t i = 0; i < time.size(); ++i)
    trajectory.continuations.push_back({time[i], reproducible[i] == 1, started[i]});
}

// What is wrong with a file that was handed in is the user's input, whatever layer noticed it.
template <class Read>
auto reading(const std::filesystem::path& path, Read read) {
  try {
    return read(open_trajectory(path).root());
  } catch (const std::runtime_error& error) {
    throw InputError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

}  // namespace

TissueState state_of(const Trajectory& trajectory, TrajectoryFrame frame) {
  return {.tissue = trajectory.tissue,
          .purse_string = std::move(frame.purse_string),
          .reference_rest_length = trajectory.reference_rest_length,
          .time = frame.time,
          .values = std::move(frame.values)};
}

int marked_frames(const Hdf5Group& root) {
  const std::int64_t marked = root.integer_attribute("frame_count");
  if (marked < 0 || marked > std::numeric_limits<int>::max()) throw FileError(fmt::format("the commit mark says {} frames", marked));
  return static_cast<int>(marked);
}

Hdf5Group frame_group(const Hdf5Group& frames, int index) { return frames.group(fmt::format("{:06}", index)); }

TrajectoryFrame read_frame(const Hdf5Group& frames, int index, const Tissue& tissue) {
  try {
    return read_frame_group(frame_group(frames, index), tissue);
  } catch (const FileError& error) {
    throw FileError(fmt::format("frame {:06}: {}", index, error.what()));
  }
}

Trajectory read_all_but_frames(const Hdf5Group& root) {
  Trajectory trajectory;
  trajectory.provenance = read_provenance(root);
  trajectory.code_version = root.text_attribute("code_version");
  trajectory.code_commit = root.text_attribute("code_commit");
  trajectory.complete = root.integer_attribute("complete") == 1;
  const Hdf5Group stages = root.group("stages");
  for (const Stage stage : protocol_order)
    if (stages.has(stage_name(stage))) trajectory.stages.emplace(stage, read_stage(stages.group(stage_name(stage))));
  read_frame_tissue(root, trajectory);
  read_observables(root, trajectory);
  read_events(root, trajectory);
  read_continuations(root, trajectory);
  if (root.has("summary")) trajectory.summary = root.text("summary");
  return trajectory;
}

TissueState Trajectory::state(int frame) const { return state_of(*this, frames.at(frame)); }

const Series* Trajectory::observable(std::string_view name) const {
  const auto found = std::find_if(observables.begin(), observables.end(),
                                  [name](const Series& series) { return series.quantity.name == name; });
  return found == observables.end() ? nullptr : &*found;
}

Trajectory read_trajectory(const std::filesystem::path& path) {
  return reading(path, [](const Hdf5Group& root) {
    Trajectory trajectory = read_all_but_frames(root);
    const Hdf5Group frames = root.group("frames");
    for (int i = 0, count = marked_frames(root); i < count; ++i)
      trajectory.frames.push_back(read_frame(frames, i, trajectory.tissue));
    return trajectory;
  });
}

struct FrameReader::Impl {
  explicit Impl(const std::filesystem::path& path_of_file) : path(path_of_file), file(open_trajectory(path)) {}

  TrajectoryFrame frame(int index) const {
    try {
      return read_frame(frames, index, rest.tissue);
    } catch (const std::runtime_error& error) {
      throw InputError(fmt::format("{}: {}", path.string(), error.what()));
    }
  }

  std::filesystem::path path;
  Hdf5File file;
  Hdf5Group root = file.root(), frames = root.group("frames");
  Trajectory rest = read_all_but_frames(root);
  int count = marked_frames(root);
};

FrameReader::FrameReader(const std::filesystem::path& path) try : impl_(new Impl(path)) {
} catch (const std::runtime_error& error) {
  throw InputError(fmt::format("{}: {}", path.string(), error.what()));
}

FrameReader::FrameReader(FrameReader&&) noexcept = default;
FrameReader::~FrameReader() = default;
int FrameReader::count() const { return impl_->count; }
const Trajectory& FrameReader::all_but_frames() const { return impl_->rest; }
FrameExtras FrameReader::extras(int frame) const { return impl_->frame(frame).extras; }
TissueState FrameReader::state(int frame) const { return state_of(impl_->rest, impl_->frame(frame)); }

double FrameReader::time(int frame) const {
  try {
    return frame_group(impl_->frames, frame).number("time");
  } catch (const std::runtime_error& error) {
    throw InputError(fmt::format("{}: frame {:06}: {}", impl_->path.string(), frame, error.what()));
  }
}

std::vector<WoundSample> read_wound_samples(const std::filesystem::path& journal, std::uint64_t length) {
  std::vector<WoundSample> samples;
  try {
    JournalReader reader(journal);
    for (std::string block; reader.offset() < length && reader.next(block);) {
      ByteReader items(block);
      while (!items.at_end()) {
        TrajectoryItem item;
        items(item);
        if (const auto* sample = std::get_if<WoundSample>(&item)) samples.push_back(*sample);
      }
    }
  } catch (const FileError& error) {
    throw InputError(error.what());
  }
  return samples;
}

std::pair<Stage, TissueState> read_last_stage(const std::filesystem::path& path) {
  return reading(path, [](const Hdf5Group& root) {
    const Hdf5Group stages = root.group("stages");
    for (auto stage = std::rbegin(protocol_order); stage != std::rend(protocol_order); ++stage)
      if (stages.has(stage_name(*stage))) return std::pair(*stage, read_stage(stages.group(stage_name(*stage))));
    throw FileError("no stage of it was finished, so there is nothing to start from");
  });
}

}  // namespace suture
