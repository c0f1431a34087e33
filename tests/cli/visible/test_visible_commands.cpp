#include <catch2/catch.hpp>

#include "support/program.hpp"
#include "support/sample_run.hpp"

using namespace suture::test;
using Catch::Matchers::Contains;

namespace {

struct Sample {
  TemporaryDirectory folder;
  Sample() { write_sample_run(folder.path() / "run.h5"); }
  Outcome operator()(const std::vector<std::string>& arguments) const {
    return run_suture(SUTURE_PROGRAM, arguments, folder.path());
  }
};

}  // namespace

TEST_CASE("suture render draws stills, strips and movies", "[cli]") {
  const Sample suture;
  const Outcome stills = suture({"render", "run.h5", "--frames", "0:2", "--size", "100"});
  CHECK(stills.exit_code == 0);
  CHECK_THAT(stills.output, Contains("3 pictures in frames"));
  const Outcome both = suture({"render", "run.h5", "--strip", "strip.png", "--movie", "run.mp4", "--size", "100", "--field", "contacts"});
  CHECK(both.exit_code == 0);
  CHECK_THAT(both.errors, Contains("4 frames") && Contains("output.frame_interval"));
  CHECK(suture.folder.contents() == std::vector<std::string>{"frames", "run.h5", "run.mp4", "strip.png"});
}

TEST_CASE("suture view and suture export write their files", "[cli]") {
  const Sample suture;
  CHECK(suture({"view", "run.h5"}).exit_code == 0);
  CHECK(suture({"export", "run.h5", "--format", "xdmf", "--out", "x"}).exit_code == 0);
  CHECK(suture({"export", "run.h5", "--format", "vtp", "--out", "v", "--frames", "last"}).exit_code == 0);
  CHECK(suture.folder.contents() == std::vector<std::string>{"run.h5", "v", "view.html", "x"});
}

TEST_CASE("what shows a run refuses bad input with one line and leaves nothing behind", "[cli]") {
  const Sample suture;
  suture.folder.write("no_run.h5", "something else");
  const std::vector<std::vector<std::string>> wrong = {
      {"render", "absent.h5"},
      {"render", "no_run.h5"},
      {"render", "run.h5", "--field", "tension"},
      {"render", "run.h5", "--frames", "9"},
      {"render", "run.h5", "--movie", "run.avi"},
      {"render", "run.h5", "--strip", "strip.bmp"},
      {"render", "run.h5", "--format", "gif"},
      {"view", "no_run.h5"},
      {"view", "run.h5", "--max-frames", "0"},
      {"export", "run.h5", "--format", "vtk", "--out", "x"},
      {"export", "run.h5", "--format", "vtp"},
      {"export", "no_run.h5", "--format", "vtp", "--out", "x"}};
  for (const auto& arguments : wrong) {
    const Outcome outcome = suture(arguments);
    INFO(arguments[0] << ' ' << arguments[1] << ' ' << outcome.errors);
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.errors, Contains("suture: error: "));
    CHECK(std::count(outcome.errors.begin(), outcome.errors.end(), '\n') == 1);
    CHECK(suture.folder.contents() == std::vector<std::string>{"no_run.h5", "run.h5"});
  }
}
