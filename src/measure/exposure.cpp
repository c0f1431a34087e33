#include "suture/measure/exposure.hpp"

#include <fmt/format.h>


#include "measure/exposure_core.hpp"
#include "suture/errors.hpp"

namespace suture {

Point probe_centre(const MembraneSegment& before, const MembraneSegment& after, double radius) {
  double nx = before.uy + after.uy, ny = -before.ux - after.ux;
  const double squared_norm = nx * nx + ny * ny;
  // A membrane folded back on itself has no bisector: its tip points along the incoming segment.
  constexpr double folded = 1e-20;
  if (squared_norm < folded) return {after.ax + radius * before.ux, after.ay + radius * before.uy};
  const double scale = radius / std::sqrt(squared_norm);
  return {after.ax + scale * nx, after.ay + scale * ny};
}

Point probe_centre(const Tissue& tissue, const SegmentGrid& grid, int vertex, double radius) {
  return probe_centre(grid[tissue.previous(vertex)], grid[vertex], radius);
}

bool inside_other_cell(const Tissue& tissue, const StateView& state, const SegmentGrid& grid, int own_cell, Point p) {
  return grid.visit_boxes_at(p.x, p.y, [&](int cell) {
    if (cell == own_cell) return false;
    bool inside = false;
    int a = tissue.end_vertex(cell) - 1;
    for (int b = tissue.first_vertex(cell); b < tissue.end_vertex(cell); a = b++)
      if ((state.y[a] > p.y) != (state.y[b] > p.y) &&
          p.x < state.x[a] + (p.y - state.y[a]) / (state.y[b] - state.y[a]) * (state.x[b] - state.x[a]))
        inside = !inside;
    return inside;
  });
}

namespace {

/// Tests one disc per vertex against the membranes around it.
class DiscTest {
 public:
  DiscTest(const Tissue& tissue, const StateView& state, const SegmentGrid& grid, const Membrane& membrane,
           ExposureRule rule, Exposure& out)
      : tissue_(tissue), state_(state), grid_(grid), rule_(rule), out_(out) {
    radius_ = rule == ExposureRule::probe_disc ? membrane.probe_radius() : membrane.interaction_distance();
    own_window_ = own_bend(membrane.probe_radius());
    constexpr double rounding = 1e-9;
    squared_limit_ = radius_ * radius_ * (1.0 - rounding);
  }

  void run(std::span<const char> watched) {
    int hint = -1;
    for (int v = 0; v < tissue_.vertex_count(); ++v) hint = watched.empty() || watched[v] ? test(v, hint) : -1;
  }

 private:
  bool counts(int vertex, int segment) const {
    const int cell = tissue_.cell_of(vertex);
    if (grid_[segment].cell != cell) return true;
    if (rule_ == ExposureRule::contact_free) return false;
    const double loop = grid_.cell_perimeter(cell);
    const double ahead = grid_.arc_position(segment) - grid_.arc_position(vertex);
    const double forward = ahead < 0.0 ? ahead + loop : ahead;
    return forward >= own_window_ && loop - forward - grid_[segment].length >= own_window_;
  }

  bool blocks(int vertex, int segment, Point centre) {
    const double d2 = grid_[segment].squared_distance(centre.x, centre.y);
    if (d2 >= least_ || !counts(vertex, segment)) return false;
    least_ = d2;
    nearest_ = segment;
    return d2 < squared_limit_;
  }

  /// Returns the segment found to block, or -1. The opposite membrane runs backwards, so the neighbour's blocker and
  /// the segments before it are likely to block this vertex too.
  int test(int v, int hint) {
    constexpr double saturation = 1.25;
    const Point centre =
        rule_ == ExposureRule::probe_disc ? probe_centre(tissue_, grid_, v, radius_) : Point{state_.x[v], state_.y[v]};
    least_ = saturation * saturation * radius_ * radius_;
    bool blocked = false;
    for (int i = 0; i < 3 && hint >= 0 && !blocked; ++i, hint = tissue_.previous(hint))
      blocked = blocks(v, hint, centre);
    if (!blocked)
      blocked = grid_.visit_near({centre.x, centre.x, centre.y, centre.y}, saturation * radius_,
                                 [&](int segment) { return blocks(v, segment, centre); });
    out_.margin[v] = std::sqrt(least_) - radius_;
    out_.blocker[v] = blocked ? nearest_ : -1;
    if (!blocked && inside_other_cell(tissue_, state_, grid_, tissue_.cell_of(v), centre)) {
      blocked = true;
      out_.margin[v] = -std::sqrt(least_);
    }
    out_.exposed[v] = !blocked;
    return out_.blocker[v];
  }

  const Tissue& tissue_;
  const StateView& state_;
  const SegmentGrid& grid_;
  ExposureRule rule_;
  Exposure& out_;
  double radius_, own_window_, squared_limit_;
  double least_ = 0.0;
  int nearest_ = -1;
};

}  // namespace

void measure_exposure(const Tissue& tissue, const StateView& state, const SegmentGrid& grid, const Membrane& membrane,
                      ExposureRule rule, std::span<const char> watched, Exposure& out) {
  out.exposed.assign(tissue.vertex_count(), 0);
  out.margin.assign(tissue.vertex_count(), 0.0);
  out.blocker.assign(tissue.vertex_count(), -1);
  DiscTest(tissue, state, grid, membrane, rule, out).run(watched);
}

struct ExposureMeasure::Impl {
  Membrane membrane;
  ExposureRule rule;
  SegmentGrid grid;
  Exposure result;
};

ExposureMeasure::ExposureMeasure(const Membrane& membrane, ExposureRule rule)
    : impl_(std::make_unique<Impl>(Impl{membrane, rule, {}, {}})) {
  if (!(membrane.contact_distance > 0.0))
    throw InputError(fmt::format("contact distance {} is not positive", membrane.contact_distance));
}
ExposureMeasure::~ExposureMeasure() = default;
ExposureMeasure::ExposureMeasure(ExposureMeasure&&) noexcept = default;
ExposureMeasure& ExposureMeasure::operator=(ExposureMeasure&&) noexcept = default;

const Exposure& ExposureMeasure::operator()(const Tissue& tissue, const StateView& state) {
  impl_->grid.build(tissue, state, grid_bucket_size(impl_->membrane));
  measure_exposure(tissue, state, impl_->grid, impl_->membrane, impl_->rule, {}, impl_->result);
  return impl_->result;
}

Exposure exposed_vertices(const Tissue& tissue, const StateView& state, const Membrane& membrane, ExposureRule rule) {
  return ExposureMeasure(membrane, rule)(tissue, state);
}

}  // namespace suture
