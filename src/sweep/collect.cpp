#include "suture/sweep/collect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/atomic_file.hpp"
#include "io/hdf5_file.hpp"
#include "suture/io/units.hpp"
#include "suture/measure/closure.hpp"
#include "suture/version.hpp"
#include "sweep/run_result.hpp"

namespace suture {

namespace {

struct Moments {
  std::optional<double> mean, standard_error;
};

Moments moments(const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto n = static_cast<double>(values.size());
  double sum = 0.0, squares = 0.0;
  for (const double value : values) sum += value;
  for (const double value : values) squares += (value - sum / n) * (value - sum / n);
  return {sum / n, n > 1.0 ? std::optional(std::sqrt(squares / (n - 1.0) / n)) : std::nullopt};
}

/// The runs of a node that count, and their mean series.
struct NodeResult {
  std::vector<const RunResult*> all, valid;
  WoundSeries mean;                ///< of the wound area
  std::vector<double> mean_shape;  ///< of the seeds that have one at that time; NaN where none has
  std::optional<ClosureSummary> closure;

  /// Of the mean shape at the first sample with at most 5 % of the wound left: does not depend on where the runs end.
  Moments shape_at_05() const {
    std::vector<double> values;
    for (const RunResult* result : valid)
      if (const auto t_05 = result->number("t_05")) {
        const std::vector<double>& times = result->wound.time;
        const auto i = static_cast<std::size_t>(std::lower_bound(times.begin(), times.end(), *t_05) - times.begin());
        if (i < times.size() && !std::isnan(result->wound.mean_shape[i])) values.push_back(result->wound.mean_shape[i]);
      }
    return moments(values);
  }
  Moments of(const std::string& name) const {
    std::vector<double> values;
    for (const RunResult* result : valid)
      if (const auto value = result->number(name)) values.push_back(*value);
    return moments(values);
  }
  template <class Condition>
  long count(Condition condition) const {
    return std::count_if(all.begin(), all.end(), [&](const RunResult* result) { return condition(*result); });
  }
};

/// The times of the longest series: all are sampled at multiples of the same interval.
void average(NodeResult& node) {
  std::vector<WoundSeries> series;
  const std::vector<double>* times = nullptr;
  for (const RunResult* result : node.valid) {
    if (result->wound.time.empty()) continue;
    series.push_back({result->wound.time, result->wound.wound_area});
    if (times == nullptr || result->wound.time.size() > times->size()) times = &result->wound.time;
  }
  if (times == nullptr) return;
  node.mean = mean_series(series, *times);
  node.closure = summarise_closure(node.mean);
  for (std::size_t i = 0; i < times->size(); ++i) {
    std::vector<double> shapes;
    for (const RunResult* result : node.valid)
      if (i < result->wound.mean_shape.size() && !std::isnan(result->wound.mean_shape[i])) shapes.push_back(result->wound.mean_shape[i]);
    node.mean_shape.push_back(moments(shapes).mean.value_or(std::numeric_limits<double>::quiet_NaN()));
  }
}

std::vector<NodeResult> by_node(const SweepPlan& plan, const std::vector<RunResult>& results) {
  std::vector<NodeResult> nodes(plan.nodes.size());
  for (const RunResult& result : results) {
    nodes[result.run->node].all.push_back(&result);
    if (result.valid()) nodes[result.run->node].valid.push_back(&result);
  }
  for (NodeResult& node : nodes) average(node);
  return nodes;
}

std::string field(const std::optional<double>& value) { return value ? fmt::format("{}", *value) : std::string(); }

std::string quoted(std::string text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  for (auto at = text.find('"'); at != std::string::npos; at = text.find('"', at + 2)) text.insert(at, 1, '"');
  return fmt::format("\"{}\"", text);
}

std::string joined(std::vector<std::string> fields) {
  for (std::string& text : fields) text = quoted(std::move(text));
  return fmt::format("{}\n", fmt::join(fields, ","));
}

constexpr const char* wound_numbers[] = {"t_closed", "t_50", "t_25", "t_10", "t_05", "closure_rate", "closure_rate_um2_per_min",
                                         "healed_shape", "wound_area_initial", "wound_area_max"};
constexpr const char* cell_numbers[] = {"shape_initial", "shape_at_release", "shape_final", "area_final"};
constexpr const char* counts[][2] = {{"events", "yield"}, {"events", "capture"}, {"events", "exchange"},
                                     {"solver", "rate_evaluations"}, {"solver", "steps"}, {"solver", "restarts"}};

double wall_seconds(const RunResult& result) {
  double sum = 0.0;
  if (result.summary.is_object() && result.summary.contains("wall_s"))
    for (const auto& [stage, seconds] : result.summary["wall_s"].items()) sum += seconds.get<double>();
  return sum;
}

std::string sweep_csv(const SweepPlan& plan, const std::vector<RunResult>& results) {
  std::vector<std::string> head{"index", "run"};
  head.insert(head.end(), plan.columns.begin(), plan.columns.end());
  for (const char* name : {"seed", "status", "reason"}) head.emplace_back(name);
  for (const char* name : wound_numbers) head.emplace_back(name);
  for (const char* name : cell_numbers) head.emplace_back(name);
  for (const auto& name : counts) head.emplace_back(name[1]);
  for (const char* name : {"wall_s", "code_commit"}) head.emplace_back(name);
  std::string text = joined(head);
  for (const RunResult& result : results) {
    std::vector<std::string> row{fmt::format("{}", result.run->index), result.run->key};
    const SweepNode& node = plan.nodes[result.run->node];
    row.insert(row.end(), node.values.begin(), node.values.end());
    row.push_back(fmt::format("{}", result.run->config.tissue.seed));
    row.push_back(result.record ? result.record->status : "waiting");
    row.push_back(result.record ? result.record->reason : "");
    for (const char* name : wound_numbers) row.push_back(field(result.number(name)));
    for (const char* name : cell_numbers) row.push_back(field(result.number(name)));
    for (const auto& name : counts)
      row.push_back(result.summary.is_object() ? fmt::format("{}", result.summary[name[0]][name[1]].get<long>()) : "");
    row.push_back(result.summary.is_object() ? fmt::format("{:.2f}", wall_seconds(result)) : "");
    row.push_back(result.record ? result.record->commit : "");
    text += joined(row);
  }
  return text;
}

/// Columns after the swept keys. The first five are a contract with other tools.
std::vector<std::pair<const char*, std::string>> node_fields(const NodeResult& node, const UnitScales& scales) {
  std::optional<double> rate, rate_um2, end_fraction;
  ClosureSummary of_mean;
  if (node.closure) {
    of_mean = *node.closure;
    rate = of_mean.closure_rate;
    if (rate) rate_um2 = *rate * scales.factor(Dimension::area_rate);
    if (of_mean.maximum_area > 0.0) end_fraction = node.mean.area.back() / of_mean.maximum_area;
  }
  const auto number = [](long value) { return fmt::format("{}", value); };
  const Moments healed = node.of("healed_shape"), t_05 = node.of("t_05"), shape_at_05 = node.shape_at_05();
  return {{"healed_shape_mean", field(healed.mean)},
          {"healed_shape_sem", field(healed.standard_error)},
          {"closure_rate_of_mean", field(rate)},
          {"t_05_mean", field(t_05.mean)},
          {"runs", number(static_cast<long>(node.valid.size()))},
          {"runs_closed", number(node.count([](const RunResult& r) { return r.closed(); }))},
          {"runs_failed", number(node.count([](const RunResult& r) { return r.record && !r.valid(); }))},
          {"runs_waiting", number(node.count([](const RunResult& r) { return !r.record; }))},
          {"t_05_sem", field(t_05.standard_error)},
          {"t_05_reached", number(node.count([](const RunResult& r) { return r.valid() && r.number("t_05"); }))},
          {"shape_at_05_mean", field(shape_at_05.mean)},
          {"shape_at_05_sem", field(shape_at_05.standard_error)},
          {"t_50_of_mean", field(of_mean.t_50)},
          {"t_25_of_mean", field(of_mean.t_25)},
          {"t_10_of_mean", field(of_mean.t_10)},
          {"t_05_of_mean", field(of_mean.t_05)},
          {"closure_rate_of_mean_um2_per_min", field(rate_um2)},
          {"wound_area_max_of_mean", node.closure ? field(of_mean.maximum_area) : ""},
          {"end_fraction_of_mean", field(end_fraction)},
          {"shape_initial_mean", field(node.of("shape_initial").mean)},
          {"shape_at_release_mean", field(node.of("shape_at_release").mean)},
          {"shape_final_mean", field(node.of("shape_final").mean)},
          {"area_final_mean", field(node.of("area_final").mean)}};
}

std::string nodes_csv(const SweepPlan& plan, const std::vector<NodeResult>& nodes) {
  std::string text;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const UnitScales scales(nodes[n].all.front()->run->config.units);
    std::vector<std::string> head = plan.columns, row = plan.nodes[n].values;
    for (const auto& [name, value] : node_fields(nodes[n], scales)) head.emplace_back(name), row.push_back(value);
    if (n == 0) text = joined(head);
    text += joined(row);
  }
  return text;
}

void write_series(const Hdf5Group& group, const WoundColumns& columns) {
  group.write("time", columns.time, {"time", "since the purse string started"});
  group.write("wound_area", columns.wound_area, {"area", "free area of the wound"});
  group.write("mean_shape", columns.mean_shape, {"1", "mean shape parameter of the wound-adjacent cells; NaN: none"});
}

std::vector<std::byte> sweep_h5(const SweepPlan& plan, const std::vector<RunResult>& results, const std::vector<NodeResult>& nodes) {
  const Hdf5File file = Hdf5File::create_in_memory();
  const Hdf5Group root = file.root();
  root.set_attribute("schema", "suture-sweep");
  root.set_attribute("schema_version", std::int64_t{1});
  root.set_attribute("code_version", build_information().version);
  const Hdf5Group runs = root.create_group("runs"), points = root.create_group("nodes");
  for (const RunResult& result : results) {
    if (!result.record) continue;
    const Hdf5Group group = runs.create_group(fmt::format("{:06}", result.run->index));
    group.set_attribute("run", result.run->key);
    group.set_attribute("node", static_cast<std::int64_t>(result.run->node));
    group.set_attribute("seed", static_cast<std::int64_t>(result.run->config.tissue.seed));
    group.set_attribute("status", result.record->status);
    write_series(group, result.wound);
  }
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const Hdf5Group group = points.create_group(fmt::format("{:06}", n));
    for (std::size_t k = 0; k < plan.columns.size(); ++k) group.set_attribute(plan.columns[k], plan.nodes[n].values[k]);
    group.set_attribute("runs", static_cast<std::int64_t>(nodes[n].valid.size()));
    write_series(group, {nodes[n].mean.time, nodes[n].mean.area, nodes[n].mean_shape});
  }
  return file.image();
}

}  // namespace

void collect_sweep(const SweepFolder& folder, const SweepPlan& plan) {
  std::vector<RunResult> results;
  for (const SweepRun& run : plan.runs) results.push_back(read_result(folder, run));
  const std::vector<NodeResult> nodes = by_node(plan, results);
  write_file_atomically(folder.root / "sweep.csv", sweep_csv(plan, results));
  write_file_atomically(folder.root / "nodes.csv", nodes_csv(plan, nodes));
  write_file_atomically(folder.root / "sweep.h5", sweep_h5(plan, results, nodes));
}

}  // namespace suture
