#include "suture/setup/acceptance.hpp"

#include <fmt/format.h>

#include "setup/energy_options.hpp"
#include "suture/measure/patch.hpp"

namespace suture {

namespace {

Acceptance judge(const Config& config, const TissueState& state, bool wounded) {
  const Membrane membrane{.contact_distance = contact_distance(config), .range = config.contact.range};
  const PatchReport patch = inspect_patch(state.tissue, state.view(), membrane, wounded);
  Acceptance verdict{
      .components = patch.components, .largest_hole = patch.largest_hole(), .wound_area = patch.wound_area};
  const WoundParameters& limits = config.wound;
  if (patch.components != 1)
    verdict.reason = fmt::format("the tissue is in {} pieces", patch.components);
  else if (verdict.largest_hole > limits.maximum_hole)
    verdict.reason = fmt::format("it has a hole of area {:.3f}, larger than wound.maximum_hole = {}",
                                 verdict.largest_hole, limits.maximum_hole);
  else if (wounded && !patch.wound_area)
    verdict.reason = "there is no wound inside it: the ablated cells leave no hole, or it is open to the outside";
  else if (wounded && *patch.wound_area < limits.minimum_area)
    verdict.reason =
        fmt::format("its wound area {:.3f} is below wound.minimum_area = {}", *patch.wound_area, limits.minimum_area);
  else if (wounded && *patch.wound_area > limits.maximum_area)
    verdict.reason =
        fmt::format("its wound area {:.3f} is above wound.maximum_area = {}", *patch.wound_area, limits.maximum_area);
  verdict.accepted = verdict.reason.empty();
  return verdict;
}

}  // namespace

Acceptance judge_annealed(const Config& config, const TissueState& state) { return judge(config, state, false); }
Acceptance judge_wounded(const Config& config, const TissueState& state) { return judge(config, state, true); }

}  // namespace suture
