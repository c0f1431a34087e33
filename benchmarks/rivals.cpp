// What 1e-3 l0 costs by each method: the cheapest run whose error is no larger, Euler with the largest step that is stable and
// accurate enough, on smooth problems (ring on, no events) up to the time at which two references part.
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
  Statistics statistics;
};

/// Loosest of `values`, tried in order, whose error is small enough; none if all have taken another branch or are unstable.
std::optional<Run> cheapest(const Smooth& problem, const SampledReference& reference, Method method, const std::vector<double>& values, int repeats) {
  for (const double value : values) {
    const IntegratorOptions options =
        method == Method::euler ? with_step(method, value, problem.state) : with_tolerance(method, value, problem.state);
    Run run;
    run.value = value;
    try {
      const Samples samples = sample(problem, options, reference.interval, reference.count());
      run.error = sampled_error(problem, samples, reference);
      run.statistics = samples.statistics;
    } catch (const NumericalError&) {
      continue;  // a step beyond the stability limit
    }
    if (!(run.error <= asked)) continue;
    run.seconds = time_calls(repeats, [&] { sample(problem, options, reference.interval, reference.count()); }).median;
    return run;
  }
  return std::nullopt;
}

/// From above the stability limit at 30 vertices down; stiffness grows as the square of their number.
std::vector<double> euler_steps(int vertices, double stiffening) {
  std::vector<double> steps;
  for (double h = 0.006 * std::pow(30.0 / vertices, 2.0); h > 1e-6 / stiffening && steps.size() < 30; h *= 0.8) steps.push_back(h);
  return steps;
}

void compare(const Settings& settings, Report& report, const std::string& name, const Packed& wounded, double horizon, double stiffening) {
  const Smooth problem{wounded.config, with_ring(wounded.config, wounded.state)};
  const SampledReference reference = sampled_reference(problem, horizon, 1e-2 * asked, 0.1 * asked);
  if (reference.count() == 0) return fmt::print("rivals: the references of '{}' agree nowhere\n", name);
  std::vector<double> tolerances;  // four per decade
  for (int k = 8; k <= 18; ++k) tolerances.push_back(std::pow(10.0, -0.25 * k));
  const std::pair<Method, std::vector<double>> methods[] = {
      {Method::euler, euler_steps(wounded.config.tissue.vertices, stiffening)}, {Method::rkc2, tolerances}, {Method::cvode, tolerances}, {Method::automatic, tolerances}};
  double euler_seconds = 0.0, rkc2_seconds = 0.0;
  for (const auto& [method, values] : methods) {
    const std::optional<Run> found = cheapest(problem, reference, method, values, settings.repeats);
    Measurement m{"rivals", fmt::format("{}: {}", name, method_name(method)), {}, {}};
    m.parameters = {{"k_a", wounded.config.area.stiffness}, {"tau", wounded.config.plasticity.tau}, {"n_v", wounded.config.tissue.vertices},
                    {"ring_stiffness", wounded.config.purse_string.stiffness}, {"seed", static_cast<double>(wounded.config.tissue.seed)}, {"agreed_until", reference.agreed_until()}};
    if (!found) {
      m.values = {{"failed", 1}};
      report.add(std::move(m));
      continue;
    }
    const Run& run = *found;
    if (method == Method::euler) euler_seconds = run.seconds;
    if (method == Method::rkc2) rkc2_seconds = run.seconds;
    m.values = {{"tolerance_or_step", run.value}, {"error", run.error}, {"seconds", run.seconds}};
    if (euler_seconds > 0.0) m.values.emplace_back("euler_over_this", euler_seconds / run.seconds);  // unless Euler failed
    if (rkc2_seconds > 0.0) m.values.emplace_back("this_over_rkc2", run.seconds / rkc2_seconds);     // not of Euler, which comes first
    append_counts(m, run.statistics);
    report.add(std::move(m));
  }
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

}  // namespace

void measure_rivals(const Settings& settings, Report& report) {
  const KeptMemory kept;
  const double horizon = settings.smoke ? 0.1 : settings.long_runs ? 40.0 : 10.0;
  // The nodes of Fig. 3 whose values are published, on several wounds: how soon references part depends on the wound.
  std::vector<Packed> wounds;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5})
    if (wounds.empty() || !settings.smoke) wounds.push_back(wounded_tissue(settings.smoke, {}, seed));
  for (const Packed& wounded : wounds)
    for (const double area_stiffness : {1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 40.0})
      for (const double tau : {4.8, 9.6, 76.8, 1228.8, 9830.4, 39321.6}) {
        if (settings.smoke && (area_stiffness != 16.0 || tau != 76.8)) continue;
        Packed node = wounded;
        set_material(node, area_stiffness, tau);
        compare(settings, report, "node", node, horizon, 1.0);
      }
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

}  // namespace suture::benchmark
