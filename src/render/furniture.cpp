#include "render/furniture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace suture {

Colour ColourScale::at(double value) const {
  return colour_at(maximum > minimum ? (value - minimum) / (maximum - minimum) : 0.5);
}

double round_down(double limit) {
  const double power = std::pow(10.0, std::floor(std::log10(limit)));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= limit) return factor * power;
  return power;
}

std::vector<double> round_ticks(double minimum, double maximum, int count) {
  std::vector<double> ticks;
  if (!(maximum > minimum)) return {minimum};
  // The step is rounded up so that no more than about `count` ticks appear.
  const double smallest = (maximum - minimum) / count;
  double step = round_down(smallest);
  for (const double factor : {2.0, 2.5, 2.0})
    if (step < smallest * (1.0 - 1e-9)) step = round_down(step * factor * (1.0 + 1e-9));
  const double slack = 1e-9 * step;
  for (double k = std::ceil((minimum - slack) / step); k * step <= maximum + slack; k += 1.0) ticks.push_back(k * step);
  return ticks;
}

void draw_colour_bar(cairo_t* context, const ColourScale& scale, const PixelBox& box, double font_size) {
  // Strips overlap by a pixel so that no seam shows when the viewer antialiases them.
  const int strips = std::max(2, static_cast<int>(box.height / 2.0));
  for (int i = 0; i < strips; ++i) {
    set_colour(context, colour_at((i + 0.5) / strips));
    const double bottom = box.y + box.height * (1.0 - static_cast<double>(i) / strips);
    const double top = std::max(box.y, bottom - box.height / strips - 1.0);
    cairo_rectangle(context, box.x, top, box.width, bottom - top);
    cairo_fill(context);
  }
  set_colour(context, ink);
  cairo_set_line_width(context, 0.06 * font_size);
  cairo_rectangle(context, box.x, box.y, box.width, box.height);
  cairo_stroke(context);
  double widest = 0.0;
  for (const double tick : round_ticks(scale.minimum, scale.maximum, 6)) {
    const double fraction =
        scale.maximum > scale.minimum ? (tick - scale.minimum) / (scale.maximum - scale.minimum) : 0.5;
    const double y = box.y + box.height * (1.0 - fraction);
    cairo_move_to(context, box.x + box.width, y);
    cairo_line_to(context, box.x + box.width + 0.3 * font_size, y);
    cairo_stroke(context);
    widest = std::max(widest, draw_text(context, fmt::format("{:.6g}", tick + 0.0),
                                        box.x + box.width + 0.55 * font_size, y + 0.36 * font_size, font_size));
  }
  cairo_save(context);
  cairo_translate(context, box.x + box.width + 1.9 * font_size + widest, box.y + 0.5 * box.height);
  cairo_rotate(context, -0.5 * std::numbers::pi);
  draw_text(context, scale.label, 0.0, 0.0, 1.05 * font_size, Align::centre);
  cairo_restore(context);
}

void draw_scale_bar(cairo_t* context, double x, double y, double wanted_pixels, double pixels_per_um,
                    double font_size) {
  const double length_um = round_down(wanted_pixels / pixels_per_um);
  const double pixels = length_um * pixels_per_um;
  set_colour(context, ink);
  cairo_rectangle(context, x, y, pixels, 0.32 * font_size);
  cairo_fill(context);
  draw_text(context, fmt::format("{:g} \xc2\xb5m", length_um), x + 0.5 * pixels, y + 1.5 * font_size, font_size,
            Align::centre);
}

}  // namespace suture
