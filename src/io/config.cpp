#include "suture/io/config.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <map>

#include "config_assign.hpp"
#include "config_check.hpp"
#include "config_document.hpp"
#include "suture/errors.hpp"
#include "suture/io/config_key.hpp"
#include "suture/io/nearest_name.hpp"

namespace suture {

namespace {

template <class Owner>
struct Match {
  const ConfigKey<Owner>* key = nullptr;
  const Alias* alias = nullptr;
  explicit operator bool() const { return key != nullptr; }
};

template <class Owner>
Match<Owner> find_key(const std::vector<ConfigKey<Owner>>& keys, std::string_view path) {
  for (const auto& key : keys) {
    if (key.path() == path) return {&key, nullptr};
    for (const Alias& alias : key.aliases)
      if (fmt::format("{}.{}", key.section, alias.name) == path) return {&key, &alias};
  }
  return {};
}

template <class Owner>
std::vector<std::string> key_names(const std::vector<ConfigKey<Owner>>& keys) {
  std::vector<std::string> names;
  for (const auto& key : keys) {
    names.push_back(key.path());
    for (const Alias& alias : key.aliases) names.push_back(fmt::format("{}.{}", key.section, alias.name));
  }
  return names;
}

bool is_section(std::string_view path) {
  for (const SectionDescription& section : config_sections())
    if (section.name == path) return true;
  return false;
}

[[noreturn]] void refuse_unknown_key(const ConfigEntry& entry, const std::string& path,
                                     const std::vector<std::string>& known) {
  throw InputError(fmt::format("{}: key '{}': found an unknown key, allowed the keys of 'suture config --defaults'{}",
                               entry.origin, path, suggestion(path, known)));
}

[[noreturn]] void refuse_unknown_section(const ConfigEntry& entry) {
  std::vector<std::string> names;
  std::string list;
  for (const SectionDescription& section : config_sections()) {
    names.emplace_back(section.name);
    list += fmt::format("{}[{}]", list.empty() ? "" : " ", section.name);
  }
  throw InputError(fmt::format("{}: key '{}': found an unknown section, allowed {}{}", entry.origin, entry.path, list,
                               suggestion(entry.path, names)));
}

// Brings the documents (the file, then each --set) together into one Config.
class Resolver {
 public:
  Resolver(std::string name, std::vector<ConfigDocument> documents)
      : name_(std::move(name)), documents_(std::move(documents)) {}

  Config resolve() {
    apply([](std::string_view section) { return section.empty(); });
    config_ = default_config(config_.preset);
    // Physical quantities elsewhere are converted with the scales, so these come first.
    apply([](std::string_view section) { return section == "units"; });
    const UnitScales scales{config_.units};
    check_names();
    apply([](std::string_view section) { return section != "units"; }, &scales);
    for (const ConfigDocument& document : documents_)
      if (document.has_cell_types) read_cell_types(document, scales);
    check_config(config_, [this](std::string_view key) { return origin_of(key); });
    return std::move(config_);
  }

 private:
  template <class Selects>
  void apply(Selects selects, const UnitScales* scales = nullptr) {
    const UnitScales defaults{UnitParameters{}};
    for (const ConfigDocument& document : documents_)
      for (const ConfigEntry& entry : document.entries)
        if (const auto match = find_key(config_keys(), entry.path); match && selects(match.key->section)) {
          assign(*match.key, match.key->slot(config_), match.alias, entry, scales ? *scales : defaults);
          origins_[match.key->path()] = entry.origin;
        }
  }

  // Every entry is a known key, given once per document, or a section.
  void check_names() const {
    for (const ConfigDocument& document : documents_) {
      std::map<std::string, const ConfigEntry*> given;
      for (const ConfigEntry& entry : document.entries) {
        const auto* not_a_scalar = std::get_if<NotAScalar>(&entry.value);
        const bool is_table = not_a_scalar != nullptr && not_a_scalar->is_table;
        if (const auto match = find_key(config_keys(), entry.path)) {
          const auto [first, is_new] = given.emplace(match.key->path(), &entry);
          if (!is_new)
            throw InputError(fmt::format("{}: key '{}': found it a second time as '{}', allowed once (first at {})",
                                         entry.origin, match.key->path(), entry.path, first->second->origin));
        } else if (is_section(entry.path)) {
          if (!is_table)
            throw InputError(fmt::format("{}: key '{}': found {}, allowed a section [{}]", entry.origin, entry.path,
                                         entry.found, entry.path));
        } else if (is_table && entry.path.find('.') == std::string::npos) {
          refuse_unknown_section(entry);
        } else {
          refuse_unknown_key(entry, entry.path, key_names(config_keys()));
        }
      }
    }
  }

