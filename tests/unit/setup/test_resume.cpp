// A preparation that goes on from what it offered to be saved ends in the same bits as one that never stopped.
#include <array>
#include <catch2/catch.hpp>
#include <limits>

#include "simulate/run_archive.hpp"
#include "support/setup_tissues.hpp"
#include "suture/setup/protocol.hpp"

using namespace suture;
using namespace suture::test;

namespace {

struct Saved {
  std::string bytes;
  SavePoint point;
};

Config checkpointed_config() {
  Config config = small_config();
  config.checkpoint.interval = 3.0;
  config.run.last_stage = Stage::ablation;
  return config;
}

/// Everything offered on the way; every `stride`-th step also asks for a save between special points.
Preparation prepare(const Config& config, std::vector<Saved>& saved, int stride) {
  int steps = 0;
  StepWatch<PreparationState> watch{
      .due = [&] { return stride > 0 && ++steps % stride == 0; },
      .save = [&](PreparationState state, SavePoint point) { saved.push_back({to_bytes(state), point}); }};
  return prepare_tissue(config, {}, {}, std::move(watch));
}

Preparation resume(const Config& config, const std::string& bytes) {
  StepWatch<PreparationState> watch;
  ByteReader reader(bytes);
  reader(watch.resumed.emplace());
  reader.expect_end();
  // Saving goes on, as in a run: it must not change anything.
  watch.save = [](const PreparationState&, SavePoint) {};
  return prepare_tissue(config, {}, {}, std::move(watch));
}

PreparationState state_of(const std::string& bytes) {
  PreparationState state;
  ByteReader reader(bytes);
  reader(state);
  return state;
}

std::size_t step_of(const std::string& bytes) { return state_of(bytes).step.index(); }

}  // namespace

TEST_CASE("a preparation resumed from any special point has the bits of an uninterrupted one", "[unit][resume]") {
  const Config config = checkpointed_config();
  std::vector<Saved> saved;
  const std::string whole = to_bytes(prepare(config, saved, 0));
  int resumed = 0;
  std::array<int, 4> within{};  // end of a stage, packing, anneal, ablation
  for (std::size_t i = 0; i < saved.size(); ++i) {
    const std::size_t step = step_of(saved[i].bytes);
    if (step == 1 && i % 5 != 0) continue;  // packing has many
    CAPTURE(i, step);
    CHECK(to_bytes(resume(config, saved[i].bytes)) == whole);
    ++within[step];
    ++resumed;
  }
  CHECK(resumed >= 8);
  for (const int count : within) CHECK(count > 0);
}

TEST_CASE("the constant-energy motion of the anneal resumed from a configured time has the bits of an uninterrupted one", "[unit][resume]") {
  Config config = small_config();
  config.run.last_stage = Stage::anneal;
  config.anneal.temperature = 0.3;  // fast enough to renew its list of contacts between two checkpoints
  config.anneal.relaxation_time = 1.0;
  config.checkpoint.interval = 0.17;  // not a multiple of the step
  std::vector<Saved> saved;
  const std::string whole = to_bytes(prepare(config, saved, 0));
  int resumed = 0;
  for (const Saved& one : saved) {
    const PreparationState state = state_of(one.bytes);
    const AnnealState* const anneal = std::get_if<AnnealState>(&state.step);
    if (anneal == nullptr || !anneal->motion) continue;
    CAPTURE(anneal->motion->steps_done);
    CHECK(one.point == SavePoint::configured);
    const bool same = to_bytes(resume(config, one.bytes)) == whole;
    CHECK(same);
    ++resumed;
  }
  CHECK(resumed >= 5);  // of every attempt
}

TEST_CASE("a preparation resumed from anywhere else agrees to its tolerance", "[unit][resume]") {
  const Config config = checkpointed_config();
  std::vector<Saved> saved;
  const Preparation whole = prepare(config, saved, 150);
  std::array<int, 4> within{};
  for (const Saved& one : saved) {
    const std::size_t step = step_of(one.bytes);
    if (one.point != SavePoint::between || ++within[step] > 2) continue;
    const Preparation resumed = resume(config, one.bytes);
    CAPTURE(step);
    CHECK(resumed.state.time == whole.state.time);
    CHECK(resumed.packing.compression_steps == whole.packing.compression_steps);
    CHECK(*resumed.acceptance.wound_area == Approx(*whole.acceptance.wound_area).epsilon(0.02));
  }
  CHECK(within[1] > 0);  // within packing
  CHECK(within[2] > 0);  // within the anneal
}

TEST_CASE("watching a preparation does not change it", "[unit][resume]") {
  Config config = checkpointed_config();
  std::vector<Saved> saved;
  const std::string watched = to_bytes(prepare(config, saved, 40));
  CHECK(to_bytes(prepare_tissue(config)) == watched);
  config.checkpoint.interval = std::numeric_limits<double>::infinity();
  CHECK(to_bytes(prepare_tissue(config)) != watched);  // configured checkpoints start the integrator afresh
}
