// A write, flush or rename that fails is said clearly, costs nothing that was written before, and can be made up for.
#include <catch2/catch.hpp>

#include <csignal>
#include <sstream>

#include "run_fixture.hpp"
#include "suture/io/trajectory_check.hpp"

using namespace suture;
using namespace suture::test;
using Catch::Matchers::Contains;

namespace {

struct FailingRun {
  int exit_code;
  long calls;
  std::string errors;
};

FailingRun run_with_failure(const TemporaryDirectory& directory, const std::string& call, long at, bool ever) {
  std::vector<std::string> environment{std::string("LD_PRELOAD=") + SUTURE_FAILING_CALLS, "SUTURE_FAIL_CALL=" + call,
                                       "SUTURE_FAIL_AT=" + std::to_string(at), "SUTURE_FAIL_LOG=" + (directory.path() / "calls").string()};
  if (ever) environment.push_back("SUTURE_FAIL_EVER=1");
  // The address sanitizer wants to be the first library; being the second, it only misses what fails before it is asked.
  const char* const asan_options = std::getenv("ASAN_OPTIONS");
  environment.push_back("ASAN_OPTIONS=verify_asan_link_order=0:" + std::string(asan_options != nullptr ? asan_options : ""));
  std::filesystem::remove(directory.path() / "calls");
  RunningProgram program(SUTURE_PROGRAM, busy_run("out", false), directory.path(), environment);
  FailingRun run{program.wait(), 0, read_bytes(directory.path() / "stderr")};
  std::istringstream(read_bytes(directory.path() / "calls")) >> run.calls;
  return run;
}

void check_remains(const std::filesystem::path& folder, const Trajectory& reference) {
  for (const char* name : {"checkpoint", "checkpoint.previous", "summary.json", "wound.csv"})
    if (std::filesystem::exists(folder / name)) {
      INFO(name);
      CHECK(check_file(folder / name).verdict == FileVerdict::valid);
    }
  if (!std::filesystem::exists(folder / "run.journal")) return;
  try {
    const Trajectory found = read_trajectory(folder / "run.journal");
    CHECK(same_content(found, reference, found.frames.size()));
  } catch (const std::exception&) {  // not even its first block was written
    CHECK(std::filesystem::file_size(folder / "run.journal") <= 16);
  }
}

}  // namespace

TEST_CASE("whichever write, fsync or rename fails, the run says so and can be resumed", "[cli][faults]") {
  const TemporaryDirectory directory = TemporaryDirectory::in_memory();
  REQUIRE(run_suture(SUTURE_PROGRAM, busy_run("reference", false), directory.path()).exit_code == 0);
  const Trajectory reference = read_trajectory(directory.path() / "reference/run.h5");
  int runs = 0, failed = 0;
  for (const std::string call : {"write", "fsync", "rename"})
    for (const bool ever : {true, false}) {
      const long calls = run_with_failure(directory, call, 0, ever).calls;
      REQUIRE(calls > 10);
      std::filesystem::remove_all(directory.path() / "out");
      const long stride = long_tests() ? every_nth() : std::max(1L, calls / 3);
      for (long at = long_tests() ? 1 : 1 + calls / 9; at <= calls; at += stride) {
        ++runs;
        CAPTURE(call, at, calls, ever);
        const FailingRun run = run_with_failure(directory, call, at, ever);
        // A failure that nobody waits for (status.json) may pass unnoticed; everything else is an error, never a crash.
        CHECK((run.exit_code == 3 || (run.exit_code == 0 && !ever)));
        if (run.exit_code == 3) {
          ++failed;
          CHECK_THAT(run.errors, Contains("suture: error: out"));
          CHECK_THAT(run.errors, Contains("cannot"));
        }
        check_remains(directory.path() / "out", reference);
        const Outcome resumed = run_suture(SUTURE_PROGRAM, busy_run("out", true), directory.path());
        CHECK(resumed.exit_code == 0);
        CHECK(same_content(read_trajectory(directory.path() / "out/run.h5"), reference));
        std::filesystem::remove_all(directory.path() / "out");
      }
    }
  CHECK(failed >= 10);
  WARN(runs << " failures injected, " << failed << " of them ended the run");
}

TEST_CASE("a disk that is full is a clear message, and what was computed stays", "[cli][faults]") {
  const TemporaryDirectory directory = TemporaryDirectory::in_memory();
  REQUIRE(run_suture(SUTURE_PROGRAM, busy_run("reference", false), directory.path()).exit_code == 0);
  const Trajectory reference = read_trajectory(directory.path() / "reference/run.h5");
  for (const int kilobytes : {4, 40, 80}) {
    // ulimit counts in blocks of 512 bytes in dash.
    std::vector<std::string> arguments{"-c", "ulimit -f " + std::to_string(2 * kilobytes) + "; exec \"$0\" \"$@\"", SUTURE_PROGRAM};
    for (const std::string& argument : busy_run("out", false)) arguments.push_back(argument);
    const Outcome full = run_suture("/bin/sh", arguments, directory.path());
    CAPTURE(kilobytes, full.errors);
    CHECK(full.exit_code == 3);
    CHECK_THAT(full.errors, Contains("cannot write") && Contains("File too large"));
    check_remains(directory.path() / "out", reference);
    CHECK(run_suture(SUTURE_PROGRAM, busy_run("out", true), directory.path()).exit_code == 0);
    CHECK(same_content(read_trajectory(directory.path() / "out/run.h5"), reference));
    std::filesystem::remove_all(directory.path() / "out");
  }
}
