#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "support/file_bytes.hpp"
#include "support/program.hpp"
#include "suture/errors.hpp"
#include "suture/io/config.hpp"
#include "suture/io/trajectory.hpp"
#include "suture/io/trajectory_check.hpp"
#include "suture/measure/cell_shape.hpp"
#include "suture/simulate/cell_experiment.hpp"

using namespace suture;
using namespace suture::test;
using Catch::Matchers::Contains;

namespace {

Config short_compression() {
  return parse_config(R"(
[run]
protocol = "compression"
[tissue]
cells = 1
vertices = 16
shape_parameter = 1.0
[compression]
gap = 0.8
closing_time = 0.5
duration = 1.3
recovery = 0.7
[output]
interval = 0.25
frame_interval = 0.5
)",
                      "short_compression");
}

Config short_dipole() {
  return parse_config(R"(
[run]
protocol = "dipole"
[tissue]
cells = 1
vertices = 24
shape_parameter = 1.0
[dipole]
duration = 1.0
)",
                      "short_dipole");
}

std::vector<double> times(const std::vector<TissueState>& frames) {
  std::vector<double> out;
  for (const TissueState& frame : frames) out.push_back(frame.time);
  return out;
}

}  // namespace

TEST_CASE("the round cell is a regular polygon of its rest area, at rest, with an edge at its top", "[unit]") {
  for (const int vertices : {16, 24, 30}) {
    Config config = short_dipole();
    config.tissue.vertices = vertices;
    const TissueState cell = make_round_cell(config);
    const CellShape shape = cell_shapes(cell.tissue, cell.view()).front();
    CHECK(shape.area == Approx(1.0).epsilon(1e-12));
    CHECK(shape.perimeter == Approx(vertices * cell.tissue.initial_rest_length(0)).epsilon(1e-12));
    CHECK(norm(shape.centre) < 1e-12);
    const StateView state = cell.view();
    CHECK(state.rest_length[3] == cell.tissue.initial_rest_length(3));
    CHECK(state.y[0] == Approx(state.y[vertices - 1]).epsilon(1e-12));
    CHECK(state.x[0] == Approx(-state.x[vertices - 1]).epsilon(1e-12));
  }
}

TEST_CASE("only one round cell can be compressed or pulled", "[unit]") {
  Config config = short_dipole();
  config.tissue.shape_parameter = 1.2;
  CHECK_THROWS_WITH(make_round_cell(config), Contains("tissue.shape_parameter") && Contains("1.2"));
  config = short_dipole();
  config.tissue.cells = 2;
  CHECK_THROWS_AS(run_cell_experiment(config), InputError);
  config = short_dipole();
  config.run.protocol = Protocol::wound_closure;
  CHECK_THROWS_AS(run_cell_experiment(config), InputError);
  config = short_compression();
  config.compression.closing_time = 2.0;
  CHECK_THROWS_WITH(check_config(config), Contains("compression.closing_time"));
  CHECK_THROWS_AS(run_cell_experiment(config), InputError);
}

TEST_CASE("the plates touch the cell first, close without a jump, and are gone after the release", "[unit]") {
  const Config config = short_compression();
  const TissueState cell = make_round_cell(config);
  const std::vector<LoadPhase> phases = load_phases(config, cell);
  REQUIRE(phases.size() == 3);
  CHECK(phases[0].start == 0.0);
  CHECK(phases[0].end == 0.5);
  CHECK(phases[1].end == 1.3);
  CHECK(phases[2].end == Approx(2.0));
  REQUIRE(phases[0].plates);
  REQUIRE(phases[1].plates);
  CHECK_FALSE(phases[2].plates);
  const ParallelPlates &closing = *phases[0].plates, &held = *phases[1].plates;
  CHECK(closing.gap_at(0.5) == Approx(held.gap_at(0.5)).epsilon(1e-12));
  CHECK(held.gap_at(0.6) == held.gap_at(1.2));
  CHECK(held.gap_at(1.0) == Approx(0.8 * closing.gap_at(0.0)));
  const int vertices = cell.tissue.vertex_count();
  CHECK(Plates(closing, vertices).energy(0.0, cell.view()) == Approx(0.0).margin(1e-20));
  CHECK(Plates(closing, vertices).energy(0.1, cell.view()) > 0.0);
}

TEST_CASE("a moving plate is a pure function of time", "[unit]") {
  const TissueState cell = make_round_cell(short_compression());
  const int vertices = cell.tissue.vertex_count();
  const Plates moving({.gap = 1.2, .range = 0.1, .energy = 1.0, .closing_speed = 0.4, .start_time = 3.0}, vertices);
  const Plates standing({.gap = 1.0, .range = 0.1, .energy = 1.0}, vertices);
  CHECK(moving.energy(3.5, cell.view()) == Approx(standing.energy(0.0, cell.view())));
  CHECK(standing.energy(0.0, cell.view()) > 0.0);
  CHECK(moving.energy(3.0, cell.view()) < moving.energy(3.5, cell.view()));
}

