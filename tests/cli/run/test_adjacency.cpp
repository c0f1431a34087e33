// output.adjacency: which cells the shapes are taken of.
#include <catch2/catch.hpp>

#include "support/program.hpp"
#include "suture/io/wound_csv.hpp"

using namespace suture::test;

namespace {

suture::WoundColumns run(const TemporaryDirectory& directory, const std::string& rule) {
  const std::string small = std::string(SUTURE_SOURCE_DIR) + "/examples/small.toml";
  REQUIRE(run_suture(SUTURE_PROGRAM,
                     {"run", small, "--quiet", "--out", rule, "--set", "run.end_time=3", "--set", "output.adjacency=" + rule},
                     directory.path())
              .exit_code == 0);
  return suture::read_wound_csv(directory.path() / rule / "wound.csv");
}

}  // namespace

TEST_CASE("the rule of adjacency changes the mean shape and nothing else", "[cli]") {
  const TemporaryDirectory directory;
  const auto outline = run(directory, "outline"), string = run(directory, "string");
  REQUIRE(outline.time.size() == 7);
  CHECK(outline.wound_area == string.wound_area);
  CHECK(outline.mean_shape != string.mean_shape);
  for (const double shape : string.mean_shape) CHECK(shape > 1.0);
}
