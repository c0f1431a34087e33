// From SWEEP.toml to the list of runs.
#include "suture/sweep/plan.hpp"

#include <catch2/catch.hpp>

#include "suture/errors.hpp"
#include "support/program.hpp"
#include "suture/sweep/preparation_cache.hpp"

using namespace suture;
using Catch::Matchers::Contains;

namespace {

SweepPlan plan_of(const std::string& text, const PlanOptions& options = {}) {
  const test::TemporaryDirectory directory;
  directory.write("base.toml", "[area]\nstiffness = 3\n[tissue]\nseed = 7\n");
  directory.write("other.toml", "[area]\nstiffness = 5\n");
  directory.write("sweep.toml", text);
  return make_plan(read_sweep_file(directory.path() / "sweep.toml"), options);
}

}  // namespace

TEST_CASE("a grid is the product of its axes, the last varies fastest, and seeds faster still", "[sweep]") {
  const SweepPlan plan = plan_of(R"(
    base = "base.toml"
    seeds = [1, 2]
    [grid]
    area.stiffness = [1, 2]
    "plasticity.tau" = [4.8, inf, "100 s"]
  )");
  REQUIRE(plan.columns == std::vector<std::string>{"area.stiffness", "plasticity.tau"});
  REQUIRE(plan.nodes.size() == 6);
  REQUIRE(plan.runs.size() == 12);
  CHECK(plan.nodes[1].values == std::vector<std::string>{"1.0", "inf"});
  CHECK(plan.runs[3].node == 1);
  CHECK(plan.runs[3].config.tissue.seed == 2);
  CHECK(plan.runs[11].config.area.stiffness == 2.0);
  CHECK(plan.runs[11].config.plasticity.tau == Approx(6.0));  // sqrt(25 um^2)/(0.3 um/s) = 16.67 s
}

TEST_CASE("a list varies its keys together, a case brings its own base and settings", "[sweep]") {
  const SweepPlan plan = plan_of(R"(
    base = "base.toml"
    [[case]]
    name = "as is"
    [[case]]
    name = "other"
    base = "other.toml"
    set = { plasticity.memory = 0.5 }
    [[list]]
    membrane.law = ["quadratic", "relative"]
    integrator.tolerance = [1e-3, 1e-4]
  )");
  REQUIRE(plan.columns == std::vector<std::string>{"case", "membrane.law", "integrator.tolerance"});
  REQUIRE(plan.runs.size() == 4);
  CHECK(plan.nodes[1].values == std::vector<std::string>{"as is", "relative", "0.0001"});
  CHECK(plan.runs[1].config.area.stiffness == 3.0);
  CHECK(plan.runs[1].config.tissue.seed == 7);  // no seeds given: that of the base
  CHECK(plan.runs[2].config.area.stiffness == 5.0);
  CHECK(plan.runs[2].config.plasticity.memory == 0.5);
}

TEST_CASE("a case may have seeds of its own, the command line has the last word", "[sweep]") {
  const std::string text = R"(
    seeds = "1-2"
    [[case]]
    name = "quick"
    seeds = "1-4"
    [[case]]
    name = "slow"
    set = { plasticity.memory = 0.5 }
  )";
  const SweepPlan plan = plan_of(text);
  REQUIRE(plan.runs.size() == 6);
  CHECK(plan.runs[3].config.tissue.seed == 4);
  CHECK(plan.runs[3].node == 0);
  CHECK(plan.runs[5].config.tissue.seed == 2);
  CHECK(plan_of(text, {{}, std::vector<std::uint64_t>{9}}).runs.size() == 2);
}

TEST_CASE("derived keys follow the swept ones", "[sweep]") {
  const SweepPlan plan = plan_of(R"(
    [grid]
    plasticity.tau = [4, 8]
    [derived]
    integrator.maximum_step = {key = "plasticity.tau", factor = 0.25}
    integrator.rest_length_tolerance = "integrator.tolerance"
  )", {.overrides = {"integrator.tolerance=5e-4"}, .seeds = std::vector<std::uint64_t>{9}});
  REQUIRE(plan.runs.size() == 2);
  CHECK(plan.runs[1].config.integrator.maximum_step == 2.0);
  CHECK(plan.runs[1].config.integrator.rest_length_tolerance == 5e-4);
  CHECK(plan.runs[1].config.tissue.seed == 9);
}

