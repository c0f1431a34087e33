#include <catch2/catch.hpp>
#include <cstdlib>

#include "support/file_bytes.hpp"
#include "support/program.hpp"
#include "support/sample_run.hpp"
#include "suture/errors.hpp"
#include "suture/render/movie.hpp"
#include "suture/render/run_pictures.hpp"

using namespace suture;
using namespace suture::test;
using Catch::Matchers::Contains;

namespace {

// Sets SUTURE_FFMPEG while it lives.
class Ffmpeg {
 public:
  explicit Ffmpeg(const char* program) { setenv("SUTURE_FFMPEG", program, 1); }
  ~Ffmpeg() { unsetenv("SUTURE_FFMPEG"); }
};

struct Sample {
  TemporaryDirectory folder;
  Sample() { write_sample_run(folder.path() / "run.h5"); }
  Replay replay() const { return Replay(folder.path() / "run.h5"); }
};

}  // namespace

TEST_CASE("stills of a run: one file per frame and format, each field another picture", "[unit]") {
  const Sample sample;
  const Replay replay = sample.replay();
  std::vector<std::string> pictures;
  for (const char* field : {"shape_parameter", "membrane_tension", "rest_length_strain", "contacts"}) {
    const RunPictures run(replay, {.field = field, .frames = {0, 2}, .size = 200, .range = {}});
    CHECK(run.write_stills(sample.folder.path() / field, {"png", "svg"}) == 4);
    pictures.push_back(read_bytes(sample.folder.path() / field / "frame_0002.png"));
    CHECK(read_bytes(sample.folder.path() / field / "frame_0000.svg").starts_with("<?xml"));
    for (std::size_t i = 0; i + 1 < pictures.size(); ++i) CHECK(pictures[i] != pictures.back());
  }
  CHECK_THROWS_WITH(RunPictures(replay, {.field = "shape", .frames = {0}, .size = 200, .range = {}}), Contains("unknown field 'shape'"));
  CHECK_THROWS_WITH(RunPictures(replay, {.field = "force_x", .frames = {0}, .size = 200, .range = {}}), Contains("cannot be drawn"));
  CHECK_THROWS_WITH(RunPictures(replay, {.frames = {0}, .size = 200, .range = {{2.0, 1.0}}}), Contains("empty"));
}

TEST_CASE("a strip shows as many panels as asked for", "[unit]") {
  const Sample sample;
  const Replay replay = sample.replay();
  const RunPictures run(replay, {.frames = {0, 1, 2, 3}, .size = 100, .range = {}});
  run.write_strip(sample.folder.path() / "two.svg", 2);
  run.write_strip(sample.folder.path() / "all.svg", 9);
  CHECK(read_bytes(sample.folder.path() / "two.svg").size() < read_bytes(sample.folder.path() / "all.svg").size());
}

TEST_CASE("a movie is made by ffmpeg, whole or not at all", "[unit]") {
  const Sample sample;
  const Replay replay = sample.replay();
  const RunPictures run(replay, {.frames = {0, 1, 2}, .size = 65, .range = {}});
  const auto movie = sample.folder.path() / "run.mp4";
  {
    const Ffmpeg missing("/nonexistent/ffmpeg");
    CHECK_THROWS_WITH(run.write_movie(movie, 25), Contains("could not be started") && Contains("apt-get install ffmpeg"));
  }
  {
    const Ffmpeg failing("false");
    CHECK_THROWS_AS(run.write_movie(movie, 25), FileError);
  }
  CHECK_THROWS_WITH(run.write_movie(sample.folder.path() / "run.avi", 25), Contains(".mp4 or .webm"));
  CHECK(sample.folder.contents() == std::vector<std::string>{"run.h5"});
  run.write_movie(movie, 25);
  CHECK(read_bytes(movie).substr(4, 4) == "ftyp");
  CHECK(sample.folder.contents() == std::vector<std::string>{"run.h5", "run.mp4"});
}
