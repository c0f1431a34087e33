// Measurements, a table for people and JSON for programs.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace suture::benchmark {

/// What is measured, and how thoroughly.
struct Settings {
  int repeats = 5;             ///< medians are taken over so many
  bool long_runs = false;      ///< full horizons and largest tissues
  bool smoke = false;          ///< everything once, on the smallest problems
  std::vector<std::string> groups;  ///< empty: all
  bool wants(const std::string& group) const;
};

/// One line of the result: parameters such as n_v, then values such as seconds or ns_per_vertex, in the order given.
struct Measurement {
  std::string group, name;
  std::vector<std::pair<std::string, double>> parameters, values;
};

/// Median and fastest CPU time of `repeats` calls. CPU time, because the machine may be shared.
struct Timing {
  double median = 0.0, fastest = 0.0;
};
Timing time_calls(int repeats, const std::function<void()>& call);
/// The same per iteration of a body short enough to be repeated until at least 20 ms have passed.
Timing time_body(int repeats, const std::function<void()>& body);

class Report {
 public:
  /// Adds and prints.
  void add(Measurement measurement);
  /// Measurements and provenance: CPU, instruction set, compiler, commit, load.
  std::string json(const std::string& command_line) const;

 private:
  std::vector<Measurement> measurements_;
};

}  // namespace suture::benchmark
