// Properties that every row of the configuration table must have; a new key is tested by being in the table.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <regex>
#include <set>

#include "suture/errors.hpp"
#include "suture/io/config.hpp"
#include "suture/io/config_key.hpp"

using namespace suture;

namespace {

bool is_integer(const Slot& slot) {
  return std::holds_alternative<int*>(slot) || std::holds_alternative<std::optional<int>*>(slot) ||
         std::holds_alternative<std::uint64_t*>(slot);
}

bool is_real(const Slot& slot) {
  return std::holds_alternative<double*>(slot) || std::holds_alternative<std::optional<double>*>(slot);
}

// TOML values just outside what a row allows.
std::vector<std::string> refused_values(const KeyDescription& key, const Slot& slot) {
  std::vector<std::string> values{"[1, 2]", "{a = 1}", "1979-05-27"};
  if (std::holds_alternative<bool*>(slot)) return {"1", "\"yes\"", "[true]"};
  if (!is_integer(slot) && !is_real(slot)) {
    values.push_back("3");
    if (!key.choices.empty()) values.push_back("\"no_such_word\"");
    return values;
  }
  values.insert(values.end(), {"true", "\"many\"", "nan"});
  if (is_integer(slot)) values.insert(values.end(), {"4.5", "inf", "99999999999999999999.0"});
  if (std::isfinite(key.range.minimum)) {
    const double step = is_integer(slot) ? 1.0 : 1e-6;
    const double outside = key.range.minimum_closed ? key.range.minimum - step : key.range.minimum;
    values.push_back(is_integer(slot) ? std::to_string(std::llround(outside)) : std::to_string(outside));
  }
  if (is_real(slot) && !key.range.maximum_closed) values.push_back("inf");
  if (is_real(slot) && std::isfinite(key.range.maximum)) values.push_back(std::to_string(key.range.maximum * 2 + 1));
  return values;
}

}  // namespace

TEST_CASE("every key has a name of its own, a section and a documentation", "[unit]") {
  std::set<std::string> sections, paths;
  for (const SectionDescription& section : config_sections()) {
    CHECK_FALSE(section.doc.empty());
    CHECK(sections.insert(std::string{section.name}).second);
  }
  for (const auto& key : config_keys()) {
    INFO(key.path());
    CHECK(key.doc.size() > 10);
    CHECK((key.section.empty() || sections.contains(std::string{key.section})));
    CHECK(paths.insert(key.path()).second);
  }
  for (const auto& key : cell_type_keys()) CHECK(key.doc.size() > 5);
  CHECK(paths.size() > 70);
}

TEST_CASE("every field of the parameter structs has a row", "[unit]") {
  std::set<std::string> known;
  for (const auto& key : config_keys()) known.insert(key.path());
  std::ifstream header{SUTURE_SOURCE_DIR "/include/suture/model/parameters.hpp"};
  REQUIRE(header);
  const std::regex structure{R"(^struct (\w+)Parameters \{)"};
  const std::regex field{R"(^  [\w:<>]+ (\w+?)(_um2|_nN|_um_per_s)?( = [^;]*)?;)"};
  const std::map<std::string, std::string> irregular{{"PurseString", "purse_string"}, {"Unit", "units"}};
  std::string section;
  int checked = 0;
  for (std::string line; std::getline(header, line);) {
    std::smatch match;
    if (std::regex_search(line, match, structure)) {
      section = match[1];
      const auto found = irregular.find(section);
      section = found != irregular.end() ? found->second : std::string(1, std::tolower(section[0])) + section.substr(1);
    } else if (line == "};") {
      section.clear();
    } else if (!section.empty() && std::regex_search(line, match, field)) {
      INFO(line);
      CHECK(known.contains(section + "." + match[1].str()));
      ++checked;
    }
  }
  CHECK(checked == static_cast<int>(known.size()) - 1);  // all but preset
}

TEST_CASE("keys that other tools use exist", "[unit]") {
  for (const char* key : {"area.stiffness", "membrane.stiffness", "membrane.law", "bending.stiffness", "plasticity.tau",
                          "plasticity.memory", "purse_string.tether_law", "tissue.seed", "tissue.cells",
                          "tissue.vertices", "integrator.method", "integrator.tolerance"})
    CHECK_NOTHROW(config_value(Config{}, key));
}

TEST_CASE("every default is allowed, and every integer fits its type", "[unit]") {
  Config defaults;
  for (const auto& key : config_keys()) {
    INFO(key.path());
    const Slot slot = key.slot(defaults);
    if (const auto* real = std::get_if<double*>(&slot)) CHECK(key.range.contains(**real));
    if (const auto* integer = std::get_if<int*>(&slot)) {
      CHECK(key.range.contains(**integer));
      CHECK(key.range.maximum <= 2147483647.0);
    }
    if (value_text(key, slot).empty()) CHECK_FALSE(key.unset.empty());
  }
}

TEST_CASE("every key refuses wrong types and values outside its range", "[unit]") {
  Config defaults;
  int checked = 0;
  for (const auto& key : config_keys())
    for (const std::string& value : refused_values(key, key.slot(defaults))) {
      const std::string text = key.section.empty() ? std::string{key.name} + " = " + value
                                                   : fmt::format("[{}]\n{} = {}", key.section, key.name, value);
      INFO(text);
      CHECK_THROWS_AS(parse_config(text, "test.toml"), InputError);
      ++checked;
    }
  CHECK(checked > 300);
}

TEST_CASE("every word of every key is accepted and written back in its first spelling", "[unit]") {
  int checked = 0;
  for (const auto& key : config_keys())
    for (const Choice& choice : key.choices) {
      if (key.section.empty()) continue;
      const std::string override_text = key.path() + "=" + std::string{choice.name};
      INFO(override_text);
      // These words need company: a chain law that divides by lambda_min, protocols of one cell, the published captures.
      const bool after_steps = override_text == "purse_string.capture_search=published";
      const Config config =
          parse_config("", "test.toml",
                       {"purse_string.minimum_rest_length=0.01", "tissue.cells=1", "run.last_stage=packing",
                        override_text, key.path() == "run.last_stage" ? "tissue.cells=50" : "tissue.vertices=30",
                        after_steps ? "purse_string.event_handling=each_step" : "tissue.vertices=30"});
      Config copy = config;
      const Slot slot = key.slot(copy);
      REQUIRE(std::holds_alternative<ChoiceSlot>(slot));
      CHECK(std::get<ChoiceSlot>(slot).get(std::get<ChoiceSlot>(slot).field) == choice.value);
      if (!choice.doc.empty()) CHECK(value_text(key, slot) == fmt::format("\"{}\"", choice.name));
      ++checked;
    }
  CHECK(checked >= 25);
}

TEST_CASE("ranges know their ends", "[unit]") {
  const Range half_open{0.0, 1.0, false, true};
  CHECK_FALSE(half_open.contains(0.0));
  CHECK(half_open.contains(1.0));
  CHECK_FALSE(half_open.contains(std::nan("")));
  CHECK(half_open.text() == "> 0 and <= 1");
  CHECK(Range{0.0, 1.0}.text() == "from 0 to 1");
  CHECK(Range{0.0, INFINITY, true, false}.text() == ">= 0");
  CHECK_FALSE(Range{0.0, INFINITY, true, false}.contains(INFINITY));
  CHECK(Range{0.0, INFINITY, false, true}.text() == "> 0 (inf allowed)");
  CHECK(Range{0.0, INFINITY, false, true}.contains(INFINITY));
}
