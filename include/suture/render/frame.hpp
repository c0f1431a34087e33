// Pictures of a tissue: one frame, a strip of frames side by side, and one-cell experiments. The ending of the path
// chooses the format: .png, .svg or .pdf. All lengths and times that go in are in model units.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "suture/geometry/point.hpp"
#include "suture/io/trajectory.hpp"
#include "suture/io/units.hpp"
#include "suture/model/state.hpp"

namespace suture {

/// Part of the plane that is shown: a square.
struct View {
  Point centre{0.0, 0.0};
  double half_width = 1.0;
};

/// A straight obstacle from `from` to `to`; the hatching shows on its left.
struct Plate {
  Point from, to;
};

/// An arrow at `point`, of length and direction `vector`.
struct ForceArrow {
  Point point, vector;
};

/// One number per segment, drawn on the membranes.
struct SegmentField {
  Quantity quantity;
  std::vector<double> values;
};

struct FrameStyle {
  UnitScales scales;  ///< for the scale bar and the time label
  int width = 1000;   ///< pixels, of render_frame
  int height = 1000;
  std::optional<CellField> field;  ///< that colours the cells; unset: the shape parameter p^2/(4 pi a)
  std::optional<SegmentField> segment_field;  ///< colours the membranes instead, over pale cells
  std::optional<double> field_minimum, field_maximum;  ///< of the colour bar; unset: from the data
  bool coloured = true;                                ///< false: all cells in one colour, no colour bar
  std::optional<double> membrane_width;                ///< s; unset: the mean initial rest length
  std::optional<View> view;                            ///< unset: the whole tissue
  double time_origin = 0.0;                            ///< time that the label calls zero
  std::vector<Point> wound_outline;                    ///< shaded when given
  std::optional<double> wound_fraction;                ///< of its maximum, for the label
  std::string caption;                                 ///< replaces the time label when not empty
  std::vector<std::vector<Point>> ghosts;              ///< closed outlines drawn dashed, e.g. the shape before loading
  std::vector<Plate> plates;
  std::vector<ForceArrow> forces;
};

/// Draws one frame of style.width x style.height pixels (SVG, PDF: points). Throws InputError for an unknown ending,
/// an empty tissue or a field of the wrong length, FileError when the file cannot be written.
void render_frame(const TissueState& state, const FrameStyle& style, const std::filesystem::path& path);

/// A picture in memory: rows from the top, each pixel the bytes blue, green, red, unused.
struct Pixels {
  int width = 0, height = 0;
  std::vector<unsigned char> bytes;
};

/// The same picture as render_frame. Throws InputError as it does.
Pixels render_pixels(const TissueState& state, const FrameStyle& style);

struct StripPanel {
  TissueState state;
  FrameStyle style;
};

/// Draws panels a, b, c ... of panel_size pixels each, with one view, one colour bar and one scale bar for all (each
/// from its style where given, else wide enough for every panel). Scales, field label and membrane width are those of
/// the first panel. Throws as render_frame.
void render_strip(std::span<const StripPanel> panels, int panel_size, const std::filesystem::path& path);

/// The course of a one-cell experiment (Ton et al. 2023, Fig. 2c and Fig. S5): each state over the dashed outline of
/// the first, captioned with its time and shape parameter. Plates and forces may differ from panel to panel.
void render_cell_experiment(std::span<const StripPanel> panels, int panel_size, const std::filesystem::path& path);

/// Shape parameter p^2/(4 pi a) of every cell, as a field.
CellField shape_parameter_field(const TissueState& state);

}  // namespace suture
