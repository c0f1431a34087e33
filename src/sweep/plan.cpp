#include "suture/sweep/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "suture/errors.hpp"
#include "suture/io/config.hpp"
#include "suture/sweep/preparation_cache.hpp"

namespace suture {

namespace {

std::string known_key(const std::string& key, const std::string& origin) {
  try {
    return canonical_config_key(key);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", origin, error.what()));
  }
}

std::string without_quotes(const std::string& value) {
  const bool quoted = value.size() >= 2 && value.front() == '"' && value.back() == '"';
  return quoted ? value.substr(1, value.size() - 2) : value;
}

double number_of(const Config& config, const DerivedKey& derived) {
  const std::string text = config_value(config, derived.of);
  if (text == "inf") return std::numeric_limits<double>::infinity();
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    throw InputError(fmt::format("{}: key 'derived.{}': found the factor of '{}', which is {}, allowed that of a number",
                                 derived.origin, derived.key, derived.of, text.empty() ? "not set" : text));
  return value;
}

class Planner {
 public:
  Planner(const SweepFile& file, const PlanOptions& options) : file_(file) {
    for (const std::string& text : options.overrides) command_line_.push_back({text, fmt::format("command line: --set {}", text)});
    from_command_line_ = options.seeds;
    check_keys();
  }

  SweepPlan plan() {
    if (!file_.cases.empty()) plan_.columns.emplace_back("case");
    for (const SweepAxis& axis : file_.axes)
      for (const std::string& key : axis.keys) plan_.columns.push_back(canonical_config_key(key));
    if (file_.cases.empty()) add_points({}, nullptr, 0);
    for (const SweepCase& row : file_.cases) add_points({}, &row, 0);
    return std::move(plan_);
  }

 private:
  void claim_key(const std::string& key, const std::string& origin) {
    const std::string name = known_key(key, origin);
    if (name == "tissue.seed")
      throw InputError(fmt::format("{}: key 'tissue.seed': found it among the swept keys, allowed in 'seeds'", origin));
    if (!swept_.emplace(name, origin).second)
      throw InputError(fmt::format("{}: key '{}': found it a second time, allowed once (first at {})", origin, name, swept_[name]));
  }

  void check_keys() {
    for (const SweepAxis& axis : file_.axes)
      for (const std::string& key : axis.keys) claim_key(key, axis.origin);
    for (const DerivedKey& derived : file_.derived) claim_key(derived.key, derived.origin);
    for (const DerivedKey& derived : file_.derived) {
      const std::string of = known_key(derived.of, derived.origin);
      for (const DerivedKey& other : file_.derived)
        if (of == canonical_config_key(other.key))
          throw InputError(fmt::format("{}: key 'derived.{}': found '{}', which is derived itself, allowed a key that is not",
                                       derived.origin, derived.key, derived.of));
    }
    for (const ConfigOverride& item : command_line_) {
      const std::string key = item.text.substr(0, item.text.find('='));
      if (const auto found = swept_.find(key); found != swept_.end())
        throw InputError(fmt::format("{}: key '{}': found an override, allowed only for keys that are not swept ({})",
                                     item.origin, key, found->second));
    }
    std::set<std::string> names;
    for (const SweepCase& row : file_.cases)
      if (!names.insert(row.name).second)
        throw InputError(fmt::format("{}: key 'case.name': found \"{}\" a second time, allowed once", row.origin, row.name));
  }

  /// The grid by recursion over the axes: the last one varies fastest.
  void add_points(std::vector<ConfigOverride> point, const SweepCase* row, std::size_t axis) {
    if (axis == file_.axes.size()) return add_node(point, row);
    const SweepAxis& a = file_.axes[axis];
    for (const std::vector<std::string>& texts : a.texts) {
      std::vector<ConfigOverride> next = point;
      for (std::size_t k = 0; k < a.keys.size(); ++k) next.push_back({fmt::format("{}={}", a.keys[k], texts[k]), a.origin});
      add_points(std::move(next), row, axis + 1);
    }
  }

  Config resolve(const std::vector<ConfigOverride>& point, const SweepCase* row, bool for_preparation) const {
    const std::filesystem::path& base = row != nullptr && !row->base.empty() ? row->base : file_.base;
    std::vector<ConfigOverride> all = file_.set;
    const auto add = [&all](const std::vector<ConfigOverride>& more) { all.insert(all.end(), more.begin(), more.end()); };
    if (row != nullptr) add(row->set);
    add(point);
    add(command_line_);
    if (for_preparation) add(file_.preparation);
    Config config = resolve_config(base, all);
    if (file_.derived.empty()) return config;
    for (const DerivedKey& derived : file_.derived)
      all.push_back({derived.factor == 1.0 ? fmt::format("{}={}", derived.key, config_value(config, derived.of))
                                           : fmt::format("{}={}", derived.key, derived.factor * number_of(config, derived)),
                     derived.origin});
    return resolve_config(base, all);
  }

  void add_node(const std::vector<ConfigOverride>& point, const SweepCase* row) {
    const Config config = resolve(point, row, false);
    std::optional<Config> preparation;
    if (!file_.preparation.empty()) preparation = resolve(point, row, true);
    SweepNode node;
    for (const std::string& column : plan_.columns)
      node.values.push_back(column == "case" ? row->name : without_quotes(config_value(config, column)));
    for (const std::uint64_t seed : seeds_of(row, config)) add_run(config, preparation, seed);
    plan_.nodes.push_back(std::move(node));
  }

  std::vector<std::uint64_t> seeds_of(const SweepCase* row, const Config& config) const {
    if (from_command_line_) return *from_command_line_;
    if (row != nullptr && !row->seeds.empty()) return row->seeds;
    return file_.seeds.empty() ? std::vector{config.tissue.seed} : file_.seeds;
  }

  void add_run(const Config& config, const std::optional<Config>& preparation, std::uint64_t seed) {
    SweepRun run{static_cast<int>(plan_.runs.size()), static_cast<int>(plan_.nodes.size()), {}, config, preparation};
    run.config.tissue.seed = seed;
    if (run.preparation) {
      run.preparation->tissue.seed = seed;
      if (!can_share_preparation(run.config))
        throw InputError(fmt::format("{}: key 'preparation': found a run that has no preparation of its own kind, allowed with wound "
                                     "closures from the beginning without [[cell_type]]", file_.preparation.front().origin));
    }
    run.key = text_hash(run.text());
    if (const auto [same, is_new] = index_.emplace(run.key, run.index); !is_new)
      throw InputError(fmt::format("the runs {} and {} of the sweep have the same configuration, allowed one of them",
                                   same->second, run.index));
    plan_.runs.push_back(std::move(run));
  }

  const SweepFile& file_;
  std::vector<ConfigOverride> command_line_;
  std::optional<std::vector<std::uint64_t>> from_command_line_;  // seeds
  std::map<std::string, std::string> swept_;  // key, where
  std::map<std::string, int> index_;
  SweepPlan plan_;
};

}  // namespace

std::string text_hash(std::string_view text) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char letter : text) hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211ULL;
  return fmt::format("{:016x}", hash);
}

std::string SweepRun::text() const {
  std::string text = write_config(config);
  if (!preparation) return text;
  std::istringstream lines(write_config(preparation_config(*preparation)));
  text += "\n# Prepared with:\n";
  for (std::string line; std::getline(lines, line);) text += fmt::format("#{}{}\n", line.empty() ? "" : " ", line);
  return text;
}

SweepPlan make_plan(const SweepFile& file, const PlanOptions& options) { return Planner(file, options).plan(); }

}  // namespace suture
