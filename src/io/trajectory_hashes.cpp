#include "io/trajectory_hashes.hpp"

#include <fmt/format.h>

#include "io/tissue_state_io.hpp"
#include "io/trajectory_items.hpp"

namespace suture {
namespace {

void compare(const Hdf5Group& group, std::uint64_t found, const std::string& where, std::vector<std::string>& problems) {
  if (!group.has_attribute("content_hash"))
    problems.push_back(where + ": its hash is missing");
  else if (static_cast<std::uint64_t>(group.integer_attribute("content_hash")) != found)
    problems.push_back(where + ": its content does not have the recorded hash");
}

}  // namespace

bool has_hashes(const Hdf5Group& root) {
  return root.has_attribute("reproducible") || root.group("events").has_attribute("content_hash");
}

std::vector<std::string> hash_problems(const Hdf5Group& group, int index, const TrajectoryFrame& frame) {
  std::vector<std::string> problems;
  compare(group, frame_hash(frame), fmt::format("frame {}", index), problems);
  return problems;
}

std::vector<std::string> hash_problems(const Hdf5Group& root, const Trajectory& trajectory) {
  std::vector<std::string> problems;
  const Hdf5Group events = root.group("events"), observables = root.group("observables");
  std::uint64_t hash = 0;
  for (const StoredEvent& event : trajectory.events) hash = event_hash(event, hash);
  compare(events, hash, "events", problems);
  for (const auto& [stage, state] : trajectory.stages)
    compare(root.group("stages").group(stage_name(stage)), stage_hash(state), "stage " + stage_name(stage), problems);
  for (const Series& series : trajectory.observables) {
    hash = 0;
    for (std::size_t i = 0; i < series.time.size(); ++i) hash = value_hash(series.time[i], series.value[i], hash);
    compare(observables.group(series.quantity.name), hash, "observable " + series.quantity.name, problems);
  }
  return problems;
}

}  // namespace suture
