#include "suture/render/run_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "suture/errors.hpp"
#include "suture/render/movie.hpp"
#include "suture/replay/colour_range.hpp"

namespace suture {
namespace {

const Field& drawable_field(const ReplayFrame& frame, const std::string& name) {
  const Field& field = frame.field(name);
  if (field.place != Place::cell && field.place != Place::segment)
    throw InputError(fmt::format("the field '{}' belongs to neither cells nor segments and cannot be drawn", name));
  return field;
}

struct Box {
  Point low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};
  void include(const TissueState& state) {
    const StateView view = state.view();
    for (std::size_t i = 0; i < view.x.size(); ++i) {
      low = {std::min(low.x, view.x[i]), std::min(low.y, view.y[i])};
      high = {std::max(high.x, view.x[i]), std::max(high.y, view.y[i])};
    }
  }
};

}  // namespace

RunPictures::RunPictures(const Replay& replay, PictureRequest request) : replay_(replay), request_(std::move(request)) {
  if (request_.frames.empty()) throw InputError("no frame is chosen");
  Box box;
  std::vector<double> values;
  Place place = Place::cell;
  for (const int index : request_.frames) {
    const ReplayFrame frame = replay.frame(index);
    const Field& field = drawable_field(frame, request_.field);
    const std::vector<double> physical = in_physical_units(field, replay.scales());
    values.insert(values.end(), physical.begin(), physical.end());
    place = field.place;
    box.include(frame.state);
  }
  const auto range = request_.range ? *request_.range : colour_range(std::move(values), place);
  minimum_ = range.first, maximum_ = range.second;
  if (!(minimum_ < maximum_)) throw InputError(fmt::format("the colour range {} to {} is empty", minimum_, maximum_));
  view_ = {.centre = 0.5 * (box.low + box.high),
           .half_width = 0.5 * std::max(box.high.x - box.low.x, box.high.y - box.low.y) +
                         replay.membrane().contact_distance};
}

FrameStyle RunPictures::style(const ReplayFrame& frame) const {
  const Field& field = drawable_field(frame, request_.field);
  // The label already holds the unit.
  const Quantity quantity{field.quantity.name, "1", label_in_physical_units(field)};
  FrameStyle style{.scales = replay_.scales(), .width = request_.size, .height = request_.size};
  if (field.place == Place::segment)
    style.segment_field = SegmentField{quantity, in_physical_units(field, replay_.scales())};
  else
    style.field = CellField{quantity, in_physical_units(field, replay_.scales())};
  style.field_minimum = minimum_, style.field_maximum = maximum_;
  style.membrane_width = replay_.membrane().contact_distance;
  style.view = view_;
  style.time_origin = replay_.time_origin();
  style.wound_outline = frame.wound_outline;
  style.wound_fraction = replay_.wound_fraction(frame.state.time);
  return style;
}

int RunPictures::write_stills(const std::filesystem::path& directory, const std::vector<std::string>& formats) const {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) throw FileError(fmt::format("{}: {}", directory.string(), error.message()));
  int files = 0;
  for (const int index : request_.frames) {
    const ReplayFrame frame = replay_.frame(index);
    for (const std::string& format : formats) {
      render_frame(frame.state, style(frame), directory / fmt::format("frame_{:04}.{}", index, format));
      ++files;
    }
  }
  return files;
}

void RunPictures::write_movie(const std::filesystem::path& path, int frames_per_second) const {
  const int even = request_.size - request_.size % 2;  // as video codecs want it
  Movie movie(path, even, even, frames_per_second);
  for (const int index : request_.frames) {
    const ReplayFrame frame = replay_.frame(index);
    FrameStyle even_style = style(frame);
    even_style.width = even_style.height = even;
    movie.add(render_pixels(frame.state, even_style));
  }
  movie.finish();
}

void RunPictures::write_strip(const std::filesystem::path& path, int panels) const {
  const int count = std::min(panels, static_cast<int>(request_.frames.size()));
  if (count < 1) throw InputError(fmt::format("a strip of {} panels", panels));
  std::vector<StripPanel> strip;
  for (int k = 0; k < count; ++k) {
    const std::size_t place = count == 1 ? 0 : (request_.frames.size() - 1) * k / (count - 1);
    const ReplayFrame frame = replay_.frame(request_.frames[place]);
    strip.push_back({frame.state, style(frame)});
  }
  render_strip(strip, request_.size, path);
}

}  // namespace suture
