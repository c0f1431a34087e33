// The two experiments on one cell against Ton et al. 2023, Fig. 2c (what happens) and Fig. S5 (the authors' numbers).
#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "../../examples/figures/figS5/published_scheme.hpp"
#include "suture/io/config.hpp"
#include "suture/simulate/cell_experiment.hpp"

using namespace suture;

namespace {

Config example(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return read_config(std::string(SUTURE_SOURCE_DIR "/examples/") + name, overrides);
}

struct PublishedDipole {
  double area_stiffness, tau, duration, area, perimeter, shape_parameter;
};

std::vector<PublishedDipole> published_dipoles() {
  std::ifstream file(SUTURE_SOURCE_DIR "/tests/data/figS5_dipole_sample.csv");
  REQUIRE(file);
  std::string line;
  std::getline(file, line);
  std::vector<PublishedDipole> rows;
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    PublishedDipole row{};
    std::istringstream fields(line);
    fields >> row.area_stiffness >> row.tau >> row.duration >> row.area >> row.perimeter >> row.shape_parameter;
    REQUIRE(fields);
    rows.push_back(row);
  }
  return rows;
}

Config dipole(const PublishedDipole& point, SpringLaw law) {
  Config config = example("dipole.toml");
  config.membrane.law = law;
  config.area.stiffness = point.area_stiffness;
  config.plasticity.tau = point.tau;
  config.dipole.duration = point.duration;
  return config;
}

CellSample final_cell(const PublishedDipole& point, SpringLaw law) {
  const CellExperimentResult result = run_cell_experiment(dipole(point, law));
  REQUIRE_FALSE(result.failure);
  return result.samples.back();
}

struct Compressed {
  double initial, pressed, final;
};

Compressed compress(const Config& config) {
  const CellExperimentResult result = run_cell_experiment(config);
  REQUIRE_FALSE(result.failure);
  REQUIRE(result.release_sample);
  return {result.samples.front().shape_parameter, result.samples[*result.release_sample].shape_parameter,
          result.samples.back().shape_parameter};
}

}  // namespace

TEST_CASE("a compressed elastic cell recovers its shape", "[validation]") {
  const Compressed shape = compress(example("compression_elastic.toml"));
  CHECK(shape.pressed > 1.1 * shape.initial);
  CHECK(shape.final == Approx(shape.initial).epsilon(0.01));  // measured: 0.2 %
}

TEST_CASE("a compressed plastic cell keeps its shape", "[validation]") {
  const Compressed shape = compress(example("compression_plastic.toml"));
  CHECK(shape.pressed > 1.1 * shape.initial);
  CHECK(shape.final > 1.1 * shape.initial);
  // What bending takes back while the membrane creeps: 13 % of the deformation in ten relaxation times.
  CHECK(shape.pressed - shape.final < 0.2 * (shape.pressed - shape.initial));
}

TEST_CASE("shape memory gives a plastic cell its shape back", "[validation]") {
  const Compressed shape = compress(example("compression_plastic.toml", {"plasticity.memory=1.0"}));
  CHECK(shape.final == Approx(shape.initial).epsilon(0.01));
}

TEST_CASE("what a compression ends in does not depend on the tolerance", "[validation]") {
  for (const char* name : {"compression_elastic.toml", "compression_plastic.toml"}) {
    const Compressed usual = compress(example(name));
    const Compressed fine =
        compress(example(name, {"integrator.tolerance=1e-6", "integrator.rest_length_tolerance=1e-6"}));
    CHECK(usual.pressed == Approx(fine.pressed).margin(1e-3));
    CHECK(usual.final == Approx(fine.final).margin(1e-3));
  }
}

TEST_CASE("dipole: final shapes are the published ones", "[validation]") {
  const std::vector<PublishedDipole> points = published_dipoles();
  REQUIRE(points.size() == 22);
  int compared = 0;
  for (const PublishedDipole& point : points) {
    const CellSample cell = final_cell(point, SpringLaw::relative);
    INFO("k_a = " << point.area_stiffness << ", tau = " << point.tau << ": A = " << cell.shape_parameter
                  << ", published " << point.shape_parameter);
    if (point.tau >= 10.0) {
      CHECK(cell.shape_parameter == Approx(point.shape_parameter).margin(0.004));
      CHECK(cell.area == Approx(point.area).margin(0.004));
      CHECK(cell.perimeter == Approx(point.perimeter).margin(0.008));
      ++compared;
    } else {
      // Drawn out to 6 and 18 times its size by exponential creep; the published rest lengths have inertia (docs/figures/figS5.md).
      CHECK(cell.shape_parameter == Approx(point.shape_parameter).epsilon(0.025));
    }
  }
  CHECK(compared == 17);
}

TEST_CASE("dipole: the published scheme gives the published digits", "[validation]") {
  int compared = 0;
  for (const PublishedDipole& point : published_dipoles()) {
    if (point.area_stiffness > 1.0) continue;  // their step falls as 1/sqrt(k_a): millions of them
    const CellShape cell = figures::published_dipole(dipole(point, SpringLaw::relative));
    INFO("k_a = " << point.area_stiffness << ", tau = " << point.tau);
    const bool thread = point.shape_parameter > 10.0;  // amplifies the rounding of its start
    CHECK(cell.area == Approx(point.area).margin(6e-6));
    CHECK(cell.perimeter == Approx(point.perimeter).margin(thread ? 5e-5 : 6e-6));
    CHECK(cell.shape_parameter() == Approx(point.shape_parameter).margin(thread ? 5e-4 : 1.5e-5));  // theirs is of rounded numbers
    ++compared;
  }
  CHECK(compared == 12);
}

TEST_CASE("dipole: the published start has the published area and perimeter", "[validation]") {
  const TissueState cell = figures::published_start(example("dipole.toml"));
  const CellShape shape = cell_shapes(cell.tissue, cell.view()).front();
  CHECK(shape.area == Approx(1.00149).margin(5e-6));
  CHECK(shape.perimeter == Approx(3.55791).margin(5e-6));
}

TEST_CASE("dipole: the printed membrane law agrees with the published shapes only while little has flowed",
          "[validation]") {
  int agree = 0, differ = 0;
  for (const PublishedDipole& point : published_dipoles()) {
    const double difference = final_cell(point, SpringLaw::quadratic).shape_parameter - point.shape_parameter;
    INFO("k_a = " << point.area_stiffness << ", tau = " << point.tau << ": " << difference);
    if (point.tau >= 40.0) {
      CHECK(std::abs(difference) < 0.02);
      ++agree;
    } else if (point.tau <= 10.0) {
      CHECK(difference < -0.02);
      ++differ;
    }
  }
  CHECK(agree == 11);
  CHECK(differ == 9);
}
