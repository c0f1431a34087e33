// How a long stage tells the outside how far it is.
#pragma once

#include <functional>
#include <string_view>

namespace suture {

/// stage: "packing", "anneal", ...; fraction: of that stage done, 0 to 1; text: one line for a person.
using Progress = std::function<void(std::string_view stage, double fraction, std::string_view text)>;

inline void report_progress(const Progress& progress, std::string_view stage, double fraction, std::string_view text) {
  if (progress) progress(stage, fraction, text);
}

}  // namespace suture
