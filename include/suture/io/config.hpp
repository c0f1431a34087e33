// Configuration files: TOML in, a complete and checked Config out. Strict: an unknown key, a wrong type, a value out of
// range, a word that is not allowed or a wrong unit is an InputError
//
//     embryo.toml:12:7: key 'plasticty.tau': found an unknown key, allowed ..., did you mean 'plasticity.tau'?
//
// All keys are described in docs/reference/config.md, which is generated from the table that also parses them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "suture/model/parameters.hpp"

namespace suture {

/// One key set from outside the configuration file.
struct ConfigOverride {
  std::string text;    ///< "section.key=value", the value in TOML or a bare word
  std::string origin;  ///< stands for the place in messages: "sweep.toml:12:1"
};

/// Reads `file` and applies `overrides` ("section.key=value", the value in TOML or a bare word), the last of which
/// wins. Throws InputError.
Config read_config(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The same for text in memory; `name` stands for the file in messages. An empty text gives the defaults.
Config parse_config(std::string_view text, const std::string& name, const std::vector<std::string>& overrides = {});

/// The configuration in `file`, or the defaults if its name is empty, with overrides that come from another file.
Config resolve_config(const std::filesystem::path& file, const std::vector<ConfigOverride>& overrides);

/// The defaults of a preset, "printed" or "published_code". Throws InputError for another name.
Config default_config(std::string_view preset = "printed");

/// Checks what involves several keys (every single value having been checked on reading). Throws InputError.
void check_config(const Config& config);

enum class Comments { none, full };

/// The complete configuration as TOML in model units; parse_config of it gives an equal Config.
std::string write_config(const Config& config, Comments comments = Comments::none);

/// All keys outside [[cell_type]], "section.key", in the order of the documentation.
std::vector<std::string> config_key_names();

/// "section.key" of a key given by that name or by its second spelling. Throws InputError for an unknown key.
std::string canonical_config_key(std::string_view key);

/// The value of one key as TOML text, model units; empty if it is unset. Throws InputError for an unknown key.
std::string config_value(const Config& config, std::string_view key);

/// One key (or all keys of one section) explained: meaning, unit, default, allowed values. Throws InputError.
std::string explain_config_key(std::string_view key);

/// docs/reference/config.md.
std::string config_reference();

}  // namespace suture
