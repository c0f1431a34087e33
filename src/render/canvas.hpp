// A cairo drawing that becomes a PNG, SVG or PDF file when it is finished. Only src/render sees cairo.
#pragma once

#include <cairo.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "suture/render/colour_map.hpp"

namespace suture {

class Canvas {
 public:
  /// White, width x height pixels (points). Throws InputError for an unknown ending of the path.
  Canvas(std::filesystem::path path, int width, int height);
  /// The same, only in memory.
  Canvas(int width, int height);
  cairo_t* context() const { return context_.get(); }
  /// Writes the file, whole or not at all. Throws FileError.
  void finish();
  /// What has been drawn in memory: four bytes per pixel (blue, green, red, unused), rows from the top.
  std::vector<unsigned char> pixels() const;

 private:
  void prepare(int width, int height);

  std::filesystem::path path_;
  std::string bytes_;  // what cairo has produced so far; must outlive the surface
  std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_{nullptr, cairo_surface_destroy};
  std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context_{nullptr, cairo_destroy};
};

enum class Align { left, centre, right };

void set_colour(cairo_t* context, const Colour& colour, double opacity = 1.0);

/// One line of text; (x, y) is its anchor on the base line. Returns its width.
double draw_text(cairo_t* context, const std::string& text, double x, double y, double size, Align align = Align::left,
                 bool bold = false);

}  // namespace suture
