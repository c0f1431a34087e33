// Pictures of a finished run: stills, a movie, a strip; one view and one colour bar for all of them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "suture/render/frame.hpp"
#include "suture/replay/replay.hpp"

namespace suture {

struct PictureRequest {
  std::string field = "shape_parameter";  ///< of cells or segments
  std::vector<int> frames;                ///< at least one
  int size = 1000;                        ///< pixels: width and height of a still, height of a movie
  /// Ends of the colour bar, physical units. Unset: from all frames; of segment fields, without the outermost 1 %.
  std::optional<std::pair<double, double>> range;
};

class RunPictures {
 public:
  /// Throws InputError for an unknown field or a range that is no range. `replay` must outlive this.
  RunPictures(const Replay& replay, PictureRequest request);

  /// DIR/frame_0007.png ... in each format ("png", "svg", "pdf"). Returns how many files were written.
  int write_stills(const std::filesystem::path& directory, const std::vector<std::string>& formats) const;
  /// Throws InputError when ffmpeg is missing, FileError.
  void write_movie(const std::filesystem::path& path, int frames_per_second) const;
  /// At most `panels` of the frames, evenly spread, first and last included.
  void write_strip(const std::filesystem::path& path, int panels) const;

 private:
  FrameStyle style(const ReplayFrame& frame) const;

  const Replay& replay_;
  PictureRequest request_;
  View view_;
  double minimum_ = 0.0, maximum_ = 1.0;
};

}  // namespace suture
