// A closure that goes on from a configured checkpoint has the bits of one that never stopped.
#include <algorithm>
#include <catch2/catch.hpp>

#include "io/model_archive.hpp"
#include "support/setup_tissues.hpp"
#include "suture/errors.hpp"
#include "suture/simulate/closure.hpp"

using namespace suture;
using namespace suture::test;

namespace {

/// Everything that can be seen of a closure, as bytes, and what it offered to be saved.
class Witness final : public ClosureObserver {
 public:
  void sample(const ClosureSample& s) override {
    seen.push_back(to_bytes(s.state) + to_bytes(s.statistics));
    ++samples;
  }
  void event(const EventRecord& e) override {
    ByteWriter bytes;
    bytes(e.time, e.kind, e.cell, e.vertex);
    seen.push_back(bytes.take());
    ++events;
    captures += e.kind == EventKind::capture;
  }
  bool checkpoint_due() override { return due_every > 0 && ++steps % due_every == 0; }
  bool stop() override { return stop_after > 0 && samples >= stop_after; }
  void checkpoint(const std::string& bytes, double time, SavePoint point) override {
    saved.push_back({bytes, time, point, seen.size(), events});
  }

  struct Saved {
    std::string bytes;
    double time;
    SavePoint point;
    std::size_t seen;
    int events;
  };
  std::vector<std::string> seen;
  std::vector<Saved> saved;
  int events = 0, captures = 0, samples = 0, steps = 0, due_every = 0, stop_after = 0;
};

Config closing_config(Method method) {
  Config config = small_closing_config(method);
  config.run.end_time = 6.0;
  config.purse_string.yield_length = 0.5;  // dozens of tethers yield and are captured again
  config.checkpoint.interval = 0.2;
  return config;
}

}  // namespace

TEST_CASE("a closure resumed from a configured checkpoint repeats every bit, before and after events", "[unit][resume]") {
  struct Case {
    Method method;
    EventHandling handling;
  };
  int captures = 0;
  for (const auto& [method, handling] : {Case{Method::cvode, EventHandling::automatic}, Case{Method::cvode, EventHandling::grid},
                                         Case{Method::cvode, EventHandling::located}, Case{Method::rkc2, EventHandling::located},
                                         Case{Method::rkc2, EventHandling::automatic}}) {
    Config config = closing_config(method);
    config.purse_string.storm_rate = 10.0;
    config.purse_string.event_handling = handling;
    config.purse_string.event_interval = 0.07;  // not a divisor of the checkpoint interval: the grid must be the old one
    Witness whole;
    TissueState last_good;
    const ClosureResult expected = run_closure(config, small_wound(config), whole, last_good);
    REQUIRE(whole.saved.size() >= 5);
    REQUIRE(whole.events > 5);
    int before_events = 0, after_events = 0;
    for (const Witness::Saved& saved : whole.saved) {
      CAPTURE(static_cast<int>(method), static_cast<int>(handling), saved.time, saved.events);
      Witness rest;
      const ClosureResult result = resume_closure(config, saved.bytes, rest, last_good);
      CHECK(std::equal(rest.seen.begin(), rest.seen.end(), whole.seen.begin() + static_cast<std::ptrdiff_t>(saved.seen),
                       whole.seen.end()));
      CHECK(to_bytes(result.state) == to_bytes(expected.state));
      CHECK(to_bytes(result.statistics) == to_bytes(expected.statistics));
      CHECK(result.t_closed == expected.t_closed);
      CHECK(result.storms == expected.storms);
      before_events += saved.events == 0;
      after_events += saved.events > 0;
    }
    CHECK(before_events > 0);
    CHECK(after_events > 10);
    captures += whole.captures;
    if (handling == EventHandling::automatic) CHECK(expected.storms > 0);
  }
  CHECK(captures > 50);
}

TEST_CASE("saving at other times leaves a closure as it is, and going on from there agrees to tolerance", "[unit][resume]") {
  const Config config = closing_config(Method::cvode);
  Witness undisturbed, watched;
  watched.due_every = 7;
  TissueState last_good;
  run_closure(config, small_wound(config), undisturbed, last_good);
  const ClosureResult expected = run_closure(config, small_wound(config), watched, last_good);
  CHECK(watched.seen == undisturbed.seen);
  int between = 0;
  for (const Witness::Saved& saved : watched.saved) {
    if (saved.point != SavePoint::between || ++between % 4 != 1) continue;
    Witness rest;
    const ClosureResult result = resume_closure(config, saved.bytes, rest, last_good);
    CAPTURE(saved.time);
    CHECK(result.status == expected.status);
    CHECK(rest.samples == watched.samples - static_cast<int>(std::count_if(
                              watched.seen.begin(), watched.seen.begin() + static_cast<std::ptrdiff_t>(saved.seen),
                              [](const std::string& bytes) { return bytes.size() > 1000; })));
    CHECK(result.statistics.steps == Approx(static_cast<double>(expected.statistics.steps)).epsilon(0.3));
  }
  CHECK(between >= 4);
}

TEST_CASE("a closure that is asked to stop has saved where it stopped", "[unit][resume]") {
  const Config config = closing_config(Method::cvode);
  Witness stopped;
  stopped.stop_after = 4;
  TissueState last_good;
  const ClosureResult result = run_closure(config, small_wound(config), stopped, last_good);
  CHECK(result.status == ClosureStatus::stopped);
  REQUIRE(!stopped.saved.empty());
  CHECK(stopped.saved.back().time == result.state.time);
}

TEST_CASE("a saved closure that is damaged is refused", "[unit][resume]") {
  const Config config = closing_config(Method::cvode);
  Witness whole, rest;
  TissueState last_good;
  whole.stop_after = 3;
  run_closure(config, small_wound(config), whole, last_good);
  const std::string bytes = whole.saved.back().bytes;
  for (const std::size_t length : {std::size_t{0}, std::size_t{9}, bytes.size() / 2, bytes.size() - 1})
    CHECK_THROWS_AS(resume_closure(config, bytes.substr(0, length), rest, last_good), FileError);
  CHECK_THROWS_AS(resume_closure(config, bytes + "x", rest, last_good), FileError);
}
