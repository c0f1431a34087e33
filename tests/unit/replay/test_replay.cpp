#include <catch2/catch.hpp>

#include "support/program.hpp"
#include "support/sample_run.hpp"
#include "support/sample_tissue.hpp"
#include "suture/errors.hpp"
#include "suture/measure/neighbours.hpp"
#include "suture/replay/choose_frames.hpp"
#include "suture/replay/colour_range.hpp"
#include "suture/replay/replay.hpp"

using namespace suture;
using namespace suture::test;
using Catch::Matchers::Contains;

TEST_CASE("frames are chosen by number, range and word", "[unit]") {
  using Frames = std::vector<int>;
  CHECK(choose_frames("all", 3) == Frames{0, 1, 2});
  CHECK(choose_frames("last", 3) == Frames{2});
  CHECK(choose_frames("4,0,4,-1", 6) == Frames{0, 4, 5});
  CHECK(choose_frames("0:5:2,1", 6) == Frames{0, 1, 2, 4});
  for (const char* wrong : {"", "x", "3", "-4", "0:3", "2:1", "0:2:0", "0:1:1:1", "1.5", "0,,1"})
    CHECK_THROWS_WITH(choose_frames(wrong, 3), Contains("--frames") && Contains("allowed"));
}

TEST_CASE("a colour range is round, contains the values and is never empty", "[unit]") {
  const auto [low, high] = colour_range({1.23, 1.31, 1.87}, Place::cell);
  CHECK(low == Approx(1.2));
  CHECK(high == Approx(1.9));
  CHECK(colour_range({3.0, 3.0}, Place::cell).first < 3.0);
  CHECK(colour_range({3.0, 3.0}, Place::cell).second > 3.0);
  CHECK(colour_range({0.0}, Place::cell).first < colour_range({0.0}, Place::cell).second);
  CHECK(colour_range({}, Place::cell) == std::pair(0.0, 1.0));
  CHECK(colour_range({NAN, 1.0, 2.0}, Place::cell) == std::pair(1.0, 2.0));
  std::vector<double> values(1000, 0.5);
  for (int i = 0; i < 500; ++i) values[i] = 0.1;
  values[0] = -100.0;
  CHECK(colour_range(values, Place::segment).first > 0.0);
  CHECK(colour_range(values, Place::cell).first <= -100.0);
}

TEST_CASE("a replay gives every frame with its fields", "[unit]") {
  const TemporaryDirectory folder;
  write_sample_run(folder.path() / "run.h5");
  const Replay replay(folder.path() / "run.h5");
  REQUIRE(replay.frame_count() == 4);
  CHECK(replay.time_origin() == 200.0);
  CHECK(replay.wound_fraction(200.0).value() == 1.0);
  CHECK(replay.wound_fraction(214.0).value() == 0.75);
  CHECK(replay.wound_fraction(999.0).value() == 0.25);

  const ReplayFrame frame = replay.frame(0);
  const TissueState state = sample_tissue();
  CHECK(frame.state.values == state.values);
  CHECK(frame.wound_outline.size() == 3);
  const int cells = state.tissue.cell_count(), vertices = state.tissue.vertex_count(), ring = state.purse_string.size();
  for (const Field& field : frame.fields) {
    INFO(field.quantity.name);
    const int expected = field.place == Place::cell ? cells : field.place == Place::segment || field.place == Place::vertex ? vertices : ring;
    CHECK(field.values.size() == static_cast<std::size_t>(expected));
    CHECK(!field.quantity.description.empty());
  }
  CHECK(replay.frame(3).find("spring_tension") == nullptr);
  CHECK(replay.frame(3).wound_outline.empty());
  CHECK_THROWS_WITH(frame.field("area_strian"), Contains("did you mean 'area_strain'") && Contains("membrane_tension"));
}

TEST_CASE("fields are what their descriptions say", "[unit]") {
  const TemporaryDirectory folder;
  write_sample_run(folder.path() / "run.h5");
  const Replay replay(folder.path() / "run.h5");
  const ReplayFrame frame = replay.frame(1);
  const Tissue& tissue = frame.state.tissue;
  const StateView view = frame.state.view();
  const auto value = [&](const char* name, int i) { return frame.field(name).values.at(i); };
  constexpr int v = 5;
  const double length = std::hypot(view.x[tissue.next(v)] - view.x[v], view.y[tissue.next(v)] - view.y[v]);
  const double l0 = view.rest_length[v], unit = tissue.initial_rest_length(v);
  CHECK(value("length", v) == Approx(length));
  CHECK(value("rest_length", v) == l0);
  CHECK(value("rest_length_strain", v) == Approx(l0 / unit - 1.0));
  // The printed equations, which the sample's empty configuration means.
  CHECK(value("membrane_tension", v) ==
        Approx(tissue.material(tissue.cell_of(v)).membrane_stiffness * (length - l0) / (unit * unit)));
  CHECK(value("area", 2) == Approx((value("area_strain", 2) + 1.0) * tissue.material(2).rest_area));
  CHECK(value("shape_parameter", 2) == Approx(std::pow(value("perimeter", 2), 2) / (4 * M_PI * value("area", 2))));
  double contacts = 0.0;
  for (const double count : frame.field("contacts").values) contacts += count;
  const ContactGraph graph = contact_graph(tissue, view, replay.membrane());
  REQUIRE(graph.pairs().size() > 0);
  CHECK(contacts == 2.0 * graph.pairs().size());  // each contact counts for both cells
  double tethers = 0.0;
  for (const double tether : frame.field("tether").values) tethers += tether > 0.0;
  CHECK(tethers == frame.state.purse_string.size());

  const Field& tension = frame.field("membrane_tension");
  CHECK(label_in_physical_units(tension) == "membrane tension (nN)");
  CHECK(in_physical_units(tension, replay.scales()).at(v) == Approx(value("membrane_tension", v) * replay.scales().force_nN()));
}

TEST_CASE("the state at the end of the closure is the last frame of a replay", "[unit]") {
  const TemporaryDirectory folder;
  const TissueState state = sample_tissue();
  {
    TrajectoryWriter writer(folder.path() / "run.h5", Provenance{});
    writer.write_frame(state);
    TissueState end = state;
    end.time = state.time + 7.5;
    end.mutable_view().x[0] += 0.01;
    writer.write_stage(Stage::closure, end);
    writer.close();
  }
  const Replay replay(folder.path() / "run.h5");
  REQUIRE(replay.frame_count() == 2);
  CHECK(replay.times()[1] == state.time + 7.5);
  CHECK(replay.frame(1).state.view().x[0] == state.view().x[0] + 0.01);
  CHECK(!replay.wound_fraction(state.time).has_value());
}

TEST_CASE("a run without frames shows nothing", "[unit]") {
  const TemporaryDirectory folder;
  TrajectoryWriter(folder.path() / "run.h5", Provenance{}).close();
  CHECK_THROWS_WITH(Replay(folder.path() / "run.h5"), Contains("holds no frame"));
  CHECK_THROWS_AS(Replay(folder.path() / "absent.h5"), InputError);
}
