#include "suture/replay/replay.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "replay/fields.hpp"
#include "suture/errors.hpp"
#include "suture/io/config.hpp"
#include "suture/io/nearest_name.hpp"
#include "suture/measure/wound.hpp"

namespace suture {
namespace {

FrameReader open_frames(const std::filesystem::path& path) {
  FrameReader frames(path);
  if (frames.count() == 0) throw InputError(fmt::format("{}: it holds no frame, so there is nothing to show", path.string()));
  return frames;
}

std::vector<double> frame_times(const FrameReader& frames) {
  const Trajectory& trajectory = frames.all_but_frames();
  std::vector<double> times;
  for (int i = 0; i < frames.count(); ++i) times.push_back(frames.time(i));
  const auto end = trajectory.stages.find(Stage::closure);
  // Sampling times are rounded, so an end state that merely repeats the last frame may differ from it in the last bits.
  if (end != trajectory.stages.end() && end->second.tissue.vertex_count() == trajectory.tissue.vertex_count() &&
      end->second.time > times.back() * (1.0 + 1e-9))
    times.push_back(end->second.time);
  return times;
}

}  // namespace

const Field* ReplayFrame::find(std::string_view name) const {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.quantity.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

const Field& ReplayFrame::field(std::string_view name) const {
  if (const Field* found = find(name)) return *found;
  std::vector<std::string> names;
  std::string list;
  for (const Field& known : fields) {
    if (known.place != Place::cell && known.place != Place::segment) continue;
    list += fmt::format("{}{}", names.empty() ? "" : ", ", known.quantity.name);
    names.push_back(known.quantity.name);
  }
  throw InputError(fmt::format("found the unknown field '{}', allowed one of {}{}", name, list,
                               suggestion(std::string(name), names)));
}

Replay::Replay(const std::filesystem::path& run)
    : frames_(open_frames(run)),
      config_(parse_config(trajectory().provenance.resolved_config, run.string() + ": provenance/resolved_config")),
      scales_(trajectory().provenance.units),
      membrane_(make_membrane(config_.contact, trajectory().tissue)),
      times_(frame_times(frames_)) {
  config_.contact.distance = membrane_.contact_distance;  // the terms expect it resolved
}

TissueState Replay::state(int index) const {
  return is_end_state(index) ? trajectory().stages.at(Stage::closure) : frames_.state(index);
}

std::optional<double> Replay::wound_fraction(double time) const {
  const Series* const area = trajectory().observable("wound_area");
  if (area == nullptr || area->time.empty()) return std::nullopt;
  const double largest = *std::max_element(area->value.begin(), area->value.end());
  if (!(largest > 0.0)) return std::nullopt;
  auto nearest = std::lower_bound(area->time.begin(), area->time.end(), time) - area->time.begin();
  const auto last = static_cast<std::ptrdiff_t>(area->time.size()) - 1;
  nearest = std::min(nearest, last);
  if (nearest > 0 && time - area->time[nearest - 1] < area->time[nearest] - time) --nearest;
  return area->value[nearest] / largest;
}

// The hole where the wound was last seen: another one may be larger by now.
std::vector<Point> Replay::outline_at_end(const TissueState& state) const {
  const std::vector<Point> last = frames_.extras(frames_.count() - 1).wound_outline;
  if (last.size() < 3) return {};
  FreeBoundary boundary(membrane_);
  boundary.evaluate(state.tissue, state.view());
  Wound previous;
  previous.outline = last;
  const std::optional<Wound> wound = find_wound(boundary, &previous);
  return wound ? wound->outline : std::vector<Point>{};
}

std::vector<Point> Replay::wound_outline(int index) const {
  return is_end_state(index) ? outline_at_end(state(index)) : frames_.extras(index).wound_outline;
}

ReplayFrame Replay::frame(int index) const {
  ReplayFrame frame{.state = state(index), .wound_outline = {}, .fields = {}};
  FrameExtras extras;
  if (is_end_state(index))
    frame.wound_outline = outline_at_end(frame.state);
  else
    extras = frames_.extras(index), frame.wound_outline = std::move(extras.wound_outline);
  frame.fields = compute_fields(frame.state, config_, membrane_, extras.cell_fields);
  return frame;
}

std::string label_in_physical_units(const Field& field) {
  std::string unit(base_unit(field.dimension));
  if (field.dimension == Dimension::length) unit = "\xc2\xb5m";
  if (field.dimension == Dimension::area) unit = "\xc2\xb5m\xc2\xb2";
  return unit.empty() ? field.quantity.description : fmt::format("{} ({})", field.quantity.description, unit);
}

std::vector<double> in_physical_units(const Field& field, const UnitScales& scales) {
  std::vector<double> values = field.values;
  for (double& value : values) value = scales.to_physical(value, field.dimension);
  return values;
}

}  // namespace suture
