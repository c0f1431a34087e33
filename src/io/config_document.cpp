#include "config_document.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <sstream>
#include <tuple>

#include "suture/errors.hpp"

namespace suture {

namespace {

constexpr std::string_view cell_type = "cell_type";

// Where a value stands: a place in a file, or the one option of the command line it came with.
struct Place {
  std::string name;
  bool has_lines = false;

  std::string at(const toml::source_region& region) const {
    return has_lines ? fmt::format("{}:{}:{}", name, region.begin.line, region.begin.column) : name;
  }
};

std::string shown(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (node.is_array()) return "an array";
  std::ostringstream text;
  node.visit([&text](const auto& value) {
    if constexpr (toml::is_value<decltype(value)>) text << value;
  });
  if (node.is_floating_point()) return fmt::format("{}", **node.as_floating_point());
  return node.is_string() ? fmt::format("\"{}\"", **node.as_string()) : text.str();
}

ConfigEntry make_entry(std::string path, std::string origin, const toml::node& node) {
  ConfigEntry entry{std::move(path), std::move(origin), NotAScalar{node.is_table()}, shown(node)};
  if (node.is_boolean()) entry.value = **node.as_boolean();
  if (node.is_integer()) entry.value = **node.as_integer();
  if (node.is_floating_point()) entry.value = **node.as_floating_point();
  if (node.is_string()) entry.value = **node.as_string();
  return entry;
}

struct Located {
  toml::source_position position;
  ConfigEntry entry;
};

std::vector<ConfigEntry> in_order(std::vector<Located> located) {
  std::stable_sort(located.begin(), located.end(), [](const Located& a, const Located& b) {
    return std::tie(a.position.line, a.position.column) < std::tie(b.position.line, b.position.column);
  });
  std::vector<ConfigEntry> entries;
  for (Located& item : located) entries.push_back(std::move(item.entry));
  return entries;
}

std::vector<ConfigEntry> table_entries(const toml::table& table, const std::string& prefix, const Place& place) {
  std::vector<Located> located;
  for (const auto& [key, node] : table)
    located.push_back({key.source().begin, make_entry(prefix + std::string{key.str()}, place.at(key.source()), node)});
  return in_order(std::move(located));
}

void add_cell_types(ConfigDocument& document, const toml::node& node, const std::string& origin, const Place& place) {
  const toml::array* array = node.as_array();
  const bool tables = array != nullptr &&
                      std::all_of(array->begin(), array->end(), [](const toml::node& item) { return item.is_table(); });
  if (!tables)
    throw InputError(fmt::format("{}: key 'cell_type': found {}, allowed one or more tables [[cell_type]]", origin,
                                 node.is_table() ? "[cell_type]" : shown(node)));
  document.has_cell_types = true;
  for (const toml::node& item : *array)
    document.cell_types.push_back({place.at(item.source()), table_entries(*item.as_table(), "", place)});
}

// Adds what stands under `path`: a section's keys, the list of cell types, or a single value.
void add_node(ConfigDocument& document, std::vector<ConfigEntry>& entries, const std::string& path,
              const std::string& origin, const toml::node& node, const Place& place) {
  if (path == cell_type) return add_cell_types(document, node, origin, place);
  entries.push_back(make_entry(path, origin, node));
  if (const toml::table* table = node.as_table(); table != nullptr && path.find('.') == std::string::npos)
    for (ConfigEntry& entry : table_entries(*table, path + ".", place)) entries.push_back(std::move(entry));
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

// The value as TOML; anything that is not one TOML value is a word.
toml::table override_value(std::string_view text) {
  try {
    toml::table table = toml::parse(fmt::format("value = {}", text));
    if (table.size() == 1) return table;
  } catch (const toml::parse_error&) {
    // A bare word such as relative, or a quantity such as 85 min.
  }
  return toml::table{{"value", std::string{text}}};
}

}  // namespace

ConfigDocument parse_document(std::string_view text, const std::string& name) {
  const Place place{name, true};
  try {
    const toml::table root = toml::parse(text, name);
    ConfigDocument document;
    std::vector<std::pair<toml::source_position, std::vector<ConfigEntry>>> blocks;
    for (const auto& [key, node] : root) {
      blocks.emplace_back(key.source().begin, std::vector<ConfigEntry>{});
      add_node(document, blocks.back().second, std::string{key.str()}, place.at(key.source()), node, place);
    }
    std::stable_sort(blocks.begin(), blocks.end(), [](const auto& a, const auto& b) {
      return std::tie(a.first.line, a.first.column) < std::tie(b.first.line, b.first.column);
    });
    for (auto& [position, entries] : blocks)
      std::move(entries.begin(), entries.end(), std::back_inserter(document.entries));
    return document;
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}: not valid TOML: {}", place.at(error.source()), error.description()));
  }
}

ConfigDocument parse_override(const std::string& text, const std::string& origin) {
  const Place place{origin, false};
  const auto equals = text.find('=');
  const std::string path{trimmed(std::string_view{text}.substr(0, equals))};
  const std::string_view value = equals == std::string::npos ? "" : trimmed(std::string_view{text}.substr(equals + 1));
  if (equals == std::string::npos || path.empty() || value.empty())
    throw InputError(fmt::format("{}: found no {}, allowed section.key=value", place.name,
                                 equals == std::string::npos ? "'='"
                                 : path.empty()              ? "key"
                                                             : "value"));
  ConfigDocument document;
  const toml::table table = override_value(value);
  add_node(document, document.entries, path, place.name, *table.get("value"), place);
  return document;
}

}  // namespace suture
