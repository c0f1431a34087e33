#include "config_assign.hpp"

#include <fmt/format.h>

#include "suture/errors.hpp"
#include "suture/io/nearest_name.hpp"

namespace suture {

namespace {

struct Assignment {
  const KeyDescription& key;
  const Slot& slot;
  const Alias* alias;
  const ConfigEntry& entry;
  const UnitScales& scales;

  [[noreturn]] void refuse(std::string_view suggested = {}) const {
    throw InputError(fmt::format("{}: key '{}': found {}, allowed {}{}", entry.origin, key.path(), entry.found,
                                 allowed_text(key, slot), suggested));
  }

  [[noreturn]] void refuse_quantity(std::string_view reason) const {
    throw InputError(fmt::format("{}: key '{}': {}", entry.origin, key.path(), reason));
  }

  double quantity(const std::string& text) const {
    if (accepted_units(key.measure.dimension).empty()) refuse();
    try {
      const double physical = parse_quantity(text, key.measure.dimension);
      return key.measure.stored_physical ? physical : scales.to_model(physical, key.measure.dimension);
    } catch (const InputError& error) {
      refuse_quantity(error.what());
    }
  }

  double bare_number(double value) const {
    if (alias != nullptr && alias->needs_unit)
      refuse_quantity(fmt::format("found {} without a unit for '{}', allowed a quantity in {}, or '{}' in model units",
                                  entry.found, alias->name, accepted_units(key.measure.dimension), key.path()));
    return value;
  }

  double number() const {
    double value = 0.0;
    if (const auto* real = std::get_if<double>(&entry.value))
      value = bare_number(*real);
    else if (const auto* integer = std::get_if<std::int64_t>(&entry.value))
      value = bare_number(static_cast<double>(*integer));
    else if (const auto* text = std::get_if<std::string>(&entry.value))
      value = quantity(*text);
    else
      refuse();
    if (!key.range.contains(value)) refuse();
    return value;
  }

  std::int64_t integer() const {
    const auto* value = std::get_if<std::int64_t>(&entry.value);
    if (value == nullptr || !key.range.contains(static_cast<double>(*value))) refuse();
    return *value;
  }

  const std::string& text() const {
    const auto* value = std::get_if<std::string>(&entry.value);
    if (value == nullptr) refuse();
    return *value;
  }

  const Choice& choice() const {
    const std::string& word = text();
    std::vector<std::string> names;
    for (const Choice& candidate : key.choices) {
      if (candidate.name == word) return candidate;
      names.emplace_back(candidate.name);
    }
    refuse(suggestion(word, names));
  }

  void operator()(bool* field) const {
    const auto* value = std::get_if<bool>(&entry.value);
    if (value == nullptr) refuse();
    *field = *value;
  }
  void operator()(int* field) const { *field = static_cast<int>(integer()); }
  void operator()(std::optional<int>* field) const { *field = static_cast<int>(integer()); }
  void operator()(std::uint64_t* field) const { *field = static_cast<std::uint64_t>(integer()); }
  void operator()(double* field) const { *field = number(); }
  void operator()(std::optional<double>* field) const { *field = number(); }
  void operator()(const ChoiceSlot& field) const { field.set(field.field, choice().value); }
  void operator()(std::string* field) const { *field = key.choices.empty() ? text() : std::string{choice().name}; }
};

}  // namespace

void assign(const KeyDescription& key, const Slot& slot, const Alias* alias, const ConfigEntry& entry,
            const UnitScales& scales) {
  std::visit(Assignment{key, slot, alias, entry, scales}, slot);
}

}  // namespace suture
