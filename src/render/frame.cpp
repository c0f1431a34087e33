#include "suture/render/frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/tissue_drawing.hpp"
#include "suture/errors.hpp"
#include "suture/geometry/polygon.hpp"

namespace suture {
namespace {

CellField field_of(const TissueState& state, const FrameStyle& style) {
  if (!style.field) return shape_parameter_field(state);
  if (style.field->values.size() != static_cast<std::size_t>(state.tissue.cell_count()))
    throw InputError(fmt::format("the field '{}' has {} values for {} cells", style.field->quantity.name,
                                 style.field->values.size(), state.tissue.cell_count()));
  return *style.field;
}

// What the colour bar is about.
CellField shown_field(const TissueState& state, const FrameStyle& style) {
  if (!style.segment_field) return field_of(state, style);
  const SegmentField& field = *style.segment_field;
  if (field.values.size() != static_cast<std::size_t>(state.tissue.vertex_count()))
    throw InputError(fmt::format("the field '{}' has {} values for {} segments", field.quantity.name,
                                 field.values.size(), state.tissue.vertex_count()));
  return {field.quantity, field.values};
}

// Wide enough for the cells, their membranes and whatever acts on them.
View view_of(std::span<const StripPanel> panels) {
  if (panels.front().style.view) return *panels.front().style.view;
  Point low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};
  const auto include = [&](const Point& point) {
    low = {std::min(low.x, point.x), std::min(low.y, point.y)};
    high = {std::max(high.x, point.x), std::max(high.y, point.y)};
  };
  for (const StripPanel& panel : panels) {
    const StateView view = panel.state.view();
    for (std::size_t i = 0; i < view.x.size(); ++i) include({view.x[i], view.y[i]});
    for (const Plate& plate : panel.style.plates) include(plate.from), include(plate.to);
    for (const ForceArrow& force : panel.style.forces) include(force.point + force.vector);
  }
  const double margin = membrane_width(panels.front().state, panels.front().style);
  return {.centre = 0.5 * (low + high), .half_width = 0.5 * std::max(high.x - low.x, high.y - low.y) + margin};
}

std::string field_label(const CellField& field) {
  const Quantity& quantity = field.quantity;
  const std::string text = quantity.description.empty() ? quantity.name : quantity.description;
  return quantity.unit.empty() || quantity.unit == "1" ? text : fmt::format("{} ({})", text, quantity.unit);
}

// Starts and ends on round numbers.
ColourScale colours_of(std::span<const StripPanel> panels, std::span<const CellField> fields) {
  double low = INFINITY, high = -INFINITY;
  for (const CellField& field : fields)
    for (const double value : field.values) low = std::min(low, value), high = std::max(high, value);
  if (!(high > low)) low -= 0.05, high = low + 0.1;
  const double step = round_down(0.2 * (high - low));
  const FrameStyle& style = panels.front().style;
  return {.minimum = style.field_minimum.value_or(step * std::floor(low / step)),
          .maximum = style.field_maximum.value_or(step * std::ceil(high / step)),
          .label = field_label(fields.front())};
}

std::string time_label(const StripPanel& panel) {
  if (!panel.style.caption.empty()) return panel.style.caption;
  const double time = panel.state.time - panel.style.time_origin;
  return fmt::format("{:.1f} min  (t = {:.1f})", time * panel.style.scales.time_min(), time);
}

void require_cells(const TissueState& state) {
  if (state.tissue.cell_count() == 0) throw InputError("there is no cell to draw");
}

void require_drawable(std::span<const StripPanel> panels) {
  if (panels.empty()) throw InputError("a strip needs at least one panel");
  for (const StripPanel& panel : panels) require_cells(panel.state);
}

struct Layout {
  double font = 0.0, left = 0.0, header = 0.0, footer = 0.0, right = 0.0;
};

// Everything around a panel scales with the font, the font with the panel.
Layout layout_for(double panel_size, bool colour_bar) {
  const double font = std::max(0.024 * panel_size, 11.0);
  return {.font = font,
          .left = 0.6 * font,
          .header = 2.3 * font,
          .footer = 3.0 * font,
          .right = (colour_bar ? 7.6 : 0.6) * font};
}

void draw_header(cairo_t* context, const StripPanel& panel, const PixelBox& box, const Layout& layout,
                 const std::string& letter) {
  const double baseline = box.y - 0.7 * layout.font;
  double x = box.x + 0.4 * layout.font;
  set_colour(context, ink);
  if (!letter.empty())
    x += draw_text(context, letter, x, baseline, 1.35 * layout.font, Align::left, true) + 0.8 * layout.font;
  draw_text(context, time_label(panel), x, baseline, 1.1 * layout.font);
  if (panel.style.wound_fraction)
    draw_text(context, fmt::format("wound {:.0f} %", 100.0 * *panel.style.wound_fraction),
              box.x + box.width - 0.4 * layout.font, baseline, 1.1 * layout.font, Align::right);
}

// A line and its meaning, ending at `right`.
void draw_key(cairo_t* context, const std::string& text, const Colour& colour, bool dashed, double right,
              double baseline, double font) {
  set_colour(context, ink);
  const double width = draw_text(context, text, right, baseline, font, Align::right);
  const double dash[] = {0.3 * font, 0.3 * font};
  cairo_save(context);
  if (dashed) cairo_set_dash(context, dash, 2, 0.0);
  set_colour(context, colour);
  cairo_set_line_width(context, (dashed ? 0.1 : 0.28) * font);
  cairo_move_to(context, right - width - 2.6 * font, baseline - 0.33 * font);
  cairo_line_to(context, right - width - 0.7 * font, baseline - 0.33 * font);
  cairo_stroke(context);
  cairo_restore(context);
}

void draw_footer(cairo_t* context, std::span<const StripPanel> panels, std::span<const PixelBox> boxes,
                 const Layout& layout, double pixels_per_length) {
  const PixelBox &first = boxes.front(), &last = boxes.back();
  const double y = first.y + first.height + 0.6 * layout.font;
  draw_scale_bar(context, first.x + 0.4 * layout.font, y, 0.2 * first.width,
                 pixels_per_length / panels.front().style.scales.length_um(), layout.font);
  const auto any = [&](auto holds) { return std::any_of(panels.begin(), panels.end(), holds); };
  const double right = last.x + last.width - 0.4 * layout.font, baseline = y + 0.9 * layout.font;
  if (any([](const StripPanel& panel) { return !panel.state.purse_string.empty(); }))
    draw_key(context, "purse string", purse_string_colour, /*dashed=*/false, right, baseline, layout.font);
  else if (any([](const StripPanel& panel) { return !panel.style.ghosts.empty(); }))
    draw_key(context, "initial shape", ink, /*dashed=*/true, right, baseline, layout.font);
}

// Panels side by side in the given boxes, which all have the same size.
void draw_figure(cairo_t* context, std::span<const StripPanel> panels, std::span<const PixelBox> boxes,
                 const Layout& layout) {
  std::vector<CellField> fields;
  for (const StripPanel& panel : panels) fields.push_back(shown_field(panel.state, panel.style));
  const ColourScale colours = colours_of(panels, fields);
  const View view = view_of(panels);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const PixelBox& box = boxes[i];
    cairo_save(context);
    cairo_rectangle(context, box.x, box.y, box.width, box.height);
    cairo_clip(context);
    draw_tissue(context, panels[i].state, panels[i].style, fields[i], colours, project(view, box));
    cairo_restore(context);
    draw_header(context, panels[i], box, layout,
                panels.size() > 1 ? std::string(1, static_cast<char>('a' + i % 26)) : "");
  }
  draw_footer(context, panels, boxes, layout, project(view, boxes.front()).scale);
  const PixelBox& last = boxes.back();
  const PixelBox bar{last.x + last.width + layout.font, last.y + 0.15 * last.height, 1.1 * layout.font,
                     0.7 * last.height};
  if (panels.front().style.coloured) draw_colour_bar(context, colours, bar, layout.font);
}

}  // namespace

