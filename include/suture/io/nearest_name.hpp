// "Did you mean ...?"
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace suture {

/// Insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`, no letter being edited twice
/// (Damerau 1964; the restricted, optimal-string-alignment distance).
int edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to `name`, or "" if none is near enough to be a misspelling. For dotted names the part after
/// the dot counts on its own too, so that a right key in a wrong section is found.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

/// ", did you mean 'x'?" or "".
std::string suggestion(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace suture
