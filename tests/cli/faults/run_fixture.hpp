// A small run that writes often, and what must be true of its folder whatever happened to it.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "support/file_bytes.hpp"
#include "support/program.hpp"
#include "suture/io/trajectory.hpp"

namespace suture::test {

/// Long forms of the fault tests (scripts/nightly).
inline bool long_tests() { return std::getenv("SUTURE_LONG_TESTS") != nullptr; }

/// SUTURE_LONG_TESTS=n: every n-th write, fsync and rename fails.
inline long every_nth() { return std::max(1L, std::atol(std::getenv("SUTURE_LONG_TESTS"))); }

/// Configured checkpoints every 0.4, samples every 0.1, a frame every 0.3, flushed each: in a tenth of a second.
inline std::vector<std::string> busy_run(const std::string& out, bool resume) {
  std::vector<std::string> arguments{"run", std::string(SUTURE_SOURCE_DIR) + "/examples/small.toml", "--quiet", "--out", out};
  for (const char* key : {"checkpoint.interval=0.4", "checkpoint.reproducible=true", "checkpoint.wall_interval=0.02",
                          "checkpoint.sync_interval=0", "output.interval=0.1", "output.frame_interval=0.3",
                          "output.pictures=2", "tissue.cells=7", "run.end_time=4", "wound.minimum_area=0", "purse_string.yield_length=0.5"})
    arguments.insert(arguments.end(), {"--set", key});
  if (resume) arguments.push_back("--resume");
  return arguments;
}

/// Everything of a trajectory that two runs of the same configuration must share, bit for bit.
inline bool same_content(const Trajectory& a, const Trajectory& b, std::size_t frames) {
  bool same = a.frames.size() >= frames && b.frames.size() >= frames;
  for (std::size_t i = 0; same && i < frames; ++i)
    same = a.frames[i].time == b.frames[i].time && a.frames[i].values == b.frames[i].values &&
           a.frames[i].purse_string.vertex == b.frames[i].purse_string.vertex;
  return same;
}

inline bool same_content(const Trajectory& a, const Trajectory& b) {
  bool same = a.frames.size() == b.frames.size() && same_content(a, b, a.frames.size()) && a.events == b.events &&
              a.observables.size() == b.observables.size() && a.stages.size() == b.stages.size();
  for (std::size_t i = 0; same && i < a.observables.size(); ++i)
    same = a.observables[i].quantity.name == b.observables[i].quantity.name && a.observables[i].time == b.observables[i].time &&
           a.observables[i].value == b.observables[i].value;
  for (const auto& [stage, state] : a.stages) same = same && state.values == b.stages.at(stage).values;
  return same;
}

}  // namespace suture::test
