// Progress of a long command: one line that rewrites itself on a terminal, plain lines now and then in a log.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace suture {

class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  /// fraction: of `stage` done, 0 to 1.
  void update(std::string_view stage, double fraction, std::string_view text);

 private:
  using Clock = std::chrono::steady_clock;
  std::string remaining(double fraction) const;

  bool terminal_;
  std::string stage_;
  double first_fraction_ = 0.0;  ///< of the stage, when it was first heard of
  Clock::time_point stage_start_, last_shown_;
  bool open_line_ = false;
};

}  // namespace suture
