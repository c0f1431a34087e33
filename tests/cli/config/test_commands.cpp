#include <catch2/catch.hpp>

#include "support/program.hpp"
#include "suture/io/config.hpp"
#include "suture/version.hpp"

using namespace suture::test;
using Catch::Matchers::Contains;

TEST_CASE("suture --version says what was built", "[cli]") {
  const TemporaryDirectory directory;
  const Outcome outcome = run_suture(SUTURE_PROGRAM, {"--version"}, directory.path());
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.errors.empty());
  CHECK_THAT(outcome.output, Contains("suture 0.") && Contains("commit") && Contains("SUNDIALS"));
}

TEST_CASE("suture --help lists the commands", "[cli]") {
  const TemporaryDirectory directory;
  const Outcome outcome = run_suture(SUTURE_PROGRAM, {"--help"}, directory.path());
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.output, Contains("validate") && Contains("config"));
}

TEST_CASE("printed defaults are a valid file, and resolve to themselves", "[cli]") {
  for (const std::string preset : {"printed", "published_code"}) {
    const TemporaryDirectory directory;
    const Outcome defaults = run_suture(SUTURE_PROGRAM, {"config", "--defaults", "--preset", preset}, directory.path());
    REQUIRE(defaults.exit_code == 0);
    directory.write("defaults.toml", defaults.output);
    const Outcome resolved = run_suture(SUTURE_PROGRAM, {"validate", "defaults.toml", "--resolved"}, directory.path());
    CHECK(resolved.exit_code == 0);
    CHECK(suture::parse_config(resolved.output, "resolved") == suture::default_config(preset));
  }
}

TEST_CASE("suture config --explain knows keys and sections", "[cli]") {
  const TemporaryDirectory directory;
  const Outcome key = run_suture(SUTURE_PROGRAM, {"config", "--explain", "plasticity.tau"}, directory.path());
  CHECK(key.exit_code == 0);
  CHECK_THAT(key.output, Contains("plasticity.tau") && Contains("default: 9.6"));
  CHECK(run_suture(SUTURE_PROGRAM, {"config", "--explain", "area"}, directory.path()).exit_code == 0);
}

TEST_CASE("overrides are taken one by one and several at a time, before and after the file", "[cli]") {
  const TemporaryDirectory directory;
  directory.write("config.toml", "[area]\nstiffness = 1\n");
  const std::vector<std::vector<std::string>> spellings{
      {"validate", "config.toml", "--set", "area.stiffness=32", "--set", "plasticity.tau=85 min"},
      {"validate", "config.toml", "--set", "area.stiffness=32", "plasticity.tau=85 min"},
      {"validate", "--set", "area.stiffness=32", "plasticity.tau=85 min", "config.toml"},
  };
  for (const auto& arguments : spellings) {
    const Outcome outcome = run_suture(SUTURE_PROGRAM, arguments, directory.path());
    INFO(outcome.errors);
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.output, Contains("k_a = 32 (1.28 kPa)") && Contains("tau = 306 (85 min)"));
  }
}
