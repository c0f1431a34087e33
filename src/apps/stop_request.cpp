#include "stop_request.hpp"

#include <fmt/format.h>

#include <charconv>
#include <csignal>
#include <cstdlib>
#include <string_view>

#include "suture/errors.hpp"

namespace suture {

namespace {

volatile std::sig_atomic_t stop_requested = 0;
volatile std::sig_atomic_t interrupts = 0;

extern "C" void on_signal(int signal) {
  if (signal == SIGINT && interrupts != 0) std::_Exit(128 + signal);
  if (signal == SIGINT) interrupts = 1;
  stop_requested = 1;
}

std::optional<double> number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value >= 0.0 && value < 1e10)) return std::nullopt;
  return value;
}

/// "HH:MM:SS" or "D-HH:MM:SS".
std::optional<double> clock_time(std::string_view text) {
  double days = 0.0;
  if (const auto dash = text.find('-'); dash != std::string_view::npos) {
    const std::optional<double> given = number(text.substr(0, dash));
    if (!given) return std::nullopt;
    days = *given;
    text.remove_prefix(dash + 1);
  }
  double seconds = 0.0;
  for (int part = 0; part < 3; ++part) {
    const auto colon = part < 2 ? text.find(':') : text.size();
    if (colon == std::string_view::npos) return std::nullopt;
    const std::optional<double> given = number(text.substr(0, colon));
    if (!given) return std::nullopt;
    seconds = 60.0 * seconds + *given;
    text.remove_prefix(std::min(colon + 1, text.size()));
  }
  return 86400.0 * days + seconds;
}

std::optional<double> with_unit(std::string_view text) {
  const auto last_digit = text.find_last_of("0123456789.");
  if (last_digit == std::string_view::npos) return std::nullopt;
  const std::optional<double> value = number(text.substr(0, last_digit + 1));
  std::string_view unit = text.substr(last_digit + 1);
  unit.remove_prefix(std::min(unit.find_first_not_of(' '), unit.size()));
  if (!value) return std::nullopt;
  if (unit.empty() || unit == "s") return value;
  if (unit == "min") return 60.0 * *value;
  if (unit == "h") return 3600.0 * *value;
  if (unit == "d") return 86400.0 * *value;
  return std::nullopt;
}

}  // namespace

StopRequest::StopRequest(std::optional<double> max_wall) {
  if (max_wall) deadline_ = std::chrono::steady_clock::now() + std::chrono::milliseconds(static_cast<long long>(1e3 * *max_wall));
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) {
    struct sigaction action {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    sigaction(signal, &action, nullptr);
  }
  std::signal(SIGXFSZ, SIG_IGN);
}

bool StopRequest::requested() const {
  return stop_requested != 0 || (deadline_ && std::chrono::steady_clock::now() >= *deadline_);
}

double parse_wall_time(const std::string& text, const std::string& option) {
  const std::optional<double> seconds = text.find(':') != std::string::npos ? clock_time(text) : with_unit(text);
  if (!seconds)
    throw InputError(fmt::format("command line: {}: found '{}', allowed a time such as 90s, 30min, 2h, 1d or 23:30:00", option, text));
  return *seconds;
}

}  // namespace suture
