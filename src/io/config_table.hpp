// Vocabulary in which the rows of the configuration table are written.
#pragma once

#include "suture/io/config_key.hpp"

namespace suture {

inline constexpr double infinite = std::numeric_limits<double>::infinity();
inline constexpr double largest_integer = 1e9;  // fits an int

inline constexpr Range anything{};
inline constexpr Range positive{0.0, infinite, false, false};
inline constexpr Range positive_or_infinite{0.0, infinite, false, true};
inline constexpr Range non_negative{0.0, infinite, true, false};
inline constexpr Range between(double minimum, double maximum) { return {minimum, maximum, true, true}; }
inline constexpr Range above_zero_to(double maximum) { return {0.0, maximum, false, true}; }

inline constexpr Measure pure_number{};
inline constexpr Measure in_contact_distances{Dimension::none, "s"};
inline constexpr Measure in_rest_lengths{Dimension::none, "l0(0)"};
inline constexpr Measure energy{Dimension::energy};
inline constexpr Measure length{Dimension::length};
inline constexpr Measure area{Dimension::area};
inline constexpr Measure time{Dimension::time};
inline constexpr Measure speed{Dimension::speed};
inline constexpr Measure force{Dimension::force};
inline constexpr Measure modulus{Dimension::modulus};

/// Columns that most rows leave empty.
struct Extra {
  std::string_view unset;
  std::vector<Alias> aliases;
};

template <auto Section, auto Field>
ConfigKey<Config> key(std::string_view section, std::string_view name, Measure measure, Range range,
                      std::string_view doc, Extra extra = {}) {
  using Value = std::remove_reference_t<decltype((std::declval<Config>().*Section).*Field)>;
  ConfigKey<Config> row{{section, name, measure, range, doc, extra.unset, std::move(extra.aliases), {}},
                        [](Config& config) { return make_slot((config.*Section).*Field); }};
  if constexpr (std::is_enum_v<Value>) row.choices = choices_of<Value>();
  return row;
}

template <auto Field>
ConfigKey<CellType> cell_type_key(std::string_view name, Measure measure, Range range, std::string_view doc,
                                  Extra extra = {}) {
  return {{"cell_type", name, measure, range, doc, extra.unset, std::move(extra.aliases), {}},
          [](CellType& type) { return make_slot(type.*Field); }};
}

/// Rows by theme; config_keys() is their concatenation in this order.
std::vector<ConfigKey<Config>> material_keys();
std::vector<ConfigKey<Config>> purse_string_keys();
std::vector<ConfigKey<Config>> protocol_keys();
std::vector<ConfigKey<Config>> program_keys();

}  // namespace suture
