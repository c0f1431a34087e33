// When a run is to end before it is done: a signal, or the wall time is up.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace suture {

/// While it lives, SIGINT, SIGTERM and SIGUSR1 ask for an orderly stop; a second SIGINT ends the program at once. The
/// others may come repeatedly (batch systems send them so). A full disk becomes an error of the write, not SIGXFSZ.
class StopRequest {
 public:
  /// max_wall: seconds from now; empty: no limit.
  explicit StopRequest(std::optional<double> max_wall);
  bool requested() const;

 private:
  std::optional<std::chrono::steady_clock::time_point> deadline_;
};

/// Seconds: "90", "90s", "1.5 h", "30min", "2d", "HH:MM:SS" or "D-HH:MM:SS" (Slurm). Throws InputError naming `option`.
double parse_wall_time(const std::string& text, const std::string& option);

}  // namespace suture
