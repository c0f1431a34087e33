// What 1e-3 l0 costs by each method: the cheapest run whose error is no larger, Euler with the largest step that is stable and
// accurate enough, on smooth problems (ring on, no events) and closures with all events, up to the time at which two references part.
#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "groups.hpp"
#include "sampled.hpp"
#include "suture/converge/study.hpp"
#include "suture/errors.hpp"

namespace suture::benchmark {

namespace {

constexpr double asked = 1e-3;  // error in l0

/// Runs of a few milliseconds: memory given back after each and faulted in again by the next would be half of their time.
struct KeptMemory {
  KeptMemory() { set(1 << 30, 1 << 30); }
  ~KeptMemory() { set(128 << 10, 128 << 10); }  // glibc's defaults
  static void set(int trim, int map) {
    mallopt(M_TRIM_THRESHOLD, trim);
    mallopt(M_MMAP_THRESHOLD, map);
  }
};

struct Run {
  double value = 0.0, error = 0.0, seconds = 0.0;  // tolerance or step
  bool accurate = false;
  Statistics statistics;
};

/// Loosest of `values`, tried in order, whose error is small enough; the last one if all have taken another branch; none if all are
/// unstable.
std::optional<Run> cheapest(const Problem& problem, const SampledReference& reference, Method method, const std::vector<double>& values, int repeats) {
  std::optional<Run> found;
  for (const double value : values) try {
      const Samples samples = sample(problem, method, value, reference.interval, reference.count());
      const double error = sampled_error(problem, samples, reference);
      found = Run{value, error, 0.0, error <= asked, samples.statistics};
      if (found->accurate) break;
    } catch (const NumericalError&) {  // a step beyond the stability limit
    }
  if (found)
    found->seconds = time_calls(repeats, [&] { sample(problem, method, found->value, reference.interval, reference.count()); }).median;
  return found;
}

/// From above the stability limit at 30 vertices down; stiffness grows as the square of their number.
std::vector<double> euler_steps(int vertices, double stiffening) {
  std::vector<double> steps;
  for (double h = 0.006 * std::pow(30.0 / vertices, 2.0); h > 1e-6 / stiffening && steps.size() < 30; h *= 0.8) steps.push_back(h);
  return steps;
}

/// Four per decade.
std::vector<double> tolerances(double loosest, double tightest) {
  std::vector<double> values;
  for (int k = 0; loosest * std::pow(10.0, -0.25 * k) > 0.99 * tightest; ++k) values.push_back(loosest * std::pow(10.0, -0.25 * k));
  return values;
}

/// Of Euler: from beyond the edge of stability down by factors of two, then between the last two.
std::optional<Run> largest_step(const Problem& problem, const SampledReference& reference, int repeats) {
  std::vector<double> steps;
  for (double step = 0.006; step > 9e-5; step *= 0.5) steps.push_back(step);
  std::optional<Run> found = cheapest(problem, reference, Method::euler, steps, repeats);
  if (!found || !found->accurate || found->value == steps.front()) return found;
  const std::optional<Run> larger = cheapest(problem, reference, Method::euler, {1.6 * found->value, 1.25 * found->value}, repeats);
  return larger && larger->accurate ? larger : found;
}

using Search = std::function<std::optional<Run>()>;

void compare_with(const Problem& problem, const SampledReference& reference, const std::string& group, const std::string& name, const Search& euler,
                  const std::vector<double>& adaptive, const Settings& settings, Report& report) {
  if (reference.count() == 0) return fmt::print("{}: the references of '{}' agree nowhere\n", group, name);
  const Config& config = problem.config;
  double euler_seconds = 0.0, rkc2_seconds = 0.0;
  for (const Method method : {Method::euler, Method::rkc2, Method::cvode, Method::automatic}) {
    const std::optional<Run> found = method == Method::euler ? euler() : cheapest(problem, reference, method, adaptive, settings.repeats);
    Measurement m{group, fmt::format("{}: {}", name, method_name(method)), {}, {}};
    m.parameters = {{"k_a", config.area.stiffness}, {"tau", config.plasticity.tau}, {"n_v", config.tissue.vertices},
                    {"ring_stiffness", config.purse_string.stiffness}, {"seed", static_cast<double>(config.tissue.seed)}, {"agreed_until", reference.agreed_until()}};
    if (!found) {
      m.values = {{"failed", 1}};
      report.add(std::move(m));
      continue;
    }
    const Run& run = *found;
    if (method == Method::euler) euler_seconds = run.seconds;
    if (method == Method::rkc2 && run.accurate) rkc2_seconds = run.seconds;
    m.values = {{"tolerance_or_step", run.value}, {"error", run.error}, {"seconds", run.seconds}, {"accurate", run.accurate}};
    // Unless Euler failed; at least so much where its smallest step is not accurate.
    if (euler_seconds > 0.0 && run.accurate) m.values.emplace_back("euler_over_this", euler_seconds / run.seconds);
    if (rkc2_seconds > 0.0 && run.accurate) m.values.emplace_back("this_over_rkc2", run.seconds / rkc2_seconds);  // not of Euler, which comes first
    append_counts(m, run.statistics);
    report.add(std::move(m));
  }
}

void compare(const Settings& settings, Report& report, const std::string& name, const Packed& wounded, double horizon, double stiffening) {
  const Problem problem{wounded.config, with_ring(wounded.config, wounded.state)};
  const SampledReference reference = sampled_reference(problem, horizon, 20, 1e-2 * asked, 0.1 * asked);
  const std::vector<double> steps = euler_steps(wounded.config.tissue.vertices, stiffening);
  compare_with(problem, reference, "rivals", name, [&] { return cheapest(problem, reference, Method::euler, steps, settings.repeats); },
               tolerances(1e-2, 3e-5), settings, report);
}

/// With all events. Errors are some ten times the tolerance there, so references must be tighter.
void compare_closures(const Settings& settings, Report& report, const std::string& name, const Packed& wounded, double horizon) try {
  const Problem problem{wounded.config, wounded.state, true};
  const SampledReference reference = sampled_reference(problem, horizon, static_cast<int>(std::ceil(2.0 * horizon)), 1e-5 * asked, 0.1 * asked);
  compare_with(problem, reference, "events", name, [&] { return largest_step(problem, reference, settings.repeats); }, tolerances(1e-2, 1e-6), settings,
               report);
} catch (const NumericalError& error) {
  fmt::print("events: {}, seed {}: {}\n", name, wounded.config.tissue.seed, error.what());
}

/// A material, contacts or string other than the embryo's; how many times its fastest motion is faster, roughly.
struct Variant {
  const char* name;
  std::function<void(Config&)> change;
  double stiffening = 1.0;
};

const Variant variants[] = {
    {"adhesion 0", [](Config& c) { c.contact.adhesion = 0.0; }},
    {"adhesion 0, tau inf", [](Config& c) { c.contact.adhesion = 0.0, c.plasticity.tau = std::numeric_limits<double>::infinity(); }},
    {"adhesion 0.02", [](Config& c) { c.contact.adhesion = 0.02; }},
    {"adhesion 0.2", [](Config& c) { c.contact.adhesion = 0.2; }},
    {"contacts 10 times softer", [](Config& c) { c.contact.energy *= 0.1; }},
    {"contacts 10 times stiffer", [](Config& c) { c.contact.energy *= 10.0; }, 3.0},
    {"contacts 100 times stiffer", [](Config& c) { c.contact.energy *= 100.0; }, 30.0},
    {"k_l 0.1", [](Config& c) { c.membrane.stiffness = 0.1; }},
    {"k_l 10", [](Config& c) { c.membrane.stiffness = 10.0; }, 10.0},
    {"k_l 100", [](Config& c) { c.membrane.stiffness = 100.0; }, 100.0},
    {"relative law, k_l 10, tau 1", [](Config& c) { c.membrane.law = SpringLaw::relative, c.membrane.stiffness = 10.0, c.plasticity.tau = 1.0; }, 10.0},
    {"k_b 0", [](Config& c) { c.bending.stiffness = 0.0; }},
    {"k_b 0.1", [](Config& c) { c.bending.stiffness = 0.1; }, 5.0},
    {"k_b 1", [](Config& c) { c.bending.stiffness = 1.0; }, 50.0},
    {"k_a 0.01", [](Config& c) { c.area.stiffness = 0.01; }},
    {"k_a 4000", [](Config& c) { c.area.stiffness = 4000.0; }, 30.0},
    {"tau 0.1", [](Config& c) { c.plasticity.tau = 0.1; }},
    {"xi 1", [](Config& c) { c.plasticity.memory = 1.0; }},
    {"string 10 times stiffer", [](Config& c) { c.purse_string.stiffness *= 10.0; }, 10.0},
    {"relative string, floor 0.01", [](Config& c) { c.purse_string.law = SpringLaw::relative, c.purse_string.minimum_rest_length = 0.01; }, 10.0},
    {"string 10 times faster", [](Config& c) { c.purse_string.constriction_rate *= 10.0; }},
    {"tethers 25 times stiffer", [](Config& c) { c.purse_string.tether_stiffness *= 25.0; }, 10.0},
    {"all stiff", [](Config& c) { c.membrane.stiffness = 10.0, c.bending.stiffness = 1.0, c.area.stiffness = 256.0, c.contact.energy *= 10.0; }, 50.0},
};

/// The nodes of Fig. 3 whose values are published.
template <class Visit>
void for_each_node(const Packed& wounded, bool smoke, const Visit& visit) {
  for (const double area_stiffness : {1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 40.0})
    for (const double tau : {4.8, 9.6, 76.8, 1228.8, 9830.4, 39321.6}) {
      if (smoke && (area_stiffness != 16.0 || tau != 76.8)) continue;
      Packed node = wounded;
      set_material(node, area_stiffness, tau);
      visit(node);
    }
}

}  // namespace

void measure_rivals(const Settings& settings, Report& report) {
  const KeptMemory kept;
  const double horizon = settings.smoke ? 0.1 : settings.long_runs ? 40.0 : 10.0;
  std::vector<Packed> wounds;  // how soon references part depends on the wound
  for (const std::uint64_t seed : {1, 2, 3, 4, 5})
    if (wounds.empty() || !settings.smoke) wounds.push_back(wounded_tissue(settings.smoke, {}, seed));
  for (const Packed& wounded : wounds)
    for_each_node(wounded, settings.smoke, [&](const Packed& node) { compare(settings, report, "node", node, horizon, 1.0); });
  if (settings.smoke) return;
  for (const Variant& variant : variants)
    for (const Packed& wounded : {wounds[0], wounds[1]}) {
      Packed changed = wounded;
      variant.change(changed.config);
      set_material(changed);
      compare(settings, report, variant.name, changed, horizon, variant.stiffening);
    }
  for (const int vertices : {30, 60, 120})
    for (const std::uint64_t seed : {4, 5, 6, 7, 8}) try {
        const Packed wounded = wounded_tissue(true, vertices, seed);
        for (const double stiffening : {1.0, 100.0}) {
          Packed refined = wounded;
          refined.config.purse_string.stiffness *= stiffening;
          compare(settings, report, stiffening > 1.0 ? "stiff ring" : "n_v ladder", refined, 0.25 * horizon, stiffening);
        }
      } catch (const NumericalError& error) {
        fmt::print("rivals: n_v {}, seed {}: {}\n", vertices, seed, error.what());
      }
}

void measure_rivals_with_events(const Settings& settings, Report& report) {
  const KeptMemory kept;
  const double horizon = settings.smoke ? 0.5 : 45.0;
  const Packed wounded = wounded_tissue(settings.smoke, {}, 1);
  for_each_node(wounded, settings.smoke, [&](const Packed& node) { compare_closures(settings, report, "node", node, horizon); });
  for (std::uint64_t seed = 1; seed <= (settings.smoke ? 0 : 10); ++seed) {
    Packed embryo = wounded_tissue(false, {}, seed);
    set_material(embryo, 16.0, 9.6);
    compare_closures(settings, report, "embryo", embryo, settings.long_runs ? 140.0 : horizon);  // it closes at 130
  }
}

}  // namespace suture::benchmark