  void read_cell_types(const ConfigDocument& document, const UnitScales& scales) {
    config_.cell_types.clear();
    for (const CellTypeEntries& table : document.cell_types) {
      CellType type;
      std::map<std::string, bool> given;
      for (const ConfigEntry& entry : table.entries) {
        const std::string path = "cell_type." + entry.path;
        const auto match = find_key(cell_type_keys(), path);
        if (!match) refuse_unknown_key(entry, path, key_names(cell_type_keys()));
        if (!given.emplace(match.key->path(), true).second)
          throw InputError(fmt::format("{}: key '{}': found it a second time as '{}', allowed once", entry.origin,
                                       match.key->path(), entry.path));
        assign(*match.key, match.key->slot(type), match.alias, entry, scales);
        origins_[match.key->path()] = entry.origin;
      }
      if (!given.contains("cell_type.cells"))
        throw InputError(
            fmt::format("{}: key 'cell_type.cells': found no value, allowed the number of cells of this "
                        "[[cell_type]]",
                        table.origin));
      config_.cell_types.push_back(std::move(type));
    }
  }

  std::string origin_of(std::string_view key) const {
    const auto found = origins_.find(key);
    return found != origins_.end() ? found->second : name_;
  }

  std::string name_;
  std::vector<ConfigDocument> documents_;
  std::map<std::string, std::string, std::less<>> origins_;
  Config config_;
};

std::vector<ConfigOverride> from_command_line(const std::vector<std::string>& overrides) {
  std::vector<ConfigOverride> located;
  for (const std::string& text : overrides) located.push_back({text, fmt::format("command line: --set {}", text)});
  return located;
}

Config parse_located(std::string_view text, const std::string& name, const std::vector<ConfigOverride>& overrides) {
  std::vector<ConfigDocument> documents{parse_document(text, name)};
  for (const ConfigOverride& item : overrides) documents.push_back(parse_override(item.text, item.origin));
  return Resolver{name, std::move(documents)}.resolve();
}

std::string text_of(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw InputError(fmt::format("{}: no such file", file.string()));
  if (std::filesystem::is_directory(file, error))
    throw InputError(fmt::format("{}: found a directory, allowed a TOML file", file.string()));
  std::ifstream stream{file, std::ios::binary};
  if (!stream) throw InputError(fmt::format("{}: the file cannot be read", file.string()));
  return {std::istreambuf_iterator<char>{stream}, {}};
}

}  // namespace

Config default_config(std::string_view preset) {
  Config config;
  if (preset == "printed") return config;
  if (preset != "published_code")
    throw InputError(fmt::format("preset: found \"{}\", allowed one of printed, published_code", preset));
  config.preset = preset;
  config.membrane.law = SpringLaw::relative;
  config.purse_string.law = SpringLaw::relative;
  config.purse_string.minimum_rest_length = 0.005;  // 0.01 (s/2), model.md section 5
  config.purse_string.tether_law = TetherLaw::published;
  config.purse_string.capture_law = CaptureLaw::slip;
  config.purse_string.capture_search = CaptureSearch::published;
  config.purse_string.event_handling = EventHandling::each_step;
  config.integrator.method = Method::euler;
  config.output.adjacency = Adjacency::string;
  config.run.closed_area = 0.0264;  // 2 pi (l0(0)/2)^2 of 30 vertices and shape 1.2, model.md section 9
  return config;
}

Config parse_config(std::string_view text, const std::string& name, const std::vector<std::string>& overrides) {
  return parse_located(text, name, from_command_line(overrides));
}

Config read_config(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return parse_located(text_of(file), file.string(), from_command_line(overrides));
}

Config resolve_config(const std::filesystem::path& file, const std::vector<ConfigOverride>& overrides) {
  return parse_located(file.empty() ? "" : text_of(file), file.empty() ? "configuration" : file.string(), overrides);
}

std::vector<std::string> config_key_names() {
  std::vector<std::string> names;
  for (const auto& key : config_keys()) names.push_back(key.path());
  return names;
}

namespace {

const ConfigKey<Config>& known_key(std::string_view key) {
  const auto match = find_key(config_keys(), key);
  if (!match)
    throw InputError(fmt::format("found the unknown key '{}'{}", key, suggestion(key, key_names(config_keys()))));
  return *match.key;
}

}  // namespace

std::string canonical_config_key(std::string_view key) { return known_key(key).path(); }

std::string config_value(const Config& config, std::string_view key) {
  const ConfigKey<Config>& known = known_key(key);
  Config copy = config;
  return value_text(known, known.slot(copy));
}

}  // namespace suture
