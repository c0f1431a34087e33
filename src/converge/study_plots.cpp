#include <algorithm>
#include <map>

#include "suture/converge/study.hpp"
#include "suture/render/line_plot.hpp"

namespace suture {

namespace {

using Abscissa = double (*)(const StudyRow&);

bool drawable(const StudyRow& row) { return row.seeds > 0 && row.failure.empty() && !row.confirmation && row.errors.position > 0.0; }

/// One curve per method, in the order of the methods, each with the same look in every panel.
std::vector<PlotSeries> curves(const StudyResult& result, Abscissa x, Abscissa y, bool (*wanted)(Method)) {
  std::map<Method, int> look;
  std::vector<PlotSeries> series;
  for (const StudyRow& row : result.rows) {
    if (!drawable(row)) continue;
    const auto [entry, is_new] = look.try_emplace(row.method, static_cast<int>(look.size()));
    if (!wanted(row.method)) continue;
    const std::string name = method_name(row.method);
    if (series.empty() || series.back().label != name) series.push_back({name, entry->second, {}});
    series.back().points.push_back({x(row), y(row)});
  }
  return series;
}

double uncertainty(const StudyResult& result) {
  double largest = 0.0;
  for (const SeedReference& reference : result.references) largest = std::max(largest, reference.uncertainty.position);
  return largest;
}

double error(const StudyRow& row) { return row.errors.position; }

}  // namespace

void draw_study(const StudyResult& result, const std::filesystem::path& directory) {
  const auto all = [](Method) { return true; };
  PlotPanel seconds{"Work and precision: time", "error of positions (l0)", "CPU seconds per run",
                    curves(result, error, [](const StudyRow& row) { return row.cpu_s; }, all)};
  PlotPanel rates{"Work and precision: evaluations", "error of positions (l0)", "rate evaluations per run",
                  curves(result, error, [](const StudyRow& row) { return row.rate_evaluations; }, all)};
  seconds.vertical = rates.vertical = uncertainty(result);
  seconds.vertical_label = rates.vertical_label = "uncertainty of the reference";
  const auto value = [](const StudyRow& row) { return row.tolerance_or_dt; };
  PlotPanel tolerance{"Error against tolerance", "tolerance asked for (l0)", "error of positions (l0)",
                      curves(result, value, error, [](Method method) { return !takes_fixed_steps(method); })};
  tolerance.diagonal = true;
  PlotPanel step{"Error against step", "step (model units of time)", "error of positions (l0)",
                 curves(result, value, error, takes_fixed_steps)};
  tolerance.horizontal = step.horizontal = uncertainty(result);
  tolerance.horizontal_label = step.horizontal_label = "uncertainty of the reference";
  const std::vector<PlotPanel> work{seconds, rates}, errors{tolerance, step};
  for (const char* ending : {".png", ".svg"}) {
    render_plots(work, directory / (std::string("work_precision") + ending));
    render_plots(errors, directory / (std::string("error_tolerance") + ending));
  }
}

}  // namespace suture
