#include "simulate/run_recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "suture/io/units.hpp"
#include "suture/measure/cell_shape.hpp"
#include "suture/measure/closure.hpp"
#include "suture/physics/purse_string_chain.hpp"
#include "suture/physics/purse_string_tethers.hpp"
#include "suture/physics/term_sum.hpp"

namespace suture {

namespace {

double shortest_segment(const TissueState& state) {
  double shortest = 1e300;
  const StateView view = state.view();
  for (std::size_t k = 0; k < view.rest_length.size(); ++k)
    shortest = std::min(shortest, view.rest_length[k] / state.tissue.initial_rest_length(static_cast<int>(k)));
  return shortest;
}

std::vector<int> cells_beside(const ClosureSample& s, Adjacency rule) {
  if (rule == Adjacency::outline)
    return s.wound ? adjacent_cells(s.state.tissue, s.state.view(), s.wound->outline) : std::vector<int>();
  const StateView view = s.state.view();
  std::vector<Point> string;
  for (std::size_t i = s.state.tissue.vertex_count(); i < view.x.size(); ++i) string.push_back({view.x[i], view.y[i]});
  return adjacent_cells_published(s.state.tissue, view, string);
}

double fraction_of(const std::optional<Wound>& wound, double largest) {
  return wound && largest > 0.0 ? wound->area / largest : 0.0;
}

}  // namespace

RunRecorder::RunRecorder(const RunRequest& request, TrajectoryWriter& writer)
    : request_(request), writer_(writer), membrane_{*request.config.contact.distance, request.config.contact.range} {}

WoundSample RunRecorder::measure(const ClosureSample& s) {
  const std::vector<CellShape> shapes = cell_shapes(s.state.tissue, s.state.view());
  const std::vector<int> adjacent = cells_beside(s, request_.config.output.adjacency);
  healed_shape_ = healed_shape(shapes, adjacent);
  WoundSample sample;
  sample.time = s.time;
  sample.wound_area = s.wound ? s.wound->area : 0.0;
  sample.mean_shape = mean_shape_parameter(shapes, adjacent);
  if (s.wound) sample.perimeter = s.wound->perimeter;
  sample.ring_size = s.state.purse_string.size();
  sample.parts = s.wound ? s.wound->parts : 0;
  sample.shortest_segment = shortest_segment(s.state);
  return sample;
}

/// Contacts are held on to until they are clearly broken, so that flicker is not counted as an exchange.
void RunRecorder::count_exchanges(const ClosureSample& s) {
  const double release = membrane_.contact_distance * (1.0 + 2.0 * membrane_.range);
  graph_ = samples_.empty() ? contact_graph(s.state.tissue, s.state.view(), membrane_)
                            : contact_graph(s.state.tissue, s.state.view(), membrane_, graph_, release);
  for (const Exchange& exchange : exchanges_.update(graph_)) {
    ++counts_.exchange;
    writer_.record(StoredEvent{s.state.time, std::string(to_string(EventKind::exchange)), exchange.gained.first, std::nullopt});
  }
}

void RunRecorder::write_frame(const ClosureSample& s) {
  FrameExtras extras;
  extras.cell_fields.push_back(shape_parameter_field(s.state));
  extras.cell_fields.push_back({{"area_strain", "1", "a/a0 - 1"}, area_strains(s.state.tissue, s.state.view())});
  if (s.wound) extras.wound_outline = s.wound->outline;
  writer_.write_frame(s.state, extras);
  TermList terms = make_cell_terms(s.state.tissue, request_.config);
  if (!s.state.purse_string.empty()) {
    terms.push_back(std::make_shared<PurseStringChain>(s.state.tissue, s.state.purse_string, request_.config.purse_string));
    terms.push_back(std::make_shared<PurseStringTethers>(s.state.tissue, s.state.purse_string, request_.config.purse_string, membrane_.contact_distance));
  }
  double total = 0.0;
  for (const auto& [name, energy] : energy_by_term(terms, s.state.time, s.state.view())) {
    writer_.record({"energy_" + name, "energy", "energy of the term " + name}, s.state.time, energy);
    total += energy;
  }
  samples_.back().energy = total;
  ++frames_;
}

void RunRecorder::sample(const ClosureSample& s) {
  if (samples_.empty()) start_ = s.state.time - s.time;
  count_exchanges(s);
  samples_.push_back(measure(s));
  const WoundSample& now = samples_.back();
  largest_area_ = std::max(largest_area_, *now.wound_area);
  const double t = s.state.time;
  writer_.record({"wound_area", "area", "free area of the wound, half a membrane off every cell"}, t, *now.wound_area);
  writer_.record({"wound_perimeter", "length", "perimeter of the wound"}, t, now.perimeter.value_or(0.0));
  if (now.mean_shape) writer_.record({"adjacent_shape", "1", "mean shape parameter of the wound-adjacent cells"}, t, *now.mean_shape);
  writer_.record({"ring_size", "1", "purse-string vertices"}, t, now.ring_size);
  writer_.record({"shortest_segment", "1", "smallest rest length over its initial value"}, t, now.shortest_segment);
  writer_.record({"step_size", "time", "last internal step of the integrator"}, t, s.last_step);
  writer_.record({"order", "1", "order of the last internal step"}, t, s.last_order);
  writer_.record({"rate_evaluations", "1", "since the purse string started"}, t, static_cast<double>(s.statistics.rate_evaluations));
  writer_.record({"steps", "1", "since the purse string started"}, t, static_cast<double>(s.statistics.steps));
  const bool frame_due = s.time + 1e-9 >= static_cast<double>(frames_) * request_.config.output.frame_interval;
  if (frame_due) write_frame(s);
  Picture picture{s.state, s.wound ? s.wound->outline : Polygon{}, s.time, fraction_of(s.wound, largest_area_)};
  if (frame_due || pictures_.size() < 2)
    pictures_.push_back(std::move(picture));
  else
    pictures_.back() = std::move(picture);  // the latest sample stands in for the end until the next frame
  if (frame_due) pictures_.push_back(pictures_.back());
  report(s);
}

void RunRecorder::event(const EventRecord& record) {
  if (record.kind == EventKind::yield) ++counts_.yield;
  if (record.kind == EventKind::capture) ++counts_.capture;
  const auto index = [](int i) { return i < 0 ? std::nullopt : std::optional<int>(i); };
  writer_.record(StoredEvent{record.time, std::string(to_string(record.kind)), index(record.cell), index(record.vertex)});
}

void RunRecorder::report(const ClosureSample& s) const {
  const double closed = 1.0 - fraction_of(s.wound, largest_area_), elapsed = s.time / request_.config.run.end_time;
  report_progress(request_.progress, "closure", std::max(closed, elapsed),
                  fmt::format("t = {:.1f}, wound {:.3f} a0 ({:.0f} %), string {}, step {:.2g}, {} rates", s.time,
                              s.wound ? s.wound->area : 0.0, 100.0 * (1.0 - closed), s.state.purse_string.size(), s.last_step,
                              s.statistics.rate_evaluations));
}

void RunRecorder::summarise(RunSummary& summary) const {
  summary.events = counts_;
  if (samples_.empty()) return;
  WoundSeries series;
  for (const WoundSample& s : samples_) series.time.push_back(s.time), series.area.push_back(*s.wound_area);
  const ClosureSummary closure = summarise_closure(series);
  summary.t_purse_string = start_;
  summary.t_50 = closure.t_50, summary.t_25 = closure.t_25, summary.t_10 = closure.t_10, summary.t_05 = closure.t_05;
  summary.wound_area_initial = series.area.front();
  summary.wound_area_max = closure.maximum_area;
  summary.closure_rate = closure.closure_rate;
  summary.healed_shape = healed_shape_;
}

void RunRecorder::write_csv() const {
  write_wound_csv(samples_, UnitScales(request_.config.units), request_.directory / "wound.csv");
}

FrameStyle RunRecorder::style(const Picture& picture) const {
  FrameStyle style{.scales = UnitScales(request_.config.units)};
  style.membrane_width = membrane_.contact_distance;
  style.time_origin = start_;
  style.wound_outline = picture.outline;
  style.wound_fraction = picture.fraction;
  return style;
}

/// output.pictures of them, spread evenly over the closing of the wound, the first and the last included.
std::vector<const RunRecorder::Picture*> RunRecorder::chosen_pictures() const {
  std::vector<const Picture*> chosen;
  const int wanted = std::min<int>(request_.config.output.pictures, static_cast<int>(pictures_.size()));
  if (wanted < 1) return chosen;
  const double first = pictures_.front().fraction, last = pictures_.back().fraction;
  std::size_t next = 0;
  for (int k = 0; k + 1 < wanted; ++k) {
    const double level = first + (last - first) * k / (wanted - 1);
    while (next + 1 < pictures_.size() && pictures_[next].fraction > level) ++next;
    if (chosen.empty() || chosen.back() != &pictures_[next]) chosen.push_back(&pictures_[next]);
  }
  if (chosen.empty() || chosen.back() != &pictures_.back()) chosen.push_back(&pictures_.back());
  return chosen;
}

void RunRecorder::draw() const {
  if (pictures_.empty()) return;
  const Picture& last = pictures_.back();
  for (const char* name : {"final.png", "final.svg"}) render_frame(last.state, style(last), request_.directory / name);
  const std::vector<const Picture*> chosen = chosen_pictures();
  std::vector<StripPanel> panels;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    render_frame(chosen[k]->state, style(*chosen[k]), request_.directory / fmt::format("frame_{:02}.png", k));
    panels.push_back({chosen[k]->state, style(*chosen[k])});
  }
  if (!panels.empty()) render_strip(panels, 420, request_.directory / "strip.png");
}

}  // namespace suture
