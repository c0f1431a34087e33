#include "view/viewer_data.hpp"

#include <algorithm>
#include <cmath>

#include "suture/render/colour_map.hpp"
#include "suture/replay/colour_range.hpp"
#include "view/viewer_curves.hpp"

namespace suture {
namespace {

using nlohmann::json;
using Integers = std::vector<std::int32_t>;

// Positions are stored in this part of the extent of the tissue: a tenth of a pixel on a large screen.
constexpr double position_steps = 8192.0;
constexpr double cell_field_steps = 65535.0, segment_field_steps = 255.0;
constexpr const char* shown_fields[] = {"shape_parameter", "area_strain",      "area",
                                        "perimeter",       "contacts",         "membrane_tension",
                                        "rest_length_strain"};

std::int32_t step_number(double value, double low, double step) {
  return static_cast<std::int32_t>(std::lround((value - low) / step));
}

struct Extent {
  double low_x = INFINITY, low_y = INFINITY, high_x = -INFINITY, high_y = -INFINITY;
  double size() const { return std::max(high_x - low_x, high_y - low_y); }
};

Extent extent_of(const Replay& replay, const std::vector<int>& indices) {
  Extent extent;
  for (const int index : indices) {
    const TissueState state = replay.state(index);
    const StateView view = state.view();
    for (std::size_t i = 0; i < view.x.size(); ++i) {
      extent.low_x = std::min(extent.low_x, view.x[i]), extent.high_x = std::max(extent.high_x, view.x[i]);
      extent.low_y = std::min(extent.low_y, view.y[i]), extent.high_y = std::max(extent.high_y, view.y[i]);
    }
  }
  return extent;
}

// Cell vertices frame after frame; the purse string as offsets from the vertices it is tethered to; the wound as steps
// along its outline.
class Geometry {
 public:
  Geometry(const Extent& extent, double step) : extent_(extent), step_(step) {}

  void add(const ReplayFrame& frame) {
    const StateView view = frame.state.view();
    vertices_ = frame.state.tissue.vertex_count();
    for (int v = 0; v < vertices_; ++v) x_.push_back(grid_x(view.x[v])), y_.push_back(grid_y(view.y[v]));
    const PurseString& ring = frame.state.purse_string;
    ring_count_.push_back(ring.size());
    for (int j = 0; j < ring.size(); ++j) {
      const int v = ring.vertex[j];
      ring_vertex_.push_back(v);
      ring_x_.push_back(grid_x(view.x[vertices_ + j]) - grid_x(view.x[v]));
      ring_y_.push_back(grid_y(view.y[vertices_ + j]) - grid_y(view.y[v]));
    }
    wound_count_.push_back(static_cast<int>(frame.wound_outline.size()));
    for (const Point& point : frame.wound_outline) {
      wound_x_.push_back(grid_x(point.x));
      wound_y_.push_back(grid_y(point.y));
    }
  }

  void pack(PackedNumbers& numbers) const {
    numbers.add("x", x_, vertices_), numbers.add("y", y_, vertices_);
    numbers.add("ring_count", ring_count_, 1), numbers.add("ring_vertex", ring_vertex_, 1);
    numbers.add("ring_x", ring_x_, 1), numbers.add("ring_y", ring_y_, 1);
    numbers.add("wound_count", wound_count_, 1);
    numbers.add("wound_x", wound_x_, 1), numbers.add("wound_y", wound_y_, 1);
  }

 private:
  std::int32_t grid_x(double value) const { return step_number(value, extent_.low_x, step_); }
  std::int32_t grid_y(double value) const { return step_number(value, extent_.low_y, step_); }

  Extent extent_;
  double step_;
  int vertices_ = 0;
  Integers x_, y_, ring_count_, ring_vertex_, ring_x_, ring_y_, wound_count_, wound_x_, wound_y_;
};

// The values of one field in all frames, physical units.
struct FieldSeries {
  const char* name;
  Field first;
  std::vector<double> values;
};

void append(FieldSeries& series, const ReplayFrame& frame, const UnitScales& scales) {
  const Field& field = frame.field(series.name);
  if (series.values.empty()) series.first = field;
  const std::vector<double> physical = in_physical_units(field, scales);
  series.values.insert(series.values.end(), physical.begin(), physical.end());
}

// As step numbers between `low` and `high`; what lies outside is taken at the nearer end.
json pack_field(const FieldSeries& series, PackedNumbers& numbers) {
  const bool of_cells = series.first.place == Place::cell;
  const auto [low, high] = colour_range(series.values, series.first.place);
  const double step = (high - low) / (of_cells ? cell_field_steps : segment_field_steps);
  Integers steps;
  for (const double value : series.values)
    steps.push_back(step_number(std::clamp(std::isfinite(value) ? value : low, low, high), low, step));
  numbers.add(series.name, steps, series.first.values.size());
  return {{"name", series.name},
          {"label", label_in_physical_units(series.first)},
          {"description", series.first.quantity.description},
          {"unit", base_unit(series.first.dimension)},
          {"place", of_cells ? "cell" : "segment"},
          {"low", low},
          {"high", high},
          {"step", step}};
}

json colour_table() {
  json colours = json::array();
  for (int i = 0; i < 256; ++i) {
    const Colour c = colour_at(i / 255.0);
    for (const double part : {c.red, c.green, c.blue}) colours.push_back(std::lround(255.0 * part));
  }
  return colours;
}

}  // namespace

ViewerData viewer_data(const Replay& replay, const std::vector<int>& indices) {
  const Extent extent = extent_of(replay, indices);
  const double step = extent.size() / position_steps, um = replay.scales().length_um();
  const Tissue& tissue = replay.trajectory().tissue;
  Geometry geometry(extent, step);
  std::vector<FieldSeries> series;
  for (const char* name : shown_fields) series.push_back({name, {}, {}});
  json fields = json::array(), times = json::array(), first_vertex = json::array();
  for (const int index : indices) {
    const ReplayFrame frame = replay.frame(index);
    geometry.add(frame);
    for (FieldSeries& one : series) append(one, frame, replay.scales());
    times.push_back(minutes(replay, frame.state.time));
  }
  ViewerData data;
  geometry.pack(data.numbers);
  for (const FieldSeries& one : series) fields.push_back(pack_field(one, data.numbers));
  for (int cell = 0; cell < tissue.cell_count(); ++cell) first_vertex.push_back(tissue.first_vertex(cell));
  first_vertex.push_back(tissue.vertex_count());
  data.description = {{"first_vertex", first_vertex},
                      {"times", times},
                      {"step_um", step * um},
                      {"width_um", (extent.high_x - extent.low_x) * um},
                      {"height_um", (extent.high_y - extent.low_y) * um},
                      {"membrane_um", replay.membrane().contact_distance * um},
                      {"time_unit_min", replay.scales().time_min()},
                      {"fields", fields},
                      {"colours", colour_table()}};
  add_run_story(replay, data.description);
  data.description["sections"] = data.numbers.index();
  return data;
}

}  // namespace suture
