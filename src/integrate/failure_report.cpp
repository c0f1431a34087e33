#include "integrate/failure_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace suture {

std::string failure_report(const OdeSystem& system, const std::string& what, double t, double step, int order,
                           std::span<const double> local_errors, const IntegratorOptions& options) {
  std::string text = fmt::format("{} at t = {:.9g}, step {:.3g}, order {}", what, t, step, order);
  std::vector<int> index(local_errors.size());
  std::iota(index.begin(), index.end(), 0);
  const auto weighted = [&](int i) {
    return std::abs(local_errors[i]) / (i < system.position_count() ? options.position_tolerance : options.rest_length_tolerance);
  };
  const std::size_t shown = std::min<std::size_t>(5, index.size());
  std::partial_sort(index.begin(), index.begin() + static_cast<std::ptrdiff_t>(shown), index.end(),
                    [&](int a, int b) { return weighted(a) > weighted(b); });
  for (std::size_t k = 0; k < shown && weighted(index[k]) > 0.0; ++k)
    text += fmt::format("{}{} ({:.3g} x tolerance)", k == 0 ? "; worst: " : ", ", system.component_name(index[k]), weighted(index[k]));
  if (!system.refusal().empty()) text += "; last refused state: " + system.refusal();
  return text;
}

}  // namespace suture
