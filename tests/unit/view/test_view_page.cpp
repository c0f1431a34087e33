#include <catch2/catch.hpp>

#include "support/file_bytes.hpp"
#include "support/program.hpp"
#include "support/sample_run.hpp"
#include "suture/errors.hpp"
#include "suture/io/base64.hpp"
#include "suture/view/view_page.hpp"
#include "view/packed_numbers.hpp"
#include "view/viewer_data.hpp"

using namespace suture;
using namespace suture::test;
using Catch::Matchers::Contains;

TEST_CASE("base64 of the examples of RFC 4648", "[unit]") {
  const auto encoded = [](std::string_view text) { return base64(std::as_bytes(std::span(text))); };
  CHECK(encoded("") == "");
  CHECK(encoded("f") == "Zg==");
  CHECK(encoded("fo") == "Zm8=");
  CHECK(encoded("foo") == "Zm9v");
  CHECK(encoded("foobar") == "Zm9vYmFy");
  CHECK(encoded("\xff\xfe\xfd") == "//79");
}

TEST_CASE("packed numbers say where they are and take little room", "[unit]") {
  PackedNumbers numbers;
  std::vector<std::int32_t> slow;
  for (int i = 0; i < 100000; ++i) slow.push_back(1000000 + i / 7);
  numbers.add("slow", slow, 1);
  numbers.add("wild", {0, -2147483647 - 1, 2147483647, -1}, 0);
  CHECK(numbers.index()["wild"] == nlohmann::json{{"offset", 400000}, {"count", 4}, {"stride", 0}});
  CHECK(numbers.base64().size() < 5000);
}

TEST_CASE("the viewer gets curves, events, milestones and facts in physical units", "[unit]") {
  const TemporaryDirectory folder;
  write_sample_run(folder.path() / "run.h5");
  const Replay replay(folder.path() / "run.h5");
  const ViewerData data = viewer_data(replay, {0, 3});
  const nlohmann::json& d = data.description;
  const double um2 = replay.scales().factor(Dimension::area), minute = replay.scales().time_min();
  CHECK(d["times"][0] == 0.0);
  CHECK(d["times"][1].get<double>() == Approx(30.0 * minute).epsilon(1e-5));
  REQUIRE(d["curves"].size() == 2);
  CHECK(d["curves"][0]["values"][0].get<double>() == Approx(5.0 * um2).epsilon(1e-5));
  CHECK(d["events"]["kinds"][0]["kind"] == "capture");
  CHECK(d["milestones"][0]["label"] == "50 %");
  CHECK(d["milestones"][0]["time"].get<double>() == Approx(12.0 * minute));
  CHECK(d["colours"].size() == 768);
  CHECK(d["sections"]["ring_count"]["count"] == 2);
  CHECK(d["sections"]["x"]["count"] == 2 * replay.trajectory().tissue.vertex_count());
}

TEST_CASE("the page is one file that asks for nothing else", "[unit]") {
  const TemporaryDirectory folder;
  write_sample_run(folder.path() / "run.h5", 9);
  const Replay replay(folder.path() / "run.h5");
  const ViewPage page = write_view_page(replay, {.title = "a </script> & {{numbers}}", .maximum_frames = 4}, folder.path() / "view.html");
  const std::string text = read_bytes(folder.path() / "view.html");
  CHECK(page.frames == 4);
  CHECK(page.bytes == text.size());
  for (const char* foreign : {"http:", "https:", "src=", "@import", "url("}) CHECK(text.find(foreign) == std::string::npos);
  CHECK_THAT(text, Contains("<title>a &lt;/script> &amp; {{numbers}} · suture</title>"));
  for (const char* mark : {"{{style}}", "{{script}}", "{{description}}", "{{title}}"}) CHECK(text.find(mark) == std::string::npos);
  CHECK(folder.contents() == std::vector<std::string>{"run.h5", "view.html"});
  CHECK_THROWS_AS(write_view_page(replay, {.title = "", .maximum_frames = 0}, folder.path() / "no.html"), InputError);
}
