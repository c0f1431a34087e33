#include "view/viewer_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "suture/io/config.hpp"

namespace suture {
namespace {

using nlohmann::json;

constexpr std::size_t curve_points = 1500;  // more than a plot has pixels
constexpr int event_parts = 500;            // of the time line; the events in one look like one

double rounded(double value) {
  if (value == 0.0 || !std::isfinite(value)) return 0.0;
  const double unit = std::pow(10.0, 5.0 - std::floor(std::log10(std::abs(value))));
  return std::round(value * unit) / unit;
}

json curve(const Replay& replay, const char* name, const char* label, const char* unit, double factor) {
  const Series* const series = replay.trajectory().observable(name);
  if (series == nullptr || series->time.empty()) return nullptr;
  json times = json::array(), values = json::array();
  const std::size_t last = series->time.size() - 1, count = std::min(curve_points, series->time.size());
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = count == 1 ? 0 : last * k / (count - 1);
    times.push_back(minutes(replay, series->time[i]));
    values.push_back(rounded(factor * series->value[i]));
  }
  return {{"name", name}, {"label", label}, {"unit", unit}, {"times", times}, {"values", values}};
}

json curves(const Replay& replay) {
  json list = json::array();
  const double area_um2 = replay.scales().factor(Dimension::area);
  for (json entry : {curve(replay, "wound_area", "Wound area", "\xc2\xb5m\xc2\xb2", area_um2),
                     curve(replay, "adjacent_shape", "Mean shape at the wound", "", 1.0)})
    if (!entry.is_null()) list.push_back(std::move(entry));
  return list;
}

// Per kind how many there were in each part of the run that had any: {part: count}.
json events(const Replay& replay) {
  const double duration = std::max(minutes(replay, replay.times().back()), 1e-9);
  std::map<std::string, std::map<int, int>> kinds;
  for (const StoredEvent& event : replay.trajectory().events) {
    const double share = std::clamp(minutes(replay, event.time) / duration, 0.0, 1.0);
    ++kinds[event.kind][std::min(static_cast<int>(share * event_parts), event_parts - 1)];
  }
  json list = json::array();
  for (const auto& [kind, parts] : kinds) {
    json where = json::array(), counts = json::array();
    for (const auto& [part, count] : parts) where.push_back(part), counts.push_back(count);
    list.push_back({{"kind", kind}, {"parts", where}, {"counts", counts}});
  }
  return {{"parts", event_parts}, {"kinds", list}};
}

json milestones(const json& summary) {
  json list = json::array();
  const std::pair<const char*, const char*> keys[] = {
      {"t_50_min", "50 %"}, {"t_25_min", "25 %"}, {"t_10_min", "10 %"}, {"t_05_min", "5 %"}, {"t_closed_min", "closed"}};
  for (const auto& [key, label] : keys)
    if (summary.contains(key) && summary[key].is_number()) list.push_back({{"time", summary[key]}, {"label", label}});
  return list;
}

json facts(const Replay& replay, const json& summary) {
  const Config& config = replay.config();
  const Tissue& tissue = replay.trajectory().tissue;
  const UnitScales& scales = replay.scales();
  json list = json::array();
  const auto add = [&](const char* name, const std::string& value) { list.push_back({name, value}); };
  add("cells", std::to_string(tissue.cell_count()));
  add("vertices", std::to_string(tissue.vertex_count()));
  add("area stiffness", fmt::format("{:g} ({})", config.area.stiffness,
                                    physical_text(config.area.stiffness, Dimension::modulus, scales)));
  const double tau = config.plasticity.tau;
  add("relaxation time", std::isfinite(tau) ? fmt::format("{:g} ({})", tau, physical_text(tau, Dimension::time, scales))
                                            : "infinite (elastic)");
  if (config.plasticity.memory > 0.0) add("shape memory", fmt::format("{:g}", config.plasticity.memory));
  add("seed", std::to_string(replay.trajectory().provenance.seed));
  if (summary.contains("status")) {
    std::string status = summary["status"].get<std::string>();
    std::replace(status.begin(), status.end(), '_', ' ');
    add("outcome", status);
  }
  add("suture", fmt::format("{} ({})", replay.trajectory().code_version, replay.trajectory().code_commit.substr(0, 8)));
  return list;
}

}  // namespace

double minutes(const Replay& replay, double time) {
  return rounded((time - replay.time_origin()) * replay.scales().time_min());
}

void add_run_story(const Replay& replay, json& description) {
  const json summary = json::parse(replay.trajectory().summary, nullptr, /*allow_exceptions=*/false);
  description["curves"] = curves(replay);
  description["events"] = events(replay);
  description["milestones"] = milestones(summary);
  description["facts"] = facts(replay, summary);
}

}  // namespace suture
