// Stopping and resuming as a user does it.
#include <catch2/catch.hpp>

#include <chrono>
#include <csignal>
#include <thread>

#include "support/file_bytes.hpp"
#include "support/program.hpp"
#include "suture/io/trajectory.hpp"

using namespace suture;
using namespace suture::test;
using Catch::Matchers::Contains;

namespace {

/// Long enough to be caught: a closure that is never over, in tiny steps.
std::vector<std::string> endless(const std::string& out, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"run", std::string(SUTURE_SOURCE_DIR) + "/examples/small.toml", "--quiet", "--out", out,
                                     "--set", "integrator.method=euler", "--set", "integrator.time_step=1e-5",
                                     "--set", "output.interval=0.001", "--set", "output.pictures=1"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

std::vector<std::string> quick(const std::string& out, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"run", std::string(SUTURE_SOURCE_DIR) + "/examples/small.toml", "--quiet", "--out", out,
                                     "--set", "output.pictures=0"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

void wait_for(const std::filesystem::path& journal, std::uintmax_t bytes) {
  std::error_code ignored;
  for (int i = 0; i < 6000; ++i, std::this_thread::sleep_for(std::chrono::milliseconds(10)))
    if (const auto size = std::filesystem::file_size(journal, ignored); !ignored && size > bytes) return;
  FAIL("the run does not get going");
}

}  // namespace

TEST_CASE("SIGINT, SIGTERM and SIGUSR1 stop a run with a checkpoint and readable output, code 75", "[cli][resume]") {
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) {
    const TemporaryDirectory directory;
    RunningProgram program(SUTURE_PROGRAM, endless("out"), directory.path());
    wait_for(directory.path() / "out/run.journal", 40000);
    program.send(signal);
    if (signal != SIGINT) program.send(signal);  // batch systems repeat themselves
    CHECK(program.wait() == 75);
    for (const char* name : {"out/checkpoint", "out/run.h5", "out/wound.csv", "out/summary.json", "out/final.png"}) {
      INFO(name);
      CHECK(std::filesystem::exists(directory.path() / name));
    }
    const Outcome status = run_suture(SUTURE_PROGRAM, {"status", "out"}, directory.path());
    CHECK(status.exit_code == 0);
    CHECK_THAT(status.output, Contains("stopped") && Contains("--resume"));
    CHECK(run_suture(SUTURE_PROGRAM, {"check", "out/run.journal"}, directory.path()).exit_code == 0);
    CHECK(run_suture(SUTURE_PROGRAM, {"check", "out/checkpoint"}, directory.path()).exit_code == 0);
    // And again: it goes on from there.
    const Trajectory before = read_trajectory(directory.path() / "out/run.h5");
    const Outcome again = run_suture(SUTURE_PROGRAM, endless("out", {"--resume", "--max-wall", "0.3s"}), directory.path());
    CHECK(again.exit_code == 75);
    const Trajectory after = read_trajectory(directory.path() / "out/run.h5");
    CHECK(after.observable("wound_area")->time.size() > before.observable("wound_area")->time.size());
    REQUIRE(after.continuations.size() == 1);
    CHECK(!after.continuations[0].reproducible);
  }
}

TEST_CASE("a second SIGINT ends a run at once", "[cli][resume]") {
  const TemporaryDirectory directory;
  RunningProgram program(SUTURE_PROGRAM, endless("out"), directory.path());
  wait_for(directory.path() / "out/run.journal", 40000);
  program.send(SIGINT);
  program.send(SIGINT);
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
  program.send(SIGINT);
  const int code = program.wait();
  CHECK((code == 130 || code == 75));  // two signals that arrive together are one
}

TEST_CASE("a run that is stopped as soon as it starts can be resumed until it is done", "[cli][resume]") {
  const TemporaryDirectory directory;
  REQUIRE(run_suture(SUTURE_PROGRAM, quick("out", {"--max-wall", "0"}), directory.path()).exit_code == 75);
  const Outcome refused = run_suture(SUTURE_PROGRAM, quick("out"), directory.path());
  CHECK(refused.exit_code == 2);
  CHECK_THAT(refused.errors, Contains("not finished") && Contains("--resume") && Contains("--overwrite"));
  const Outcome changed =
      run_suture(SUTURE_PROGRAM, quick("out", {"--resume", "--set", "area.stiffness=17", "--set", "run.end_time=150"}), directory.path());
  CHECK(changed.exit_code == 2);
  CHECK_THAT(changed.errors, Contains("area.stiffness was 16.0, is 17.0") && !Contains("end_time"));
  REQUIRE(run_suture(SUTURE_PROGRAM, quick("out", {"--resume"}), directory.path()).exit_code == 0);
  const auto check_gone = [&] {
    for (const char* gone : {"run.journal", "checkpoint", "checkpoint.previous", "status.json"})
      CHECK(!std::filesystem::exists(directory.path() / "out" / gone));
  };
  check_gone();
  const std::string done = read_bytes(directory.path() / "out/run.h5");
  for (const char* left : {"checkpoint", "checkpoint.previous", "status.json"})  // as by a program killed at the very end
    write_bytes(directory.path() / "out" / left, "left");
  CHECK(run_suture(SUTURE_PROGRAM, quick("out", {"--resume"}), directory.path()).exit_code == 0);
  check_gone();
  CHECK(read_bytes(directory.path() / "out/run.h5") == done);
  CHECK_THAT(run_suture(SUTURE_PROGRAM, {"status", "out"}, directory.path()).output, Contains("finished: closed"));
  REQUIRE(run_suture(SUTURE_PROGRAM, quick("whole"), directory.path()).exit_code == 0);
  CHECK(read_bytes(directory.path() / "whole/wound.csv").size() > 1000);
}

TEST_CASE("a damaged checkpoint gives way to the previous one, and without any, what was computed is not thrown away", "[cli][resume]") {
  const TemporaryDirectory directory;
  const std::vector<std::string> keys{"--set", "checkpoint.interval=1", "--set", "run.end_time=5"};
  REQUIRE(run_suture(SUTURE_PROGRAM, quick("whole", keys), directory.path()).exit_code == 0);
  RunningProgram program(SUTURE_PROGRAM, quick("out", keys), directory.path());
  const auto exists = [&](const char* name) { return std::filesystem::exists(directory.path() / "out" / name); };
  // Both: the previous one is there a moment before the present one takes its place.
  for (int i = 0; i < 60000 && !(exists("checkpoint.previous") && exists("checkpoint")); ++i)
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  program.send(SIGKILL);
  if (program.wait() != -SIGKILL) return;  // it was faster
  REQUIRE(exists("checkpoint"));
  std::string bytes = read_bytes(directory.path() / "out/checkpoint");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
  write_bytes(directory.path() / "out/checkpoint", bytes);
  std::filesystem::copy(directory.path() / "out", directory.path() / "bad");
  std::filesystem::resize_file(directory.path() / "bad/checkpoint.previous", 100);
  std::vector<std::string> resume = keys;
  resume.push_back("--resume");
  REQUIRE(run_suture(SUTURE_PROGRAM, quick("out", resume), directory.path()).exit_code == 0);
  CHECK(read_bytes(directory.path() / "out/wound.csv") == read_bytes(directory.path() / "whole/wound.csv"));

  const Outcome refused = run_suture(SUTURE_PROGRAM, quick("bad", resume), directory.path());
  CHECK(refused.exit_code == 2);
  CHECK_THAT(refused.errors, Contains("no checkpoint can be used") && Contains("damaged") && Contains("suture recover bad"));
  const Outcome recovered = run_suture(SUTURE_PROGRAM, {"recover", "bad"}, directory.path());
  CHECK(recovered.exit_code == 0);
  CHECK_THAT(recovered.output, Contains("recovered"));
  CHECK(!read_trajectory(directory.path() / "bad/run.h5").stages.empty());
}

TEST_CASE("wall times are read as people and Slurm write them", "[cli][resume]") {
  const TemporaryDirectory directory;
  for (const char* good : {"100", "100s", "100 s", "1.5h", "2min", "1d", "00:10:00", "1-00:00:00"})
    CHECK(run_suture(SUTURE_PROGRAM, {"run", std::string(SUTURE_SOURCE_DIR) + "/examples/dipole.toml", "--quiet", "--max-wall", good},
                     directory.path()).exit_code == 0);
  for (const char* bad : {"soon", "-5", "10 years", "1:2", ":::"}) {
    const Outcome refused = run_suture(
        SUTURE_PROGRAM, {"run", std::string(SUTURE_SOURCE_DIR) + "/examples/dipole.toml", "--out", "bad", std::string("--max-wall=") + bad},
        directory.path());
    CAPTURE(bad);
    CHECK(refused.exit_code == 2);
    CHECK(!std::filesystem::exists(directory.path() / "bad"));
  }
}
