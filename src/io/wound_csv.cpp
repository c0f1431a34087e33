#include "suture/io/wound_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <limits>
#include <string_view>

#include "io/atomic_file.hpp"
#include "suture/errors.hpp"

namespace suture {
namespace {

constexpr const char* header =
    "time,time_min,wound_area,wound_area_um2,wound_area_fraction,mean_shape,perimeter,perimeter_um,ring_size,parts,"
    "shortest_segment,energy\n";

std::string field(const std::optional<double>& value, double scale = 1.0) {
  return value ? fmt::format("{}", *value * scale) : std::string();
}

/// The fields of one line up to its end.
void split(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t comma = std::min(line.find(',', at), line.size());
    fields.push_back(line.substr(at, comma - at));
    at = comma + 1;
  }
}

double value_of(std::string_view field, const std::filesystem::path& path, std::size_t row) {
  if (field.empty()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || end != field.data() + field.size())
    throw InputError(fmt::format("{}:{}: found \"{}\", allowed a number", path.string(), row, field));
  return value;
}

}  // namespace

WoundColumns read_wound_csv(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string line;
  if (!std::getline(stream, line) || line + "\n" != header)
    throw InputError(fmt::format("{}: not a wound.csv of this version", path.string()));
  constexpr std::size_t time = 0, wound_area = 2, mean_shape = 5, columns = 12;
  WoundColumns result;
  std::vector<std::string_view> fields;
  for (std::size_t row = 2; std::getline(stream, line); ++row) {
    split(line, fields);
    if (fields.size() != columns)
      throw InputError(fmt::format("{}:{}: found {} fields, allowed {}", path.string(), row, fields.size(), columns));
    result.time.push_back(value_of(fields[time], path, row));
    result.wound_area.push_back(value_of(fields[wound_area], path, row));
    result.mean_shape.push_back(value_of(fields[mean_shape], path, row));
  }
  return result;
}

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
