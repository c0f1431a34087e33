// output.adjacency: which cells the shapes are taken of.
#include <catch2/catch.hpp>

#include <sstream>

#include "support/file_bytes.hpp"
#include "support/program.hpp"

using namespace suture::test;

namespace {

/// The second sample of a run: fields of wound.csv.
std::vector<std::string> second_sample(const TemporaryDirectory& directory, const std::string& rule) {
  const std::string small = std::string(SUTURE_SOURCE_DIR) + "/examples/small.toml";
  REQUIRE(run_suture(SUTURE_PROGRAM,
                     {"run", small, "--quiet", "--out", rule, "--set", "run.end_time=1", "--set", "output.adjacency=" + rule},
                     directory.path())
              .exit_code == 0);
  std::istringstream stream(read_bytes(directory.path() / rule / "wound.csv"));
  std::string line, field;
  for (int row = 0; row < 3; ++row) std::getline(stream, line);
  std::vector<std::string> fields;
  for (std::istringstream rest(line); std::getline(rest, field, ',');) fields.push_back(field);
  REQUIRE(fields.size() > 6);
  return fields;
}

}  // namespace

TEST_CASE("the rule of adjacency changes the mean shape and nothing else", "[cli]") {
  const TemporaryDirectory directory;
  const auto outline = second_sample(directory, "outline"), string = second_sample(directory, "string");
  constexpr std::size_t wound_area = 2, mean_shape = 5, perimeter = 6;
  CHECK(outline[wound_area] == string[wound_area]);
  CHECK(outline[perimeter] == string[perimeter]);
  CHECK(outline[mean_shape] != string[mean_shape]);
  CHECK(std::stod(string[mean_shape]) > 1.0);
}
