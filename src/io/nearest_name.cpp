#include "suture/io/nearest_name.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace suture {

namespace {

std::string_view last_part(std::string_view name) { return name.substr(name.find_last_of('.') + 1); }

// A misspelling changes about a third of a word at most.
int largest_misspelling(std::string_view name) { return std::max(1, static_cast<int>(name.size()) / 3); }

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  const std::size_t columns = b.size() + 1;
  std::vector<int> before_last(columns), last(columns), current(columns);
  for (std::size_t j = 0; j < columns; ++j) current[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before_last, last);
    std::swap(last, current);
    current[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int substitution = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({last[j] + 1, current[j - 1] + 1, substitution});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        current[j] = std::min(current[j], before_last[j - 2] + 1);
    }
  }
  return current.back();
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  std::string nearest;
  int smallest = 1000;
  const auto consider = [&](const std::string& candidate, int distance, int limit) {
    if (distance <= limit && distance < smallest) {
      smallest = distance;
      nearest = candidate;
    }
  };
  for (const std::string& candidate : candidates) {
    consider(candidate, edit_distance(name, candidate), largest_misspelling(name));
    const std::string_view part = last_part(name);
    // One more for the wrong section, so that a slip inside the right section is preferred.
    if (part != name || last_part(candidate) != candidate)
      consider(candidate, edit_distance(part, last_part(candidate)) + 1, largest_misspelling(part) + 1);
  }
  return nearest;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& candidates) {
  const std::string nearest = nearest_name(name, candidates);
  return nearest.empty() ? "" : fmt::format(", did you mean '{}'?", nearest);
}

}  // namespace suture
