// The runs of a sweep: every case at every point of the axes, with every seed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "suture/io/sweep_file.hpp"
#include "suture/model/parameters.hpp"

namespace suture {

struct SweepRun {
  int index = 0;     ///< counted through the sweep; seeds vary fastest, then the last axis
  int node = 0;
  std::string key;   ///< hash of the resolved configuration(s), names its folder
  Config config;
  std::optional<Config> preparation;  ///< what the tissue is prepared with instead, if the sweep says so

  /// All that the result depends on, as text.
  std::string text() const;
};

/// One parameter point: its seeds are averaged over.
struct SweepNode {
  std::vector<std::string> values;  ///< one per column, model units, words without quotes
};

struct SweepPlan {
  std::vector<std::string> columns;  ///< "case" if there are cases, then the swept keys
  std::vector<SweepNode> nodes;
  std::vector<SweepRun> runs;
};

struct PlanOptions {
  std::vector<std::string> overrides;               ///< --set of the command line, for every run
  std::optional<std::vector<std::uint64_t>> seeds;  ///< instead of those of the file
};

/// Resolves and checks every configuration. Throws InputError for a key that does not exist, is swept twice or is swept
/// and overridden, for values that are not allowed, and for two runs that are the same.
SweepPlan make_plan(const SweepFile& file, const PlanOptions& options = {});

/// 16 hexadecimal digits that stand for a text (FNV-1a, 64 bits). Not secure: whoever relies on it compares the texts too.
std::string text_hash(std::string_view text);

}  // namespace suture
