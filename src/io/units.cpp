#include "suture/io/units.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "suture/errors.hpp"

namespace suture {

namespace {

struct Unit {
  std::string_view symbol;
  Dimension dimension;
  double factor;  // base units per this unit
};

// Within a dimension from small to large; the base unit has factor 1.
constexpr std::array units{
    Unit{"nm", Dimension::length, 1e-3},
    Unit{"um", Dimension::length, 1.0},
    Unit{"mm", Dimension::length, 1e3},
    Unit{"um^2", Dimension::area, 1.0},
    Unit{"um2", Dimension::area, 1.0},
    Unit{"mm^2", Dimension::area, 1e6},
    Unit{"s", Dimension::time, 1.0},
    Unit{"min", Dimension::time, 60.0},
    Unit{"h", Dimension::time, 3600.0},
    Unit{"nm/s", Dimension::speed, 1e-3},
    Unit{"um/s", Dimension::speed, 1.0},
    Unit{"um/min", Dimension::speed, 1.0 / 60.0},
    Unit{"um/h", Dimension::speed, 1.0 / 3600},
    Unit{"pN", Dimension::force, 1e-3},
    Unit{"nN", Dimension::force, 1.0},
    Unit{"uN", Dimension::force, 1e3},
    Unit{"Pa", Dimension::modulus, 1e-3},
    Unit{"kPa", Dimension::modulus, 1.0},
    Unit{"MPa", Dimension::modulus, 1e3},
    Unit{"um^2/min", Dimension::area_rate, 1.0},
};

// Both Unicode micro signs and the superscript two have an ASCII spelling.
std::string in_ascii(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, char>, 2> micro_signs{{{"\xC2\xB5", 'u'}, {"\xCE\xBC", 'u'}}};
  std::string result;
  while (!text.empty()) {
    std::size_t used = 1;
    char replacement = text.front();
    for (const auto& [sign, letter] : micro_signs)
      if (text.starts_with(sign)) used = sign.size(), replacement = letter;
    if (text.starts_with("\xC2\xB2")) result.push_back('^'), used = 2, replacement = '2';
    result.push_back(replacement);
    text.remove_prefix(used);
  }
  return result;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

const Unit* find_unit(std::string_view symbol) {
  for (const Unit& unit : units)
    if (unit.symbol == symbol) return &unit;
  return nullptr;
}

}  // namespace

UnitScales::UnitScales(const UnitParameters& parameters)
    : length_um_(std::sqrt(parameters.rest_area_um2)),
      time_s_(length_um_ / parameters.constriction_rate_um_per_s),
      force_nN_(parameters.unsticking_force_nN) {
  for (const double scale : {length_um_, time_s_, force_nN_})
    if (!(scale > 0.0 && std::isfinite(scale))) throw InputError("the scales in [units] must be positive and finite");
}

double UnitScales::factor(Dimension dimension) const {
  const double area = length_um_ * length_um_;
  switch (dimension) {
    case Dimension::length:
      return length_um_;
    case Dimension::area:
      return area;
    case Dimension::time:
      return time_s_;
    case Dimension::speed:
      return length_um_ / time_s_;
    case Dimension::force:
      return force_nN_;
    case Dimension::modulus:
      return force_nN_ / area;  // nN/um^2 = kPa
    case Dimension::area_rate:
      return area / time_min();
    case Dimension::none:
    case Dimension::energy:
      return 1.0;
  }
  return 1.0;
}

std::string_view base_unit(Dimension dimension) {
  for (const Unit& unit : units)
    if (unit.dimension == dimension && unit.factor == 1.0) return unit.symbol;
  return {};
}

std::string_view model_unit(Dimension dimension) {
  switch (dimension) {
    case Dimension::none:
      return "";
    case Dimension::energy:
      return "epsilon";
    case Dimension::length:
      return "sqrt(a0)";
    case Dimension::area:
      return "a0";
    case Dimension::time:
      return "sqrt(a0)/omega";
    case Dimension::speed:
      return "omega";
    case Dimension::force:
      return "f_adh";
    case Dimension::modulus:
      return "epsilon";
    case Dimension::area_rate:
      return "omega sqrt(a0)";
  }
  return "";
}

std::string accepted_units(Dimension dimension) {
  std::string text;
  for (const Unit& unit : units)
    if (unit.dimension == dimension) text += fmt::format("{}{}", text.empty() ? "" : ", ", unit.symbol);
  return text;
}

double parse_quantity(std::string_view text, Dimension dimension) {
  const std::string allowed = accepted_units(dimension);
  const std::string ascii = in_ascii(text);
  const std::string_view body = trimmed(ascii);
  double value = 0.0;
  const auto [end, error] = std::from_chars(body.data(), body.data() + body.size(), value);
  if (error != std::errc{})
    throw InputError(fmt::format("found \"{}\", allowed a number and a unit ({})", text, allowed));
  const std::string_view symbol = trimmed(body.substr(end - body.data()));
  if (symbol.empty())
    throw InputError(fmt::format(
        "found \"{}\" without a unit, allowed a unit ({}) or, without quotes, a number in model units", text, allowed));
  const Unit* unit = find_unit(symbol);
  if (unit == nullptr)
    throw InputError(fmt::format("found the unknown unit '{}' in \"{}\", allowed units: {}", symbol, text, allowed));
  if (unit->dimension != dimension)
    throw InputError(
        fmt::format("found the unit '{}' of another dimension in \"{}\", allowed units: {}", symbol, text, allowed));
  return value * unit->factor;
}

std::string physical_text(double model, Dimension dimension, const UnitScales& scales, int digits) {
  if (!std::isfinite(model)) return fmt::format("{}", model);
  const double physical = scales.to_physical(model, dimension);
  std::string_view symbol = base_unit(dimension);
  double shown = physical;
  if (dimension == Dimension::time && std::abs(physical) >= 60.0) {
    symbol = std::abs(physical) >= 36000.0 ? "h" : "min";
    shown = physical / find_unit(symbol)->factor;
  }
  return symbol.empty() ? fmt::format("{:.{}g}", shown, digits) : fmt::format("{:.{}g} {}", shown, digits, symbol);
}

}  // namespace suture
