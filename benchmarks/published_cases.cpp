// Smooth problems with a known answer: cases B, C and D of the design study (45 cells x 30 points, purse string on, quadratic
// law, no events), and the grid on which the error must follow the tolerance.
#include <fmt/format.h>

#include <cstdint>
#include <span>

#include "groups.hpp"
#include "sampled.hpp"
#include "suture/converge/study.hpp"

namespace suture::benchmark {

namespace {

struct Case {
  const char* name;
  double area_stiffness, tau, horizon;
};

struct Solver {
  const char* name;
  Method method;
  double value;  ///< tolerance in l0, or step
  bool fixed;
};

constexpr Solver solvers[] = {
    {"euler 0.004", Method::euler, 0.004, true},  {"euler 0.002", Method::euler, 0.002, true},
    {"verlet 0.0125", Method::verlet, 0.0125, true}, {"rk4 0.005", Method::rk4, 0.005, true},
    {"rkc2 1e-4", Method::rkc2, 1e-4, false},     {"rkc2 1e-6", Method::rkc2, 1e-6, false},
    {"rkc2 1e-7", Method::rkc2, 1e-7, false},     {"arkode 1e-4", Method::arkode, 1e-4, false},
    {"adams 1e-4", Method::adams, 1e-4, false},   {"cvode 1e-4", Method::cvode, 1e-4, false},
    {"cvode 1e-5", Method::cvode, 1e-5, false},   {"cvode 1e-6", Method::cvode, 1e-6, false},
};

struct Reference {
  std::vector<double> y;
  PositionErrors uncertainty;  ///< difference of two methods
};

Reference make_reference(const Packed& problem, const TissueState& state, double horizon, double tolerance) {
  Reference reference;
  reference.y = integrate(problem.config, state, with_tolerance(Method::rkc2, tolerance, state), horizon).y;
  const std::vector<double> second = integrate(problem.config, state, with_tolerance(Method::cvode, tolerance, state), horizon).y;
  reference.uncertainty = position_errors(state, second, reference.y);
  return reference;
}

void measure_case(const Settings& settings, Report& report, const Packed& wounded, const Case& studied) {
  Packed problem = wounded;
  set_material(problem, studied.area_stiffness, studied.tau);
  const TissueState state = with_ring(problem.config, problem.state);
  const double horizon = studied.horizon * (settings.smoke ? 0.001 : settings.long_runs ? 1.0 : 0.1);
  const Reference reference = make_reference(problem, state, horizon, settings.smoke ? 1e-6 : 1e-9);
  for (const Solver& solver : solvers) {
    const IntegratorOptions options = solver.fixed ? with_step(solver.method, solver.value, state) : with_tolerance(solver.method, solver.value, state);
    Integrated result;
    const Timing timing = time_calls(settings.repeats, [&] { result = integrate(problem.config, state, options, horizon); });
    const PositionErrors errors = position_errors(state, result.y, reference.y);
    Measurement m{"cases", fmt::format("{}: {}", studied.name, solver.name), {}, {}};
    m.parameters = {{"k_a", studied.area_stiffness}, {"tau", studied.tau}, {"horizon", horizon}};
    m.values = {{"seconds", timing.median}, {"fastest_s", timing.fastest}, {"error_rms", errors.rms}, {"error_max", errors.largest},
                {"uncertainty_rms", reference.uncertainty.rms}, {"uncertainty_max", reference.uncertainty.largest}};
    append_counts(m, result.statistics);
    report.add(std::move(m));
  }
}

}  // namespace

void measure_cases(const Settings& settings, Report& report, const Packed& wounded) {
  for (const Case& studied : {Case{"B", 16.0, 76.8, 100.0}, Case{"C", 256.0, 39322.0, 200.0}, Case{"D", 16.0, 39322.0, 1000.0}})
    measure_case(settings, report, wounded, studied);
}

namespace {

struct GridProblem {
  Problem smooth;
  SampledReference reference;
};

GridProblem grid_problem(Packed material, double area_stiffness, double tau, double horizon, double agreement) {
  set_material(material, area_stiffness, tau);
  GridProblem problem{{material.config, with_ring(material.config, material.state)}, {}};
  problem.reference = sampled_reference(problem.smooth, horizon, 20, 1e-7, agreement);
  return problem;
}

void measure_grid_problem(Report& report, const GridProblem& studied, double horizon, std::span<const double> tolerances) {
  const auto& [problem, reference] = studied;
  const Config& config = problem.config;
  for (const Method method : {Method::cvode, Method::rkc2, Method::automatic})
    for (const double tolerance : tolerances) {
      const Samples run = sample(problem, method, tolerance, reference.interval, reference.count());
      const double error = sampled_error(problem, run, reference);
      Measurement m{"grid", method_name(method), {{"k_a", config.area.stiffness}, {"tau", config.plasticity.tau}, {"tolerance", tolerance}, {"horizon", horizon}, {"seed", static_cast<double>(config.tissue.seed)}}, {}};
      m.values = {{"error", error}, {"ratio", error / tolerance}, {"within", error >= 0.01 * tolerance && error <= 10.0 * tolerance},
                  {"agreed_until", reference.agreed_until()}, {"uncertainty", reference.uncertainty}};
      append_counts(m, run.statistics);
      report.add(std::move(m));
    }
}

}  // namespace

/// On several wounds: in some a contact that switches amplifies any error, and one of them decides nothing.
void measure_tolerance_grid(const Settings& settings, Report& report) {
  constexpr double tolerances[] = {1e-2, 1e-3, 1e-4};
  const double horizon = settings.smoke ? 0.1 : settings.long_runs ? 20.0 : 5.0;
  const std::uint64_t wounds = settings.smoke ? 1 : 20;
  for (std::uint64_t seed = 1; seed <= wounds; ++seed) {
    const Packed wounded = wounded_tissue(settings.smoke, {}, seed);
    for (const double area_stiffness : {0.25, 1.0, 16.0, 40.0, 256.0})
      for (const double tau : {2.4, 9.6, 76.8, 1228.8, 39321.6}) {
        if (settings.smoke && (area_stiffness != 16.0 || tau != 9.6)) continue;
        const GridProblem problem = grid_problem(wounded, area_stiffness, tau, horizon, 0.1 * tolerances[2]);
        if (problem.reference.count() == 0)
          fmt::print(stderr, "grid: seed {}, k_a {}, tau {} is left out, the references agree nowhere\n", seed, area_stiffness, tau);
        else
          measure_grid_problem(report, problem, horizon, tolerances);
      }
  }
}

}  // namespace suture::benchmark
