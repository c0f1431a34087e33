// Model units <-> micrometres, minutes, nanonewtons, kilopascals (model.md section 1; Ton et al. 2023, supplement V).
// Physical units exist only at the file boundary: a quantity is converted once when it is read and once when written.
#pragma once

#include <string>
#include <string_view>

#include "suture/model/parameters.hpp"

namespace suture {

/// What a number measures. `modulus` is a bulk modulus B, whose model number is the area stiffness k_a.
enum class Dimension { none, energy, length, area, time, speed, force, modulus, area_rate };

/// Factors from model units to the base physical units um, um^2, s, um/s, nN, kPa, um^2/min.
class UnitScales {
 public:
  /// Throws InputError unless every scale is positive and finite.
  explicit UnitScales(const UnitParameters& units);

  /// Base physical units per model unit; 1 for dimensions without a physical unit.
  double factor(Dimension dimension) const;
  double to_physical(double model, Dimension dimension) const { return model * factor(dimension); }
  double to_model(double physical, Dimension dimension) const { return physical / factor(dimension); }

  double length_um() const { return length_um_; }
  double time_s() const { return time_s_; }
  double time_min() const { return time_s_ / 60.0; }
  double force_nN() const { return force_nN_; }

 private:
  double length_um_, time_s_, force_nN_;
};

/// The unit `factor` converts to: "um", "um^2", "s", "um/s", "nN", "kPa", "um^2/min"; "" for none and energy.
std::string_view base_unit(Dimension dimension);

/// The unit spelled as a model unit: "sqrt(a0)", "a0", "sqrt(a0)/omega", ...; "" for none.
std::string_view model_unit(Dimension dimension);

/// Units accepted in text for this dimension, "s, min, h"; "" if none are.
std::string accepted_units(Dimension dimension);

/// Value of text such as "85 min" or "0.64kPa" in base units. Throws InputError, whose message says what was found and
/// which units are allowed, when the number or the unit is missing or the unit has another dimension.
double parse_quantity(std::string_view text, Dimension dimension);

/// "0.64 kPa", "2.7 min": the model value in a readable physical unit, with `digits` significant digits.
std::string physical_text(double model, Dimension dimension, const UnitScales& scales, int digits = 3);

}  // namespace suture
