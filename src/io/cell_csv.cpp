#include "suture/io/cell_csv.hpp"

#include <fmt/format.h>

#include <iterator>

#include "io/atomic_file.hpp"

namespace suture {

std::string to_csv(std::span<const CellSample> samples, const UnitScales& scales) {
  std::string text = "time,time_min,shape_parameter,area,area_um2,perimeter,perimeter_um,energy,shortest_segment\n";
  for (const CellSample& sample : samples)
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{}\n", sample.time,
                   sample.time * scales.time_min(), sample.shape_parameter, sample.area,
                   sample.area * scales.factor(Dimension::area), sample.perimeter,
                   sample.perimeter * scales.length_um(), sample.energy, sample.shortest_segment);
  return text;
}

void write_cell_csv(std::span<const CellSample> samples, const UnitScales& scales, const std::filesystem::path& path) {
  write_file_atomically(path, to_csv(samples, scales));
}

}  // namespace suture
