// A finished run, frame by frame, with every field that can be computed from it: what pictures, exports and the viewer
// show. All numbers are in model units; Field::dimension says how they become physical ones.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "suture/io/trajectory.hpp"
#include "suture/io/units.hpp"
#include "suture/measure/membrane.hpp"
#include "suture/model/parameters.hpp"

namespace suture {

/// What the values of a field belong to, one each. `spring`: from each purse-string vertex to the next.
enum class Place { cell, segment, vertex, ring, spring };

/// One number per cell, segment, ...
struct Field {
  Quantity quantity;
  Place place = Place::cell;
  Dimension dimension = Dimension::none;
  std::vector<double> values;
};

struct ReplayFrame {
  TissueState state;
  std::vector<Point> wound_outline;  ///< counter-clockwise; empty when there is no wound
  std::vector<Field> fields;

  /// nullptr when the frame has no such field.
  const Field* find(std::string_view name) const;
  const Field& field(std::string_view name) const;  ///< throws InputError, which lists the names
};

class Replay {
 public:
  /// Opens the file, whose frames are read one at a time as they are asked for; that may throw InputError later. Throws
  /// InputError when it is no readable run.h5 or holds no frame.
  explicit Replay(const std::filesystem::path& run);

  /// Everything in the file but the frames; `frames` is empty.
  const Trajectory& trajectory() const { return frames_.all_but_frames(); }
  const Config& config() const { return config_; }
  const UnitScales& scales() const { return scales_; }
  const Membrane& membrane() const { return membrane_; }

  /// The stored frames, and after them the state at the end of the closure where it is later than the last of them.
  int frame_count() const { return static_cast<int>(times_.size()); }
  /// Simulation times, increasing.
  std::span<const double> times() const { return times_; }
  /// Simulation time that counts as zero: of the first frame, which a closure writes when its purse string starts.
  double time_origin() const { return times_.front(); }

  /// Of the largest area of the run, at the sample nearest to `time`; empty when no wound was recorded.
  std::optional<double> wound_fraction(double time) const;

  TissueState state(int index) const;
  /// Counter-clockwise; empty when there is no wound.
  std::vector<Point> wound_outline(int index) const;
  /// Fields: of cells shape_parameter, area_strain, area, perimeter, contacts and whatever else is stored; of segments
  /// length, rest_length, rest_length_strain (l0/l0(0) - 1), membrane_tension (dU/dl); of vertices force_x, force_y and
  /// tether; with a purse string, of its vertices tether_length, tether_force, slipped and of its springs spring_length,
  /// spring_rest_length, spring_tension.
  ReplayFrame frame(int index) const;

 private:
  bool is_end_state(int index) const { return index >= frames_.count(); }
  std::vector<Point> outline_at_end(const TissueState& state) const;

  FrameReader frames_;
  Config config_;
  UnitScales scales_;
  Membrane membrane_;
  std::vector<double> times_;
};

/// "membrane tension (nN)": description and physical unit, for people.
std::string label_in_physical_units(const Field& field);
/// The values in the unit of the label.
std::vector<double> in_physical_units(const Field& field, const UnitScales& scales);

}  // namespace suture
