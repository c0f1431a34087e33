#include "suture/converge/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "suture/errors.hpp"
#include "suture/io/config.hpp"
#include "suture/measure/closure.hpp"
#include "suture/setup/protocol.hpp"

namespace suture {

namespace {

constexpr double forever = std::numeric_limits<double>::infinity();

struct StudyCase {
  Method method;
  double value;  ///< tolerance in l0, or step
  bool confirmation = false;
};

/// One case at one seed, without positions.
struct SeedRun {
  std::uint64_t seed;
  std::size_t reference;
  CourseErrors errors;
  Course course;
};

Config configure(Config config, const StudyCase& studied) {
  IntegratorParameters& p = config.integrator;
  p.method = studied.method;
  if (takes_fixed_steps(studied.method)) {
    p.time_step = studied.value;
  } else {
    p.rest_length_tolerance *= studied.value / p.tolerance;
    p.tolerance = studied.value;
  }
  return config;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

std::vector<StudyCase> cases_of(const StudyOptions& options) {
  std::vector<StudyCase> cases;
  for (const Method method : options.methods)
    for (const double value : takes_fixed_steps(method) ? options.steps : options.tolerances) cases.push_back({method, value});
  cases.push_back({options.confirmation, options.reference_tolerance, true});
  return cases;
}

/// Median of the values there are: one tissue that took another branch does not hide the others.
std::optional<double> typical(const std::vector<const SeedRun*>& runs, const std::function<std::optional<double>(const CourseErrors&)>& value) {
  std::vector<double> values;
  for (const SeedRun* run : runs)
    if (const std::optional<double> v = value(run->errors)) values.push_back(*v);
  return values.empty() ? std::nullopt : std::optional(median(values));
}

void summarise_errors(StudyRow& row, const std::vector<const SeedRun*>& runs) {
  row.errors.position = *typical(runs, [](const CourseErrors& e) { return e.position; });
  row.errors.area = *typical(runs, [](const CourseErrors& e) { return e.area; });
  row.errors.shape = typical(runs, [](const CourseErrors& e) { return e.shape; });
  row.errors.t_05 = typical(runs, [](const CourseErrors& e) { return e.t_05; });
  row.errors.until = forever;
  for (const SeedRun* run : runs) {
    row.errors.position_max = std::max(row.errors.position_max, run->errors.position_max);
    row.errors.until = std::min(row.errors.until, run->errors.until);
    if (run->errors.diverged_at)
      row.errors.diverged_at = std::min(row.errors.diverged_at.value_or(forever), *run->errors.diverged_at);
  }
}

void average_costs(StudyRow& row, const std::vector<const SeedRun*>& runs) {
  const auto n = static_cast<double>(runs.size());
  for (const SeedRun* run : runs) {
    const Statistics& s = run->course.statistics;
    row.rate_evaluations += static_cast<double>(s.rate_evaluations) / n;
    row.steps += static_cast<double>(s.steps) / n;
    row.newton_iterations += static_cast<double>(s.newton_iterations) / n;
    row.linear_iterations += static_cast<double>(s.linear_iterations) / n;
    row.restarts += static_cast<double>(s.restarts) / n;
    row.wall_s += run->course.wall_s / n;
    row.cpu_s += run->course.cpu_s / n;
  }
}

std::optional<double> mean_shape_at(const std::vector<const Course*>& courses, std::size_t sample) {
  double sum = 0.0;
  int count = 0;
  for (const Course* course : courses)
    if (sample < course->shape.size() && course->shape[sample]) sum += *course->shape[sample], ++count;
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

/// Errors of the means over seeds, over the whole run: what survives when single trajectories diverge.
void compare_means(StudyRow& row, const std::vector<const Course*>& courses, const std::vector<const Course*>& references) {
  const auto series = [](const std::vector<const Course*>& list) {
    std::vector<WoundSeries> all;
    for (const Course* course : list) all.push_back({course->time, course->area});
    return all;
  };
  std::vector<double> times;
  for (const std::vector<const Course*>* list : {&courses, &references})
    for (const Course* course : *list)
      if (course->time.size() > times.size()) times = course->time;
  const WoundSeries mean = mean_series(series(courses), times), expected = mean_series(series(references), times);
  double area = 0.0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    area = std::max(area, std::abs(mean.area[k] - expected.area[k]));
    const std::optional<double> a = mean_shape_at(courses, k), b = mean_shape_at(references, k);
    if (a && b) row.mean_shape = std::max(row.mean_shape.value_or(0.0), std::abs(*a - *b));
  }
  row.mean_area = area;
  if (!references.front()->t_05) return;
  const std::optional<double> t = time_to_fraction(mean, 0.05), t_expected = time_to_fraction(expected, 0.05);
  if (t && t_expected) row.mean_t_05 = std::abs(*t - *t_expected);
}

class Study {
 public:
  explicit Study(const StudyRequest& request) : request_(request), cases_(cases_of(request.options)), runs_(cases_.size()) {}
  StudyResult run();

 private:
  bool stopped() const { return result_.stopped; }
  TissueState prepare(const Config& config);
  Course integrate(const Config& config, const TissueState& start, const StudyCase& studied, int repeats);
  void run_seed(std::uint64_t seed);
  void record(std::size_t k, std::uint64_t seed, Course course, const Course& reference, double until);
  StudyRow row(std::size_t k, const std::vector<const SeedRun*>& runs) const;
  void update_rows();

  const StudyRequest& request_;
  std::vector<StudyCase> cases_;
  std::vector<std::vector<SeedRun>> runs_;  // by case
  std::vector<Course> references_;          // by seed, without positions once the seed is done
  StudyResult result_;
  std::size_t done_ = 0;
};

struct StopRequested {};

TissueState Study::prepare(const Config& config) {
  if (config.run.protocol != Protocol::wound_closure) return {};
  const auto stoppable = [&](std::string_view stage, double fraction, std::string_view text) {
    if (request_.stop && request_.stop()) throw StopRequested{};
    report_progress(request_.progress, stage, fraction, text);
  };
  try {
    return prepare_tissue(config, stoppable).state;
  } catch (const StopRequested&) {
    result_.stopped = true;
    return {};
  }
}

Course Study::integrate(const Config& config, const TissueState& start, const StudyCase& studied, int repeats) {
  const Config configured = configure(config, studied);
  const std::size_t all = request_.options.seeds.size() * (cases_.size() + 1);
  const std::string label = fmt::format("{} {:.3g}", method_name(studied.method), studied.value);
  const Progress labelled = [&](std::string_view, double fraction, std::string_view text) {
    report_progress(request_.progress, fmt::format("run {}/{}", done_ + 1, all), fraction, fmt::format("{}, {}", label, text));
  };
  Course course = run_course(configured, start, labelled, request_.stop);
  std::vector<double> wall{course.wall_s}, cpu{course.cpu_s};
  for (int k = 1; k < repeats && !course.stopped && course.failure.empty(); ++k) {
    const Course again = run_course(configured, start, labelled, request_.stop);
    wall.push_back(again.wall_s);
    cpu.push_back(again.cpu_s);
    course.stopped = again.stopped;
  }
  course.wall_s = median(wall);
  course.cpu_s = median(cpu);
  result_.stopped |= course.stopped;
  ++done_;
  return course;
}

void Study::record(std::size_t k, std::uint64_t seed, Course course, const Course& reference, double until) {
  SeedRun run{seed, references_.size(), {}, std::move(course)};
  if (!run.course.time.empty())
    run.errors = compare(run.course, reference, result_.rest_length, until, request_.options.divergence);
  run.course.positions.clear();
  runs_[k].push_back(std::move(run));
}

void Study::run_seed(std::uint64_t seed) {
  const StudyOptions& options = request_.options;
  Config config = request_.config;
  config.tissue.seed = seed;
  const TissueState start = prepare(config);
  if (stopped()) return;
  result_.rest_length = make_tissue(config).mean_initial_rest_length();
  const std::size_t last = cases_.size() - 1;
  Course reference = integrate(config, start, {options.reference, options.reference_tolerance}, 1);
  if (stopped()) return;
  Course confirmation = integrate(config, start, cases_[last], 1);
  if (stopped()) return;
  for (const Course* course : {&reference, &confirmation})
    if (!course->failure.empty()) throw NumericalError(fmt::format("seed {}: the reference failed: {}", seed, course->failure));
  SeedReference judged{seed, {}, {}, differences(confirmation, reference, result_.rest_length)};
  judged.divergence_time = compare(confirmation, reference, result_.rest_length, forever, options.divergence).diverged_at;
  const double until = judged.divergence_time ? *judged.divergence_time - 0.5 * config.output.interval : forever;
  record(last, seed, std::move(confirmation), reference, until);
  judged.uncertainty = runs_[last].back().errors;
  result_.references.push_back(judged);
  for (std::size_t k = 0; k < last && !stopped(); ++k) {
    Course course = integrate(config, start, cases_[k], options.repeats);
    if (stopped()) break;
    record(k, seed, std::move(course), reference, until);
    references_.push_back(reference);  // complete for the rows of this seed
    update_rows();
    references_.pop_back();
    if (request_.row_done) request_.row_done(result_);
  }
  reference.positions.clear();
  references_.push_back(std::move(reference));
}

StudyRow Study::row(std::size_t k, const std::vector<const SeedRun*>& runs) const {
  StudyRow row;
  row.method = cases_[k].method;
  row.tolerance_or_dt = cases_[k].value;
  row.confirmation = cases_[k].confirmation;
  std::vector<const SeedRun*> good;
  std::vector<const Course*> courses, references;
  for (const SeedRun* run : runs) {
    if (!run->course.failure.empty()) {
      if (row.failure.empty()) row.failure = run->course.failure;
      continue;
    }
    good.push_back(run);
    courses.push_back(&run->course);
    references.push_back(&references_[run->reference]);
  }
  row.seeds = static_cast<int>(good.size());
  average_costs(row, good.empty() ? runs : good);
  if (good.empty()) return row;
  summarise_errors(row, good);
  compare_means(row, courses, references);
  return row;
}

void Study::update_rows() {
  result_.rows.clear();
  result_.seed_rows.clear();
  for (std::size_t k = 0; k < cases_.size(); ++k) {
    if (runs_[k].empty()) continue;
    std::vector<const SeedRun*> all;
    for (const SeedRun& run : runs_[k]) {
      all.push_back(&run);
      result_.seed_rows.emplace_back(run.seed, row(k, {&run}));
    }
    result_.rows.push_back(row(k, all));
  }
}

StudyResult Study::run() {
  for (const std::uint64_t seed : request_.options.seeds) {
    run_seed(seed);
    if (stopped()) break;
  }
  return std::move(result_);
}

void check_options(const StudyOptions& options) {
  const auto adaptive = [](Method method) { return !takes_fixed_steps(method); };
  if (options.methods.empty() || options.seeds.empty()) throw InputError("converge: at least one method and one seed are needed");
  if (std::any_of(options.methods.begin(), options.methods.end(), adaptive) && options.tolerances.empty())
    throw InputError("converge: the adaptive methods need --tolerances");
  if (std::any_of(options.methods.begin(), options.methods.end(), takes_fixed_steps) && options.steps.empty())
    throw InputError("converge: the fixed-step methods need --steps");
  if (options.reference == options.confirmation)
    throw InputError(fmt::format("converge: the reference must be confirmed by a second method, not by {} again", method_name(options.reference)));
  if (!adaptive(options.reference) || !adaptive(options.confirmation))
    throw InputError("converge: the reference needs two adaptive methods");
}

}  // namespace

bool takes_fixed_steps(Method method) { return method == Method::euler || method == Method::verlet || method == Method::rk4; }

std::string method_name(Method method) {
  Config config;
  config.integrator.method = method;
  std::string text = config_value(config, "integrator.method");
  std::erase(text, '"');
  return text;
}

StudyResult run_study(const StudyRequest& request) {
  check_options(request.options);
  if (!request.config.run.start_from.empty())
    throw InputError("converge prepares its own tissues, one per seed: key 'run.start_from' is not allowed here");
  if (request.config.run.protocol == Protocol::wound_closure && request.config.run.last_stage != Stage::closure)
    throw InputError("converge integrates the closure: key 'run.last_stage' must be \"closure\"");
  StudyRequest resolved = request;
  if (resolved.config.run.protocol == Protocol::wound_closure) resolved.config = with_contact_distance(resolved.config);
  return Study(resolved).run();
}

}  // namespace suture
