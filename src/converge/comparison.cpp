#include <algorithm>
#include <cmath>

#include "suture/converge/course.hpp"
#include "suture/errors.hpp"

namespace suture {

namespace {

struct Distance {
  double rms = 0.0, largest = 0.0;
};

Distance distance(const std::vector<double>& a, const std::vector<double>& b) {
  const std::size_t vertices = a.size() / 2;
  double sum = 0.0, largest = 0.0;
  for (std::size_t v = 0; v < vertices; ++v) {
    const double dx = a[v] - b[v], dy = a[vertices + v] - b[vertices + v];
    sum += dx * dx + dy * dy;
    largest = std::max(largest, dx * dx + dy * dy);
  }
  return {std::sqrt(sum / static_cast<double>(a.size())), std::sqrt(largest)};
}

void widen(std::optional<double>& error, double value) { error = std::max(error.value_or(0.0), value); }

}  // namespace

std::vector<SampleDifference> differences(const Course& course, const Course& reference, double unit) {
  std::vector<SampleDifference> all;
  const std::size_t samples = std::min(course.time.size(), reference.time.size());
  for (std::size_t k = 0; k < samples; ++k) {
    const double t = reference.time[k];
    if (std::abs(course.time[k] - t) > 1e-6 * std::max(1.0, t)) break;  // one of them has ended between samples
    const Distance d = distance(course.positions[k], reference.positions[k]);
    all.push_back({t, d.rms / unit, d.largest / unit, std::abs(course.area[k] - reference.area[k]), {}});
    if (course.shape[k] && reference.shape[k]) all.back().shape = std::abs(*course.shape[k] - *reference.shape[k]);
  }
  return all;
}

CourseErrors compare(const Course& course, const Course& reference, double unit, double until, double threshold) {
  CourseErrors errors;
  std::size_t compared = 0;
  for (const SampleDifference& d : differences(course, reference, unit)) {
    if (!errors.diverged_at && d.position > threshold) errors.diverged_at = d.time;
    if (d.time > until) continue;
    ++compared;
    errors.until = d.time;
    errors.position = std::max(errors.position, d.position);
    errors.position_max = std::max(errors.position_max, d.position_max);
    errors.area = std::max(errors.area, d.area);
    if (d.shape) widen(errors.shape, *d.shape);
  }
  if (compared == 0) throw InputError("two courses without a common sample cannot be compared");
  if (course.t_05 && reference.t_05) errors.t_05 = std::abs(*course.t_05 - *reference.t_05);
  return errors;
}

}  // namespace suture
