#include "support/sample_run.hpp"

#include "support/sample_tissue.hpp"
#include "suture/io/trajectory.hpp"

namespace suture::test {
namespace {

TissueState without_purse_string(const TissueState& state) {
  TissueState result = state;
  result.purse_string = {};
  result.values.clear();
  const StateView view = state.view();
  const std::size_t vertices = state.tissue.vertex_count();
  for (const auto& part : {view.x.first(vertices), view.y.first(vertices), view.rest_length})
    result.values.insert(result.values.end(), part.begin(), part.end());
  return result;
}

}  // namespace

void write_sample_run(const std::filesystem::path& path, int frames) {
  TrajectoryWriter writer(path, {.resolved_config = "[tissue]\nseed = 7\n", .seed = 7});
  TissueState state = sample_tissue();
  for (int i = 0; i < frames; ++i) {
    state.time = 200.0 + 10.0 * i;
    const bool last = i + 1 == frames;
    FrameExtras extras;
    if (!last) extras.wound_outline = {{-0.4, -0.4}, {0.4, -0.4}, {0.0, 0.5}};
    writer.write_frame(last ? without_purse_string(state) : state, extras);
    writer.record({"wound_area", "area", "area of the wound"}, state.time, 5.0 * (1.0 - 1.0 * i / frames));
    writer.record({"adjacent_shape", "1", "mean shape"}, state.time, 1.2 + 0.1 * i);
    writer.record(StoredEvent{state.time, "capture", 0, 1});
    const MutableStateView view = state.mutable_view();
    for (double& x : view.x) x *= 0.99;
    for (double& y : view.y) y *= 0.99;
    for (double& l0 : view.rest_length) l0 *= 1.02;
  }
  writer.write_summary({.status = RunStatus::closed, .seed = 7, .t_50 = 12.0});
  writer.close();
}

}  // namespace suture::test
