#include "suture/io/sweep_file.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <sstream>

#include "suture/errors.hpp"
#include "suture/io/nearest_name.hpp"

namespace suture {

namespace {

struct Leaf {
  std::string key, origin;
  const toml::node* node;
};

std::string value_as_text(const toml::node& node) {
  if (node.is_floating_point()) return fmt::format("{}", **node.as_floating_point());
  std::ostringstream text;
  node.visit([&text](const auto& value) { text << value; });
  return text.str();
}

class SweepReader {
 public:
  explicit SweepReader(const std::filesystem::path& file) : name_(file.string()), folder_(file.parent_path()) {
    try {
      root_ = toml::parse_file(name_);
    } catch (const toml::parse_error& error) {
      throw InputError(fmt::format("{}: not valid TOML: {}", at(error.source()), error.description()));
    }
  }

  SweepFile read() {
    require_known(root_, {"base", "seeds", "set", "grid", "list", "case", "derived", "preparation"}, "");
    SweepFile sweep;
    if (const toml::node* base = root_.get("base")) sweep.base = folder_ / text(*base, "base");
    if (const toml::node* seeds = root_.get("seeds")) sweep.seeds = read_seeds(*seeds, "seeds");
    sweep.set = overrides(table_at(root_, "set"), "set");
    sweep.preparation = overrides(table_at(root_, "preparation"), "preparation");
    for (const Leaf& leaf : leaves(table_at(root_, "grid"))) sweep.axes.push_back(axis({leaf}, "grid"));
    for (const toml::table* list : tables_at("list")) sweep.axes.push_back(axis(leaves(list), "list"));
    for (const toml::table* given : tables_at("case")) sweep.cases.push_back(read_case(*given));
    for (const Leaf& leaf : leaves(table_at(root_, "derived"))) sweep.derived.push_back(read_derived(leaf));
    return sweep;
  }

 private:
  std::string at(const toml::source_region& region) const {
    return fmt::format("{}:{}:{}", name_, region.begin.line, region.begin.column);
  }

  [[noreturn]] void refuse(const toml::node& node, std::string_view key, std::string_view allowed) const {
    const std::string found = node.is_table() ? "a table" : node.is_array() ? "an array" : value_as_text(node);
    throw InputError(fmt::format("{}: key '{}': found {}, allowed {}", at(node.source()), key, found, allowed));
  }

  void require_known(const toml::table& table, const std::vector<std::string>& known, std::string_view prefix) const {
    for (const auto& [key, node] : table)
      if (std::find(known.begin(), known.end(), key.str()) == known.end())
        throw InputError(fmt::format("{}: key '{}{}': found an unknown key, allowed {}{}", at(key.source()), prefix,
                                     key.str(), fmt::format("{}", fmt::join(known, ", ")), suggestion(key.str(), known)));
  }

  std::string text(const toml::node& node, std::string_view key) const {
    if (!node.is_string()) refuse(node, key, "a text in quotes");
    return **node.as_string();
  }

  const toml::table* table_at(const toml::table& parent, std::string_view name) const {
    const toml::node* node = parent.get(name);
    if (node != nullptr && !node->is_table()) refuse(*node, name, fmt::format("a table [{}]", name));
    return node == nullptr ? nullptr : node->as_table();
  }

  std::vector<const toml::table*> tables_at(std::string_view name) const {
    std::vector<const toml::table*> tables;
    const toml::node* node = root_.get(name);
    if (node == nullptr) return tables;
    if (!node->is_array()) refuse(*node, name, fmt::format("one or more tables [[{}]]", name));
    for (const toml::node& item : *node->as_array()) {
      if (!item.is_table()) refuse(item, name, fmt::format("one or more tables [[{}]]", name));
      tables.push_back(item.as_table());
    }
    return tables;
  }

  /// Keys of the configuration under `table`, written "section.key" or as a table [section], in the order of the file.
  std::vector<Leaf> leaves(const toml::table* table) const {
    std::vector<std::pair<toml::source_position, Leaf>> found;
    const auto add = [&](const std::string& path, const toml::key& key, const toml::node& node) {
      found.push_back({key.source().begin, Leaf{path, at(key.source()), &node}});
    };
    if (table == nullptr) return {};
    for (const auto& [key, node] : *table) {
      const std::string path{key.str()};
      if (node.is_table() && path.find('.') == std::string::npos)
        for (const auto& [inner, value] : *node.as_table()) add(path + "." + std::string{inner.str()}, inner, value);
      else
        add(path, key, node);
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
      return std::tie(a.first.line, a.first.column) < std::tie(b.first.line, b.first.column);
    });
    std::vector<Leaf> ordered;
    for (auto& [position, leaf] : found) ordered.push_back(std::move(leaf));
    return ordered;
  }

  std::vector<ConfigOverride> overrides(const toml::table* table, std::string_view where) const {
    std::vector<ConfigOverride> result;
    for (const Leaf& leaf : leaves(table)) {
      if (leaf.node->is_table()) refuse(*leaf.node, fmt::format("{}.{}", where, leaf.key), "a single value");
      result.push_back({fmt::format("{}={}", leaf.key, value_as_text(*leaf.node)), leaf.origin});
    }
    return result;
  }

