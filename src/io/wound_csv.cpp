#include "suture/io/wound_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "io/atomic_file.hpp"

namespace suture {
namespace {

constexpr const char* header =
    "time,time_min,wound_area,wound_area_um2,wound_area_fraction,mean_shape,perimeter,perimeter_um,ring_size,parts,"
    "shortest_segment,energy\n";

std::string field(const std::optional<double>& value, double scale = 1.0) {
  return value ? fmt::format("{}", *value * scale) : std::string();
}

}  // namespace

std::string to_csv(std::span<const WoundSample> samples, const UnitScales& scales) {
  double largest = 0.0;
  for (const WoundSample& sample : samples) largest = std::max(largest, sample.wound_area.value_or(0.0));
  std::string text = header;
  for (const WoundSample& sample : samples) {
    const std::optional<double> fraction =
        sample.wound_area && largest > 0.0 ? std::optional(*sample.wound_area / largest) : std::nullopt;
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{},{},{},{}\n", sample.time,
                   sample.time * scales.time_min(), field(sample.wound_area),
                   field(sample.wound_area, scales.factor(Dimension::area)), field(fraction), field(sample.mean_shape),
                   field(sample.perimeter), field(sample.perimeter, scales.length_um()), sample.ring_size, sample.parts,
                   sample.shortest_segment, field(sample.energy));
  }
  return text;
}

void write_wound_csv(std::span<const WoundSample> samples, const UnitScales& scales,
                     const std::filesystem::path& path) {
  write_file_atomically(path, to_csv(samples, scales));
}

}  // namespace suture
