#include "suture/io/config_key.hpp"

#include <fmt/format.h>

#include <cmath>

namespace suture {

namespace {

std::string choice_list(std::span<const Choice> choices) {
  std::string text;
  for (const Choice& choice : choices)
    if (!choice.doc.empty()) text += fmt::format("{}{}", text.empty() ? "" : ", ", choice.name);
  return text;
}

std::string number_text(double value) {
  std::string text = fmt::format("{}", value);
  const bool looks_integral = text.find_first_not_of("-0123456789") == std::string::npos;
  return looks_integral ? text + ".0" : text;
}

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (static_cast<unsigned char>(c) < 0x20)
      result += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    else
      result += c;
  }
  return result + '"';
}

struct Allowed {
  const KeyDescription& key;

  std::string operator()(const bool*) const { return "true or false"; }
  std::string operator()(const int*) const { return integer(); }
  std::string operator()(const std::uint64_t*) const { return integer(); }
  std::string operator()(const std::optional<int>*) const { return integer(); }
  std::string operator()(const double*) const { return number(); }
  std::string operator()(const std::optional<double>*) const { return number(); }
  std::string operator()(const ChoiceSlot&) const { return one_of(); }
  std::string operator()(const std::string*) const { return key.choices.empty() ? "text in quotes" : one_of(); }

  std::string one_of() const { return "one of " + choice_list(key.choices); }
  std::string integer() const { return "an integer " + key.range.text(); }
  std::string number() const {
    const std::string units = accepted_units(key.measure.dimension);
    const std::string range = key.range.text();
    return fmt::format("a number{}{}{}", range.empty() ? "" : " ", range,
                       units.empty() ? "" : fmt::format(" or a quantity in {}", units));
  }
};

struct Text {
  const KeyDescription& key;

  std::string operator()(const bool* value) const { return *value ? "true" : "false"; }
  std::string operator()(const int* value) const { return fmt::format("{}", *value); }
  std::string operator()(const std::uint64_t* value) const { return fmt::format("{}", *value); }
  std::string operator()(const double* value) const { return number_text(*value); }
  std::string operator()(const std::string* value) const { return quoted(*value); }
  std::string operator()(const std::optional<int>* value) const { return *value ? fmt::format("{}", **value) : ""; }
  std::string operator()(const std::optional<double>* value) const { return *value ? number_text(**value) : ""; }
  std::string operator()(const ChoiceSlot& slot) const {
    const int value = slot.get(slot.field);
    for (const Choice& choice : key.choices)
      if (choice.value == value) return quoted(choice.name);
    return quoted(fmt::format("{}", value));
  }
};

}  // namespace

bool Range::contains(double value) const {
  const bool above = minimum_closed ? value >= minimum : value > minimum;
  const bool below = maximum_closed ? value <= maximum : value < maximum;
  return above && below;
}

std::string Range::text() const {
  const bool bounded_below = std::isfinite(minimum);
  const bool bounded_above = std::isfinite(maximum);
  if (bounded_below && bounded_above && minimum_closed && maximum_closed)
    return fmt::format("from {} to {}", minimum, maximum);
  const std::string low = bounded_below ? fmt::format("{} {}", minimum_closed ? ">=" : ">", minimum) : "";
  const std::string high = bounded_above ? fmt::format("{} {}", maximum_closed ? "<=" : "<", maximum) : "";
  const std::string both = low.empty() || high.empty() ? low + high : low + " and " + high;
  return !bounded_above && maximum_closed && !both.empty() ? both + " (inf allowed)" : both;
}

std::string KeyDescription::path() const {
  return section.empty() ? std::string{name} : fmt::format("{}.{}", section, name);
}

std::string allowed_text(const KeyDescription& key, const Slot& slot) { return std::visit(Allowed{key}, slot); }
std::string value_text(const KeyDescription& key, const Slot& slot) { return std::visit(Text{key}, slot); }

}  // namespace suture
