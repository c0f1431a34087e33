#include "render/tissue_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace suture {
namespace {

constexpr Colour plain_cell{0.72, 0.85, 0.86};
constexpr Colour pale_cell{0.93, 0.94, 0.95};
constexpr Colour obstacle{0.45, 0.47, 0.52};
constexpr double edge_share = 0.22;    // of the membrane width that is drawn as the dark edge of the cell
constexpr double ring_share = 0.45;    // width of the purse string / membrane width
constexpr double smallest_line = 1.2;  // pixels

using Outline = std::vector<Point>;

// Zero stays zero: two vertices in one place have no direction.
Point unit_vector(Point a) { return norm(a) > 0.0 ? 1.0 / norm(a) * a : Point{}; }

Outline cell_outline(const Tissue& tissue, const StateView& view, int cell, const Projection& projection) {
  Outline points;
  for (int v = tissue.first_vertex(cell); v < tissue.end_vertex(cell); ++v)
    points.push_back(projection(view.x[v], view.y[v]));
  return points;
}

void trace(cairo_t* context, const Outline& points) {
  cairo_new_path(context);
  for (const Point& point : points) cairo_line_to(context, point.x, point.y);
  cairo_close_path(context);
}

// Part i, from point i to the next, of a closed curve through every point, tangent to the chord of its neighbours.
// Handles are a third of their own segment, so very unequal segments (plastic membranes) cannot make it overshoot.
void continue_curve(cairo_t* context, const Outline& points, std::size_t i) {
  const std::size_t n = points.size();
  const auto tangent = [&](std::size_t k) { return unit_vector(points[(k + 1) % n] - points[(k + n - 1) % n]); };
  const Point &from = points[i], &to = points[(i + 1) % n];
  const double handle = norm(to - from) / 3.0;
  const Point first = from + handle * tangent(i), second = to - handle * tangent((i + 1) % n);
  cairo_curve_to(context, first.x, first.y, second.x, second.y, to.x, to.y);
}

void trace_smooth(cairo_t* context, const Outline& points) {
  cairo_new_path(context);
  cairo_move_to(context, points[0].x, points[0].y);
  for (std::size_t i = 0; i < points.size(); ++i) continue_curve(context, points, i);
  cairo_close_path(context);
}

// All dark edges first, then all bodies: a thin dark line remains between neighbours whose membranes overlap.
void draw_cells(cairo_t* context, const TissueState& state, const FrameStyle& style, const CellField& field,
                const ColourScale& colours, const Projection& projection) {
  const double width = membrane_width(state, style) * projection.scale;
  const double edge = std::max(edge_share * width, smallest_line);
  const StateView view = state.view();
  const auto body = [&](int cell) {
    if (style.segment_field) return pale_cell;
    return style.coloured ? colours.at(field.values[cell]) : plain_cell;
  };
  for (int cell = 0; cell < state.tissue.cell_count(); ++cell) {
    trace_smooth(context, cell_outline(state.tissue, view, cell, projection));
    set_colour(context, mix(body(cell), ink, 0.85));
    cairo_set_line_width(context, width);
    cairo_stroke(context);
  }
  for (int cell = 0; cell < state.tissue.cell_count(); ++cell) {
    trace_smooth(context, cell_outline(state.tissue, view, cell, projection));
    set_colour(context, body(cell));
    cairo_fill_preserve(context);
    set_colour(context, mix(body(cell), {1.0, 1.0, 1.0}, 0.45));
    cairo_set_line_width(context, std::max(width - edge, smallest_line));
    cairo_stroke(context);
  }
}

// Every segment in the colour of its value, as wide as the membrane within its dark edge.
void draw_segments(cairo_t* context, const TissueState& state, const FrameStyle& style, const ColourScale& colours,
                   const Projection& projection) {
  const double width = membrane_width(state, style) * projection.scale;
  cairo_set_line_width(context, std::max(width - std::max(edge_share * width, smallest_line), 2.0 * smallest_line));
  const StateView view = state.view();
  for (int cell = 0; cell < state.tissue.cell_count(); ++cell) {
    const Outline points = cell_outline(state.tissue, view, cell, projection);
    for (std::size_t i = 0; i < points.size(); ++i) {
      set_colour(context, colours.at(style.segment_field->values[state.tissue.first_vertex(cell) + i]));
      cairo_move_to(context, points[i].x, points[i].y);
      continue_curve(context, points, i);
      cairo_stroke(context);
    }
  }
}

void draw_purse_string(cairo_t* context, const TissueState& state, double width, const Projection& projection) {
  if (state.purse_string.empty()) return;
  const StateView view = state.view();
  const int vertices = state.tissue.vertex_count();
  Outline ring;
  for (int j = 0; j < state.purse_string.size(); ++j)
    ring.push_back(projection(view.x[vertices + j], view.y[vertices + j]));
  const double line = std::max(ring_share * width, 2.0 * smallest_line);
  set_colour(context, purse_string_colour);
  cairo_set_line_width(context, 0.4 * line);
  for (std::size_t j = 0; j < ring.size(); ++j) {
    const int v = state.purse_string.vertex[j];
    const Point cell_vertex = projection(view.x[v], view.y[v]);
    cairo_move_to(context, ring[j].x, ring[j].y);
    cairo_line_to(context, cell_vertex.x, cell_vertex.y);
    cairo_stroke(context);
  }
  trace(context, ring);
  cairo_set_line_width(context, line);
  cairo_stroke(context);
  for (const Point& point : ring) {
    cairo_arc(context, point.x, point.y, 0.62 * line, 0.0, 2.0 * std::numbers::pi);
    set_colour(context, {1.0, 1.0, 1.0});
    cairo_fill_preserve(context);
    set_colour(context, purse_string_colour);
    cairo_set_line_width(context, 0.45 * line);
    cairo_stroke(context);
  }
}

// The outer edge of the membrane whose centre line is given, as the cells show it.
Outline outer_edge(const std::vector<Point>& centre_line, double width, const Projection& projection) {
  Outline edge;
  const std::size_t n = centre_line.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point chord = unit_vector(centre_line[(i + 1) % n] - centre_line[(i + n - 1) % n]);
    const Point outward{chord.y, chord.x};  // of a counter-clockwise outline, in the picture's axes
    edge.push_back(projection(centre_line[i].x, centre_line[i].y) + 0.5 * width * outward);
  }
  return edge;
}

