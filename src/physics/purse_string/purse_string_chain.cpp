#include "suture/physics/purse_string_chain.hpp"

#include <fmt/format.h>

#include <cmath>

#include "physics/pair_hessian.hpp"
#include "suture/errors.hpp"

namespace suture {

PurseStringChain::PurseStringChain(const Tissue& tissue, const PurseString& purse_string,
                                   const PurseStringParameters& parameters)
    : purse_string_(purse_string),
      law_(parameters.law),
      stiffness_(parameters.stiffness),
      first_point_(tissue.vertex_count()) {
  if (purse_string.empty()) return;
  if (law_ == SpringLaw::relative && !(purse_string.minimum_rest_length > 0.0))
    throw InputError(
        "purse_string.law = \"relative\" needs purse_string.minimum_rest_length > 0: "
        "the stiffness grows as 1/lambda0^2 while the rest lengths shrink to that floor");
  if (law_ != SpringLaw::quadratic) return;
  for (int j = 0; j < purse_string.size(); ++j) {
    const double length = purse_string.spring[j].reference_length;
    if (!(length > 0.0)) throw InputError(fmt::format("purse-string spring {}: the reference length {} is not positive", j, length));
    spring_stiffness_.push_back(stiffness_ / (length * length));
  }
}

PurseStringChain::Spring PurseStringChain::spring(int j, double t, const StateView& state) const {
  Spring s;
  s.from = first_point_ + j;
  s.to = j + 1 == purse_string_.size() ? first_point_ : s.from + 1;
  s.dx = state.x[s.to] - state.x[s.from];
  s.dy = state.y[s.to] - state.y[s.from];
  s.length = std::sqrt(s.dx * s.dx + s.dy * s.dy);
  s.rest_length = purse_string_.rest_length(j, t);
  // Both laws are k/2 (l - lambda0)^2 over the square of a length: they differ in which one.
  s.stiffness = law_ == SpringLaw::relative ? stiffness_ / (s.rest_length * s.rest_length) : spring_stiffness_[j];
  return s;
}

double PurseStringChain::energy(double t, const StateView& state) const {
  double sum = 0.0;
  for (int j = 0; j < purse_string_.size(); ++j) {
    const Spring s = spring(j, t, state);
    const double elongation = s.length - s.rest_length;
    sum += 0.5 * s.stiffness * elongation * elongation;
  }
  return sum;
}

void PurseStringChain::add_gradient(double t, const StateView& state, MutableStateView gradient) const {
  for (int j = 0; j < purse_string_.size(); ++j) {
    const Spring s = spring(j, t, state);
    if (s.length == 0.0) continue;
    const double tension_per_length = s.stiffness * (1.0 - s.rest_length / s.length);
    gradient.x[s.to] += tension_per_length * s.dx;
    gradient.y[s.to] += tension_per_length * s.dy;
    gradient.x[s.from] -= tension_per_length * s.dx;
    gradient.y[s.from] -= tension_per_length * s.dy;
  }
}

void PurseStringChain::add_hessian(double t, const StateView& state, HessianSink& sink) const {
  for (int j = 0; j < purse_string_.size(); ++j) {
    const Spring s = spring(j, t, state);
    const double tension = s.stiffness * (s.length - s.rest_length);
    const Block block = s.length > 0.0
                            ? radial_block({s.dx / s.length, s.dy / s.length}, s.length, tension, s.stiffness)
                            : Block{s.stiffness, 0.0, 0.0, s.stiffness};
    add_pair(sink, s.from, s.to, block);
  }
}

std::vector<double> PurseStringChain::tensions(double t, const StateView& state) const {
  std::vector<double> result;
  for (int j = 0; j < purse_string_.size(); ++j) {
    const Spring s = spring(j, t, state);
    result.push_back(s.stiffness * (s.length - s.rest_length));
  }
  return result;
}

}  // namespace suture
