// A TOML text taken apart into located values, so that only config_document.cpp sees the TOML library.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace suture {

/// A table or array where a single value may be expected.
struct NotAScalar {
  bool is_table = false;
};

struct ConfigEntry {
  std::string path;    ///< "section.key"; "section" for the table itself; "key" inside [[cell_type]]
  std::string origin;  ///< "embryo.toml:12:7" or "command line: --set ..."
  std::variant<NotAScalar, bool, std::int64_t, double, std::string> value;
  std::string found;  ///< the value as it is to be shown in messages
};

struct CellTypeEntries {
  std::string origin;
  std::vector<ConfigEntry> entries;
};

struct ConfigDocument {
  std::vector<ConfigEntry> entries;  ///< in the order of the text
  std::vector<CellTypeEntries> cell_types;
  bool has_cell_types = false;
};

/// Throws InputError where the text is not TOML.
ConfigDocument parse_document(std::string_view text, const std::string& name);

/// "section.key=value"; a value that is not TOML is taken as a bare word. `origin` is where messages say it comes from.
/// Throws InputError without key or '='.
ConfigDocument parse_override(const std::string& text, const std::string& origin);

}  // namespace suture