void draw_ghosts(cairo_t* context, const FrameStyle& style, double width, const Projection& projection) {
  const double dash[] = {0.35 * width, 0.35 * width};
  cairo_save(context);
  cairo_set_dash(context, dash, 2, 0.0);
  cairo_set_line_width(context, std::max(0.07 * width, smallest_line));
  set_colour(context, ink, 0.75);
  for (const auto& ghost : style.ghosts) {
    trace_smooth(context, outer_edge(ghost, width, projection));
    cairo_stroke(context);
  }
  cairo_restore(context);
}

void draw_plates(cairo_t* context, const FrameStyle& style, double width, const Projection& projection) {
  for (const Plate& plate : style.plates) {
    const Point from = projection(plate.from.x, plate.from.y), to = projection(plate.to.x, plate.to.y);
    const Point along = unit_vector(to - from), left{along.y, -along.x};
    const double depth = 1.4 * width;
    set_colour(context, obstacle, 0.25);
    trace(context, {from, to, to + depth * left, from + depth * left});
    cairo_fill(context);
    set_colour(context, obstacle);
    cairo_set_line_width(context, std::max(0.3 * width, smallest_line));
    cairo_move_to(context, from.x, from.y);
    cairo_line_to(context, to.x, to.y);
    cairo_stroke(context);
  }
}

void draw_forces(cairo_t* context, const FrameStyle& style, double width, const Projection& projection) {
  set_colour(context, purse_string_colour);
  for (const ForceArrow& force : style.forces) {
    const Point tail = projection(force.point.x, force.point.y);
    const Point tip = projection(force.point.x + force.vector.x, force.point.y + force.vector.y);
    const Point along = unit_vector(tip - tail), side = left_normal(along);
    const double head = std::min(0.8 * width, 0.6 * norm(tip - tail));
    cairo_set_line_width(context, std::max(0.2 * width, smallest_line));
    cairo_move_to(context, tail.x, tail.y);
    const Point neck = tip - 0.8 * head * along;
    cairo_line_to(context, neck.x, neck.y);
    cairo_stroke(context);
    trace(context, {tip, tip - head * along + 0.45 * head * side, tip - head * along - 0.45 * head * side});
    cairo_fill(context);
  }
}

void draw_wound(cairo_t* context, const FrameStyle& style, const Projection& projection) {
  if (style.wound_outline.size() < 3) return;
  Outline points;
  for (const Point& point : style.wound_outline) points.push_back(projection(point.x, point.y));
  trace(context, points);
  set_colour(context, wound_colour);
  cairo_fill(context);
}

}  // namespace

Projection project(const View& view, const PixelBox& box) {
  return {.scale = 0.5 * std::min(box.width, box.height) / view.half_width,
          .origin = view.centre,
          .anchor = {box.x + 0.5 * box.width, box.y + 0.5 * box.height}};
}

double membrane_width(const TissueState& state, const FrameStyle& style) {
  return style.membrane_width.value_or(state.tissue.mean_initial_rest_length());
}

void draw_tissue(cairo_t* context, const TissueState& state, const FrameStyle& style, const CellField& field,
                 const ColourScale& colours, const Projection& projection) {
  const double width = membrane_width(state, style) * projection.scale;
  draw_wound(context, style, projection);
  draw_cells(context, state, style, field, colours, projection);
  if (style.segment_field) draw_segments(context, state, style, colours, projection);
  draw_plates(context, style, width, projection);
  draw_ghosts(context, style, width, projection);
  draw_purse_string(context, state, width, projection);
  draw_forces(context, style, width, projection);
}

}  // namespace suture
