#include "progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace suture {

ProgressLine::ProgressLine() : terminal_(isatty(STDERR_FILENO) != 0), last_shown_(Clock::now() - std::chrono::hours(1)) {}

ProgressLine::~ProgressLine() {
  if (open_line_) fmt::print(stderr, "\n");
}

std::string ProgressLine::remaining(double fraction) const {
  const double elapsed = std::chrono::duration<double>(Clock::now() - stage_start_).count();
  const double gained = fraction - first_fraction_;  // a resumed stage begins in the middle
  if (gained < 0.01 || elapsed < 0.5 || fraction >= 1.0) return "";
  const double left = elapsed * (1.0 - fraction) / gained;
  return left < 90.0 ? fmt::format(", about {:.0f} s left", left) : fmt::format(", about {:.0f} min left", left / 60.0);
}

void ProgressLine::update(std::string_view stage, double fraction, std::string_view text) {
  const bool new_stage = stage != stage_;
  const auto now = Clock::now();
  if (new_stage) stage_ = stage, stage_start_ = now, first_fraction_ = fraction;
  const auto interval = terminal_ ? std::chrono::milliseconds(200) : std::chrono::milliseconds(10000);
  if (!new_stage && fraction < 1.0 && now - last_shown_ < interval) return;
  last_shown_ = now;
  fraction = std::clamp(fraction, 0.0, 1.0);
  const std::string body = fmt::format("{:<9} {:5.1f} %  {}{}", stage, 100.0 * fraction, text, remaining(fraction));
  if (!terminal_) {
    fmt::print(stderr, "{}\n", body);
    return;
  }
  const int filled = static_cast<int>(20.0 * fraction);
  fmt::print(stderr, "\r\033[K[{}{}] {}", std::string(filled, '='), std::string(20 - filled, ' '), body);
  std::fflush(stderr);
  open_line_ = true;
}

}  // namespace suture
