// A run for ParaView and VisIt: time series of the cells, the segments, the purse string and the wound.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "suture/replay/replay.hpp"

namespace suture {

enum class ExportUnits {
  model,    ///< as in run.h5
  physical  ///< um, min, nN; the names of fields with a unit end in it (area_um2)
};

struct ExportRequest {
  std::vector<int> frames;  ///< of the replay, ascending, at least one
  ExportUnits units = ExportUnits::model;
};

/// Writes DIR/<series>.xdmf for the series cells, segments, purse_string and wound, as far as the run has them, and
/// DIR/data.h5, which they refer to. Returns the .xdmf files. Throws InputError, FileError.
std::vector<std::filesystem::path> export_xdmf(const Replay& replay, const ExportRequest& request,
                                               const std::filesystem::path& directory);

/// Writes DIR/<series>/<series>_<frame>.vtp, and DIR/<series>.pvd (ParaView) and DIR/<series>.visit (VisIt), which list
/// them. Returns the .pvd files. Throws InputError, FileError.
std::vector<std::filesystem::path> export_vtp(const Replay& replay, const ExportRequest& request,
                                              const std::filesystem::path& directory);

}  // namespace suture
