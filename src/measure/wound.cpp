#include "suture/measure/wound.hpp"

#include <algorithm>
#include <numbers>

namespace suture {
namespace {

struct HoleSize {
  double area, perimeter;
};

/// Steiner's formula for a hole with the islands inside it.
HoleSize hole_size(const FreeBoundary& boundary, const BoundaryLoop& hole) {
  const double delta = boundary.membrane().probe_radius() - boundary.membrane().half_width();
  double area = -hole.signed_area, length = hole.length;
  int islands = 0;
  for (const BoundaryLoop& loop : boundary.loops()) {
    if (loop.is_hole() || loop.signed_area > -hole.signed_area || !contains(hole.outline, loop.inside_probe)) continue;
    area -= loop.signed_area;
    length += loop.length;
    ++islands;
  }
  return {area + delta * length + std::numbers::pi * delta * delta * (1 - islands),
          length + 2.0 * std::numbers::pi * delta * (1 - islands)};
}

Wound make_wound(const FreeBoundary& boundary, const BoundaryLoop& hole) {
  const HoleSize size = hole_size(boundary, hole);
  Wound wound;
  wound.area = size.area;
  wound.perimeter = size.perimeter;
  wound.outline.assign(hole.outline.rbegin(), hole.outline.rend());
  wound.boundary.assign(hole.vertices.rbegin(), hole.vertices.rend());
  wound.centre = centroid(wound.outline);
  wound.area_of_parts = wound.area;
  return wound;
}

/// Whether one of a few points of the loop lies inside the wound: a wound that closes has most of its outline inside the former one.
bool begins_inside(const BoundaryLoop& loop, const Wound& wound) {
  const std::size_t n = loop.outline.size(), step = std::max<std::size_t>(n / 8, 1);
  for (std::size_t k = 0; k < n; k += step)
    if (contains(wound.outline, loop.outline[k])) return true;
  return false;
}

bool boxes_meet(const BoundingBox& a, const BoundingBox& b) {
  return a.x_low <= b.x_high && b.x_low <= a.x_high && a.y_low <= b.y_high && b.y_low <= a.y_high;
}

/// Whether most of the former wound lies inside the patches of cells.
bool covered_by_tissue(const FreeBoundary& boundary, const Wound& former) {
  double covered = 0.0;
  for (const BoundaryLoop& loop : boundary.loops())
    if (!loop.is_hole()) covered += overlap_area(loop.outline, former.outline);
  return covered > 0.5 * signed_area(former.outline);
}

}  // namespace

std::optional<Wound> find_wound(const FreeBoundary& boundary, const Wound* previous) {
  // Without a previous wound all holes are candidates, else those that may overlap it.
  const BoundingBox place = previous ? bounding_box(previous->outline) : BoundingBox{};
  const auto candidate = [&](const BoundaryLoop& loop) {
    return loop.is_hole() && (!previous || boxes_meet(bounding_box(loop.outline), place));
  };
  const auto alone = [&](const BoundaryLoop& loop) {
    return std::ranges::none_of(boundary.loops(), [&](const BoundaryLoop& other) {
      return &other != &loop && candidate(other) && overlap_area(other.outline, previous->outline) > 0.0;
    });
  };
  const BoundaryLoop* chosen = nullptr;
  double most = 0.0, area_of_parts = 0.0;
  int parts = 0;
  for (const BoundaryLoop& loop : boundary.loops()) {
    if (!candidate(loop)) continue;
    double merit = -loop.signed_area;
    // One that has a point inside the previous wound overlaps it; how much does not matter if no other does.
    if (previous && !(begins_inside(loop, *previous) && alone(loop))) merit = overlap_area(loop.outline, previous->outline);
    if (!(merit > 0.0)) continue;
    if (previous || !chosen) {
      ++parts;
      area_of_parts += hole_size(boundary, loop).area;
    }
    if (merit > most) most = merit, chosen = &loop;
  }
  if (!chosen) return std::nullopt;
  Wound wound = make_wound(boundary, *chosen);
  wound.parts = parts;
  wound.area_of_parts = area_of_parts;
  return wound;
}

std::optional<Wound> find_wound(const Tissue& tissue, const StateView& state, const Membrane& membrane) {
  FreeBoundary boundary(membrane);
  boundary.evaluate(tissue, state);
  return find_wound(boundary);
}

std::vector<double> hole_areas(const FreeBoundary& boundary) {
  std::vector<double> areas;
  for (const BoundaryLoop& loop : boundary.loops())
    if (loop.is_hole()) areas.push_back(hole_size(boundary, loop).area);
  std::sort(areas.begin(), areas.end(), std::greater<>());
  return areas;
}

WoundTracker::WoundTracker(const Membrane& membrane, ExposureRule rule) : boundary_(membrane) {
  if (rule == ExposureRule::contact_free) strict_.emplace(membrane, rule);
}

const Exposure& WoundTracker::expose(const Tissue& tissue, const StateView& state, const std::optional<BoundingBox>& within) {
  boundary_.expose(tissue, state, within);
  return boundary_.exposure();
}

const std::optional<Wound>& WoundTracker::update(const Tissue& tissue, const StateView& state) {
  expose(tissue, state);
  return update_exposed(tissue, state);
}

const std::optional<Wound>& WoundTracker::update_exposed(const Tissue& tissue, const StateView& state) {
  boundary_.trace(tissue, state);
  // Once closed it stays closed: a hole that opens elsewhere later is another wound.
  if (status_ == WoundStatus::closed || status_ == WoundStatus::open_to_outside) return wound_;
  std::optional<Wound> found = find_wound(boundary_, wound_ ? &*wound_ : nullptr);
  if (found) {
    status_ = WoundStatus::open;
    splits_ += found->parts > 1;
    if (strict_) {
      const Exposure& exposure = (*strict_)(tissue, state);
      std::erase_if(found->boundary, [&](int v) { return !exposure.exposed[v]; });
    }
  } else if (wound_) {
    status_ = covered_by_tissue(boundary_, *wound_) ? WoundStatus::closed : WoundStatus::open_to_outside;
  }
  wound_ = std::move(found);
  return wound_;
}

}  // namespace suture
