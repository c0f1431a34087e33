#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <iterator>

#include "suture/errors.hpp"
#include "suture/io/config.hpp"

using namespace suture;
using Catch::Matchers::Contains;

namespace {

Config parsed(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_config(text, "test.toml", overrides);
}

}  // namespace

TEST_CASE("an empty configuration is the default one", "[unit]") {
  CHECK(parsed("") == Config{});
  CHECK(default_config() == Config{});
}

TEST_CASE("printed defaults parse back to the same configuration", "[unit]") {
  for (const std::string preset : {"printed", "published_code"})
    for (const Comments comments : {Comments::none, Comments::full}) {
      const Config config = default_config(preset);
      CHECK(parsed(write_config(config, comments)) == config);
    }
}

TEST_CASE("a configuration far from the defaults survives writing and reading", "[unit]") {
  const Config config = parsed(R"(
    [tissue]
    seed = 9000000000000000000
    cells = 20
    [plasticity]
    tau = inf
    memory = 0.1
    [contact]
    distance = 0.123456789012345678
    [purse_string]
    enabled = false
    [run]
    start_from = "a \"quoted\" \\ path"
    [integrator]
    method = "rkc"
    time_step = 1e-7
    [[cell_type]]
    name = "stiff"
    cells = 4
    area_stiffness = "1.28 kPa"
    tau = inf
    [[cell_type]]
    cells = 3
    vertices = 40
  )");
  CHECK(std::isinf(config.plasticity.tau));
  CHECK(config.integrator.method == Method::rkc2);
  REQUIRE(config.cell_types.size() == 2);
  CHECK(config.cell_types[0].area_stiffness.value() == Approx(32.0));
  CHECK(config.cell_types[1].vertices.value() == 40);
  CHECK_FALSE(config.cell_types[1].tau.has_value());
  CHECK(parsed(write_config(config)) == config);
  CHECK(parsed(write_config(config, Comments::full)) == config);
}

TEST_CASE("presets are bundles of defaults that explicit keys override in any order", "[unit]") {
  const Config published = default_config("published_code");
  CHECK(published.membrane.law == SpringLaw::relative);
  CHECK(published.purse_string.law == SpringLaw::relative);
  CHECK(published.purse_string.minimum_rest_length == 0.005);
  CHECK(published.purse_string.tether_law == TetherLaw::published);
  CHECK(published.purse_string.capture_law == CaptureLaw::slip);
  CHECK(published.purse_string.capture_search == CaptureSearch::published);
  CHECK(published.purse_string.gap_law == GapLaw::span);
  CHECK(published.purse_string.event_handling == EventHandling::each_step);
  CHECK(published.integrator.method == Method::euler);
  CHECK_FALSE(published.integrator.time_step.has_value());
  CHECK(parsed("preset = \"published_code\"") == published);
  CHECK(parsed("", {"preset=published_code"}) == published);

  Config expected = published;
  expected.integrator.method = Method::cvode;
  CHECK(parsed("preset = \"published_code\"\n[integrator]\nmethod = \"cvode\"") == expected);
  CHECK(parsed("[integrator]\nmethod = \"cvode\"", {"preset=published_code"}) == expected);
  CHECK(parsed("preset = \"published_code\"", {"integrator.method=cvode", "preset=published_code"}) == expected);
  CHECK(parsed("preset = \"published_code\"", {"preset=printed"}) == Config{});
  CHECK_THROWS_AS(default_config("other"), InputError);
}

TEST_CASE("physical quantities are converted with the scales of [units], wherever these stand", "[unit]") {
  const Config config = parsed("[plasticity]\ntau = \"85 min\"\n[area]\nB = \"0.64 kPa\"\n[units]\na0 = \"25 um^2\"\n");
  CHECK(config.plasticity.tau == Approx(306.0));
  CHECK(config.area.stiffness == Approx(16.0));
  CHECK(config.units.rest_area_um2 == 25.0);
  CHECK(parsed("[area]\nbulk_modulus = \"2 kPa\"\n[units]\nrest_area = 16").area.stiffness == Approx(32.0));
  CHECK(parsed("[area]\nstiffness = \"2 kPa\"\n[units]\na0 = 16").area.stiffness == Approx(32.0));
  CHECK(parsed("", {"plasticity.tau=85 min"}).plasticity.tau == Approx(306.0));
  CHECK(parsed("", {"plasticity.tau=\"85 min\"", "units.a0=16"}).plasticity.tau == Approx(5100.0 / (4.0 / 0.3)));
  CHECK(parsed("[contact]\ndistance = \"650 nm\"").contact.distance.value() == Approx(0.13));
  CHECK(parsed("[run]\nclosed_area = \"2.5 um^2\"").run.closed_area == Approx(0.1));
  CHECK(parsed("[purse_string]\nconstriction_rate = \"0.6 um/s\"").purse_string.constriction_rate == Approx(2.0));
  CHECK(parsed("[dipole]\nforce = \"20 pN\"").dipole.force == Approx(0.02));
  CHECK(parsed("[units]\nunsticking_force = \"0.002 uN\"").units.unsticking_force_nN == Approx(2.0));
  CHECK(std::isinf(parsed("[plasticity]\ntau = \"inf s\"").plasticity.tau));
}

