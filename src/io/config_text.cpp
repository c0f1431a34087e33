// Everything that prints the configuration table.
#include <fmt/format.h>

#include <iterator>

#include "suture/errors.hpp"
#include "suture/io/config.hpp"
#include "suture/io/config_key.hpp"
#include "suture/io/nearest_name.hpp"

namespace suture {

namespace {

std::string_view unit_of(const KeyDescription& key) {
  return key.measure.unit.empty() ? model_unit(key.measure.dimension) : key.measure.unit;
}

std::string in_unit(const KeyDescription& key) {
  return unit_of(key).empty() ? "" : fmt::format("[{}] ", unit_of(key));
}

template <class Owner>
void write_values(std::string& out, const std::vector<ConfigKey<Owner>>& keys, std::string_view section, Owner& owner,
                  Comments comments) {
  for (const auto& key : keys) {
    if (key.section != section) continue;
    const Slot slot = key.slot(owner);
    const std::string value = value_text(key, slot);
    if (comments == Comments::full)
      out += fmt::format("# {}\n#   {}{}\n", key.doc, in_unit(key), allowed_text(key, slot));
    if (!value.empty())
      out += fmt::format("{} = {}\n", key.name, value);
    else if (comments == Comments::full)
      out += fmt::format("# {} = not set: {}\n", key.name, key.unset);
  }
}

void write_cell_types(std::string& out, Config& config, std::string_view doc, Comments comments) {
  if (comments == Comments::full)
    out += fmt::format("\n# {}:\n# [[cell_type]]\n# name = \"stiff\"\n# cells = 10\n# area_stiffness = 64.0\n", doc);
  for (CellType& type : config.cell_types) {
    out += "\n[[cell_type]]\n";
    write_values(out, cell_type_keys(), "cell_type", type, Comments::none);
  }
}

void explain_choices(std::string& out, const KeyDescription& key, std::string_view indent) {
  for (const Choice& choice : key.choices)
    if (!choice.doc.empty()) out += fmt::format("{}{}: {}\n", indent, choice.name, choice.doc);
}

template <class Owner>
std::string default_text(const ConfigKey<Owner>& key, Owner& defaults) {
  const std::string value = value_text(key, key.slot(defaults));
  return value.empty() ? fmt::format("not set ({})", key.unset) : value;
}

template <class Owner>
std::string explanation(const ConfigKey<Owner>& key, Owner& defaults) {
  std::string out = fmt::format("{}\n  {}\n", key.path(), key.doc);
  if (!unit_of(key).empty())
    out += fmt::format("  {}: {}\n", key.measure.stored_physical ? "unit" : "model unit", unit_of(key));
  out +=
      fmt::format("  default: {}\n  allowed: {}\n", default_text(key, defaults), allowed_text(key, key.slot(defaults)));
  explain_choices(out, key, "    ");
  for (const Alias& alias : key.aliases)
    out +=
        fmt::format("  also written {}.{}{}\n", key.section, alias.name,
                    alias.needs_unit ? fmt::format(", with a unit ({})", accepted_units(key.measure.dimension)) : "");
  return out;
}

std::string preset_note(const ConfigKey<Config>& key) {
  Config printed = default_config("printed");
  Config published = default_config("published_code");
  const std::string there = value_text(key, key.slot(published));
  if (key.section.empty() || value_text(key, key.slot(printed)) == there) return "";
  return fmt::format("  default with preset = \"published_code\": {}\n", there);
}

std::string explain_all(std::string_view section) {
  std::string out;
  Config config;
  CellType type;
  for (const auto& key : config_keys())
    if (key.section == section) out += explanation(key, config) + preset_note(key);
  for (const auto& key : cell_type_keys())
    if (key.section == section) out += explanation(key, type);
  return out;
}

template <class Owner>
void reference_rows(std::string& out, const std::vector<ConfigKey<Owner>>& keys, std::string_view section,
                    Owner& defaults) {
  for (const auto& key : keys) {
    if (key.section != section) continue;
    std::string doc{key.doc};
    for (const Choice& choice : key.choices)
      if (!choice.doc.empty()) doc += fmt::format("<br>`{}`: {}", choice.name, choice.doc);
    for (const Alias& alias : key.aliases)
      doc += fmt::format("<br>also written `{}`{}", alias.name, alias.needs_unit ? " with a unit" : "");
    // A vertical bar would end the table cell.
    for (auto at = doc.find('|'); at != std::string::npos; at = doc.find('|', at + 2)) doc.replace(at, 1, "\\|");
    out += fmt::format("| `{}` | {} | `{}` | {} | {} |\n", key.name, unit_of(key), default_text(key, defaults),
                       key.choices.empty() ? allowed_text(key, key.slot(defaults)) : "one of those on the right", doc);
  }
}

constexpr std::string_view table_head = "| key | unit | default | allowed | meaning |\n|---|---|---|---|---|\n";

std::string preset_table() {
  std::string out =
      "\n## Presets\n\nDefaults in which the presets differ:\n\n| key | `printed` | `published_code` |\n"
      "|---|---|---|\n";
  Config printed = default_config("printed");
  Config published = default_config("published_code");
  for (const auto& key : config_keys()) {
    if (key.section.empty() || preset_note(key).empty()) continue;
    out += fmt::format("| `{}` | `{}` | `{}` |\n", key.path(), value_text(key, key.slot(printed)),
                       value_text(key, key.slot(published)));
  }
  return out;
}

constexpr std::string_view reference_head = R"(# Configuration keys

Generated by `suture config --reference` from the table that parses the files; do not edit.

Numbers without a unit are in model units: length `sqrt(a0)`, energy `epsilon`, time `sqrt(a0)/omega`. `s` is the contact
distance, `l0(0)` the mean initial rest length of the membrane segments. Where units are listed under "allowed", a
quantity in quotes such as `"85 min"` is converted with the scales in `[units]`. On the command line,
`--set section.key=value` overrides any key.

)";

}  // namespace

