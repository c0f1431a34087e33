// output.adjacency: which cells the shapes are taken of.
#include <catch2/catch.hpp>

#include "support/program.hpp"
#include "suture/io/wound_csv.hpp"

using namespace suture::test;

namespace {

suture::WoundColumns run(const TemporaryDirectory& directory, const std::string& rule, int seed) {
  const std::string small = std::string(SUTURE_SOURCE_DIR) + "/examples/small.toml";
  REQUIRE(run_suture(SUTURE_PROGRAM,
                     {"run", small, "--quiet", "--overwrite", "--out", rule, "--set", "run.end_time=3", "--set", "output.adjacency=" + rule, "--set",
                      "tissue.seed=" + std::to_string(seed)},
                     directory.path())
              .exit_code == 0);
  return suture::read_wound_csv(directory.path() / rule / "wound.csv");
}

}  // namespace

TEST_CASE("the rule of adjacency changes the mean shape and nothing else", "[cli]") {
  const TemporaryDirectory directory;
  int differing = 0;  // in such small tissues the two rules may name the same cells
  for (const int seed : {1, 2, 3, 4}) {
    const auto outline = run(directory, "outline", seed), string = run(directory, "string", seed);
    REQUIRE(outline.time.size() == 7);
    CHECK(outline.wound_area == string.wound_area);
    differing += outline.mean_shape != string.mean_shape ? 1 : 0;
    for (const double shape : string.mean_shape) CHECK(shape > 1.0);
  }
  CHECK(differing >= 2);
}
