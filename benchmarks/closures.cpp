#include <algorithm>

#include "groups.hpp"
#include "suture/converge/study.hpp"
#include "suture/errors.hpp"
#include "suture/measure/closure.hpp"
#include "suture/simulate/closure.hpp"

namespace suture::benchmark {

namespace {

class AreaObserver final : public ClosureObserver {
 public:
  void sample(const ClosureSample& s) override {
    series_.time.push_back(s.time);
    series_.area.push_back(s.wound ? s.wound->area : 0.0);
  }
  void event(const EventRecord&) override { ++events_; }
  const WoundSeries& series() const { return series_; }
  double events() const { return static_cast<double>(events_); }

 private:
  WoundSeries series_;
  long events_ = 0;
};

/// False for a run that fails, as Euler's may.
bool measure_closure(const std::string& name, const Config& config, const TissueState& state, int repeats, Report& report) {
  ClosureResult result;
  AreaObserver last;
  Timing timing;
  Measurement m{"closures", name, {}, {}};
  m.parameters = {{"k_a", config.area.stiffness}, {"tau", config.plasticity.tau}, {"horizon", config.run.end_time}, {"tolerance", config.integrator.tolerance},
                  {"seed", static_cast<double>(config.tissue.seed)}};
  if (config.integrator.method == Method::euler) m.parameters.emplace_back("time_step", *config.integrator.time_step);
  try {
    timing = time_calls(repeats, [&] {
      AreaObserver observer;
      TissueState last_good;
      result = run_closure(config, state, observer, last_good);
      last = observer;
    });
  } catch (const NumericalError&) {
    m.values = {{"failed", 1.0}};
    report.add(std::move(m));
    return false;
  }
  m.values = {{"seconds", timing.median}, {"fastest_s", timing.fastest}, {"end", last.series().time.back()}, {"area_end", last.series().area.back()}, {"events", last.events()}};
  append_counts(m, result.statistics);
  report.add(std::move(m));
  return true;
}

}  // namespace

void measure_packing(const Settings& settings, Report& report) {
  const std::pair<int, int> size = settings.smoke ? std::pair{6, 12} : std::pair{50, 30};
  std::vector<double> seconds;
  for (int k = 0; k < settings.repeats; ++k) seconds.push_back(packed_tissue(size.first, size.second).seconds);
  std::sort(seconds.begin(), seconds.end());
  report.add({"packing", "to final_fraction 0.985", {{"cells", size.first}, {"n_v", size.second}},
              {{"seconds", seconds[seconds.size() / 2]}, {"fastest_s", seconds.front()}}});
}

void measure_closures(const Settings& settings, Report& report, const Packed& wounded) {
  struct Case {
    const char* name;
    double area_stiffness, tau;
  };
  std::vector<Packed> wounds{wounded};
  for (std::uint64_t seed = 2; settings.long_runs && seed <= 10; ++seed) wounds.push_back(wounded_tissue(false, {}, seed));
  for (const Case& studied : {Case{"embryo", 16.0, 9.6}, Case{"wing disc", 32.0, 1228.8}})
    for (Packed problem : wounds) {
      set_material(problem, studied.area_stiffness, studied.tau);
      problem.config.run.end_time = settings.smoke ? 1.0 : settings.long_runs ? 300.0 : 20.0;
      if (settings.long_runs) problem.config.run.closed_area = 0.0264;  // 0.5 % of the wound
      for (const Method method : {Method::euler, Method::cvode, Method::rkc2, Method::automatic}) {
        problem.config.integrator.method = method;
        const auto measure = [&](double time_step) {
          problem.config.integrator.time_step = time_step;
          return measure_closure(std::string(studied.name) + ", " + method_name(method), problem.config, problem.state, settings.repeats, report);
        };
        // The edge of Euler's stability; in some wounds it is lower.
        for (double step = 0.004; !measure(step) && method == Method::euler && step > 0.0005;) step *= 0.8;
      }
    }
}

void measure_ladders(const Settings& settings, Report& report, const Packed& wounded) {
  const double end = settings.smoke ? 0.2 : settings.long_runs ? 100.0 : 10.0;
  const auto measure = [&](const char* name, double area_stiffness, double tau) {
    Packed problem = wounded;
    set_material(problem, area_stiffness, tau);
    const TissueState state = with_ring(problem.config, problem.state);
    for (const Method method : {Method::cvode, Method::rkc2}) {
      const IntegratorOptions options = with_tolerance(method, 1e-3, state);
      Integrated result;
      const Timing timing = time_calls(settings.repeats, [&] { result = integrate(problem.config, state, options, end); });
      Measurement m{"ladders", std::string(name) + ", " + method_name(method), {}, {}};
      m.parameters = {{"k_a", area_stiffness}, {"tau", tau}, {"horizon", end}};
      m.values = {{"seconds", timing.median}, {"fastest_s", timing.fastest}};
      append_counts(m, result.statistics);
      report.add(std::move(m));
    }
  };
  for (const double area_stiffness : {0.25, 1.0, 16.0, 40.0, 256.0}) measure("k_a ladder", area_stiffness, 9.6);
  for (const double tau : {2.4, 9.6, 76.8, 1228.8, 39321.6}) measure("tau ladder", 16.0, tau);
}

}  // namespace suture::benchmark