TEST_CASE("the same configuration has the same key, whatever sweep it is part of, and another one has another", "[sweep]") {
  const SweepPlan wide = plan_of("seeds = \"1-3\"\n[grid]\narea.stiffness = [1, 2]\n");
  const SweepPlan narrow = plan_of("seeds = [3]\n[set]\narea.stiffness = 2\n");
  CHECK(narrow.runs[0].key == wide.runs[5].key);
  for (int i = 0; i < 5; ++i) CHECK(wide.runs[i].key != wide.runs[5].key);
}

TEST_CASE("a bad sweep is one message that says where and what is allowed", "[sweep]") {
  const auto [text, expected] = GENERATE(table<std::string, std::string>({
      {"grids = 1", "sweep.toml:1:1: key 'grids': found an unknown key"},
      {"[grid]\narea.stifness = [1]", "did you mean 'area.stiffness'?"},
      {"[grid]\narea.stifness = [1]", "sweep.toml:2:"},
      {"[grid]\narea.stiffness = 1", "allowed an array of at least one value"},
      {"[grid]\narea.stiffness = [1, -1]", "key 'area.stiffness': found -1"},
      {"[grid]\ntissue.seed = [1]", "allowed in 'seeds'"},
      {"[grid]\narea.stiffness = [1]\n[[list]]\narea.stiffness = [2]", "found it a second time"},
      {"[grid]\narea.stiffness = [1, 1]", "have the same configuration"},
      {"[[list]]\narea.stiffness = [1, 2]\nplasticity.tau = [1]", "found 1 values, allowed as many as 'area.stiffness' has: 2"},
      {"[[case]]\nset = {}", "key 'case.name': found no value"},
      {"[[case]]\nname = \"a\"\n[[case]]\nname = \"a\"", "found \"a\" a second time"},
      {"seeds = \"5-1\"", "allowed an increasing one"},
      {"seeds = 3", "found 3, allowed an array of whole numbers"},
      {"base = \"nowhere.toml\"", "nowhere.toml: no such file"},
      {"[derived]\nplasticity.memory = {key = \"membrane.law\", factor = 2}", "allowed that of a number"},
      {"[derived]\nplasticity.memory = {kee = \"plasticity.tau\"}", "did you mean 'key'?"},
      {"[derived]\nplasticity.memory = \"bending.stiffness\"\nplasticity.tau = \"plasticity.memory\"", "which is derived itself"},
  }));
  INFO(text);
  CHECK_THROWS_WITH(plan_of(text), Contains(expected));
  CHECK_THROWS_AS(plan_of(text), InputError);
}

TEST_CASE("keys of [preparation] change what runs start from and not what they are", "[sweep]") {
  const std::string sweep = "[[list]]\nmembrane.law = [\"quadratic\", \"relative\"]\n";
  const SweepPlan own = plan_of(sweep), shared = plan_of(sweep + "[preparation]\nmembrane.law = \"quadratic\"\n");
  REQUIRE(shared.runs.size() == 2);
  CHECK(shared.runs[1].config.membrane.law == SpringLaw::relative);
  REQUIRE((shared.runs[0].preparation && shared.runs[1].preparation));
  CHECK(write_config(preparation_config(*shared.runs[1].preparation)) == write_config(preparation_config(shared.runs[0].config)));
  CHECK(write_config(preparation_config(own.runs[1].config)) != write_config(preparation_config(own.runs[0].config)));
  CHECK(shared.runs[1].key != own.runs[1].key);
  CHECK(parse_config(shared.runs[1].text(), "stored") == shared.runs[1].config);
}

TEST_CASE("an override of a swept key is refused", "[sweep]") {
  CHECK_THROWS_WITH(plan_of("[grid]\narea.stiffness = [1]", {.overrides = {"area.stiffness=2"}, .seeds = {}}),
                    Contains("allowed only for keys that are not swept"));
}
