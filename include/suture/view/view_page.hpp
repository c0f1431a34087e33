// One self-contained web page that plays a run: no network, no other files.
#pragma once

#include <cstddef>
#include <filesystem>

#include "suture/replay/replay.hpp"

namespace suture {

struct ViewRequest {
  std::string title;       ///< of the page
  int maximum_frames = 1000;  ///< of a longer run so many are taken, evenly spread
};

struct ViewPage {
  int frames = 0;  ///< that the page plays
  std::size_t bytes = 0;
};

/// Writes the page, whole or not at all. Throws InputError for fewer than one frame, FileError.
ViewPage write_view_page(const Replay& replay, const ViewRequest& request, const std::filesystem::path& path);

}  // namespace suture
