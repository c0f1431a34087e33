// cell.csv: one cell against time, one row per sample (model.md section 8).
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "suture/io/units.hpp"

namespace suture {

/// Model units.
struct CellSample {
  double time = 0.0;             ///< since the start
  double shape_parameter = 0.0;  ///< A = p^2/(4 pi a)
  double area = 0.0;
  double perimeter = 0.0;
  double energy = 0.0;            ///< of the cell, without the load
  double shortest_segment = 0.0;  ///< smallest length l/l0(0)
};

/// CSV text with one header line; numbers are the shortest that read back to the same double.
std::string to_csv(std::span<const CellSample> samples, const UnitScales& scales);

/// Writes the file so that either the old or the new one is there, whole. Throws FileError.
void write_cell_csv(std::span<const CellSample> samples, const UnitScales& scales, const std::filesystem::path& path);

}  // namespace suture
