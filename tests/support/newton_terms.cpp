#include "support/newton_terms.hpp"

#include <array>

#include "physics/numerical_failure.hpp"
#include "suture/errors.hpp"
#include "suture/physics/area_elasticity.hpp"
#include "suture/physics/bending_elasticity.hpp"
#include "suture/physics/contact_geometry.hpp"
#include "suture/physics/membrane_elasticity.hpp"

namespace suture::test {

namespace {

class Repulsion final : public EnergyTerm {
 public:
  Repulsion(const Tissue& tissue, const ContactParameters& contact)
      : tissue_(tissue), contact_(contact), distance_(*contact.distance), curvature_(2.0 * contact.energy / (distance_ * distance_)) {}

  std::string_view name() const override { return "repulsion"; }
  double energy(double, const StateView&) const override { throw NumericalError("only second derivatives"); }
  void add_gradient(double, const StateView&, MutableStateView) const override { throw NumericalError("only second derivatives"); }

  void add_hessian(double, const StateView& state, HessianSink& sink) const override {
    for (int v = 0; v < tissue_.vertex_count(); ++v)
      for (int cell = 0; cell < tissue_.cell_count(); ++cell)
        if (v < tissue_.first_vertex(cell) || v >= tissue_.end_vertex(cell)) add_vertex_and_cell(state, v, cell, sink);
    if (contact_.self_contact) add_self_contact(state, sink);
  }

 private:
  void add_vertex_and_cell(const StateView& state, int v, int cell, HessianSink& sink) const {
    const int first = tissue_.first_vertex(cell), count = tissue_.vertex_count(cell);
    const double reach = distance_ * (1.0 + contact_.adhesion);
    const Point p = point_at(state, v);
    const auto on_segment = [&](int k, double t) {
      const int a = first + k, b = tissue_.next(a);
      add_repulsion(sink, reach, p - ((1.0 - t) * point_at(state, a) + t * point_at(state, b)), {v, a, b}, {1.0, t - 1.0, -t});
    };
    const auto on_vertex = [&](int k, int weight) {
      if (weight > 0) add_repulsion(sink, reach, p - point_at(state, first + k), {v, first + k, first + k}, {1.0, -1.0, 0.0});
    };
    for_each_contact_feature(p, state.x.subspan(first, count), state.y.subspan(first, count), on_segment, on_vertex);
  }

  void add_self_contact(const StateView& state, HessianSink& sink) const {
    for (int cell = 0; cell < tissue_.cell_count(); ++cell)
      for (int a = tissue_.first_vertex(cell); a < tissue_.end_vertex(cell); ++a)
        for (int b = a + 2; b < tissue_.end_vertex(cell); ++b)
          if (tissue_.next(b) != a) add_repulsion(sink, distance_, point_at(state, a) - point_at(state, b), {a, b, b}, {1.0, -1.0, 0.0});
  }

  void add_repulsion(HessianSink& sink, double reach, Point from_foot, std::array<int, 3> vertex, std::array<double, 3> weight) const {
    const double distance = norm(from_foot);
    if (distance >= reach) return;
    const Point n = (1.0 / distance) * from_foot;
    const Block normal{n.x * n.x, n.x * n.y, n.x * n.y, n.y * n.y};
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) {
        Block block;
        for (int k = 0; k < 4; ++k) block[k] = curvature_ * weight[i] * weight[j] * normal[k];
        sink.add_block(vertex[i], vertex[j], block);
      }
  }

  Tissue tissue_;
  ContactParameters contact_;
  double distance_, curvature_;
};

}  // namespace

TermList newton_terms(const Tissue& tissue, const Config& config) {
  return {std::make_shared<AreaElasticity>(tissue), std::make_shared<MembraneElasticity>(tissue, config.membrane.law),
          std::make_shared<BendingElasticity>(tissue), std::make_shared<Repulsion>(tissue, config.contact)};
}

}  // namespace suture::test
