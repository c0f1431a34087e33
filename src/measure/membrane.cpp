#include "suture/measure/membrane.hpp"

#include <fmt/format.h>

#include "suture/errors.hpp"

namespace suture {

Membrane make_membrane(const ContactParameters& contact, const Tissue& tissue) {
  const Membrane membrane{.contact_distance = contact.distance.value_or(tissue.mean_initial_rest_length()),
                          .range = contact.range};
  if (!(membrane.contact_distance > 0.0))
    throw InputError(fmt::format("contact.distance is {}; it must be positive", membrane.contact_distance));
  if (!(membrane.range >= 0.0))
    throw InputError(fmt::format("contact.range is {}; it must not be negative", membrane.range));
  return membrane;
}

}  // namespace suture
