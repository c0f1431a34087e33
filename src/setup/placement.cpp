#include "suture/setup/placement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "geometry/hilbert_curve.hpp"
#include "suture/setup/fire.hpp"

namespace suture {

namespace {

/// Which discs may touch: a grid of squares as wide as the largest disc, over the circle of the wall. What is outside counts to the
/// squares at the edge.
class DiscPairs {
 public:
  DiscPairs(std::span<const double> radii, double wall_radius)
      : wall_radius_(wall_radius),
        width_(2.0 * *std::max_element(radii.begin(), radii.end())),
        side_(1 + static_cast<int>(2.0 * wall_radius / width_)),
        next_(radii.size()) {}

  /// visit(i, j) for all pairs closer than the largest diameter and some others, in the order of a double loop: j < i.
  template <class Visit>
  void for_each(std::span<const double> x, std::span<const double> y, Visit visit) {
    last_.assign(static_cast<std::size_t>(side_) * side_, none);
    for (int i = 0; i < static_cast<int>(x.size()); ++i) {
      const int column = square(x[i]), row = square(y[i]);
      near_.clear();
      for (int c = std::max(column - 1, 0); c <= std::min(column + 1, side_ - 1); ++c)
        for (int r = std::max(row - 1, 0); r <= std::min(row + 1, side_ - 1); ++r)
          for (int j = last_[c * side_ + r]; j != none; j = next_[j]) near_.push_back(j);
      std::sort(near_.begin(), near_.end());
      for (const int j : near_) visit(i, j);
      next_[i] = std::exchange(last_[column * side_ + row], i);
    }
  }

 private:
  static constexpr int none = -1;
  int square(double coordinate) const {
    return static_cast<int>(std::clamp((coordinate + wall_radius_) / width_, 0.0, static_cast<double>(side_ - 1)));
  }
  double wall_radius_, width_;
  int side_;
  std::vector<int> last_, next_, near_;  // the disc put last into a square, and the one put there before each disc
};

/// Adds dU/dr of the soft overlaps; positions are all x, then all y.
Evaluation overlap_gradient(std::span<const double> radii, double wall_radius, DiscPairs& pairs, std::span<const double> q,
                            std::span<double> gradient) {
  const std::size_t count = radii.size();
  const auto x = q.first(count), y = q.last(count);
  const auto gx = gradient.first(count), gy = gradient.last(count);
  std::fill(gradient.begin(), gradient.end(), 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const double from_centre = std::hypot(x[i], y[i]);
    if (wall_radius - from_centre < radii[i] && from_centre > 0.0) {
      const double slope = 2.0 * (1.0 - (wall_radius - from_centre) / radii[i]) / (radii[i] * from_centre);
      gx[i] += slope * x[i];
      gy[i] += slope * y[i];
    }
  }
  pairs.for_each(x, y, [&](int i, int j) {
    const double dx = x[i] - x[j], dy = y[i] - y[j], reach = radii[i] + radii[j];
    const double squared_distance = dx * dx + dy * dy;
    if (squared_distance >= reach * reach || squared_distance == 0.0) return;
    const double distance = std::sqrt(squared_distance);
    const double slope = -2.0 * (1.0 - distance / reach) / (reach * distance);
    gx[i] += slope * dx, gx[j] -= slope * dx;
    gy[i] += slope * dy, gy[j] -= slope * dy;
  });
  return Evaluation::ok;
}

double deepest_overlap(std::span<const double> radii, double wall_radius, DiscPairs& pairs, std::span<const double> x,
                       std::span<const double> y) {
  double deepest = -wall_radius;
  for (std::size_t i = 0; i < radii.size(); ++i) deepest = std::max(deepest, std::hypot(x[i], y[i]) + radii[i] - wall_radius);
  pairs.for_each(x, y, [&](int i, int j) { deepest = std::max(deepest, radii[i] + radii[j] - std::hypot(x[i] - x[j], y[i] - y[j])); });
  return deepest;
}

}  // namespace

DiscPlacement spread_discs(std::span<const double> radii, double wall_radius, RandomStream& random) {
  const std::size_t count = radii.size();
  std::vector<double> q(2 * count);
  for (std::size_t i = 0; i < count; ++i) {
    double x, y;
    do {
      x = random.uniform(-1.0, 1.0);
      y = random.uniform(-1.0, 1.0);
    } while (x * x + y * y >= 1.0);
    q[i] = wall_radius * x;
    q[count + i] = wall_radius * y;
  }
  // A disc of radius r has stiffness 2/(2r)^2 per contact and at most six neighbours.
  const double smallest = *std::min_element(radii.begin(), radii.end());
  const FireOptions options{.force_tolerance = 1e-4 / smallest,
                            .maximum_iterations = 20000,
                            .initial_time_step = 0.1 * smallest,
                            .maximum_time_step = 0.5 * smallest,
                            .minimum_time_step = 0.002 * smallest,
                            .maximum_displacement = 0.1 * smallest};
  DiscPairs pairs(radii, wall_radius);
  Fire(q.size()).minimise(
      q,
      [&](std::span<const double> at, std::span<double> out) { return overlap_gradient(radii, wall_radius, pairs, at, out); },
      options);
  DiscPlacement placement{.x = {q.begin(), q.begin() + count}, .y = {q.begin() + count, q.end()}};
  placement.deepest_overlap = deepest_overlap(radii, wall_radius, pairs, placement.x, placement.y);
  return placement;
}

void number_along_curve(const Tissue& tissue, DiscPlacement& centres) {
  double extent = 1.0;
  for (const auto* coordinates : {&centres.x, &centres.y})
    for (const double c : *coordinates) extent = std::max(extent, std::abs(c));
  struct Place {
    std::uint64_t index;
    double x, y;
  };
  const auto same_kind = [&](int a, int b) {
    return tissue.vertex_count(a) == tissue.vertex_count(b) && tissue.material(a) == tissue.material(b);
  };
  std::vector<Place> places;
  for (int first = 0, end; first < tissue.cell_count(); first = end) {
    places.clear();
    for (end = first; end < tissue.cell_count() && same_kind(first, end); ++end) {
      const double x = centres.x[end], y = centres.y[end];
      places.push_back({hilbert_index(0.5 + 0.5 * x / extent, 0.5 + 0.5 * y / extent), x, y});
    }
    std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.index < b.index; });
    for (int cell = first; cell < end; ++cell) centres.x[cell] = places[cell - first].x, centres.y[cell] = places[cell - first].y;
  }
}

std::vector<double> regular_polygons(const Tissue& tissue, const DiscPlacement& centres,
                                     std::span<const double> corner_radius, double noise, RandomStream& random) {
  const int count = tissue.vertex_count();
  std::vector<double> positions(2 * static_cast<std::size_t>(count));
  for (int cell = 0; cell < tissue.cell_count(); ++cell) {
    const double phase = random.uniform();
    for (int v = tissue.first_vertex(cell); v < tissue.end_vertex(cell); ++v) {
      const double turn = phase + static_cast<double>(v - tissue.first_vertex(cell)) / tissue.vertex_count(cell);
      const double radius = corner_radius[cell] * (1.0 + noise * random.normal());
      positions[v] = centres.x[cell] + radius * std::cos(2.0 * std::numbers::pi * turn);
      positions[count + v] = centres.y[cell] + radius * std::sin(2.0 * std::numbers::pi * turn);
    }
  }
  return positions;
}

}  // namespace suture
