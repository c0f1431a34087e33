// wound.csv: the wound against time, one row per sample.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "suture/io/units.hpp"

namespace suture {

/// Model units. What could not be measured (no wound, no adjacent cell) stays empty and leaves an empty field.
struct WoundSample {
  double time = 0.0;  ///< since the purse string started
  std::optional<double> wound_area;
  std::optional<double> mean_shape;  ///< of the wound-adjacent cells
  std::optional<double> perimeter;
  int ring_size = 0;              ///< purse-string vertices
  int parts = 0;                  ///< pieces the wound consists of
  double shortest_segment = 0.0;  ///< smallest l0/l0(0)
  std::optional<double> energy;    ///< at the times of stored frames only
};

/// CSV text with one header line; numbers are the shortest that read back to the same double. wound_area_fraction is
/// relative to the largest area among the samples.
std::string to_csv(std::span<const WoundSample> samples, const UnitScales& scales);

/// Writes the file so that either the old or the new one is there, whole. Throws FileError.
void write_wound_csv(std::span<const WoundSample> samples, const UnitScales& scales, const std::filesystem::path& path);

/// The columns of a wound.csv that a time series consists of, each as long as the file has rows; NaN where a field is empty.
struct WoundColumns {
  std::vector<double> time, wound_area, mean_shape;
};

/// Throws InputError when the file is not a whole wound.csv.
WoundColumns read_wound_csv(const std::filesystem::path& path);

}  // namespace suture
