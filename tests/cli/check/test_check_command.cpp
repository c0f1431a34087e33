#include <catch2/catch.hpp>

#include "support/file_bytes.hpp"
#include "support/program.hpp"
#include "support/sample_tissue.hpp"
#include "suture/io/trajectory.hpp"

using namespace suture;
using namespace suture::test;
using Catch::Matchers::Contains;

namespace {

Outcome check(const TemporaryDirectory& directory, const std::string& file) {
  return run_suture(SUTURE_PROGRAM, {"check", file}, directory.path());
}

}  // namespace

TEST_CASE("suture check tells good, unfinished and foreign files apart by exit code", "[cli]") {
  const TemporaryDirectory directory;
  TrajectoryWriter writer(directory.path() / "run.h5", Provenance{});
  writer.write_frame(sample_tissue());
  writer.publish(/*complete=*/false);
  const Outcome unfinished = check(directory, "run.h5");
  CHECK(unfinished.exit_code == 3);
  CHECK_THAT(unfinished.output, Contains("run.h5: INVALID") && Contains("did not finish"));

  writer.close();
  const Outcome good = check(directory, "run.h5");
  CHECK(good.exit_code == 0);
  CHECK(good.errors.empty());
  CHECK_THAT(good.output, Contains("run.h5: valid") && Contains("1 frames"));

  const std::string bytes = read_bytes(directory.path() / "run.h5");
  directory.write("short.h5", bytes.substr(0, bytes.size() / 3));
  for (const char* name : {"short.h5", "absent.h5"}) {
    const Outcome bad = check(directory, name);
    CHECK(bad.exit_code == 2);
    CHECK(bad.output.empty());
    CHECK_THAT(bad.errors, Contains("not a readable suture file"));
  }
  CHECK(check(directory, ".").exit_code == 0);  // the files of a run in it: run.h5
  const TemporaryDirectory empty;
  CHECK(check(empty, ".").exit_code == 2);
}
