#include "suture/simulate/closure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/model_archive.hpp"
#include "simulate/closure_events.hpp"
#include "suture/errors.hpp"
#include "suture/ode/tissue_ode.hpp"
#include "suture/physics/purse_string_chain.hpp"
#include "suture/physics/purse_string_operations.hpp"
#include "suture/physics/purse_string_tethers.hpp"

namespace suture {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

class Closure {
 public:
  Closure(const Config& config, TissueState state, ClosureObserver& observer, TissueState& last_good);
  /// Goes on from `saved`; `state` is the one in it.
  Closure(const Config& config, const TissueState& state, const std::string& saved, ClosureObserver& observer, TissueState& last_good);
  ClosureResult run();

 private:
  std::vector<std::shared_ptr<const EnergyTerm>> string_terms() const;
  void start_integrator();
  void resume(TissueState at_event);
  void step();
  void take_samples(double until);
  void sample(double t);
  void publish_events();
  void between_steps();
  void save(SavePoint point);
  template <class Archive>
  void fields(Archive& archive) {
    archive(state_, start_, initial_step_, sampled_wound_, event_wound_, events_, finished_, restarts_, samples_, instant_, at_instant_, last_area_);
  }
  void guard_progress(double event_time);
  TissueState state_at(double t) const;
  Statistics statistics() const;
  double since_start(double t) const { return t - start_; }