  SweepAxis axis(const std::vector<Leaf>& keys, std::string_view where) const {
    SweepAxis result;
    for (const Leaf& leaf : keys) {
      const std::string path = fmt::format("{}.{}", where, leaf.key);
      const toml::array* values = leaf.node->as_array();
      if (values == nullptr || values->empty()) refuse(*leaf.node, path, "an array of at least one value");
      if (result.keys.empty()) {
        result.origin = leaf.origin;
        result.texts.resize(values->size());
      }
      if (values->size() != result.texts.size())
        throw InputError(fmt::format("{}: key '{}': found {} values, allowed as many as '{}' has: {}", leaf.origin, path,
                                     values->size(), result.keys.front(), result.texts.size()));
      result.keys.push_back(leaf.key);
      for (std::size_t i = 0; i < values->size(); ++i) result.texts[i].push_back(value_as_text((*values)[i]));
    }
    return result;
  }

  SweepCase read_case(const toml::table& table) const {
    require_known(table, {"name", "base", "set", "seeds"}, "case.");
    const toml::node* name = table.get("name");
    if (name == nullptr) throw InputError(fmt::format("{}: key 'case.name': found no value, allowed a name", at(table.source())));
    SweepCase result{text(*name, "case.name"), {}, overrides(table_at(table, "set"), "case.set"), at(table.source()), {}};
    if (result.name.empty() || result.name.find_first_of(",\"\n") != std::string::npos)
      refuse(*name, "case.name", "a name without comma, quote or line break");
    if (const toml::node* base = table.get("base")) result.base = folder_ / text(*base, "case.base");
    if (const toml::node* seeds = table.get("seeds")) result.seeds = read_seeds(*seeds, "case.seeds");
    return result;
  }

  DerivedKey read_derived(const Leaf& leaf) const {
    DerivedKey derived{leaf.key, {}, 1.0, leaf.origin};
    if (leaf.node->is_string()) {
      derived.of = **leaf.node->as_string();
      return derived;
    }
    const std::string path = "derived." + leaf.key;
    const toml::table* table = leaf.node->as_table();
    if (table == nullptr) refuse(*leaf.node, path, "another key in quotes or {key = \"...\", factor = ...}");
    require_known(*table, {"key", "factor"}, path + ".");
    const toml::node *of = table->get("key"), *factor = table->get("factor");
    if (of == nullptr) refuse(*table, path, "{key = \"...\", factor = ...}");
    derived.of = text(*of, path + ".key");
    if (factor != nullptr && !factor->is_number()) refuse(*factor, path + ".factor", "a number");
    if (factor != nullptr) derived.factor = *factor->value<double>();
    return derived;
  }

  std::vector<std::uint64_t> read_seeds(const toml::node& node, std::string_view key) const {
    if (node.is_string()) return parse_seeds(**node.as_string(), fmt::format("{}: key '{}'", at(node.source()), key));
    constexpr std::string_view allowed = "an array of whole numbers, or a text such as \"1-25\"";
    const toml::array* array = node.as_array();
    if (array == nullptr || array->empty()) refuse(node, key, allowed);
    std::set<std::uint64_t> seeds;
    for (const toml::node& item : *array) {
      if (!item.is_integer() || **item.as_integer() < 0) refuse(item, key, allowed);
      seeds.insert(static_cast<std::uint64_t>(**item.as_integer()));
    }
    return {seeds.begin(), seeds.end()};
  }

  std::string name_;
  std::filesystem::path folder_;
  toml::table root_;
};

std::uint64_t whole_number(std::string_view text, std::string_view all, std::string_view origin) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    throw InputError(fmt::format("{}: found \"{}\", allowed whole numbers and ranges such as 1-25 or 1,2,7-9", origin, all));
  return value;
}

}  // namespace

std::vector<std::uint64_t> parse_seeds(std::string_view text, std::string_view origin) {
  constexpr std::uint64_t most = 1000000;
  std::set<std::uint64_t> seeds;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t comma = std::min(text.find(',', start), text.size());
    const std::string_view part = text.substr(start, comma - start);
    const std::size_t dash = part.find('-');
    const std::uint64_t first = whole_number(part.substr(0, dash), text, origin);
    const std::uint64_t last = dash == std::string_view::npos ? first : whole_number(part.substr(dash + 1), text, origin);
    if (last < first || last - first >= most)
      throw InputError(fmt::format("{}: found the range \"{}\", allowed an increasing one of at most {} seeds", origin, part, most));
    for (std::uint64_t seed = first; seed <= last; ++seed) seeds.insert(seed);
    start = comma + 1;
  }
  return {seeds.begin(), seeds.end()};
}

SweepFile read_sweep_file(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) throw InputError(fmt::format("{}: no such file", file.string()));
  return SweepReader(file).read();
}

}  // namespace suture
