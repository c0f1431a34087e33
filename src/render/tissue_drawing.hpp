// The tissue itself: wound, cells with their membranes, purse string, and what acts on a single cell.
#pragma once

#include "render/furniture.hpp"
#include "suture/render/frame.hpp"

namespace suture {

/// Model plane to picture: y points down there.
struct Projection {
  double scale = 1.0;      ///< pixels per model length
  Point origin{0.0, 0.0};  ///< model point shown at pixel `anchor`
  Point anchor{0.0, 0.0};
  Point operator()(double x, double y) const {
    return {anchor.x + scale * (x - origin.x), anchor.y - scale * (y - origin.y)};
  }
};

/// Shows `view` in the middle of `box`.
Projection project(const View& view, const PixelBox& box);

/// s, which the membrane is drawn as wide as.
double membrane_width(const TissueState& state, const FrameStyle& style);

void draw_tissue(cairo_t* context, const TissueState& state, const FrameStyle& style, const CellField& field,
                 const ColourScale& colours, const Projection& projection);

}  // namespace suture
