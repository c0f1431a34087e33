// `suture converge` as a user meets it, on one smooth cell and on a small wound.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/program.hpp"

using namespace suture::test;

namespace {

const std::string examples = std::string(SUTURE_SOURCE_DIR) + "/examples/";

using Table = std::vector<std::map<std::string, std::string>>;

Table read_table(const std::filesystem::path& file) {
  std::ifstream stream(file);
  const auto fields = [](const std::string& line) {
    std::vector<std::string> all(1);
    for (const char c : line)
      if (c == ',')
        all.emplace_back();
      else
        all.back() += c;
    return all;
  };
  std::string line;
  std::getline(stream, line);
  const std::vector<std::string> names = fields(line);
  Table table;
  while (std::getline(stream, line)) {
    const std::vector<std::string> values = fields(line);
    REQUIRE(values.size() == names.size());
    table.emplace_back();
    for (std::size_t k = 0; k < names.size(); ++k) table.back()[names[k]] = values[k];
  }
  return table;
}

}  // namespace

TEST_CASE("converge on a smooth cell: errors follow tolerance and step, and everything promised is there", "[cli]") {
  const TemporaryDirectory directory;
  const Outcome outcome = run_suture(SUTURE_PROGRAM,
                                     {"converge", examples + "dipole.toml", "--quiet", "--out", "out", "--methods", "cvode,rkc,euler,rk4", "--tolerances",
                                      "1e-3,1e-4", "--steps", "0.01,0.005", "--repeats", "2", "--set", "dipole.duration=20"},
                                     directory.path());
  INFO(outcome.errors);
  REQUIRE(outcome.exit_code == 0);
  for (const char* name : {"converge.csv", "converge_seeds.csv", "converge.json", "work_precision.png", "work_precision.svg",
                           "error_tolerance.png", "error_tolerance.svg"}) {
    INFO(name);
    CHECK(std::filesystem::file_size(directory.path() / "out" / name) > 100);
  }
  const Table table = read_table(directory.path() / "out/converge.csv");
  REQUIRE(table.size() == 9);  // four methods, two values each, and the confirmation
  CHECK(table.back().at("role") == "confirmation");
  for (const int coarse : {0, 2, 4}) {
    const double error = std::stod(table[coarse].at("error_position")), finer = std::stod(table[coarse + 1].at("error_position"));
    CAPTURE(table[coarse].at("method"), error, finer);
    CHECK(finer < 0.7 * error);
    CHECK(std::stod(table[coarse].at("rate_evaluations")) > 10.0);
    CHECK(table[coarse].at("error_t5").empty());
  }
  CHECK(std::stod(table[4].at("error_position")) / std::stod(table[5].at("error_position")) == Approx(2.0).margin(0.3));  // Euler
  std::ifstream stream(directory.path() / "out/converge.json");
  const nlohmann::json json = nlohmann::json::parse(stream);
  CHECK(json["references"][0]["divergence_time"].is_null());
  CHECK(json["references"][0]["uncertainty_position"].get<double>() < 0.1 * std::stod(table[1].at("error_position")));
}

TEST_CASE("converge on a small wound finds closure times and compares means over seeds", "[cli]") {
  const TemporaryDirectory directory;
  const Outcome outcome = run_suture(SUTURE_PROGRAM,
                                     {"converge", examples + "small.toml", "--out", "out", "--methods", "cvode", "--tolerances", "3e-3", "--seeds", "1-2",
                                      "--reference-tolerance", "3e-4", "--set", "run.end_time=60"},
                                     directory.path());
  INFO(outcome.errors);
  REQUIRE(outcome.exit_code == 0);
  const Table table = read_table(directory.path() / "out/converge.csv"), seeds = read_table(directory.path() / "out/converge_seeds.csv");
  REQUIRE(table.size() == 2);
  REQUIRE(seeds.size() == 4);
  CHECK(table[0].at("seeds") == "2");
  CHECK(std::stod(table[0].at("error_position_max")) >= std::stod(seeds[0].at("error_position_max")));
  CHECK_FALSE(table[0].at("error_t5").empty());
  CHECK_FALSE(table[0].at("mean_error_t5").empty());
  CHECK(outcome.output.find("the two references differ by") != std::string::npos);
}

// With 1e-3 a run may take another branch of events than the reference, which rounding decides: arkode did, with 18 restarts for 13 and
// t_05 off by 0.4, and not with 3e-4. With 1e-4 the worst of six packings has 0.09.
TEST_CASE("every method closes a small wound, events included", "[cli]") {
  const TemporaryDirectory directory;
  const Outcome outcome = run_suture(SUTURE_PROGRAM,
                                     {"converge", examples + "small.toml", "--quiet", "--out", "out", "--methods", "cvode,rkc2,auto,arkode,adams,euler,verlet,rk4",
                                      "--tolerances", "1e-4", "--steps", "2e-3", "--seeds", "2", "--reference-tolerance", "1e-6", "--set", "integrator.vertex_mass=0.05",
                                      "--set", "purse_string.yield_length=1.6"},  // tethers that break early: some 25 events
                                     directory.path());
  INFO(outcome.errors);
  REQUIRE(outcome.exit_code == 0);
  const Table table = read_table(directory.path() / "out/converge.csv");
  REQUIRE(table.size() == 9);
  for (const auto& row : table) {
    CAPTURE(row.at("method"), row.at("error_t5"), row.at("mean_error_area"));
    CHECK(row.at("status") == "done");
    CHECK(std::stod(row.at("restarts")) >= 5.0);
    REQUIRE_FALSE(row.at("error_t5").empty());
    const bool with_mass = row.at("method") == "verlet";  // another motion, which meets other events
    CHECK(std::stod(row.at("error_t5")) < (with_mass ? 10.0 : 0.2));
    CHECK(std::stod(row.at("mean_error_area")) < (with_mass ? 0.5 : 0.03));
  }
}

TEST_CASE("bad options of converge are refused before anything is written", "[cli]") {
  const TemporaryDirectory directory;
  const auto refused = [&](std::vector<std::string> extra, const std::string& expected) {
    std::vector<std::string> arguments{"converge", examples + "dipole.toml", "--out", "out"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    const Outcome outcome = run_suture(SUTURE_PROGRAM, arguments, directory.path());
    INFO(outcome.errors);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.errors.find(expected) != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(directory.path() / "out"));
  };
  refused({"--methods", "cvod"}, "cvode");
  refused({"--tolerances", "-1"}, "--tolerances");
  refused({"--steps", "0"}, "--steps");
  refused({"--seeds", "3-1"}, "--seeds");
  refused({"--seeds", "many"}, "--seeds");
  refused({"--confirmation", "cvode"}, "second method");
}
