// Claims on runs among processes that may be killed at any time.
#include "suture/sweep/claim.hpp"

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <ctime>
#include <fstream>
#include <vector>

#include "support/program.hpp"

using namespace suture;

namespace {

constexpr double lease = 300.0;

/// A process that has claimed "work" and waits to be killed.
pid_t holder(const std::filesystem::path& folder) {
  int ready[2];
  REQUIRE(pipe(ready) == 0);
  const pid_t child = fork();
  if (child == 0) {
    const auto claim = Claim::take(folder, "work", lease);
    const char answer = claim ? 'y' : 'n';
    if (write(ready[1], &answer, 1) == 1) pause();
    _exit(0);
  }
  char answer = 0;
  REQUIRE(read(ready[0], &answer, 1) == 1);
  REQUIRE(answer == 'y');
  close(ready[0]), close(ready[1]);
  return child;
}

void age(const std::filesystem::path& file, double seconds) {
  const timespec then{std::time(nullptr) - static_cast<time_t>(seconds), 0};
  const timespec times[2] = {then, then};
  REQUIRE(utimensat(AT_FDCWD, file.c_str(), times, 0) == 0);
}

}  // namespace

TEST_CASE("what is claimed cannot be claimed again until it is given back", "[sweep]") {
  const test::TemporaryDirectory folder;
  {
    const auto first = Claim::take(folder.path(), "work", lease);
    REQUIRE(first);
    CHECK_FALSE(Claim::take(folder.path(), "work", lease));
    CHECK(Claim::take(folder.path(), "other", lease));
    CHECK(Claim::held(folder.path(), "work", lease));
  }
  CHECK_FALSE(Claim::held(folder.path(), "work", lease));
  CHECK(Claim::take(folder.path(), "work", lease));
  CHECK(folder.contents().empty());
}

TEST_CASE("the claim of a killed process on this machine is taken over at once, that of a living one is not", "[sweep]") {
  const test::TemporaryDirectory folder;
  const pid_t child = holder(folder.path());
  CHECK_FALSE(Claim::take(folder.path(), "work", lease));
  kill(child, SIGKILL);
  siginfo_t dead{};
  waitid(P_PID, child, &dead, WEXITED | WNOWAIT);  // dead, but its parent has not asked for it yet
  auto claim = Claim::take(folder.path(), "work", lease);
  CHECK(claim);
  waitpid(child, nullptr, 0);
  CHECK_FALSE(Claim::take(folder.path(), "work", lease));
  REQUIRE(claim);
  claim->finish();
  claim.reset();
  CHECK(folder.contents().empty());
}

TEST_CASE("a claim from another machine holds as long as its lease", "[sweep]") {
  const test::TemporaryDirectory folder;
  folder.write("work.1", "elsewhere boot pid:[1]\n1234\n5678\n");
  CHECK_FALSE(Claim::take(folder.path(), "work", lease));
  age(folder.path() / "work.1", lease + 60.0);
  CHECK(Claim::take(folder.path(), "work", lease));
}

TEST_CASE("of many processes that want a dead claim exactly one gets it", "[sweep]") {
  const test::TemporaryDirectory folder;
  constexpr int rounds = 20, takers = 8;
  for (int round = 0; round < rounds; ++round) {
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) std::filesystem::remove(entry);
    folder.write("work.1", "elsewhere boot pid:[1]\n1234\n5678\n");
    age(folder.path() / "work.1", lease + 60.0);
    int start[2], hold[2];
    REQUIRE((pipe(start) == 0 && pipe(hold) == 0));
    std::vector<pid_t> children;
    for (int k = 0; k < takers; ++k) {
      const pid_t child = fork();
      if (child == 0) {
        close(start[1]), close(hold[1]);
        char none;
        if (read(start[0], &none, 1) != 0) _exit(9);  // returns when the parent closes its end
        const auto claim = Claim::take(folder.path(), "work", lease);
        std::ofstream(folder.path().string() + "/result." + std::to_string(k)) << (claim ? 1 : 0);
        if (read(hold[0], &none, 1) != 0) _exit(9);  // holds until everybody has tried
        _exit(0);
      }
      children.push_back(child);
    }
    close(start[0]), close(start[1]);
    int holders = 0;
    for (int k = 0; k < takers; ++k) {
      const std::filesystem::path result = folder.path() / ("result." + std::to_string(k));
      int won = -1;
      while (won < 0) {
        std::ifstream stream(result);
        if (!(stream >> won)) won = -1, usleep(1000);
      }
      holders += won;
    }
    close(hold[0]), close(hold[1]);
    for (const pid_t child : children) waitpid(child, nullptr, 0);
    CHECK(holders == 1);
  }
}
