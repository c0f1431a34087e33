#include "suture/converge/course.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>

#include "suture/errors.hpp"
#include "suture/measure/cell_shape.hpp"
#include "suture/measure/closure.hpp"
#include "suture/simulate/cell_experiment.hpp"
#include "suture/simulate/closure.hpp"

namespace suture {

namespace {

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

class Stopwatch {
 public:
  void read(Course& course) const {
    course.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count();
    course.cpu_s = cpu_seconds() - cpu_;
  }

 private:
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  double cpu_ = cpu_seconds();
};

std::vector<double> cell_positions(const TissueState& state) {
  const StateView view = state.view();
  const auto vertices = static_cast<std::size_t>(state.tissue.vertex_count());
  std::vector<double> positions(view.x.begin(), view.x.begin() + state.tissue.vertex_count());
  positions.insert(positions.end(), view.y.begin(), view.y.begin() + static_cast<std::ptrdiff_t>(vertices));
  return positions;
}

class CourseRecorder final : public ClosureObserver {
 public:
  CourseRecorder(const Config& config, const Progress& progress, const std::function<bool()>& stop, Course& course)
      : config_(config), progress_(progress), stop_(stop), course_(course) {}

  void sample(const ClosureSample& s) override {
    course_.time.push_back(s.time);
    course_.positions.push_back(cell_positions(s.state));
    course_.area.push_back(s.wound ? s.wound->area : 0.0);
    course_.shape.emplace_back();
    if (s.wound) {
      const std::vector<int> adjacent = adjacent_cells(s.state.tissue, s.state.view(), s.wound->outline);
      course_.shape.back() = mean_shape_parameter(cell_shapes(s.state.tissue, s.state.view()), adjacent);
    }
    course_.statistics = s.statistics;
    const double largest = *std::max_element(course_.area.begin(), course_.area.end());
    const double fraction = largest > 0.0 ? course_.area.back() / largest : 0.0;
    report_progress(progress_, "integrate", std::max(1.0 - fraction, s.time / config_.run.end_time),
                    fmt::format("t = {:.1f}, wound {:.0f} %", s.time, 100.0 * fraction));
  }
  void event(const EventRecord&) override {}
  bool stop() override { return course_.stopped = stop_ && stop_(); }

 private:
  const Config& config_;
  const Progress& progress_;
  const std::function<bool()>& stop_;
  Course& course_;
};

Course closure_course(const Config& config, const TissueState& start, const Progress& progress, const std::function<bool()>& stop) {
  Course course;
  CourseRecorder recorder(config, progress, stop, course);
  TissueState last_good;
  const Stopwatch watch;
  try {
    course.statistics = run_closure(config, start, recorder, last_good).statistics;
  } catch (const NumericalError& error) {
    course.failure = error.what();
  }
  watch.read(course);
  if (!course.time.empty()) course.t_05 = time_to_fraction({course.time, course.area}, 0.05);
  return course;
}

/// Thrown through a one-cell experiment by its progress callback, the only place at which it can be stopped.
struct StopRequested {};

Course cell_course(Config config, const Progress& progress, const std::function<bool()>& stop) {
  config.output.frame_interval = config.output.interval;  // positions at every sample
  Course course;
  const Progress stoppable = [&](std::string_view stage, double fraction, std::string_view text) {
    if (stop && stop()) throw StopRequested{};
    report_progress(progress, stage, fraction, text);
  };
  const Stopwatch watch;
  try {
    const CellExperimentResult result = run_cell_experiment(config, stoppable);
    watch.read(course);
    course.statistics = result.statistics;
    course.failure = result.failure.value_or("");
    for (const TissueState& frame : result.frames) {
      const CellShape shape = cell_shapes(frame.tissue, frame.view()).front();
      course.time.push_back(frame.time);
      course.positions.push_back(cell_positions(frame));
      course.area.push_back(shape.area);
      course.shape.emplace_back(shape.shape_parameter());
    }
  } catch (const StopRequested&) {
    course.stopped = true;
  }
  return course;
}

}  // namespace

Course run_course(const Config& config, const TissueState& start, const Progress& progress,
                  const std::function<bool()>& stop) {
  return config.run.protocol == Protocol::wound_closure ? closure_course(config, start, progress, stop)
                                                        : cell_course(config, progress, stop);
}

}  // namespace suture
