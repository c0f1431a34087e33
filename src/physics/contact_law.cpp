#include "suture/physics/contact_law.hpp"

#include <fmt/format.h>

#include <cmath>

#include "suture/errors.hpp"

namespace suture {

ContactLaw::ContactLaw(double energy, double distance, double adhesion, double range)
    : energy_(energy),
      distance_(distance),
      adhesion_(adhesion),
      range_(range),
      inner_(distance * (1.0 + adhesion)),
      outer_(distance * (1.0 + range)) {
  if (!(energy >= 0.0 && std::isfinite(energy)))
    throw InputError(fmt::format("contact.energy is {}; it must be zero or positive", energy));
  if (!(distance > 0.0 && std::isfinite(distance)))
    throw InputError(fmt::format("contact.distance is {}; it must be positive", distance));
  if (!(adhesion >= 0.0 && std::isfinite(adhesion)))
    throw InputError(fmt::format("contact.adhesion is {}; it must be zero or positive", adhesion));
  if (!(range >= 0.0 && std::isfinite(range)))
    throw InputError(fmt::format("contact.range is {}; it must be zero or positive", range));
  if (adhesion > 0.0 && !(adhesion < range))
    throw InputError(
        fmt::format("contact.adhesion is {}, but it must be smaller than contact.range, which is {}", adhesion, range));
  if (adhesion > 0.0) tail_ = energy * adhesion / (range - adhesion);
}

double ContactLaw::value(double d) const {
  if (d >= reach()) return 0.0;
  const double inside = 1.0 - d / distance_;
  if (d < inner_) return energy_ * (inside * inside - adhesion_ * range_);
  const double left = inside + range_;
  return -tail_ * left * left;
}

double ContactLaw::first_derivative(double d) const {
  if (d >= reach()) return 0.0;
  const double inside = 1.0 - d / distance_;
  if (d < inner_) return -2.0 * energy_ * inside / distance_;
  return 2.0 * tail_ * (inside + range_) / distance_;
}

double ContactLaw::second_derivative(double d) const {
  if (d >= reach()) return 0.0;
  return 2.0 * (d < inner_ ? energy_ : -tail_) / (distance_ * distance_);
}

ContactLaw make_contact_law(const Tissue& tissue, const ContactParameters& parameters) {
  return {parameters.energy, parameters.distance.value_or(tissue.mean_initial_rest_length()), parameters.adhesion,
          parameters.range};
}

}  // namespace suture
