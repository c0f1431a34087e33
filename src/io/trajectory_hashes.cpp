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

std::vector<std::string> hash_problems(const Hdf5Group& root, const Trajectory& trajectory) {
  std::vector<std::string> problems;
  const Hdf5Group events = root.group("events");
  if (!root.has_attribute("reproducible") && !events.has_attribute("content_hash")) return problems;  // version 0.1.0
  std::uint64_t hash = 0;
  for (const StoredEvent& event : trajectory.events) hash = event_hash(event, hash);
  compare(events, hash, "events", problems);
  for (const auto& [stage, state] : trajectory.stages)
    compare(root.group("stages").group(stage_name(stage)), stage_hash(state), "stage " + stage_name(stage), problems);
  const Hdf5Group frames = root.group("frames"), observables = root.group("observables");
  for (std::size_t i = 0; i < trajectory.frames.size(); ++i)
    compare(frames.group(fmt::format("{:06}", i)), frame_hash(trajectory.frames[i]), fmt::format("frame {}", i), problems);
  for (const Series& series : trajectory.observables) {
    hash = 0;
    for (std::size_t i = 0; i < series.time.size(); ++i) hash = value_hash(series.time[i], series.value[i], hash);
    compare(observables.group(series.quantity.name), hash, "observable " + series.quantity.name, problems);
  }
  return problems;
}

}  // namespace suture
