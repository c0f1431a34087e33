#include "sweep/run_result.hpp"

#include <fmt/format.h>

#include <fstream>

#include "suture/errors.hpp"

namespace suture {

std::optional<double> RunResult::number(const std::string& name) const {
  if (!summary.is_object()) return std::nullopt;
  const auto found = summary.find(name);
  return found != summary.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

RunResult read_result(const SweepFolder& folder, const SweepRun& run) {
  RunResult result{&run, finished_record(folder, run), nullptr, {}};
  if (!result.record) return result;
  const std::filesystem::path summary = folder.run(run) / "summary.json", wound = folder.run(run) / "wound.csv";
  try {
    if (std::ifstream stream(summary); stream) result.summary = nlohmann::json::parse(stream);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: not readable: {}", summary.string(), error.what()));
  }
  if (std::filesystem::exists(wound)) result.wound = read_wound_csv(wound);
  return result;
}

}  // namespace suture
