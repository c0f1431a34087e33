#include <catch2/catch.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "support/file_bytes.hpp"
#include "support/program.hpp"
#include "suture/errors.hpp"
#include "suture/io/summary.hpp"
#include "suture/io/trajectory_check.hpp"

using namespace suture;
using namespace suture::test;
using nlohmann::json;

namespace {

std::set<std::string> keys(const json& object) {
  std::set<std::string> names;
  for (const auto& [key, value] : object.items()) names.insert(key);
  return names;
}

RunSummary sample_summary() {
  return {.status = RunStatus::closed,
          .seed = 3,
          .k_a = 16.0,
          .tau = std::numeric_limits<double>::infinity(),
          .t_50 = 34.0,
          .wound_area_initial = 5.5,
          .closure_rate = 0.1,
          .healed_shape = 1.7,
          .events = {.yield = 5, .capture = 4, .exchange = 3},
          .solver = {.rate_evaluations = 8000, .steps = 2000},
          .wall_s = {{"packing", 1.5}, {"closure", 0.9}},
          .units = {.rest_area_um2 = 25.0, .constriction_rate_um_per_s = 1.0 / 3.0}};
}

}  // namespace

TEST_CASE("summary.json has exactly the keys other tools rely on", "[unit]") {
  const json summary = json::parse(to_json(sample_summary()));
  CHECK(keys(summary) == std::set<std::string>{"status",
                                               "seed",
                                               "k_a",
                                               "tau",
                                               "xi",
                                               "t_purse_string",
                                               "t_purse_string_min",
                                               "t_closed",
                                               "t_closed_min",
                                               "t_50",
                                               "t_50_min",
                                               "t_25",
                                               "t_25_min",
                                               "t_10",
                                               "t_10_min",
                                               "t_05",
                                               "t_05_min",
                                               "wound_area_initial",
                                               "wound_area_initial_um2",
                                               "wound_area_max",
                                               "wound_area_max_um2",
                                               "closure_rate",
                                               "closure_rate_um2_per_min",
                                               "healed_shape",
                                               "events",
                                               "solver",
                                               "wall_s"});
  CHECK(keys(summary["events"]) == std::set<std::string>{"yield", "capture", "exchange"});
  CHECK(keys(summary["solver"]) == std::set<std::string>{"rate_evaluations", "steps", "explicit_steps", "newton_iterations",
                                                         "linear_iterations", "error_test_failures",
                                                         "convergence_failures", "restarts"});
  CHECK(keys(summary["wall_s"]) == std::set<std::string>{"packing", "closure"});
}

TEST_CASE("summary.json holds model and physical units, null for never", "[unit]") {
  const json summary = json::parse(to_json(sample_summary()));
  CHECK(summary["status"] == "closed");
  CHECK(summary["tau"] == "inf");
  CHECK(summary["t_50"] == 34.0);
  CHECK(summary["t_50_min"].get<double>() == Approx(8.5));
  CHECK(summary["t_05"].is_null());
  CHECK(summary["t_05_min"].is_null());
  CHECK(summary["wound_area_initial_um2"].get<double>() == Approx(137.5));
  CHECK(summary["closure_rate_um2_per_min"].get<double>() == Approx(10.0));
  CHECK(summary["solver"]["rate_evaluations"] == 8000);
}

TEST_CASE("summary.json is replaced whole and can be checked", "[unit]") {
  const TemporaryDirectory folder;
  const auto path = folder.path() / "summary.json";
  write_bytes(path, "old");
  CHECK(check_file(path).verdict == FileVerdict::unreadable);
  write_summary(sample_summary(), path);
  CHECK(read_bytes(path) == to_json(sample_summary()));
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
  CHECK(check_file(path).verdict == FileVerdict::valid);
  json broken = json::parse(to_json(sample_summary()));
  broken.erase("t_05");
  write_bytes(path, broken.dump());
  const FileReport report = check_file(path);
  CHECK(report.verdict == FileVerdict::invalid);
  REQUIRE(report.problems.size() == 1);
  CHECK(report.problems[0] == "key 't_05' is missing");
  CHECK_THROWS_AS(write_summary(sample_summary(), folder.path() / "missing" / "summary.json"), FileError);
}
