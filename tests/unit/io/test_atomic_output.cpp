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

TEST_CASE("a commit that runs out of room leaves the journal whole and can be repeated", "[unit]") {
  const TemporaryDirectory folder;
  const auto path = folder.path() / "run.h5", journal = folder.path() / "run.journal";
  TrajectoryWriter writer(path, Provenance{});
  TissueState state = sample_tissue();
  writer.write_frame(state);
  writer.commit();
  const std::string committed = read_bytes(journal);
  state.time += 1.0;
  writer.write_frame(state);
  {
    const FileSizeLimit limit(committed.size() + 1000);
    CHECK_THROWS_WITH(writer.commit(), Contains("run.journal: cannot write"));
    CHECK(read_bytes(journal) == committed);
    CHECK_THROWS_WITH(writer.close(), Contains("cannot write"));
  }
  CHECK(read_bytes(journal) == committed);
  CHECK(folder.contents() == std::vector<std::string>{"run.journal"});
  writer.close();
  const Trajectory trajectory = read_trajectory(path);
  CHECK(trajectory.complete);
  CHECK(trajectory.frames.size() == 2);
}

TEST_CASE("a run.h5 that finds no room leaves the old one, the journal and a working HDF5 library", "[unit]") {
  const TemporaryDirectory folder;
  const auto path = folder.path() / "run.h5";
  TrajectoryWriter writer(path, Provenance{});
  TissueState state = sample_tissue();
  for (int i = 0; i < 20; ++i, state.time += 1.0) writer.write_frame(state);
  writer.publish(/*complete=*/false);
  const std::string published = read_bytes(path);
  writer.commit();
  for (const std::size_t room : {published.size() / 10, published.size() / 2, published.size() - 100}) {
    const FileSizeLimit limit(room);
    CHECK_THROWS_WITH(writer.publish(true), Contains("run.h5: cannot write"));
    CHECK(read_bytes(path) == published);
    CHECK(folder.contents() == std::vector<std::string>{"run.h5", "run.journal"});
  }
  writer.close();
  CHECK(read_trajectory(path).complete);
}
