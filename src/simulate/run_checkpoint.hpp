// What a run of the wound-closure protocol saves, and whether a saved one can be continued here.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>

#include "simulate/run_archive.hpp"

namespace suture {

/// The closure of a run, and what was kept of watching it.
struct ClosureProgress {
  std::string closure;   ///< of ClosureObserver::checkpoint
  std::string recorder;  ///< fields of RunRecorder
};

struct RunCheckpoint {
  std::string resolved_config;
  std::string build;        ///< program and processor: other ones round differently
  bool reproducible = false;  ///< going on from here gives the bits of an uninterrupted run
  double time = 0.0;        ///< simulation time
  std::uint64_t journal_length = 0;
  std::map<std::string, double> wall_s;  ///< by stage, so far
  Statistics solver;        ///< of the preparation, once it is over
  std::variant<PreparationState, ClosureProgress> progress;
};

template <class Archive>
void exchange_fields(Archive& archive, ClosureProgress& p) {
  archive(p.closure, p.recorder);
}
template <class Archive>
void exchange_fields(Archive& archive, RunCheckpoint& c) {
  archive(c.resolved_config, c.build, c.reproducible, c.time, c.journal_length, c.wall_s, c.solver, c.progress);
}

/// This program on this processor.
std::string build_identity();

/// Throws InputError that names the keys in which `saved` (resolved configurations, TOML) differs from `now`. Keys that
/// cannot change what was computed so far are free: output.pictures, run.end_time and the wall times of [checkpoint].
void expect_same_configuration(const std::filesystem::path& directory, const std::string& saved, const Config& now);

/// Simulation time at which a preparation stands; 0 while packing.
double time_of(const PreparationState& state);

}  // namespace suture
