#include "simulate/run_recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "simulate/closure_forecast.hpp"
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

RunRecorder::RunRecorder(const RunRequest& request, TrajectoryWriter& writer, Progress progress,
                         std::function<bool()> checkpoint_due, Save save)
    : request_(request),
      writer_(writer),
      progress_(std::move(progress)),
      checkpoint_due_(std::move(checkpoint_due)),
      save_(std::move(save)),
      membrane_{*request.config.contact.distance, request.config.contact.range} {}

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
  latest_ = {s.state, s.wound ? s.wound->outline : Polygon{}, fraction_of(s.wound, largest_area_)};
  writer_.record(samples_.back());
  commit(frame_due);
  report(s);
}

/// Every sample is safe from a kill; every frame, now and then, from a power failure.
void RunRecorder::commit(bool frame) {
  writer_.commit();
  const auto now = std::chrono::steady_clock::now();
  if (!frame || std::chrono::duration<double>(now - synced_).count() < request_.config.checkpoint.sync_interval) return;
  writer_.sync();
  synced_ = now;
}

std::string RunRecorder::saved() {
  ByteWriter archive;
  exchange(archive);
  return archive.take();
}

void RunRecorder::restore(const std::string& saved, std::vector<WoundSample> samples) {
  ByteReader archive(saved);
  exchange(archive);
  archive.expect_end();
  samples_ = std::move(samples);
}

void RunRecorder::event(const EventRecord& record) {
  if (record.kind == EventKind::yield) ++counts_.yield;
  if (record.kind == EventKind::capture) ++counts_.capture;
  const auto index = [](int i) { return i < 0 ? std::nullopt : std::optional<int>(i); };
  writer_.record(StoredEvent{record.time, std::string(to_string(record.kind)), index(record.cell), index(record.vertex)});
}

void RunRecorder::report(const ClosureSample& s) const {
  const RunParameters& run = request_.config.run;
  const double left = std::min(forecast_closure(samples_, run.closed_area), run.end_time - s.time);
  report_progress(progress_, "closure", left > 0.0 ? s.time / (s.time + left) : 1.0,
                  fmt::format("t = {:.1f}, wound {:.3f} a0 ({:.0f} %), string {}, step {:.2g}, {} rates", s.time,
                              s.wound ? s.wound->area : 0.0, 100.0 * fraction_of(s.wound, largest_area_), s.state.purse_string.size(), s.last_step,
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

/// Wound area at the times of the frames, relative to the largest until then.
std::vector<double> RunRecorder::fractions_at(const FrameReader& frames) const {
  std::vector<double> fractions;
  double largest = 0.0, fraction = 0.0;
  auto sample = samples_.begin();
  for (int i = 0; i < frames.count(); ++i) {
    const double time = frames.time(i), until = time + 1e-9 * std::max(1.0, std::abs(time));
    for (; sample != samples_.end() && start_ + sample->time <= until; ++sample) {
      largest = std::max(largest, *sample->wound_area);
      fraction = largest > 0.0 ? *sample->wound_area / largest : 0.0;
    }
    fractions.push_back(fraction);
  }
  return fractions;
}

/// output.pictures of them, spread evenly over the closing of the wound, the first and the last included.
std::vector<RunRecorder::Picture> RunRecorder::chosen_pictures() const {
  const FrameReader frames(request_.directory / "run.h5");
  std::vector<double> fractions = fractions_at(frames);  // and of the latest sample
  fractions.push_back(latest_.fraction);
  std::vector<std::size_t> chosen;
  const int wanted = std::min<int>(request_.config.output.pictures, static_cast<int>(fractions.size()));
  std::size_t next = 0;
  for (int k = 0; k + 1 < wanted; ++k) {
    const double level = fractions.front() + (fractions.back() - fractions.front()) * k / (wanted - 1);
    while (next + 1 < fractions.size() && fractions[next] > level) ++next;
    if (chosen.empty() || chosen.back() != next) chosen.push_back(next);
  }
  if (wanted > 0 && (chosen.empty() || chosen.back() != fractions.size() - 1)) chosen.push_back(fractions.size() - 1);
  std::vector<Picture> pictures;
  for (const std::size_t i : chosen) {
    const int frame = static_cast<int>(i);
    if (frame < frames.count())
      pictures.push_back({frames.state(frame), frames.extras(frame).wound_outline, fractions[i]});
    else
      pictures.push_back(latest_);
  }
  return pictures;
}

void RunRecorder::draw() const {
  remove_pictures(request_.directory);
  if (samples_.empty() || request_.config.output.pictures == 0) return;
  for (const char* name : {"final.png", "final.svg"}) render_frame(latest_.state, style(latest_), request_.directory / name);
  const std::vector<Picture> chosen = chosen_pictures();
  std::vector<StripPanel> panels;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    render_frame(chosen[k].state, style(chosen[k]), request_.directory / fmt::format("frame_{:02}.png", k));
    panels.push_back({chosen[k].state, style(chosen[k])});
  }
  if (!panels.empty()) render_strip(panels, 420, request_.directory / "strip.png");
}

}  // namespace suture
