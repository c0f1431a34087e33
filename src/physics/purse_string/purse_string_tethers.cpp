#include "suture/physics/purse_string_tethers.hpp"

#include <fmt/format.h>

#include <cmath>

#include "physics/pair_hessian.hpp"
#include "suture/errors.hpp"

namespace suture {

TetherResponse tether_response(TetherLaw law, TetherMode mode, double stiffness, double yield_length, double l) {
  const double h = 0.5 * yield_length;
  const TetherResponse linear{0.5 * stiffness * l * l, stiffness * l, stiffness};
  switch (law) {
    case TetherLaw::saturating_energy:
      return mode == TetherMode::attached ? linear : TetherResponse{0.5 * stiffness * h * h, 0.0, 0.0};
    case TetherLaw::saturating_force:
    case TetherLaw::published:
      return l < h ? linear : TetherResponse{stiffness * h * (l - 0.5 * h), stiffness * h, 0.0};
    case TetherLaw::ramp: {
      if (l < h) return linear;
      if (l >= yield_length) return {stiffness * h * h, 0.0, 0.0};
      const double left = yield_length - l;
      return {stiffness * (h * h - 0.5 * left * left), stiffness * left, -stiffness};
    }
  }
  return linear;
}

PurseStringTethers::PurseStringTethers(const Tissue& tissue, const PurseString& purse_string,
                                       const PurseStringParameters& parameters, double contact_distance)
    : vertex_(purse_string.vertex),
      mode_(purse_string.mode),
      law_(parameters.tether_law),
      stiffness_(parameters.tether_stiffness),
      yield_length_(parameters.yield_length * contact_distance),
      first_point_(tissue.vertex_count()) {
  if (!(yield_length_ > 0.0))
    throw InputError(fmt::format("the tethers' yield length {} x contact distance {} is not positive",
                                 parameters.yield_length, contact_distance));
}

PurseStringTethers::Stretch PurseStringTethers::stretch(int j, const StateView& state) const {
  const int cell_point = vertex_[j], ring_point = first_point_ + j;
  return {cell_point, ring_point, state.x[ring_point] - state.x[cell_point], state.y[ring_point] - state.y[cell_point]};
}

TetherResponse PurseStringTethers::response(int j, double l) const {
  return tether_response(law_, mode_[j], stiffness_, yield_length_, l);
}

std::array<double, 2> PurseStringTethers::pull(int j, const Stretch& d) const {
  if (law_ == TetherLaw::published) return {response(j, d.dx).force, response(j, d.dy).force};
  const double l = std::sqrt(d.dx * d.dx + d.dy * d.dy);
  const TetherResponse r = response(j, l);
  const double force_per_length = l > 0.0 ? r.force / l : r.slope;
  return {force_per_length * d.dx, force_per_length * d.dy};
}

double PurseStringTethers::energy(double, const StateView& state) const {
  double sum = 0.0;
  for (int j = 0; j < static_cast<int>(vertex_.size()); ++j) {
    const Stretch d = stretch(j, state);
    sum += law_ == TetherLaw::published ? response(j, d.dx).energy + response(j, d.dy).energy
                                        : response(j, std::sqrt(d.dx * d.dx + d.dy * d.dy)).energy;
  }
  return sum;
}

void PurseStringTethers::add_gradient(double, const StateView& state, MutableStateView gradient) const {
  for (int j = 0; j < static_cast<int>(vertex_.size()); ++j) {
    const Stretch d = stretch(j, state);
    const auto [fx, fy] = pull(j, d);
    gradient.x[d.ring_point] += fx;
    gradient.y[d.ring_point] += fy;
    gradient.x[d.cell_point] -= fx;
    gradient.y[d.cell_point] -= fy;
  }
}

Block PurseStringTethers::curvature(int j, const Stretch& d) const {
  if (law_ == TetherLaw::published) return {response(j, d.dx).slope, 0.0, 0.0, response(j, d.dy).slope};
  const double l = std::sqrt(d.dx * d.dx + d.dy * d.dy);
  const TetherResponse r = response(j, l);
  if (l == 0.0) return {r.slope, 0.0, 0.0, r.slope};
  return radial_block({d.dx / l, d.dy / l}, l, r.force, r.slope);
}

void PurseStringTethers::add_hessian(double, const StateView& state, HessianSink& sink) const {
  for (int j = 0; j < static_cast<int>(vertex_.size()); ++j) {
    const Stretch d = stretch(j, state);
    add_pair(sink, d.cell_point, d.ring_point, curvature(j, d));
  }
}

std::vector<double> PurseStringTethers::forces(const StateView& state) const {
  std::vector<double> result;
  for (int j = 0; j < static_cast<int>(vertex_.size()); ++j) {
    const auto [fx, fy] = pull(j, stretch(j, state));
    result.push_back(std::sqrt(fx * fx + fy * fy));
  }
  return result;
}

}  // namespace suture
