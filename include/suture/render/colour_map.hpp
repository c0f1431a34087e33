// A sequential colour map, even in perceived lightness, so that it survives grey-scale printing and colour blindness.
#pragma once

namespace suture {

/// sRGB, each component in [0, 1].
struct Colour {
  double red = 0.0, green = 0.0, blue = 0.0;
};

/// From dark violet (0) through teal to light yellow (1); lightness rises linearly. Values outside [0, 1] are taken
/// at the nearer end.
Colour colour_at(double fraction);

/// Relative luminance of a colour, in [0, 1] (WCAG 2.1).
double luminance(const Colour& colour);

/// weight 0: first, 1: second; mixed in sRGB.
Colour mix(const Colour& first, const Colour& second, double weight);

}  // namespace suture
