#include <catch2/catch.hpp>
#include <cmath>

#include "support/setup_tissues.hpp"
#include "suture/setup/dynamics.hpp"
#include "suture/setup/packing.hpp"

using namespace suture;
using namespace suture::test;

namespace {

double potential_energy(const Config& config, const TissueState& state) {
  double sum = 0.0;
  for (const auto& [name, energy] : energy_by_term(make_cell_terms(state.tissue, config), state.time, state.view()))
    sum += energy;
  return sum;
}

}  // namespace

TEST_CASE("Maxwell velocities carry no momentum and exactly the temperature", "[unit]") {
  const TissueState state = packed_small_tissue().state;
  const int count = state.tissue.vertex_count();
  const std::vector<double> v = maxwell_velocities(state, 0.03, 5);
  REQUIRE(v.size() == 2u * count);
  double px = 0.0, py = 0.0, angular = 0.0, kinetic = 0.0;
  for (int i = 0; i < count; ++i) {
    px += v[i], py += v[count + i];
    angular += state.view().x[i] * v[count + i] - state.view().y[i] * v[i];
    kinetic += 0.5 * (v[i] * v[i] + v[count + i] * v[count + i]);
  }
  CHECK(px == Approx(0.0).margin(1e-13));
  CHECK(py == Approx(0.0).margin(1e-13));
  CHECK(angular == Approx(0.0).margin(1e-12));
  CHECK(kinetic == Approx(0.03 * count).epsilon(1e-12));
  CHECK(maxwell_velocities(state, 0.03, 5) == v);
  CHECK(maxwell_velocities(state, 0.03, 6) != v);
  CHECK(maxwell_velocities(state, 0.03, 5, 1) != v);
}

TEST_CASE("The constant-energy motion keeps the energy at second order in the step", "[unit]") {
  const Config config = small_config();
  const TissueState start = packed_small_tissue().state;
  std::vector<double> deviations;
  for (const double step : {0.02, 0.01, 0.005}) {
    TissueState state = start;
    std::vector<double> velocities = maxwell_velocities(state, 0.01, 1);
    const EnergyReport report =
        move_at_constant_energy(elastic_forces(config, state.tissue), make_cell_terms(state.tissue, config), state, velocities, 1.0, step);
    CHECK(state.time == Approx(1.0));
    CHECK(report.initial == Approx(potential_energy(config, start) + 0.01 * state.tissue.vertex_count()));
    deviations.push_back(report.largest_deviation);
  }
  REQUIRE(deviations.back() > 1e-12);
  for (std::size_t i = 1; i < deviations.size(); ++i) {
    const double order = std::log2(deviations[i - 1] / deviations[i]);
    CHECK(order > 1.6);
    CHECK(order < 2.6);
  }
}

TEST_CASE("Constant-energy motion covers any duration in equal steps", "[unit]") {
  const Config config = small_config();
  TissueState state = packed_small_tissue().state;
  state.time = 3.0;
  std::vector<double> velocities = maxwell_velocities(state, 0.01, 1);
  move_at_constant_energy(elastic_forces(config, state.tissue), {}, state, velocities, 0.0123, 0.005);
  CHECK(state.time == Approx(3.0123).epsilon(1e-14));
}

TEST_CASE("Overdamped motion only loses energy and leaves the rest lengths alone", "[unit]") {
  const Config config = small_config();
  TissueState state = packed_small_tissue().state;
  const std::vector<double> rest_lengths(state.view().rest_length.begin(), state.view().rest_length.end());
  std::vector<double> energies{potential_energy(config, state)};
  int reports = 0;
  for (int i = 0; i < 6; ++i) {
    const Statistics statistics = relax_overdamped(config, state, 1.0, [&](double, std::string_view) { ++reports; });
    CHECK(statistics.rate_evaluations > 0);
    energies.push_back(potential_energy(config, state));
  }
  CHECK(state.time == Approx(6.0));
  CHECK(reports > 0);
  CHECK(energies.front() - energies.back() > 1e-3);
  for (std::size_t i = 1; i < energies.size(); ++i) CHECK(energies[i] < energies[i - 1]);
  CHECK(std::equal(rest_lengths.begin(), rest_lengths.end(), state.view().rest_length.begin()));
}