TEST_CASE("overrides take TOML values and bare words, and the last one wins", "[unit]") {
  const Config config =
      parsed("[area]\nstiffness = 4",
             {"area.stiffness=8", "area.stiffness = 32", "plasticity.tau=inf", "purse_string.tether_law=ramp",
              "purse_string.capture=false", "tissue.seed=7", "membrane={stiffness=2.0}"});
  CHECK(config.area.stiffness == 32.0);
  CHECK(std::isinf(config.plasticity.tau));
  CHECK(config.purse_string.tether_law == TetherLaw::ramp);
  CHECK_FALSE(config.purse_string.capture);
  CHECK(config.tissue.seed == 7);
  CHECK(config.membrane.stiffness == 2.0);
  const Config typed = parsed("[[cell_type]]\ncells = 3", {"cell_type=[{cells=1}, {cells=2, tau=5}]"});
  REQUIRE(typed.cell_types.size() == 2);
  CHECK(typed.cell_types[1].tau.value() == 5.0);
}

TEST_CASE("messages say where, which key, what was found and what is allowed", "[unit]") {
  CHECK_THROWS_WITH(parsed("# first line\n[plasticty]\ntau = 3"),
                    Contains("test.toml:2:") && Contains("'plasticty'") && Contains("did you mean 'plasticity'?"));
  CHECK_THROWS_WITH(parsed("[plasticity]\n  tua = 3"),
                    Contains("test.toml:2:3: key 'plasticity.tua': found an unknown key") &&
                        Contains("did you mean 'plasticity.tau'?"));
  CHECK_THROWS_WITH(parsed("tau = 3"), Contains("did you mean 'plasticity.tau'?"));
  CHECK_THROWS_WITH(parsed("[membrane]\nlaw = \"quadatic\""),
                    Contains("test.toml:2:1: key 'membrane.law': found \"quadatic\", allowed one of relative, "
                             "quadratic, did you mean 'quadratic'?"));
  CHECK_THROWS_WITH(parsed("", {"area.stiffness=-1"}),
                    Contains("command line: --set area.stiffness=-1: key 'area.stiffness': found -1"));
  CHECK_THROWS_WITH(parsed("[tissue]\ncells = 5\n[wound]\ncells = 5"),
                    Contains("test.toml:4:1: key 'wound.cells': found 5, allowed less than tissue.cells = 5"));
  CHECK_THROWS_WITH(parsed("[area]\nstiffness = 1\nB = \"1 kPa\""),
                    Contains("test.toml:3:1") && Contains("second time") && Contains("test.toml:2:1"));
  CHECK_THROWS_WITH(parsed("[area]\nB = 0.64"), Contains("found 0.64 without a unit for 'B'"));
  CHECK_THROWS_WITH(parsed("[area]\nstiffness = \"0.64 min\""), Contains("Pa, kPa, MPa"));
}

TEST_CASE("files that cannot be read are input errors", "[unit]") {
  CHECK_THROWS_AS(read_config("/does/not/exist.toml"), InputError);
  CHECK_THROWS_AS(read_config("/tmp"), InputError);
}

TEST_CASE("config_value prints any key, and explain says what it means", "[unit]") {
  const Config config;
  CHECK(config_value(config, "area.stiffness") == "16.0");
  CHECK(config_value(config, "membrane.law") == "\"quadratic\"");
  CHECK(config_value(config, "contact.distance").empty());
  CHECK_THROWS_AS(config_value(config, "area.stifness"), InputError);
  CHECK_THAT(explain_config_key("plasticity.tau"), Contains("default: 9.6") && Contains("s, min, h"));
  CHECK_THAT(explain_config_key("cell_type.tau"), Contains("plasticity.tau"));
  CHECK_THAT(explain_config_key("area.B"), Contains("area.stiffness"));
  CHECK_THAT(explain_config_key("purse_string"), Contains("purse_string.tether_law"));
  CHECK_THROWS_WITH(explain_config_key("area.stifness"), Contains("did you mean 'area.stiffness'?"));
}

TEST_CASE("docs/reference/config.md is what `suture config --reference` prints", "[unit]") {
  std::ifstream file{SUTURE_SOURCE_DIR "/docs/reference/config.md"};
  REQUIRE(file);
  const std::string text{std::istreambuf_iterator<char>{file}, {}};
  CHECK(text == config_reference());
}

TEST_CASE("every example configuration is valid", "[unit]") {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator{SUTURE_SOURCE_DIR "/examples"})
    if (entry.path().extension() == ".toml" && entry.path().stem().string().find("sweep") == std::string::npos) {
      INFO(entry.path());
      CHECK_NOTHROW(read_config(entry.path()));
      ++count;
    }
  CHECK(count >= 7);
}
