#include "support/integration.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

namespace suture::test {

namespace {

TissueState single_cell(const std::vector<double>& x, const std::vector<double>& y, CellMaterial material,
                        double rest_length) {
  const int n = static_cast<int>(x.size());
  TissueState state{.tissue = Tissue({n}, {material}, std::vector<double>(n, rest_length))};
  state.values = x;
  state.values.insert(state.values.end(), y.begin(), y.end());
  state.values.insert(state.values.end(), n, rest_length);
  return state;
}

}  // namespace

TissueState regular_cell(int vertices, double radius, CellMaterial material) {
  std::vector<double> x, y;
  for (int k = 0; k < vertices; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / vertices;
    x.push_back(radius * std::cos(angle));
    y.push_back(radius * std::sin(angle));
  }
  material.rest_area = 0.5 * vertices * radius * radius * std::sin(2.0 * std::numbers::pi / vertices);
  return single_cell(x, y, material, 2.0 * radius * std::sin(std::numbers::pi / vertices));
}

TissueState wavy_cell(int vertices, CellMaterial material, double amplitude) {
  TissueState state = regular_cell(vertices, 0.5, material);
  const MutableStateView view = state.mutable_view();
  for (int k = 0; k < vertices; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / vertices;
    const double stretch = 1.0 + amplitude * (std::cos(2.0 * angle) + 0.5 * std::sin(3.0 * angle));
    view.x[k] *= stretch;
    view.y[k] *= stretch * (1.0 - 0.5 * amplitude);
  }
  return state;
}

TissueState facing_triangles(double gap) {
  const CellMaterial soft{.area_stiffness = 0.0, .membrane_stiffness = 0.0, .bending_stiffness = 0.0};
  TissueState state{.tissue = Tissue({3, 3}, {soft, soft}, std::vector<double>(6, 1.0))};
  state.values = {0.0, -1.0, -1.0, gap, gap + 1.0, gap + 1.0,  // x
                  0.0, 0.5,  -0.5, 0.0, -0.5,      0.5,        // y
                  1.0, 1.0,  1.0,  1.0, 1.0,       1.0};
  return state;
}

ContactParameters contact_law(double distance, double adhesion, bool self_contact) {
  ContactParameters contact;
  contact.distance = distance;
  contact.adhesion = adhesion;
  contact.self_contact = self_contact;
  return contact;
}

TissueOdeOptions ode_options(const ContactParameters& contact, SpringLaw law, bool plastic, double skin) {
  TissueOdeOptions options;
  options.membrane_law = law;
  options.contact = contact;
  options.plastic = plastic;
  options.skin = skin;
  return options;
}

IntegratorOptions with_tolerance(Method method, double tolerance) {
  IntegratorOptions options;
  options.method = method;
  options.position_tolerance = options.rest_length_tolerance = tolerance;
  return options;
}

IntegratorOptions with_step(Method method, double step) {
  IntegratorOptions options = with_tolerance(method, 1.0);
  options.time_step = step;
  return options;
}

std::vector<double> integrate(OdeSystem& system, const IntegratorOptions& options, double t0, std::span<const double> y,
                              double t1, Statistics* statistics) {
  const auto integrator = make_integrator(system, options, t0, y);
  while (integrator->time() < t1) integrator->step(t1);
  if (statistics != nullptr) *statistics = integrator->statistics();
  return {integrator->state().begin(), integrator->state().end()};
}

double rms_difference(std::span<const double> a, std::span<const double> b) {
  REQUIRE(a.size() == b.size());
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

double largest_difference(std::span<const double> a, std::span<const double> b) {
  REQUIRE(a.size() == b.size());
  double worst = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) worst = std::max(worst, std::abs(a[k] - b[k]));
  return worst;
}

double largest(std::span<const double> a) {
  double worst = 0.0;
  for (const double v : a) worst = std::max(worst, std::abs(v));
  return worst;
}

}  // namespace suture::test
