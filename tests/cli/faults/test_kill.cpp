// A run that is killed again and again, at random moments, loses nothing that was written and ends in the same bits.
#include <catch2/catch.hpp>

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "run_fixture.hpp"
#include "suture/io/trajectory_check.hpp"

using namespace suture;
using namespace suture::test;

namespace {

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Whatever the kill left: every file with a final name is whole, and the frames are those of the undisturbed run.
void check_remains(const std::filesystem::path& folder, const Trajectory& reference, std::size_t& frames_before) {
  for (const char* name : {"checkpoint", "checkpoint.previous", "summary.json", "wound.csv"})
    if (std::filesystem::exists(folder / name)) {
      INFO(name);
      CHECK(check_file(folder / name).verdict == FileVerdict::valid);
    }
  if (std::filesystem::exists(folder / "run.h5")) CHECK(check_file(folder / "run.h5").verdict != FileVerdict::unreadable);
  if (!std::filesystem::exists(folder / "run.journal")) return;
  const Trajectory found = read_trajectory(folder / "run.journal");
  CHECK(same_content(found, reference, found.frames.size()));
  frames_before = found.frames.size();
}

}  // namespace

TEST_CASE("SIGKILL at random moments costs nothing that was written, and resuming ends in the same bits", "[cli][faults]") {
  const TemporaryDirectory directory = TemporaryDirectory::in_memory();
  const double duration = seconds_of([&] {
    REQUIRE(run_suture(SUTURE_PROGRAM, busy_run("reference", false), directory.path()).exit_code == 0);
  });
  const Trajectory reference = read_trajectory(directory.path() / "reference/run.h5");
  REQUIRE(reference.frames.size() > 8);
#if defined(__SANITIZE_ADDRESS__)
  const int wanted = long_tests() ? 220 : 20;  // programs are ten times slower
#else
  constexpr int wanted = 220;
#endif
  int kills = 0, finished = 0, resumed = 0;
  std::mt19937 random(20261122);
  std::size_t frames = 0;
  while (kills < wanted || finished == 0) {
    RunningProgram program(SUTURE_PROGRAM, busy_run("out", true), directory.path());
    // In the end it is left alone, so that it gets there also on a machine that is busy now.
    if (kills < wanted) {
      const double delay = std::uniform_real_distribution(0.0, duration)(random);
      std::this_thread::sleep_for(std::chrono::duration<double>(delay));
      program.send(SIGKILL);
    }
    const int result = program.wait();
    if (result == -SIGKILL) {
      ++kills;
      check_remains(directory.path() / "out", reference, frames);
      continue;
    }
    REQUIRE(result == 0);
    ++finished;
    const Trajectory found = read_trajectory(directory.path() / "out/run.h5");
    CHECK(found.complete);
    CHECK(same_content(found, reference));
    for (const Continuation& continuation : found.continuations) CHECK(continuation.reproducible);
    resumed += !found.continuations.empty();
    CHECK(read_bytes(directory.path() / "out/wound.csv") == read_bytes(directory.path() / "reference/wound.csv"));
    CHECK(!std::filesystem::exists(directory.path() / "out/checkpoint"));
    std::filesystem::remove_all(directory.path() / "out");
  }
  CHECK(kills >= wanted);
  CHECK(resumed > 0);
  WARN(kills << " kills, " << finished << " runs finished, " << resumed << " of them resumed");
}
