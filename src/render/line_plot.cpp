#include "suture/render/line_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/canvas.hpp"
#include "render/furniture.hpp"

namespace suture {

namespace {

constexpr int panel_width = 620, panel_height = 560;
constexpr double left = 84.0, right = 24.0, top = 48.0, bottom = 66.0, font = 15.0;
constexpr Colour grid_colour{0.88, 0.89, 0.91}, guide_colour{0.45, 0.47, 0.52};

// Eight colours that colour-blind readers can tell apart: Okabe and Ito 2008 (jfly.uni-koeln.de/color), yellow darkened.
constexpr std::array<Colour, 8> palette{{{0.00, 0.45, 0.70}, {0.84, 0.37, 0.00}, {0.00, 0.62, 0.45}, {0.80, 0.47, 0.65},
                                         {0.34, 0.71, 0.91}, {0.90, 0.62, 0.00}, {0.20, 0.20, 0.20}, {0.70, 0.65, 0.10}}};

bool shown(const Point& p) { return p.x > 0.0 && p.y > 0.0 && std::isfinite(p.x) && std::isfinite(p.y); }

/// One logarithmic axis: decades from `low` to `high`, on pixels `from` to `to`.
struct LogAxis {
  double low = 0.0, high = 1.0, from = 0.0, to = 1.0;
  double pixel(double value) const { return from + (std::log10(value) - low) / (high - low) * (to - from); }
  bool contains(double value) const { return value > 0.0 && std::log10(value) >= low && std::log10(value) <= high; }
};

/// Room around the data: a tenth of their range, and at least a decade in all.
LogAxis axis_for(double smallest, double largest, double from, double to) {
  double low = std::log10(smallest), high = std::log10(largest);
  const double margin = std::max(0.08 * (high - low), 0.5 * (1.0 - (high - low)));
  low -= std::max(margin, 0.08), high += std::max(margin, 0.08);
  return {low, high, from, to};
}

void draw_line(cairo_t* context, double x1, double y1, double x2, double y2) {
  cairo_move_to(context, x1, y1);
  cairo_line_to(context, x2, y2);
  cairo_stroke(context);
}

/// "1", "0.01", "1e-5", "1e6".
std::string tick_label(double value) {
  if (value >= 0.99e-2 && value < 0.99e4) return fmt::format("{:g}", value);
  const int exponent = static_cast<int>(std::floor(std::log10(value) + 1e-9));
  return fmt::format("{:.0f}e{}", value / std::pow(10.0, exponent), exponent);
}

/// Decades, and 2 and 5 times one where there are few.
std::vector<double> ticks(const LogAxis& axis) {
  std::vector<double> values;
  const bool few = axis.high - axis.low < 2.2;
  const int stride = axis.high - axis.low > 8.0 ? 2 : 1;
  for (int decade = static_cast<int>(std::floor(axis.low)); decade <= static_cast<int>(std::ceil(axis.high)); decade += stride)
    for (const double factor : {1.0, 2.0, 5.0})
      if ((factor == 1.0 || few) && axis.contains(factor * std::pow(10.0, decade))) values.push_back(factor * std::pow(10.0, decade));
  return values;
}

void trace_marker(cairo_t* context, int look, double x, double y, double r) {
  const int corners = std::array{0, 4, 3, 5, 6, 4, 3, 0}[static_cast<std::size_t>(look) % 8];
  cairo_new_path(context);
  if (corners == 0) {
    cairo_arc(context, x, y, r, 0.0, 2.0 * std::numbers::pi);
    return;
  }
  const double turn = look % 8 == 5 ? 0.25 * std::numbers::pi : look % 8 == 6 ? std::numbers::pi : 0.0;
  for (int k = 0; k < corners; ++k) {
    const double angle = turn - 0.5 * std::numbers::pi + 2.0 * std::numbers::pi * k / corners;
    cairo_line_to(context, x + 1.15 * r * std::cos(angle), y + 1.15 * r * std::sin(angle));
  }
  cairo_close_path(context);
}

void draw_marker(cairo_t* context, int look, double x, double y) {
  trace_marker(context, look, x, y, 4.6);
  set_colour(context, palette[static_cast<std::size_t>(look) % palette.size()]);
  cairo_fill(context);
}

void draw_axes(cairo_t* context, const PlotPanel& panel, const LogAxis& x, const LogAxis& y) {
  cairo_set_line_width(context, 1.0);
  for (const double value : ticks(x)) {
    set_colour(context, grid_colour);
    draw_line(context, x.pixel(value), y.from, x.pixel(value), y.to);
    set_colour(context, ink);
    draw_text(context, tick_label(value), x.pixel(value), y.from + 20.0, font, Align::centre);
  }
  for (const double value : ticks(y)) {
    set_colour(context, grid_colour);
    draw_line(context, x.from, y.pixel(value), x.to, y.pixel(value));
    set_colour(context, ink);
    draw_text(context, tick_label(value), x.from - 8.0, y.pixel(value) + 5.0, font, Align::right);
  }
  set_colour(context, ink);
  cairo_rectangle(context, x.from, y.to, x.to - x.from, y.from - y.to);
  cairo_stroke(context);
  draw_text(context, panel.title, x.from, y.to - 16.0, 1.1 * font, Align::left, true);
  draw_text(context, panel.x_label, 0.5 * (x.from + x.to), y.from + 48.0, font, Align::centre);
  cairo_save(context);
  cairo_translate(context, x.from - 64.0, 0.5 * (y.from + y.to));
  cairo_rotate(context, -0.5 * std::numbers::pi);
  draw_text(context, panel.y_label, 0.0, 0.0, font, Align::centre);
  cairo_restore(context);
}

void draw_guides(cairo_t* context, const PlotPanel& panel, const LogAxis& x, const LogAxis& y) {
  const double dash[] = {6.0, 5.0};
  set_colour(context, guide_colour);
  cairo_set_line_width(context, 1.2);
  cairo_set_dash(context, dash, 2, 0.0);
  if (panel.diagonal) {
    const double from = std::max(x.low, y.low), to = std::min(x.high, y.high);
    if (from < to) draw_line(context, x.pixel(std::pow(10.0, from)), y.pixel(std::pow(10.0, from)), x.pixel(std::pow(10.0, to)), y.pixel(std::pow(10.0, to)));
  }
  if (x.contains(panel.vertical)) draw_line(context, x.pixel(panel.vertical), y.from, x.pixel(panel.vertical), y.to);
  if (y.contains(panel.horizontal)) draw_line(context, x.from, y.pixel(panel.horizontal), x.to, y.pixel(panel.horizontal));
  cairo_set_dash(context, nullptr, 0, 0.0);
  if (x.contains(panel.vertical)) {
    cairo_save(context);
    cairo_translate(context, x.pixel(panel.vertical) - 6.0, y.from - 8.0);
    cairo_rotate(context, -0.5 * std::numbers::pi);
    draw_text(context, panel.vertical_label, 0.0, 0.0, 0.8 * font);
    cairo_restore(context);
  }
  if (y.contains(panel.horizontal)) draw_text(context, panel.horizontal_label, x.to - 8.0, y.pixel(panel.horizontal) - 6.0, 0.8 * font, Align::right);
}

void draw_series(cairo_t* context, const PlotSeries& series, const LogAxis& x, const LogAxis& y) {
  set_colour(context, palette[static_cast<std::size_t>(series.look) % palette.size()]);
  cairo_set_line_width(context, 2.0);
  for (const Point& p : series.points)
    if (shown(p)) cairo_line_to(context, x.pixel(p.x), y.pixel(p.y));
  cairo_stroke(context);
  for (const Point& p : series.points)
    if (shown(p)) draw_marker(context, series.look, x.pixel(p.x), y.pixel(p.y));
}

/// In a column of its own to the right of the last panel.
void draw_legend(cairo_t* context, std::span<const PlotPanel> panels, double x) {
  std::vector<int> listed;
  double y = top + 12.0;
  for (const PlotPanel& panel : panels)
    for (const PlotSeries& series : panel.series) {
      if (std::find(listed.begin(), listed.end(), series.look) != listed.end()) continue;
      listed.push_back(series.look);
      set_colour(context, palette[static_cast<std::size_t>(series.look) % palette.size()]);
      cairo_set_line_width(context, 2.0);
      draw_line(context, x, y, x + 26.0, y);
      draw_marker(context, series.look, x + 13.0, y);
      set_colour(context, ink);
      draw_text(context, series.label, x + 34.0, y + 5.0, font);
      y += 24.0;
    }
}

void draw_panel(cairo_t* context, const PlotPanel& panel, double origin) {
  std::vector<double> xs, ys;
  for (const PlotSeries& series : panel.series)
    for (const Point& p : series.points)
      if (shown(p)) xs.push_back(p.x), ys.push_back(p.y);
  if (xs.empty()) {
    set_colour(context, guide_colour);
    draw_text(context, panel.title + ": nothing to show", origin + 0.5 * panel_width, 0.5 * panel_height, font, Align::centre);
    return;
  }
  if (panel.horizontal > 0.0) ys.push_back(panel.horizontal);
  if (panel.vertical > 0.0) xs.push_back(panel.vertical);
  const auto [x_low, x_high] = std::minmax_element(xs.begin(), xs.end());
  const auto [y_low, y_high] = std::minmax_element(ys.begin(), ys.end());
  const LogAxis x = axis_for(*x_low, *x_high, origin + left, origin + panel_width - right);
  const LogAxis y = axis_for(*y_low, *y_high, panel_height - bottom, top);
  draw_axes(context, panel, x, y);
  draw_guides(context, panel, x, y);
  for (const PlotSeries& series : panel.series) draw_series(context, series, x, y);
}

}  // namespace

void render_plots(std::span<const PlotPanel> panels, const std::filesystem::path& path) {
  constexpr int legend_width = 120;
  Canvas canvas(path, panel_width * static_cast<int>(panels.size()) + legend_width, panel_height);
  for (std::size_t k = 0; k < panels.size(); ++k) draw_panel(canvas.context(), panels[k], static_cast<double>(k) * panel_width);
  draw_legend(canvas.context(), panels, panel_width * static_cast<double>(panels.size()));
  canvas.finish();
}

}  // namespace suture
