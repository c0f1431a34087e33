#include "report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "kernels/kernels.hpp"
#include "suture/io/provenance.hpp"
#include "suture/version.hpp"

namespace suture::benchmark {

namespace {

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::string cpu_model() {
  std::ifstream stream("/proc/cpuinfo");
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

std::string pairs(const std::vector<std::pair<std::string, double>>& list) {
  std::string text;
  for (const auto& [name, value] : list) text += fmt::format("  {} {:.6g}", name, value);
  return text;
}

}  // namespace

bool Settings::wants(const std::string& group) const {
  return groups.empty() || std::find(groups.begin(), groups.end(), group) != groups.end();
}

Timing time_calls(int repeats, const std::function<void()>& call) {
  std::vector<double> seconds;
  for (int k = 0; k < repeats; ++k) {
    const double start = cpu_seconds();
    call();
    seconds.push_back(cpu_seconds() - start);
  }
  std::sort(seconds.begin(), seconds.end());
  return {0.5 * (seconds[(seconds.size() - 1) / 2] + seconds[seconds.size() / 2]), seconds.front()};
}

Timing time_body(int repeats, const std::function<void()>& body) {
  constexpr double shortest = 0.02;
  int count = 1;
  for (double spent = 0.0; spent < shortest; count *= 2) {
    spent = time_calls(1, [&] {
              for (int k = 0; k < count; ++k) body();
            }).median;
    if (spent >= shortest) break;
  }
  const Timing total = time_calls(repeats, [&] {
    for (int k = 0; k < count; ++k) body();
  });
  return {total.median / count, total.fastest / count};
}

void Report::add(Measurement measurement) {
  fmt::print("{:<12} {:<24}{} |{}\n", measurement.group, measurement.name, pairs(measurement.parameters), pairs(measurement.values));
  std::fflush(stdout);
  measurements_.push_back(std::move(measurement));
}

std::string Report::json(const std::string& command_line) const {
  using Json = nlohmann::ordered_json;
  const BuildInformation& build = build_information();
  double load[3] = {-1.0, -1.0, -1.0};
  getloadavg(load, 3);
  Json list = Json::array();
  for (const Measurement& m : measurements_) {
    Json item{{"group", m.group}, {"name", m.name}};
    for (const auto& [name, value] : m.parameters) item["parameters"][name] = value;
    for (const auto& [name, value] : m.values) item["values"][name] = value;
    list.push_back(item);
  }
  const Json json{{"command_line", command_line},
                  {"written", utc_now()},
                  {"cpu", cpu_model()},
                  {"processors", std::thread::hardware_concurrency()},
                  {"load_average", load[0]},
                  {"instruction_set", kernels::best().name},
                  {"compiler", build.compiler},
                  {"flags", build.flags},
                  {"libraries", build.libraries},
                  {"version", build.version},
                  {"commit", build.commit},
                  {"uncommitted_changes", build.dirty},
                  {"times", "seconds are CPU seconds; values named seconds are medians, fastest_s minima"},
                  {"measurements", list}};
  return json.dump(2) + "\n";
}

}  // namespace suture::benchmark
