// Watches a closure and keeps what the output files hold.
#pragma once

#include <filesystem>
#include <vector>

#include "suture/io/summary.hpp"
#include "suture/io/trajectory.hpp"
#include "suture/io/wound_csv.hpp"
#include "suture/measure/neighbours.hpp"
#include "suture/render/frame.hpp"
#include "suture/simulate/closure.hpp"
#include "suture/simulate/run.hpp"

namespace suture {

class RunRecorder final : public ClosureObserver {
 public:
  RunRecorder(const RunRequest& request, TrajectoryWriter& writer);

  void sample(const ClosureSample& sample) override;
  void event(const EventRecord& record) override;
  bool stop() override { return request_.stop && request_.stop(); }

  /// Results of the samples so far, into the fields of `summary` that depend on them.
  void summarise(RunSummary& summary) const;
  void write_csv() const;
  /// final.png, final.svg, strip.png and one picture per kept frame.
  void draw() const;

 private:
  struct Picture {
    TissueState state;
    Polygon outline;
    double time = 0.0, fraction = 0.0;
  };
  WoundSample measure(const ClosureSample& sample);
  void count_exchanges(const ClosureSample& sample);
  void write_frame(const ClosureSample& sample);
  void report(const ClosureSample& sample) const;
  FrameStyle style(const Picture& picture) const;
  std::vector<const Picture*> chosen_pictures() const;

  const RunRequest& request_;
  TrajectoryWriter& writer_;
  Membrane membrane_;
  std::vector<WoundSample> samples_;
  std::vector<Picture> pictures_;  ///< one per frame, the last one always the latest sample's
  ContactGraph graph_;
  ExchangeCounter exchanges_;
  EventCounts counts_;
  double healed_shape_ = 0.0, largest_area_ = 0.0, start_ = 0.0;
  long frames_ = 0;
};

}  // namespace suture
