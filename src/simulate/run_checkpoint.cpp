#include "simulate/run_checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "suture/errors.hpp"
#include "suture/io/config.hpp"

namespace suture {

void expect_same_configuration(const std::filesystem::path& directory, const std::string& saved, const Config& now) {
  constexpr std::string_view free_keys[] = {"output.pictures", "run.end_time", "checkpoint.wall_interval",
                                            "checkpoint.sync_interval"};
  const Config before = parse_config(saved, (directory / "checkpoint").string());
  std::string differences;
  for (const std::string& key : config_key_names()) {
    if (std::find(std::begin(free_keys), std::end(free_keys), key) != std::end(free_keys)) continue;
    const std::string then = config_value(before, key), here = config_value(now, key);
    if (then != here) differences += fmt::format("{}{} was {}, is {}", differences.empty() ? "" : "; ", key, then, here);
  }
  if (before.cell_types != now.cell_types) differences += differences.empty() ? "[[cell_type]]" : "; [[cell_type]]";
  if (!differences.empty())
    throw InputError(fmt::format("{}: holds a run of another configuration ({}); resume it with its own, or choose another --out",
                                 directory.string(), differences));
}

double time_of(const PreparationState& state) {
  struct Time {
    double so_far;
    double operator()(const std::monostate&) const { return so_far; }
    double operator()(const CompressionState&) const { return 0.0; }
    double operator()(const AnnealState& s) const {
      return s.relaxation ? s.relaxation->state.time : s.motion ? s.motion->state.time : so_far;
    }
    double operator()(const RelaxationState& s) const { return s.state.time; }
  };
  return std::visit(Time{state.so_far.state.time}, state.step);
}

}  // namespace suture