CellField shape_parameter_field(const TissueState& state) {
  CellField field{{"shape_parameter", "1",
                   "shape parameter p\xc2\xb2/4\xcf\x80"
                   "a"},
                  {}};
  const StateView view = state.view();
  for (int cell = 0; cell < state.tissue.cell_count(); ++cell) {
    const std::size_t first = state.tissue.first_vertex(cell), count = state.tissue.vertex_count(cell);
    field.values.push_back(shape_parameter(view.x.subspan(first, count), view.y.subspan(first, count)));
  }
  return field;
}

namespace {

void draw_frame(const TissueState& state, const FrameStyle& style, const Canvas& canvas) {
  const StripPanel panel{state, style};
  const Layout layout = layout_for(std::min(style.width, style.height), style.coloured);
  const PixelBox box{layout.left, layout.header, style.width - layout.left - layout.right,
                     style.height - layout.header - layout.footer};
  draw_figure(canvas.context(), {&panel, 1}, {&box, 1}, layout);
}

}  // namespace

void render_frame(const TissueState& state, const FrameStyle& style, const std::filesystem::path& path) {
  require_cells(state);
  Canvas canvas(path, style.width, style.height);
  draw_frame(state, style, canvas);
  canvas.finish();
}

Pixels render_pixels(const TissueState& state, const FrameStyle& style) {
  require_cells(state);
  const Canvas canvas(style.width, style.height);
  draw_frame(state, style, canvas);
  return {style.width, style.height, canvas.pixels()};
}

void render_strip(std::span<const StripPanel> panels, int panel_size, const std::filesystem::path& path) {
  require_drawable(panels);
  const Layout layout = layout_for(panel_size, panels.front().style.coloured);
  const double gap = layout.font;
  std::vector<PixelBox> boxes;
  for (std::size_t i = 0; i < panels.size(); ++i)
    boxes.push_back(
        {layout.left + static_cast<double>(i) * (panel_size + gap), layout.header, 1.0 * panel_size, 1.0 * panel_size});
  const double width = boxes.back().x + panel_size + layout.right;
  Canvas canvas(path, static_cast<int>(std::ceil(width)),
                static_cast<int>(std::ceil(layout.header + panel_size + layout.footer)));
  draw_figure(canvas.context(), panels, boxes, layout);
  canvas.finish();
}

void render_cell_experiment(std::span<const StripPanel> panels, int panel_size, const std::filesystem::path& path) {
  require_drawable(panels);
  const StateView first = panels.front().state.view();
  std::vector<Point> initial;
  for (int v = 0; v < panels.front().state.tissue.end_vertex(0); ++v) initial.push_back({first.x[v], first.y[v]});
  std::vector<StripPanel> captioned(panels.begin(), panels.end());
  for (std::size_t i = 0; i < captioned.size(); ++i) {
    StripPanel& panel = captioned[i];
    panel.style.coloured = false;
    if (panel.style.caption.empty())
      panel.style.caption = fmt::format("t = {:.4g}   A = {:.3f}", panel.state.time - panel.style.time_origin,
                                        shape_parameter_field(panel.state).values.front());
    if (i > 0) panel.style.ghosts.push_back(initial);
  }
  render_strip(captioned, panel_size, path);
}

}  // namespace suture
