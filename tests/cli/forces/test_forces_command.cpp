#include <catch2/catch.hpp>
#include <filesystem>

#include "support/program.hpp"
#include "support/reference_tissue.hpp"
#include "support/file_bytes.hpp"
#include "suture/io/state_csv.hpp"

using namespace suture;
using namespace suture::test;
using Catch::Matchers::Contains;

namespace {

const std::string state_file = std::string(SUTURE_SOURCE_DIR) + "/tests/data/perturbed_large.csv";

}  // namespace

TEST_CASE("suture forces writes what the library computes", "[cli]") {
  const TemporaryDirectory directory;
  const Outcome outcome = run_suture(SUTURE_PROGRAM,
                                     {"forces", state_file, "--set", "area.stiffness=3", "membrane.law=relative",
                                      "--set", "contact.adhesion=0", "--out", "out.csv"},
                                     directory.path());
  INFO(outcome.errors);
  REQUIRE(outcome.exit_code == 0);
  CHECK(directory.contents() == std::vector<std::string>{"out.csv", "out_energy.csv"});
  Config config;
  config.area.stiffness = 3.0;
  config.membrane.law = SpringLaw::relative;
  config.contact.adhesion = 0.0;
  const TissueState state = reference_state(config);
  const std::vector<TermForces> forces = evaluate_forces(state, config);
  write_forces_csv((directory.path() / "expected.csv").string(), state, forces);
  write_energy_csv((directory.path() / "expected_energy.csv").string(), forces);
  CHECK(read_bytes(directory.path() / "out.csv") == read_bytes(directory.path() / "expected.csv"));
  CHECK(read_bytes(directory.path() / "out_energy.csv") == read_bytes(directory.path() / "expected_energy.csv"));
}

TEST_CASE("suture forces refuses bad input and leaves nothing behind", "[cli]") {
  const TemporaryDirectory directory;
  directory.write("bad.csv", "cell,vertex,x,y,l0\n0,0,0,zero,1\n");
  directory.write("folded.csv", "cell,vertex,x,y,l0\n0,0,0,0,1\n0,1,1,0,1\n0,2,1,0,1\n0,3,1,1,1\n");
  const auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "forces");
    return run_suture(SUTURE_PROGRAM, arguments, directory.path());
  };
  const Outcome bad = run({"bad.csv", "--out", "out.csv"});
  CHECK(bad.exit_code == 2);
  CHECK_THAT(bad.errors, Contains("bad.csv:2: column y: 'zero' is not a number"));
  const Outcome missing = run({"missing.csv", "--out", "out.csv"});
  CHECK(missing.exit_code == 2);
  CHECK_THAT(missing.errors, Contains("missing.csv: cannot be read"));
  const Outcome misspelt = run({state_file, "--set", "area.stifness=1", "--out", "out.csv"});
  CHECK(misspelt.exit_code == 2);
  CHECK_THAT(misspelt.errors, Contains("area.stiffness"));
  CHECK(run({state_file}).exit_code == 2);
  const Outcome folded = run({"folded.csv", "--out", "out.csv"});
  CHECK(folded.exit_code == 3);
  CHECK_THAT(folded.errors, Contains("cell 0, vertex 1") && Contains("length zero"));
  CHECK(run({state_file, "--out", "nowhere/out.csv"}).exit_code == 3);
  CHECK(directory.contents() == std::vector<std::string>{"bad.csv", "folded.csv"});
}
