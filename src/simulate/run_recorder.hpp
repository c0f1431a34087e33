// Watches a closure and keeps what the output files hold.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "simulate/run_archive.hpp"

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
  /// What a checkpoint of the run needs of a closure: both parts belong together.
  using Save = std::function<void(const std::string& closure, double time, SavePoint point)>;
  RunRecorder(const RunRequest& request, TrajectoryWriter& writer, Progress progress,
              std::function<bool()> checkpoint_due, Save save);

  void sample(const ClosureSample& sample) override;
  void event(const EventRecord& record) override;
  bool stop() override { return request_.stop && request_.stop(); }
  bool checkpoint_due() override { return checkpoint_due_(); }
  void checkpoint(const std::string& saved, double time, SavePoint point) override { save_(saved, time, point); }

  /// Its fields, as a checkpoint holds them, and back. The rows of wound.csv are in the journal.
  std::string saved();
  void restore(const std::string& saved, std::vector<WoundSample> samples);

  /// Results of the samples so far, into the fields of `summary` that depend on them.
  void summarise(RunSummary& summary) const;
  void write_csv() const;
  /// final.png, final.svg, strip.png and frame_*.png, from the frames of the published run.h5.
  void draw() const;

 private:
  struct Picture {
    TissueState state;
    Polygon outline;
    double fraction = 0.0;
  };
  WoundSample measure(const ClosureSample& sample);
  void commit(bool frame);
  template <class Archive>
  void exchange(Archive& archive) {
    archive(latest_.state, latest_.outline, latest_.fraction, graph_, exchanges_, counts_.yield, counts_.capture,
            counts_.exchange, healed_shape_, largest_area_, start_, frames_);
  }
  void count_exchanges(const ClosureSample& sample);
  void write_frame(const ClosureSample& sample);
  void report(const ClosureSample& sample) const;
  FrameStyle style(const Picture& picture) const;
  std::vector<Picture> chosen_pictures() const;
  std::vector<double> fractions_at(const FrameReader& frames) const;

  const RunRequest& request_;
  TrajectoryWriter& writer_;
  Progress progress_;
  std::function<bool()> checkpoint_due_;
  Save save_;
  Membrane membrane_;
  std::vector<WoundSample> samples_;
  Picture latest_;  ///< of the latest sample
  ContactGraph graph_;
  ExchangeCounter exchanges_;
  EventCounts counts_;
  double healed_shape_ = 0.0, largest_area_ = 0.0, start_ = 0.0;
  long frames_ = 0;
  std::chrono::steady_clock::time_point synced_ = std::chrono::steady_clock::now();
};

}  // namespace suture
