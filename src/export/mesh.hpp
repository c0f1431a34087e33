// One frame of one series as both formats need it.
#pragma once

#include <string>
#include <vector>

#include "suture/export/export.hpp"

namespace suture {

struct MeshArray {
  std::string name;
  int components = 1;          ///< 1, or 3 for vectors
  std::vector<double> values;  ///< row by row
};

struct Mesh {
  enum class Kind { polygons, lines };
  Kind kind = Kind::polygons;
  std::vector<Point> points;
  std::vector<int> connectivity;  ///< points of all elements, element after element
  std::vector<int> end;           ///< of each element in connectivity
  std::vector<MeshArray> point_data, element_data;
};

inline constexpr const char* series_names[] = {"cells", "segments", "purse_string", "wound"};

/// One mesh per series name. A frame without purse string or wound has a mesh without points.
std::vector<Mesh> make_meshes(const ReplayFrame& frame, const UnitScales& scales, ExportUnits units);

/// Which series have points in at least one of the frames.
std::vector<bool> series_present(const Replay& replay, const std::vector<int>& frames);

/// Since the time origin: model units, or minutes.
double export_time(const Replay& replay, int frame, ExportUnits units);

/// Creates it. Throws FileError.
void make_directory(const std::filesystem::path& directory);

}  // namespace suture
