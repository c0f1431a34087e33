#include "integrate/failure_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace suture {

std::vector<WorstComponent> worst_components(const OdeSystem& system, std::span<const double> errors, const IntegratorOptions& options) {
  constexpr std::size_t most = 5;
  const int positions = system.position_count();
  std::vector<WorstComponent> worst;
  double beaten = 0.0;  // what the next one has to exceed
  for (int i = 0; i < static_cast<int>(errors.size()); ++i) {
    const double error = std::abs(errors[i]) / (i < positions ? options.position_tolerance : options.rest_length_tolerance);
    if (!(error > beaten)) continue;
    const auto larger = [error](const WorstComponent& w) { return w.error >= error; };
    worst.insert(std::partition_point(worst.begin(), worst.end(), larger), {i, error});
    if (worst.size() > most) worst.pop_back();
    if (worst.size() == most) beaten = worst.back().error;
  }
  return worst;
}

std::string failure_report(const OdeSystem& system, const std::string& what, double t, double step, int order,
                           std::span<const WorstComponent> worst) {
  std::string text = fmt::format("{} at t = {:.9g}, step {:.3g}, order {}", what, t, step, order);
  for (std::size_t k = 0; k < worst.size(); ++k)
    text += fmt::format("{}{} ({:.3g} x tolerance)", k == 0 ? "; worst: " : ", ", system.component_name(worst[k].index), worst[k].error);
  if (!system.refusal().empty()) text += "; last refused state: " + system.refusal();
  return text;
}

}  // namespace suture
