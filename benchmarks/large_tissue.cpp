// Tissues of thousands of cells: a honeycomb with a wound in its middle, relaxed and then closed for a short time, with the
// string, its events and the measures of a run.
#include <malloc.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <string>
#include <utility>

#include "geometry/hilbert_curve.hpp"
#include "groups.hpp"
#include "suture/converge/study.hpp"
#include "suture/setup/protocol.hpp"
#include "suture/simulate/closure.hpp"

namespace suture::benchmark {

namespace {

/// Point at `part` of the way round a hexagon of area 1 with a corner at angle 0, and the hexagon's half width.
constexpr double half_width = 0.537284965911771;
std::pair<double, double> on_hexagon(double part) {
  const double side = 2.0 * half_width / std::numbers::sqrt3, along = 6.0 * part;
  const double first = std::floor(along), inside = along - first, corner = std::numbers::pi / 3.0;
  return {side * ((1.0 - inside) * std::cos(corner * first) + inside * std::cos(corner * (first + 1.0))),
          side * ((1.0 - inside) * std::sin(corner * first) + inside * std::sin(corner * (first + 1.0)))};
}

/// Centres of a honeycomb of `cells` places and the given pitch around the origin, without the `left_out` nearest to it; numbered
/// along a space-filling curve, as packings of this size are.
std::vector<std::pair<double, double>> honeycomb_centres(int cells, int left_out, double pitch) {
  std::vector<std::pair<double, double>> centres;
  const int half = static_cast<int>(std::ceil(0.6 * std::sqrt(cells))) + 2;
  for (int j = -half; j <= half; ++j)
    for (int i = -half; i <= half; ++i)
      centres.emplace_back(pitch * j * 0.5 * std::numbers::sqrt3, pitch * (i + 0.5 * std::abs(j % 2)));
  const auto radius = [](const auto& c) { return c.first * c.first + c.second * c.second; };
  std::stable_sort(centres.begin(), centres.end(), [&](const auto& a, const auto& b) { return radius(a) < radius(b); });
  centres.resize(cells);
  centres.erase(centres.begin(), centres.begin() + left_out);
  const double extent = std::sqrt(radius(centres.back()));
  const auto index = [extent](const auto& c) { return hilbert_index(0.5 + 0.5 * c.first / extent, 0.5 + 0.5 * c.second / extent); };
  std::stable_sort(centres.begin(), centres.end(), [&](const auto& a, const auto& b) { return index(a) < index(b); });
  return centres;
}

long memory_kb(const char* what) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(what)) return std::stol(line.substr(std::string(what).size() + 1));
  return 0;
}

void forget_peak_memory() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";  // Linux: the peak becomes what is in use now
}

class AreaObserver final : public ClosureObserver {
 public:
  void sample(const ClosureSample& s) override { area = s.wound ? s.wound->area : 0.0; }
  void event(const EventRecord&) override { ++events; }
  double area = 0.0;
  int events = 0;
};

void measure_one(const Packed& relaxed, Method method, int threads, Report& report) {
  Packed problem = relaxed;
  problem.config.integrator.method = method;
  problem.config.integrator.threads = threads;
  forget_peak_memory();
  AreaObserver observer;
  TissueState last_good;
  const auto start = std::chrono::steady_clock::now();
  ClosureResult result;
  const double cpu = time_calls(1, [&] { result = run_closure(problem.config, std::move(problem.state), observer, last_good); }).median;  // as a run does
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double horizon = problem.config.run.end_time, vertices = relaxed.state.tissue.vertex_count();
  Measurement m{"large", std::string("honeycomb, ") + method_name(method), {}, {}};
  m.parameters = {{"cells", relaxed.state.tissue.cell_count()}, {"threads", threads}, {"horizon", horizon}};
  m.values = {{"wall_s_per_time", wall / horizon}, {"cpu_s_per_time", cpu / horizon},
              {"ns_per_vertex_and_rate", 1e9 * wall / static_cast<double>(result.statistics.rate_evaluations) / vertices},
              {"peak_bytes_per_vertex", 1024.0 * static_cast<double>(memory_kb("VmHWM:")) / vertices},
              {"area_end", observer.area}, {"events", observer.events}};
  append_counts(m, result.statistics);
  report.add(std::move(m));
}

}  // namespace

Packed honeycomb_with_wound(int cells, int vertices, double relaxation_time) {
  constexpr int ablated = 19;
  constexpr double jitter = 0.02;  // of the rest length
  Packed packed;
  packed.config.tissue.cells = cells - ablated;
  packed.config.tissue.vertices = vertices;
  packed.config = with_contact_distance(packed.config);
  const double s = *packed.config.contact.distance;
  packed.state = TissueState{.tissue = make_tissue(packed.config)};
  packed.state.values.resize(packed.state.layout().size());
  const MutableStateView view = packed.state.mutable_view();
  std::mt19937_64 engine(1);
  const auto noise = [&] { return jitter * s * (static_cast<double>(engine() >> 11) * 0x1p-52 - 1.0); };
  int v = 0;
  for (const auto& [cx, cy] : honeycomb_centres(cells, ablated, 2.0 * half_width + s))
    for (int k = 0; k < vertices; ++k, ++v) {
      const auto [x, y] = on_hexagon(static_cast<double>(k) / vertices);
      view.x[v] = cx + x + noise(), view.y[v] = cy + y + noise();
      view.rest_length[v] = packed.state.tissue.initial_rest_length(v);
    }
  packed.config.integrator.threads = 0;
  packed.state.values = integrate(packed.config, packed.state, with_tolerance(Method::rkc2, 1e-3, packed.state), relaxation_time).y;
  return packed;
}

void measure_large_tissues(const Settings& settings, Report& report) {
  std::vector<int> sizes = settings.smoke ? std::vector{100} : std::vector{1000, 10000};
  if (settings.long_runs) sizes.push_back(100000);
  for (const int cells : sizes) {
    Packed relaxed = honeycomb_with_wound(cells, settings.smoke ? 12 : 30, settings.smoke ? 0.1 : 1.0);
    relaxed.config.run.end_time = settings.smoke ? 0.1 : 2e4 / cells;
    for (const Method method : {Method::rkc2, Method::cvode})
      for (const int threads : {1, 2}) measure_one(relaxed, method, threads, report);
  }
}

}  // namespace suture::benchmark
