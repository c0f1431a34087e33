// `suture run` as a user meets it, on a small tissue.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "support/program.hpp"

using namespace suture::test;

namespace {

const std::string small = std::string(SUTURE_SOURCE_DIR) + "/examples/small.toml";

nlohmann::json summary_of(const std::filesystem::path& folder) {
  std::ifstream stream(folder / "summary.json");
  return nlohmann::json::parse(stream);
}

Outcome run(const TemporaryDirectory& directory, const std::string& out, std::vector<std::string> overrides) {
  std::vector<std::string> arguments{"run", small, "--quiet", "--out", out};
  for (const std::string& text : overrides) arguments.insert(arguments.end(), {"--set", text});
  return run_suture(SUTURE_PROGRAM, arguments, directory.path());
}

}  // namespace

TEST_CASE("a run leaves everything the README promises, and it passes the check", "[cli]") {
  const TemporaryDirectory directory;
  REQUIRE(run(directory, "out", {}).exit_code == 0);
  for (const char* name : {"run.h5", "summary.json", "wound.csv", "final.png", "final.svg", "strip.png"}) {
    INFO(name);
    CHECK(std::filesystem::file_size(directory.path() / "out" / name) > 100);
  }
  for (const char* name : {"out/run.h5", "out/summary.json", "out/wound.csv"})
    CHECK(run_suture(SUTURE_PROGRAM, {"check", name}, directory.path()).exit_code == 0);
  const nlohmann::json summary = summary_of(directory.path() / "out");
  CHECK(summary["status"] == "closed");
  CHECK(summary["t_50"].get<double>() < summary["t_closed"].get<double>());
}

TEST_CASE("fewer pictures leave none of an earlier run behind, and without any a run has none", "[cli]") {
  const TemporaryDirectory directory;
  const auto pictures = [&](int number) {
    REQUIRE(run(directory, "out", {"run.end_time=1", fmt::format("output.pictures={}", number)}).exit_code == 0);
    std::set<std::string> names;
    for (const auto& file : std::filesystem::directory_iterator(directory.path() / "out"))
      if (const auto kind = file.path().extension(); kind == ".png" || kind == ".svg") names.insert(file.path().filename());
    return names;
  };
  CHECK(pictures(2) == std::set<std::string>{"final.png", "final.svg", "strip.png", "frame_00.png", "frame_01.png"});
  CHECK(pictures(1) == std::set<std::string>{"final.png", "final.svg", "strip.png", "frame_00.png"});
  CHECK(pictures(0).empty());
}

TEST_CASE("a closure from a saved stage is the closure of the whole run, with the material asked for now", "[cli]") {
  const TemporaryDirectory directory;
  REQUIRE(run(directory, "whole", {"plasticity.tau=1"}).exit_code == 0);
  REQUIRE(run(directory, "prepared", {"run.last_stage=ablation"}).exit_code == 0);  // tau 9.6: elastic until here
  REQUIRE(run(directory, "continued", {"plasticity.tau=1", "run.start_from=prepared/run.h5"}).exit_code == 0);
  const nlohmann::json whole = summary_of(directory.path() / "whole"), continued = summary_of(directory.path() / "continued");
  CHECK(whole["t_closed"].get<double>() == continued["t_closed"].get<double>());
  CHECK(whole["healed_shape"].get<double>() == continued["healed_shape"].get<double>());
  REQUIRE(run(directory, "elastic", {"plasticity.tau=1e6", "run.start_from=prepared/run.h5"}).exit_code == 0);
  CHECK(summary_of(directory.path() / "elastic")["healed_shape"] != continued["healed_shape"]);
}

TEST_CASE("the option --seed is --set tissue.seed, and refused in the same words", "[cli]") {
  const TemporaryDirectory directory;
  const auto with = [&](const char* option, const char* seed, const char* out) {
    return run_suture(SUTURE_PROGRAM, {"run", small, "--quiet", "--set", "run.last_stage=packing", option, seed, "--out", out}, directory.path());
  };
  CHECK(with("--seed", "7", "short").exit_code == 0);
  CHECK(with("--set", "tissue.seed=7", "long").exit_code == 0);
  CHECK(summary_of(directory.path() / "short")["seed"] == 7);
  const Outcome bad = with("--seed", "seven", "bad"), as_long = with("--set", "tissue.seed=seven", "bad");
  CHECK(bad.exit_code == 2);
  CHECK(bad.errors == as_long.errors);
}