TEST_CASE("the dipole pulls both halves of the cell equally", "[unit]") {
  for (const int vertices : {16, 24, 30}) {
    Config config = short_dipole();
    config.tissue.vertices = vertices;
    const TissueState cell = make_round_cell(config);
    const std::vector<double> forces = dipole_forces(config, cell);
    REQUIRE(forces.size() == static_cast<std::size_t>(vertices));
    CHECK(std::accumulate(forces.begin(), forces.end(), 0.0) == Approx(0.0).margin(1e-15));
    for (int v = 0; v < vertices; ++v) CHECK(forces[v] == (cell.view().x[v] < 0.0 ? -0.01 : 0.01));
  }
}

TEST_CASE("a vertex on the dividing axis is not sorted by its rounding error", "[unit]") {
  Config config = short_dipole();
  config.tissue.vertices = 4;
  TissueState cell = make_round_cell(config);
  const MutableStateView state = cell.mutable_view();
  state.x[0] = -1e-17, state.x[1] = -0.5, state.x[2] = 1e-17, state.x[3] = 0.5;
  CHECK(dipole_forces(config, cell) == std::vector<double>{0.01, -0.01, 0.01, 0.01});
}

TEST_CASE("samples and frames fall on their intervals, the release and the end", "[unit]") {
  const CellExperimentResult result = run_cell_experiment(short_compression());
  CHECK_FALSE(result.failure);
  const std::vector<double> expected{0.0, 0.5, 1.0, 1.3, 1.5, 2.0}, found = times(result.frames);
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i] == Approx(expected[i]).margin(1e-12));
  REQUIRE(result.release_frame == 3);
  REQUIRE(result.samples.size() == 10);  // 0, 0.25, ..., 2 and the release
  REQUIRE(result.release_sample == 6);
  CHECK(result.samples[6].time == 1.3);
  for (std::size_t i = 1; i < result.samples.size(); ++i) CHECK(result.samples[i].time > result.samples[i - 1].time);
  CHECK(result.samples[6].shape_parameter > result.samples[0].shape_parameter + 0.01);
  CHECK(result.samples.back().shape_parameter < result.samples[6].shape_parameter);
  CHECK(result.samples[0].shortest_segment == Approx(1.0));
  CHECK(result.samples[0].energy == Approx(short_compression().bending.stiffness / 2.0 * 16 * std::pow(M_PI / 8.0, 2)));
  CHECK(result.statistics.restarts == 2);
  CHECK(result.statistics.steps > 10);
}

TEST_CASE("output times do not change the motion", "[unit]") {
  Config fine = short_dipole(), coarse = short_dipole();
  fine.output.interval = 0.01;
  fine.output.frame_interval = 0.07;
  const CellExperimentResult a = run_cell_experiment(fine), b = run_cell_experiment(coarse);
  CHECK(a.samples.size() > 100);
  CHECK(a.frames.back().values == b.frames.back().values);
  CHECK(a.statistics.steps == b.statistics.steps);
}

TEST_CASE("what was computed before a failure is kept", "[unit]") {
  Config config = short_dipole();
  config.dipole.force = 1e8;
  config.dipole.duration = 100.0;
  const CellExperimentResult result = run_cell_experiment(config);
  REQUIRE(result.failure);
  CHECK_FALSE(result.failure->empty());
  REQUIRE_FALSE(result.samples.empty());
  REQUIRE_FALSE(result.frames.empty());
  CHECK(summarise(result, config).status == RunStatus::failed);
}

TEST_CASE("a written experiment can be read and checked", "[unit]") {
  const Config config = short_compression();
  const CellExperimentResult result = run_cell_experiment(config);
  const TemporaryDirectory folder;
  write_cell_experiment(result, config, {.resolved_config = write_config(config)}, folder.path());
  CHECK(folder.contents() == std::vector<std::string>{"cell.csv", "final.png", "final.svg", "run.h5", "summary.json"});
  for (const char* name : {"cell.csv", "run.h5", "summary.json"}) {
    const FileReport report = check_file(folder.path() / name);
    INFO(name << ": " << report.content << (report.problems.empty() ? "" : report.problems.front()));
    CHECK(report.verdict == FileVerdict::valid);
  }
  const Trajectory run = read_trajectory(folder.path() / "run.h5");
  CHECK(run.complete);
  REQUIRE(run.frames.size() == result.frames.size());
  CHECK(run.frames.back().values == result.frames.back().values);
  REQUIRE(run.observable("shape_parameter") != nullptr);
  CHECK(run.observable("shape_parameter")->value.size() == result.samples.size());
  REQUIRE(run.events.size() == 1);
  CHECK(run.events[0].kind == "release");
  CHECK(run.events[0].time == 1.3);
  const auto summary = nlohmann::json::parse(read_bytes(folder.path() / "summary.json"));
  CHECK(summary["status"] == "reached_t_end");
  CHECK(summary["t_closed"].is_null());
  CHECK(summary["shape_initial"].get<double>() == result.samples.front().shape_parameter);
  CHECK(summary["shape_at_release"].get<double>() == result.samples[*result.release_sample].shape_parameter);
  CHECK(summary["shape_final"].get<double>() == result.samples.back().shape_parameter);
  CHECK(summary["area_final_um2"].get<double>() == Approx(25.0 * result.samples.back().area));
}
