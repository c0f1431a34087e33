// What stands around the tissue in a figure: colour bar, scale bar, key.
#pragma once

#include <string>
#include <vector>

#include "render/canvas.hpp"

namespace suture {

inline constexpr Colour ink{0.13, 0.14, 0.17};
inline constexpr Colour purse_string_colour{0.84, 0.07, 0.27};
inline constexpr Colour wound_colour{0.99, 0.90, 0.88};

/// Range of the colour bar and what it shows.
struct ColourScale {
  double minimum = 0.0;
  double maximum = 1.0;
  std::string label;
  Colour at(double value) const;
};

/// A rectangle of the picture, in pixels; y points down.
struct PixelBox {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
};

/// Round numbers (1, 2 or 5 times a power of ten apart) within [minimum, maximum], about `count` of them.
std::vector<double> round_ticks(double minimum, double maximum, int count);
/// The largest 1, 2 or 5 times a power of ten not above `limit`.
double round_down(double limit);

/// Upright bar that fills `box`; ticks and label stand to its right.
void draw_colour_bar(cairo_t* context, const ColourScale& scale, const PixelBox& box, double font_size);
/// Bar from (x, y) to the right, of a round length near wanted_pixels, with its length in um beneath.
void draw_scale_bar(cairo_t* context, double x, double y, double wanted_pixels, double pixels_per_um, double font_size);

}  // namespace suture
