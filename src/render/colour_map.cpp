#include "suture/render/colour_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace suture {
namespace {

// Hue path in OKLab (Ottosson 2020): green-red and blue-yellow coordinates at evenly spaced lightness.
struct OklabPoint {
  double a, b;
};
constexpr double darkest = 0.40, lightest = 0.93;
constexpr std::array<OklabPoint, 6> hue_path{
    {{0.050, -0.140}, {-0.020, -0.125}, {-0.075, -0.055}, {-0.105, 0.020}, {-0.095, 0.105}, {-0.030, 0.150}}};

double encode(double linear) {
  const double value = std::clamp(linear, 0.0, 1.0);
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
}

double decode(double value) { return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4); }

Colour from_oklab(double lightness, double a, double b) {
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  return {encode(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          encode(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          encode(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

}  // namespace

Colour colour_at(double fraction) {
  const double clamped = std::clamp(fraction, 0.0, 1.0);
  const double position = clamped * (hue_path.size() - 1);
  const auto left = std::min(static_cast<std::size_t>(position), hue_path.size() - 2);
  const double weight = position - static_cast<double>(left);
  const OklabPoint &p = hue_path[left], &q = hue_path[left + 1];
  return from_oklab(std::lerp(darkest, lightest, clamped), std::lerp(p.a, q.a, weight), std::lerp(p.b, q.b, weight));
}

double luminance(const Colour& colour) {
  return 0.2126 * decode(colour.red) + 0.7152 * decode(colour.green) + 0.0722 * decode(colour.blue);
}

Colour mix(const Colour& first, const Colour& second, double weight) {
  return {std::lerp(first.red, second.red, weight), std::lerp(first.green, second.green, weight),
          std::lerp(first.blue, second.blue, weight)};
}

}  // namespace suture
