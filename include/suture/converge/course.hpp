// One integration, reduced to what the errors of a method are measured on: samples of positions, area and shape in time.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "suture/integrate/integrator.hpp"
#include "suture/model/parameters.hpp"
#include "suture/model/state.hpp"
#include "suture/setup/progress.hpp"

namespace suture {

/// Samples of one integration, every output.interval from its start. Of a closure: wound area and mean shape of the
/// wound-adjacent cells; of a one-cell experiment: the cell's area and shape.
struct Course {
  std::vector<double> time;                      ///< since the start
  std::vector<std::vector<double>> positions;    ///< x, then y of the cell vertices (not of the purse string)
  std::vector<double> area;                      ///< units of a0
  std::vector<std::optional<double>> shape;
  std::optional<double> t_05;                    ///< closures only
  Statistics statistics;
  double wall_s = 0.0;  ///< of the integration with its sampling
  double cpu_s = 0.0;
  std::string failure;  ///< why it ended early; empty if it did not
  bool stopped = false;
};

/// Runs config.run.protocol: the closure of `start`, or the one-cell experiment, which makes its own start. A numerical
/// failure is reported in the course. `stop` is asked after every sample.
Course run_course(const Config& config, const TissueState& start, const Progress& progress,
                  const std::function<bool()>& stop);

/// How far a course is from a reference. Positions in the unit given (l0); the largest over the samples compared.
struct CourseErrors {
  double position = 0.0;      ///< largest over time of the root mean square over all coordinates
  double position_max = 0.0;  ///< largest displacement of any vertex at any sample
  double area = 0.0;          ///< largest difference, units of a0
  std::optional<double> shape;
  std::optional<double> t_05;  ///< of the whole courses; empty unless both have one
  double until = 0.0;          ///< last sample compared
  std::optional<double> diverged_at;  ///< first sample of all at which the root mean square exceeds the threshold
};

/// The difference of two courses at one common sample; positions in the unit given.
struct SampleDifference {
  double time = 0.0, position = 0.0, position_max = 0.0, area = 0.0;
  std::optional<double> shape;
};
std::vector<SampleDifference> differences(const Course& course, const Course& reference, double unit);

/// `until`: samples later than this are not compared (infinity: all that both have). `threshold`: units of `unit`.
/// Throws InputError when the courses have no sample in common.
CourseErrors compare(const Course& course, const Course& reference, double unit, double until, double threshold);

}  // namespace suture
