// One row of the configuration table: what a key is called, means and may be, and where its value lives in Config.
// The same rows parse, validate, print the defaults and write docs/reference/config.md.
#pragma once

#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "suture/io/units.hpp"
#include "suture/model/parameters.hpp"

namespace suture {

/// One allowed word of a key. A word without documentation is a second spelling of an earlier word of the same value.
struct Choice {
  std::string_view name;
  int value = 0;
  std::string_view doc;
};

/// Allowed numbers. A limit of infinity that is `closed` admits the value inf itself.
struct Range {
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool minimum_closed = true;
  bool maximum_closed = true;

  bool contains(double value) const;
  /// "> 0", "from 0 to 1", ...
  std::string text() const;
};

/// How a bare number is to be read: its dimension, and the unit printed in the documentation.
struct Measure {
  Dimension dimension = Dimension::none;
  std::string_view unit;         ///< empty: model_unit(dimension)
  bool stored_physical = false;  ///< the [units] scales: numbers are in base_unit(dimension), not in model units
};

/// A second spelling of a key.
struct Alias {
  std::string_view name;
  bool needs_unit = false;  ///< bare numbers are refused, because the name promises a physical quantity
};

/// Access to an enumeration as one of its choices.
struct ChoiceSlot {
  void* field;
  int (*get)(const void* field);
  void (*set)(void* field, int value);
};

/// Where a value lives.
using Slot = std::variant<bool*, int*, std::uint64_t*, double*, std::string*, std::optional<int>*,
                          std::optional<double>*, ChoiceSlot>;

struct KeyDescription {
  std::string_view section;  ///< empty for top-level keys
  std::string_view name;
  Measure measure;
  Range range;
  std::string_view doc;
  std::string_view unset;  ///< what an optional key means when it is not given
  std::vector<Alias> aliases;
  std::span<const Choice> choices;

  std::string path() const;
};

template <class Owner>
struct ConfigKey : KeyDescription {
  Slot (*slot)(Owner& owner) = nullptr;
};

struct SectionDescription {
  std::string_view name;
  std::string_view doc;
};

/// Specialised for every enumeration that a key can hold.
template <class Enumeration>
std::span<const Choice> choices_of();
template <>
std::span<const Choice> choices_of<SpringLaw>();
template <>
std::span<const Choice> choices_of<TetherLaw>();
template <>
std::span<const Choice> choices_of<CaptureLaw>();
template <>
std::span<const Choice> choices_of<CaptureSearch>();
template <>
std::span<const Choice> choices_of<GapLaw>();
template <>
std::span<const Choice> choices_of<EventHandling>();
template <>
std::span<const Choice> choices_of<Adjacency>();
template <>
std::span<const Choice> choices_of<Method>();
template <>
std::span<const Choice> choices_of<LinearSolver>();
template <>
std::span<const Choice> choices_of<Protocol>();
template <>
std::span<const Choice> choices_of<Stage>();

template <class Field>
Slot make_slot(Field& field) {
  if constexpr (std::is_enum_v<Field>) {
    return ChoiceSlot{&field, [](const void* value) { return static_cast<int>(*static_cast<const Field*>(value)); },
                      [](void* target, int value) { *static_cast<Field*>(target) = static_cast<Field>(value); }};
  } else {
    return &field;
  }
}

/// Sections in the order in which they are printed; cell_type is the one that may be repeated.
std::span<const SectionDescription> config_sections();
/// Every key outside [[cell_type]], section by section.
const std::vector<ConfigKey<Config>>& config_keys();
/// Keys of one [[cell_type]] table.
const std::vector<ConfigKey<CellType>>& cell_type_keys();

/// "a number > 0 or a quantity in s, min, h", "one of relative, quadratic", ...
std::string allowed_text(const KeyDescription& key, const Slot& slot);
/// The value as TOML; empty when it is unset.
std::string value_text(const KeyDescription& key, const Slot& slot);

}  // namespace suture
