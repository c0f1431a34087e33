#include "suture/replay/choose_frames.hpp"

#include <fmt/format.h>

#include <charconv>
#include <set>
#include <string_view>

#include "suture/errors.hpp"

namespace suture {
namespace {

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t start = 0;; ) {
    const std::size_t end = text.find(separator, start);
    parts.push_back(text.substr(start, end - start));
    if (end == std::string_view::npos) return parts;
    start = end + 1;
  }
}

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw InputError(fmt::format("--frames '{}': {}; allowed: all, last, numbers and ranges first:last[:step], such as "
                               "0,10,20 or 0:100:5",
                               text, why));
}

int number(std::string_view part, const std::string& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
  if (error != std::errc{} || end != part.data() + part.size()) refuse(text, fmt::format("'{}' is no number", part));
  return value;
}

int frame_number(std::string_view part, const std::string& text, int count) {
  const int value = number(part, text);
  if (value < -count || value >= count)
    refuse(text, fmt::format("there is no frame {}, the run has the frames 0 to {}", value, count - 1));
  return value < 0 ? value + count : value;
}

}  // namespace

std::vector<int> choose_frames(const std::string& text, int count) {
  std::set<int> chosen;
  for (const std::string_view part : split(text, ',')) {
    const std::vector<std::string_view> range = split(part, ':');
    if (range.size() > 3) refuse(text, fmt::format("'{}' is no range", part));
    if (part == "all" || part == "last") {
      for (int i = part == "all" ? 0 : count - 1; i < count; ++i) chosen.insert(i);
      continue;
    }
    const int first = frame_number(range.front(), text, count);
    const int last = range.size() > 1 ? frame_number(range[1], text, count) : first;
    const int step = range.size() > 2 ? number(range[2], text) : 1;
    if (step < 1 || last < first) refuse(text, fmt::format("'{}' does not run upwards", part));
    for (int i = first; i <= last; i += step) chosen.insert(i);
  }
  return {chosen.begin(), chosen.end()};
}

}  // namespace suture