  const Config& config_;
  ClosureObserver& observer_;
  TissueState& state_;  // at the last restart or, after each step, at the integrator's time
  Membrane membrane_;
  double start_, end_;
  WoundNeighbourhood sampled_wound_, event_wound_;
  ClosureEvents events_;
  std::unique_ptr<TissueOde> ode_;
  std::unique_ptr<Integrator> integrator_;
  std::vector<EventRecord> log_;
  std::size_t published_ = 0;
  std::int64_t restarts_ = 0;
  Statistics finished_;        // of the integrators before the present one
  double initial_step_ = 0.0;  // with which a resumed integrator starts
  long samples_ = 0;
  double instant_ = -1e300;
  int at_instant_ = 0;
  double last_area_ = 0.0;
  ClosureResult result_;
  double next_checkpoint_ = 0.0;
  double next_kink_ = -infinity;  // after the integrator's time, once that has passed the last; the ring changes only at restarts
  bool done_ = false;
};

TissueState with_string(const Config& config, TissueState state, const Wound& wound, double contact_distance) {
  if (!config.purse_string.enabled) return state;
  const std::vector<int> boundary = string_boundary(state.tissue, wound.boundary, config.purse_string.crevice_depth);
  return create_purse_string(std::move(state), boundary, config.purse_string, contact_distance);
}

Closure::Closure(const Config& config, TissueState state, ClosureObserver& observer, TissueState& last_good)
    : config_(config),
      observer_(observer),
      state_(last_good),
      membrane_(make_membrane(config.contact, state.tissue)),
      start_(state.time),
      end_(state.time + config.run.end_time),
      sampled_wound_(membrane_),
      event_wound_(membrane_),
      events_(config, membrane_, state.time) {
  event_wound_.update(state.tissue, state.view());
  if (!event_wound_.wound()) throw NumericalError("there is no wound to close: the tissue has no hole");
  state_ = with_string(config, std::move(state), *event_wound_.wound(), membrane_.contact_distance);
}

Closure::Closure(const Config& config, const TissueState& state, const std::string& saved, ClosureObserver& observer, TissueState& last_good)
    : config_(config),
      observer_(observer),
      state_(last_good),
      membrane_(make_membrane(config.contact, state.tissue)),
      sampled_wound_(membrane_),
      event_wound_(membrane_),
      events_(config, membrane_, state.time) {
  ByteReader archive(saved);
  fields(archive);
  archive.expect_end();
  end_ = start_ + config.run.end_time;
}

std::vector<std::shared_ptr<const EnergyTerm>> Closure::string_terms() const {
  if (state_.purse_string.empty()) return {};
  return {std::make_shared<PurseStringChain>(state_.tissue, state_.purse_string, config_.purse_string),
          std::make_shared<PurseStringTethers>(state_.tissue, state_.purse_string, config_.purse_string, membrane_.contact_distance)};
}

void Closure::start_integrator() {
  TissueOdeOptions options;
  options.membrane_law = config_.membrane.law;
  options.contact = config_.contact;
  options.contact.distance = membrane_.contact_distance;
  options.skin = config_.integrator.skin * state_.tissue.mean_initial_rest_length();
  options.threads = config_.integrator.threads;
  ode_ = std::make_unique<TissueOde>(state_.tissue, state_.purse_string.size(), options, string_terms(), state_.reference_rest_length);
  IntegratorOptions method = integrator_options(config_, state_.tissue.mean_initial_rest_length());
  method.initial_step = initial_step_;
  integrator_ = make_integrator(*ode_, method, state_.time, state_.values);
}

/// For every component after an event the one before it whose past it carries on: a purse-string vertex that stays its
/// own, a captured one that of the cell vertex it sits on.
std::vector<int> component_sources(const TissueState& before, const TissueState& after) {
  const StateLayout old_layout = before.layout(), layout = after.layout();
  std::vector<int> point(layout.points()), source(layout.size()), old_index(layout.vertices, -1);
  for (int j = 0; j < old_layout.ring; ++j) old_index[before.purse_string.vertex[j]] = old_layout.ring_point(j);
  for (int v = 0; v < layout.vertices; ++v) point[v] = v;
  for (int j = 0; j < layout.ring; ++j) {
    const int v = after.purse_string.vertex[j];
    point[layout.ring_point(j)] = old_index[v] >= 0 ? old_index[v] : v;
  }
  for (int p = 0; p < layout.points(); ++p) source[layout.x(p)] = old_layout.x(point[p]), source[layout.y(p)] = old_layout.y(point[p]);
  for (int v = 0; v < layout.vertices; ++v) source[layout.rest_length(v)] = old_layout.rest_length(v);
  return source;
}

void Closure::resume(TissueState at_event) {
  std::vector<int> source;
  if (at_event.purse_string.vertex != state_.purse_string.vertex) source = component_sources(state_, at_event);
  state_ = std::move(at_event);
  next_kink_ = -infinity;
  ode_->replace_extra(state_.purse_string.size(), string_terms());
  integrator_->resume(state_.time, state_.values, source);
  ++restarts_;
}

Statistics Closure::statistics() const {
  Statistics total = finished_;
  total += integrator_->statistics();
  total.restarts = restarts_;
  return total;
}

TissueState Closure::state_at(double t) const {
  TissueState state = state_;
  state.time = t;
  if (t >= integrator_->time())  // bit for bit what events were looked for in
    std::copy(integrator_->state().begin(), integrator_->state().end(), state.values.begin());
  else if (t > state_.time)
    integrator_->interpolate(t, state.values);
  return state;
}

void Closure::sample(double t) {
  std::optional<TissueState> between;
  if (t != state_.time) between = state_at(t);
  const TissueState& state = between ? *between : state_;
  const std::optional<Wound>& wound = sampled_wound_.update(state.tissue, state.view());
  observer_.sample({.state = state,
                    .wound = wound,
                    .time = since_start(t),
                    .last_step = integrator_->last_step(),
                    .last_order = integrator_->last_order(),
                    .statistics = statistics()});
  const double area = wound ? wound->area : 0.0, limit = config_.run.closed_area;
  if (sampled_wound_.status() == WoundStatus::open_to_outside) {
    result_.status = ClosureStatus::opened;
    done_ = true;
  } else if (area < limit) {
    const double fraction = samples_ == 0 ? 1.0 : (last_area_ - limit) / std::max(last_area_ - area, 1e-300);
    result_.status = ClosureStatus::closed;
    result_.t_closed = since_start(t) - (1.0 - std::clamp(fraction, 0.0, 1.0)) * config_.output.interval;
    log_.push_back({start_ + *result_.t_closed, EventKind::closed, -1, -1});
    done_ = true;
  }
  last_area_ = area;
  ++samples_;
  if (done_) result_.state = between ? std::move(*between) : state_;
}

void Closure::take_samples(double until) {
  while (!done_ && start_ + static_cast<double>(samples_) * config_.output.interval <= until + 1e-9 * config_.output.interval)
    sample(std::min(start_ + static_cast<double>(samples_) * config_.output.interval, until));
}

void Closure::publish_events() {
  for (; published_ < log_.size(); ++published_) observer_.event(log_[published_]);
  log_.clear();
  published_ = 0;
}

/// A run must not repeat one instant for ever: the ring can change only so often before time moves on.
void Closure::guard_progress(double event_time) {
  constexpr int most_at_one_instant = 1000;
  const double resolution = 1e-9 * std::max(1.0, std::abs(event_time));
  at_instant_ = event_time - instant_ < resolution ? at_instant_ + 1 : 0;
  if (at_instant_ == 0) instant_ = event_time;
  if (at_instant_ > most_at_one_instant)
    throw NumericalError(fmt::format("events of the purse string repeat at t = {:.9g} without time moving on", event_time));
}

void Closure::step() {
  if (next_kink_ <= integrator_->time()) next_kink_ = next_kink_time(state_.purse_string, integrator_->time()).value_or(infinity);
  double limit = std::min(end_, next_kink_);
  if (integrator_->stops_cheaply()) limit = std::min(limit, events_.next_known(integrator_->time()));
  integrator_->step(limit);
  double until = integrator_->time();
  while (const std::optional<DueEvents> due = events_.find(*integrator_, state_, event_wound_)) {
    TissueState at_event = state_at(due->time);
    guard_progress(due->time);
    if (!events_.apply(*due, at_event, event_wound_, log_)) continue;
    take_samples(due->time);
    publish_events();
    resume(std::move(at_event));
    return;
  }
  take_samples(until);
  if (until >= next_kink_) log_.push_back({until, EventKind::kink, -1, -1});
  publish_events();
  state_.time = until;
  std::copy(integrator_->state().begin(), integrator_->state().end(), state_.values.begin());
}

/// A closure that goes on from what is saved starts its integrator afresh. At a configured time this one does too, so that
/// both have the same future.
void Closure::save(SavePoint point) {
  const Statistics before = finished_;
  const std::int64_t restarts = restarts_;
  if (point != SavePoint::natural) {
    constexpr double restart_step = 0.1;  // of the last step: order 1 needs shorter ones
    initial_step_ = restart_step * integrator_->last_step();
    finished_ += integrator_->statistics();
    ++restarts_;
  }
  if (point == SavePoint::configured) {
    integrator_.reset();  // before the system it refers to
    start_integrator();
  }
  ByteWriter archive;
  fields(archive);
  observer_.checkpoint(archive.bytes(), state_.time, point);
  if (point == SavePoint::between) finished_ = before, restarts_ = restarts;
}

void Closure::between_steps() {
  const bool stop = observer_.stop();
  const double interval = config_.checkpoint.interval, t = state_.time;
  if (t >= next_checkpoint_) {
    save(SavePoint::configured);
    next_checkpoint_ = next_multiple(start_, interval, t);
  } else if (stop || observer_.checkpoint_due()) {
    save(SavePoint::between);
  }
  if (!stop) return;
  result_.status = ClosureStatus::stopped;
  result_.state = state_;
  done_ = true;
}

ClosureResult Closure::run() {
  start_integrator();
  if (samples_ == 0) {
    sample(start_);
    save(SavePoint::natural);
  }
  next_checkpoint_ = next_multiple(start_, config_.checkpoint.interval, state_.time);
  while (!done_ && integrator_->time() < end_) {
    step();
    if (!done_ && integrator_->time() < end_) between_steps();
  }
  publish_events();
  result_.statistics = statistics();
  result_.storms = events_.storms();
  if (!done_) result_.state = state_;
  return std::move(result_);
}

}  // namespace

ClosureResult run_closure(const Config& config, TissueState state, ClosureObserver& observer, TissueState& last_good) {
  return Closure(config, std::move(state), observer, last_good).run();
}

ClosureResult resume_closure(const Config& config, const std::string& saved, ClosureObserver& observer, TissueState& last_good) {
  TissueState state;
  ByteReader archive(saved);
  archive(state);  // its first field
  return Closure(config, state, saved, observer, last_good).run();
}

}  // namespace suture
