#include <algorithm>
#include <chrono>
#include <cmath>

#include "groups.hpp"
#include "suture/errors.hpp"
#include "threads/ranges.hpp"

namespace suture::benchmark {

namespace {

constexpr double gamma_of_interest = 0.1;  // h/l_10 of a step in a quiet part of a closure

void require(Evaluation evaluation, const TissueOde& ode) {
  if (evaluation != Evaluation::ok) throw NumericalError("the benchmark's state was refused: " + ode.refusal());
}

/// Alternates between two states farther apart than the skin allows: every evaluation rebuilds the list.
double rebuild_seconds(TissueOde& ode, const std::vector<double>& y, double skin, double rate, int repeats) {
  std::vector<double> moved(y), out(y.size());
  for (int k = 0; k < ode.position_count(); ++k) moved[k] += skin;  // a translation: same forces, stale list
  bool there = false;
  const long before = ode.list_rebuilds();
  long calls = 0;
  const Timing both = time_body(repeats, [&] {
    there = !there;
    ++calls;
    require(ode.rate(0.0, there ? moved : y, out), ode);
  });
  if (ode.list_rebuilds() - before < calls - 1) throw NumericalError("the list was not rebuilt at every evaluation");
  return both.median - rate;
}

void measure_tissue(const char* name, const Config& config, const TissueState& state, int repeats, Report& report) {
  const std::unique_ptr<TissueOde> ode = make_ode(config, state);
  const auto n = static_cast<std::size_t>(ode->position_count());
  std::vector<double> out(state.values.size()), residual(n), direction(n), product(n);
  for (std::size_t k = 0; k < n; ++k) direction[k] = std::sin(0.7 * static_cast<double>(k));
  require(ode->rate(0.0, state.values, out), *ode);
  const auto per_vertex = 1e9 / state.tissue.vertex_count();
  const double rate = time_body(repeats, [&] { require(ode->rate(0.0, state.values, out), *ode); }).median;
  ode->begin_implicit_step(0.0, gamma_of_interest, state.values);
  const std::span<const double> q = std::span(state.values).first(n);
  require(ode->residual(q, residual), *ode);
  Measurement m{"kernels", name, {}, {}};
  m.parameters = {{"cells", state.tissue.cell_count()}, {"n_v", state.tissue.vertex_count(0)}, {"vertices", state.tissue.vertex_count()}};
  const auto add = [&](const char* what, double seconds) { m.values.emplace_back(what, seconds * per_vertex); };
  add("rate_ns", rate);
  add("residual_ns", time_body(repeats, [&] { require(ode->residual(q, residual), *ode); }).median);
  add("linearise_ns", time_body(repeats, [&] { ode->linearise(); }).median);
  add("product_ns", time_body(repeats, [&] { ode->product(direction, product); }).median);
  add("preconditioner_setup_ns", time_body(repeats, [&] { ode->set_up_preconditioner(); }).median);
  add("precondition_ns", time_body(repeats, [&] { ode->precondition(residual, product); }).median);
  if (state.tissue.vertex_count() < 5000) {  // the reference path, for comparison; its memory grows with every cell's size squared
    ode->choose_linear_solver(LinearSolver::sparse_direct);
    add("direct_setup_ns", time_body(repeats, [&] { ode->set_up_preconditioner(); }).median);
    add("direct_solve_ns", time_body(repeats, [&] { ode->precondition(residual, product); }).median);
    ode->choose_linear_solver(LinearSolver::structured);
  }
  const double skin = config.integrator.skin * state.tissue.mean_initial_rest_length();
  add("list_rebuild_ns", rebuild_seconds(*ode, state.values, skin, rate, repeats));
  report.add(std::move(m));
}

double wall_seconds(int calls, const std::function<void()>& body) {
  const auto start = std::chrono::steady_clock::now();
  for (int k = 0; k < calls; ++k) body();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / calls;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

/// One thread and two in turn, in wall time.
void append_speed_up(Measurement& m, const Config& config, const TissueState& state, TissueOde& alone, int repeats) {
  Config shared = config;
  shared.integrator.threads = 2;
  const std::unique_ptr<TissueOde> both = make_ode(shared, state);
  std::vector<double> out(state.values.size()), one, two, ratio;
  require(both->rate(0.0, state.values, out), *both);
  constexpr int calls = 10;
  for (int k = 0; k < repeats; ++k) {
    one.push_back(wall_seconds(calls, [&] { require(alone.rate(0.0, state.values, out), alone); }));
    two.push_back(wall_seconds(calls, [&] { require(both->rate(0.0, state.values, out), *both); }));
    ratio.push_back(one.back() / two.back());
  }
  const double per_vertex = 1e9 / state.tissue.vertex_count();
  m.values.emplace_back("wall_ns_1_thread", median(one) * per_vertex);
  m.values.emplace_back("wall_ns_2_threads", median(two) * per_vertex);
  m.values.emplace_back("speed_up", median(ratio));
}

void measure_rate(const Config& config, const TissueState& state, int repeats, Report& report) {
  const std::unique_ptr<TissueOde> ode = make_ode(config, state);
  const double skin = config.integrator.skin * state.tissue.mean_initial_rest_length();
  std::vector<double> out(state.values.size()), moved(state.values);
  Measurement m{"rate", "N ladder (tiles)", {}, {}};
  m.parameters = {{"cells", state.tissue.cell_count()}, {"vertices", state.tissue.vertex_count()}};
  const auto add = [&](const char* what, const std::vector<double>& y) {
    require(ode->rate(0.0, y, out), *ode);
    m.values.emplace_back(what, 1e9 / state.tissue.vertex_count() * time_body(repeats, [&] { require(ode->rate(0.0, y, out), *ode); }).median);
  };
  add("fresh_list_ns", state.values);
  for (int k = 0; k < ode->position_count() / 2; ++k) moved[k] += 0.25 * skin;  // half of what a list bears
  add("aged_list_ns", moved);
  for (int k = 0; k < ode->position_count() / 2; ++k) moved[k] += 0.24 * skin;
  add("old_list_ns", moved);
  if (state.tissue.vertex_count() >= divided_from_vertices) append_speed_up(m, config, state, *ode, repeats);
  report.add(std::move(m));
}

/// What a rate costs while a wound closes (ring on, no events): the tissue is that of a run, the list as old as it is on the way. Another
/// system follows the integrator's and is asked for a few rates at the end of each step.
void measure_rate_in_use(const char* name, const Packed& problem, double horizon, Report& report) {
  constexpr int calls = 4;
  const TissueState state = with_ring(problem.config, problem.state);
  const std::unique_ptr<TissueOde> ode = make_ode(problem.config, state), follower = make_ode(problem.config, state);
  const std::unique_ptr<Integrator> integrator = make_integrator(*ode, with_tolerance(Method::rkc2, 1e-3, state), 0.0, state.values);
  std::vector<double> out(state.values.size()), by_old_list, by_new_list;
  while (integrator->time() < horizon) {
    integrator->step(horizon);
    for (int k = 0; k < calls; ++k) {
      const long before = follower->list_rebuilds();
      const double seconds = wall_seconds(1, [&] { require(follower->rate(integrator->time(), integrator->state(), out), *follower); });
      (follower->list_rebuilds() > before ? by_new_list : by_old_list).push_back(seconds);
    }
  }
  const double per_vertex = 1e9 / state.tissue.vertex_count(), rate = median(by_old_list) * per_vertex;
  const double rates_per_list = static_cast<double>(integrator->statistics().rate_evaluations) / static_cast<double>(ode->list_rebuilds());
  const double rebuild = median(by_new_list) * per_vertex - rate;
  Measurement m{"rate", name, {}, {}};
  m.parameters = {{"cells", state.tissue.cell_count()}, {"vertices", state.tissue.vertex_count()}, {"horizon", horizon}};
  m.values = {{"rate_ns", rate}, {"rebuild_ns", rebuild}, {"rates_per_list", rates_per_list}, {"all_in_ns", rate + rebuild / rates_per_list}};
  report.add(std::move(m));
}

}  // namespace

void measure_rates(const Settings& settings, Report& report) {
  const Packed patch = packed_tissue(settings.smoke ? 6 : 45, settings.smoke ? 12 : 30, true);
  std::vector<int> cells = settings.smoke ? std::vector{12} : std::vector{45, 450, 3330, 9990};
  if (settings.long_runs) cells.push_back(99990);
  for (const int count : cells)
    measure_rate(patch.config, tiled(patch.state, count / patch.state.tissue.cell_count(), *patch.config.contact.distance), settings.repeats, report);
  measure_rate_in_use("in use: embryo", wounded_tissue(settings.smoke), settings.smoke ? 0.5 : 20.0, report);
  for (const int count : settings.smoke ? std::vector{100} : std::vector{450, 3330}) {
    Packed honeycomb = honeycomb_with_wound(count, settings.smoke ? 12 : 30, settings.smoke ? 0.1 : 1.0);
    honeycomb.config.integrator.threads = 1;
    measure_rate_in_use("in use: honeycomb", honeycomb, settings.smoke ? 0.1 : 10.0, report);
  }
}

void measure_kernels(const Settings& settings, Report& report) {
  const std::vector<int> ladder = settings.smoke ? std::vector{15} : std::vector{15, 30, 60, 120, 240};
  for (const int vertices : ladder) {  // 16 cells: full vector lanes
    const Packed packed = packed_tissue(16, vertices, true);
    measure_tissue("n_v ladder", packed.config, packed.state, settings.repeats, report);
  }
  const Packed patch = packed_tissue(settings.smoke ? 6 : 45, settings.smoke ? 12 : 30, true);
  std::vector<int> cells = settings.smoke ? std::vector{12} : std::vector{45, 450, 4500, 45000};
  if (settings.long_runs) cells.push_back(99990);
  for (const int count : cells) {
    const TissueState state = tiled(patch.state, count / patch.state.tissue.cell_count(), *patch.config.contact.distance);
    measure_tissue("N ladder (tiles)", patch.config, state, settings.repeats, report);
  }
}

}  // namespace suture::benchmark
