// SWEEP.toml: which configurations a sweep consists of. This header is the file as written; sweep/plan.hpp makes the
// runs. docs/how-to/sweep.md describes the format.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "suture/io/config.hpp"

namespace suture {

/// Keys that vary together ([grid]: one key; [[list]]: several, zipped). texts[i][k] is value i of key k as TOML.
struct SweepAxis {
  std::vector<std::string> keys;
  std::vector<std::vector<std::string>> texts;
  std::string origin;
};

/// A named row of the sweep with settings of its own.
struct SweepCase {
  std::string name;
  std::filesystem::path base;  ///< empty: that of the sweep
  std::vector<ConfigOverride> set;
  std::string origin;
  std::vector<std::uint64_t> seeds;  ///< increasing; empty: those of the sweep
};

/// A key whose value is `factor` times that of another key, in model units.
struct DerivedKey {
  std::string key, of;
  double factor = 1.0;
  std::string origin;
};

struct SweepFile {
  std::filesystem::path base;  ///< configuration file; empty: the defaults
  std::vector<ConfigOverride> set;
  std::vector<ConfigOverride> preparation;  ///< hold for the stages before the closure only
  std::vector<SweepCase> cases;
  std::vector<SweepAxis> axes;       ///< in the order of the file, [grid] before [[list]]
  std::vector<DerivedKey> derived;
  std::vector<std::uint64_t> seeds;  ///< increasing; empty: the seed of the base
};

/// Strict, as configurations are. Paths in it are relative to the folder of the file. Whether keys and their values
/// exist is not looked at. Throws InputError.
SweepFile read_sweep_file(const std::filesystem::path& file);

/// "1-25" or "1,2,7-9": increasing, each once. `origin` is for messages. Throws InputError.
std::vector<std::uint64_t> parse_seeds(std::string_view text, std::string_view origin);

}  // namespace suture
