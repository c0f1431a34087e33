// A write that fails half-way, as on a full disk, must cost neither the old file nor what is still in memory.
#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <csignal>

#include "support/file_bytes.hpp"
#include "support/program.hpp"
#include "support/sample_tissue.hpp"
#include "suture/errors.hpp"
#include "suture/io/trajectory.hpp"

using namespace suture;
using namespace suture::test;
using Catch::Matchers::Contains;

namespace {

// While it lives, no file of this process may grow beyond `bytes`.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

}  // namespace

TEST_CASE("a commit that runs out of room leaves the last one in place and can be repeated", "[unit]") {
  const TemporaryDirectory folder;
  const auto path = folder.path() / "run.h5";
  TrajectoryWriter writer(path, Provenance{});
  TissueState state = sample_tissue();
  writer.write_frame(state);
  writer.commit();
  const std::string committed = read_bytes(path);
  state.time += 1.0;
  writer.write_frame(state);
  {
    const FileSizeLimit limit(10000);
    CHECK_THROWS_AS(writer.commit(), FileError);
    CHECK_THROWS_WITH(writer.close(), Contains("cannot write"));
  }
  CHECK(read_bytes(path) == committed);
  CHECK(folder.contents() == std::vector<std::string>{"run.h5"});
  writer.close();
  const Trajectory trajectory = read_trajectory(path);
  CHECK(trajectory.complete);
  CHECK(trajectory.frames.size() == 2);
}
