// What goes through a whole run does so frame by frame: its memory hardly grows with the length of the run.
#include <catch2/catch.hpp>

#include "support/program.hpp"
#include "support/reference_tissue.hpp"
#include "suture/io/trajectory.hpp"

using namespace suture;
using namespace suture::test;

namespace {

void write_run(const std::filesystem::path& path, int frames) {
  TrajectoryWriter writer(path, {.resolved_config = "[tissue]\nseed = 7\n", .seed = 7});
  TissueState state = reference_state(reference_config());
  for (int i = 0; i < frames; ++i) {
    state.time = i;
    for (double& value : state.values) value *= 1.0 + 1e-6;  // no two frames alike
    writer.write_frame(state);
    writer.commit();
  }
  writer.close();
}

}  // namespace

TEST_CASE("check, export and view do not keep the frames of a long run in memory", "[cli]") {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  WARN("not under a sanitizer, which keeps freed memory for itself");
#else
  constexpr int few = 300, many = 1200;  // few: enough to fill the caches
  const TemporaryDirectory directory;
  write_run(directory.path() / "short.h5", few);
  write_run(directory.path() / "long.h5", many);
  const double more_kB = (many - few) * 3 * 8 * reference_state(reference_config()).tissue.vertex_count() / 1024.0;  // x, y, l0
  const std::vector<std::vector<std::string>> commands = {
      {"check"}, {"export", "--format", "xdmf", "--out", "out"}, {"view", "--max-frames", "10", "--out", "view.html"}};
  for (std::vector<std::string> command : commands) {
    command.insert(command.begin() + 1, "short.h5");
    const Outcome short_run = run_suture(SUTURE_PROGRAM, command, directory.path());
    command[1] = "long.h5";
    const Outcome long_run = run_suture(SUTURE_PROGRAM, command, directory.path());
    CAPTURE(command[0], short_run.peak_kB, long_run.peak_kB, more_kB, long_run.errors);
    CHECK(short_run.exit_code == 0);
    CHECK(long_run.exit_code == 0);
    // Measured: 0.02 (check), 0.3 (export, which keeps its index, a text of 5 kB per frame), 0.1 (view).
    CHECK(static_cast<double>(long_run.peak_kB - short_run.peak_kB) < 0.4 * more_kB);
  }
#endif
}
