#include "suture/physics/self_contact.hpp"

#include "physics/numerical_failure.hpp"
#include "physics/pair_hessian.hpp"

namespace suture {

namespace {

/// Calls visit(a, b, unit vector from b to a, distance) for every non-adjacent pair of one cell closer than `reach`.
template <class Visit>
void for_each_close_pair(const Tissue& tissue, const StateView& state, double reach, Visit&& visit) {
  for (int cell = 0; cell < tissue.cell_count(); ++cell)
    for (int a = tissue.first_vertex(cell); a < tissue.end_vertex(cell); ++a)
      for (int b = a + 2; b < tissue.end_vertex(cell); ++b) {
        if (tissue.next(b) == a) continue;
        const Point separation = point_at(state, a) - point_at(state, b);
        const double squared_distance = squared_norm(separation);
        if (squared_distance >= reach * reach) continue;
        if (squared_distance == 0.0) fail_zero_distance(tissue, a, b);
        const double distance = std::sqrt(squared_distance);
        visit(a, b, (1.0 / distance) * separation, distance);
      }
}

}  // namespace

SelfContact::SelfContact(const Tissue& tissue, const ContactParameters& parameters)
    : tissue_(tissue),
      law_(parameters.energy, parameters.distance.value_or(tissue.mean_initial_rest_length()), 0.0, parameters.range) {}

double SelfContact::energy(double, const StateView& state) const {
  double sum = 0.0;
  for_each_close_pair(tissue_, state, law_.reach(),
                      [&](int, int, Point, double distance) { sum += law_.value(distance); });
  return sum;
}

void SelfContact::add_gradient(double, const StateView& state, MutableStateView gradient) const {
  for_each_close_pair(tissue_, state, law_.reach(), [&](int a, int b, Point normal, double distance) {
    const Point pull = law_.first_derivative(distance) * normal;
    gradient.x[a] += pull.x;
    gradient.y[a] += pull.y;
    gradient.x[b] -= pull.x;
    gradient.y[b] -= pull.y;
  });
}

void SelfContact::add_hessian(double, const StateView& state, HessianSink& sink) const {
  for_each_close_pair(tissue_, state, law_.reach(), [&](int a, int b, Point normal, double distance) {
    add_pair(sink, a, b,
             radial_block(normal, distance, law_.first_derivative(distance), law_.second_derivative(distance)));
  });
}

}  // namespace suture
