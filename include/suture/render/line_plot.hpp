// Plots with two logarithmic axes: panels side by side, curves with markers, guides. The ending of the path chooses the
// format: .png, .svg or .pdf.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "suture/geometry/point.hpp"

namespace suture {

struct PlotSeries {
  std::string label;
  int look = 0;  ///< number of its colour and marker; equal looks in several panels mean the same thing
  std::vector<Point> points;
};

/// Points that are not positive and finite are left out. A panel without points says so.
struct PlotPanel {
  std::string title, x_label, y_label;
  std::vector<PlotSeries> series;
  bool diagonal = false;                     ///< draws y = x
  double vertical = 0.0, horizontal = 0.0;   ///< guides at this x and y, if positive
  std::string vertical_label, horizontal_label;
};

/// Draws the panels from left to right. Throws InputError for an unknown ending, FileError when it cannot be written.
void render_plots(std::span<const PlotPanel> panels, const std::filesystem::path& path);

}  // namespace suture
