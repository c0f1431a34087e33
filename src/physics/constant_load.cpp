#include "suture/physics/constant_load.hpp"

#include <fmt/format.h>

#include "suture/errors.hpp"

namespace suture {

ConstantLoad::ConstantLoad(std::vector<double> fx, std::vector<double> fy) : fx_(std::move(fx)), fy_(std::move(fy)) {
  if (fx_.size() != fy_.size())
    throw InputError(fmt::format("a load has {} x but {} y components", fx_.size(), fy_.size()));
}

double ConstantLoad::energy(double, const StateView& state) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < fx_.size(); ++i) sum -= fx_[i] * state.x[i] + fy_[i] * state.y[i];
  return sum;
}

void ConstantLoad::add_gradient(double, const StateView&, MutableStateView gradient) const {
  for (std::size_t i = 0; i < fx_.size(); ++i) {
    gradient.x[i] -= fx_[i];
    gradient.y[i] -= fy_[i];
  }
}

void ConstantLoad::add_hessian(double, const StateView&, HessianSink&) const {}

}  // namespace suture