std::string write_config(const Config& config, Comments comments) {
  Config copy = config;
  std::string out;
  if (comments == Comments::full)
    out += "# Numbers are in model units unless they carry a unit in quotes, such as \"85 min\".\n\n";
  write_values(out, config_keys(), "", copy, comments);
  for (const SectionDescription& section : config_sections()) {
    if (section.name == "cell_type") continue;
    out += comments == Comments::full ? fmt::format("\n# {}\n[{}]\n", section.doc, section.name)
                                      : fmt::format("\n[{}]\n", section.name);
    write_values(out, config_keys(), section.name, copy, comments);
  }
  for (const SectionDescription& section : config_sections())
    if (section.name == "cell_type") write_cell_types(out, copy, section.doc, comments);
  return out;
}

std::string explain_config_key(std::string_view name) {
  std::vector<std::string> known;
  for (const SectionDescription& section : config_sections()) {
    if (section.name == name) return fmt::format("[{}]: {}\n\n{}", section.name, section.doc, explain_all(name));
    known.emplace_back(section.name);
  }
  Config config;
  CellType type;
  const auto named = [&](const KeyDescription& key) {
    known.push_back(key.path());
    bool matches = key.path() == name;
    for (const Alias& alias : key.aliases) matches = matches || fmt::format("{}.{}", key.section, alias.name) == name;
    return matches;
  };
  for (const auto& key : config_keys())
    if (named(key)) return explanation(key, config) + preset_note(key);
  for (const auto& key : cell_type_keys())
    if (named(key)) return explanation(key, type);
  throw InputError(
      fmt::format("command line: --explain {}: found an unknown key, allowed a key or section of "
                  "'suture config --defaults'{}",
                  name, suggestion(name, known)));
}

std::string config_reference() {
  Config config;
  CellType type;
  std::string out{reference_head};
  out += table_head;
  reference_rows(out, config_keys(), "", config);
  for (const SectionDescription& section : config_sections()) {
    const bool repeated = section.name == "cell_type";
    out += fmt::format("\n## {}{}{}\n\n{}.\n\n{}", repeated ? "[[" : "[", section.name, repeated ? "]]" : "]",
                       section.doc, table_head);
    reference_rows(out, config_keys(), section.name, config);
    reference_rows(out, cell_type_keys(), section.name, type);
  }
  return out + preset_table();
}

}  // namespace suture
