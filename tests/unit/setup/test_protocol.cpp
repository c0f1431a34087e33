#include <catch2/catch.hpp>
#include <map>

#include "support/setup_tissues.hpp"
#include "suture/errors.hpp"
#include "suture/setup/protocol.hpp"

using namespace suture;
using namespace suture::test;

TEST_CASE("A run continued from any saved stage ends with the same bits", "[unit]") {
  const Config config = small_config();
  std::map<Stage, TissueState> saved;
  const Preparation whole =
      prepare_tissue(config, {}, [&](Stage stage, const TissueState& state) { saved[stage] = state; });
  REQUIRE(saved.size() == 3);
  CHECK(whole.stage == Stage::ablation);
  CHECK(whole.attempt == 0);
  CHECK(whole.acceptance.accepted);
  CHECK(whole.state.tissue.cell_count() == 6);
  CHECK(whole.state.values == saved[Stage::ablation].values);
  CHECK(whole.packing.iterations > 0);
  CHECK(whole.relaxation.steps > 0);
  for (const Stage stage : {Stage::packing, Stage::anneal, Stage::ablation}) {
    const Preparation continued = continue_preparation(config, stage, saved[stage]);
    CHECK(continued.stage == Stage::ablation);
    CHECK(continued.state.values == whole.state.values);
    CHECK(continued.state.reference_rest_length == whole.state.reference_rest_length);
  }
  CHECK_THROWS_AS(continue_preparation(config, Stage::closure, whole.state), InputError);
}

TEST_CASE("The protocol stops at the stage asked for", "[unit]") {
  Config config = small_config();
  config.run.last_stage = Stage::packing;
  const Preparation packed = prepare_tissue(config);
  CHECK(packed.stage == Stage::packing);
  CHECK(packed.state.values == packed_small_tissue().state.values);
  config.run.last_stage = Stage::anneal;
  const Preparation annealed = prepare_tissue(config);
  CHECK(annealed.stage == Stage::anneal);
  CHECK(annealed.state.tissue.cell_count() == 7);
  CHECK(annealed.state.time == Approx(config.anneal.duration + config.anneal.relaxation_time));
  CHECK_FALSE(annealed.acceptance.wound_area);
}

TEST_CASE("A refused tissue is packed again, and every refusal is told", "[unit]") {
  Config config = small_config();
  config.packing.attempts = 2;
  config.wound.minimum_area = 50.0;
  int packings = 0, refusals = 0;
  const auto count_packings = [&](Stage stage, const TissueState&) { packings += stage == Stage::packing; };
  const auto count_refusals = [&](std::string_view, double, std::string_view text) {
    refusals += text.find("refused") != text.npos;
  };
  CHECK_THROWS_WITH(prepare_tissue(config, count_refusals, count_packings),
                    Catch::Contains("wound.minimum_area = 50") && Catch::Contains("packing.attempts = 2"));
  CHECK(packings == 2);
  CHECK(refusals == 2);

  // A limit between the wounds of the two attempts: the second is taken.
  config.wound.minimum_area = 0.0;
  config.run.last_stage = Stage::ablation;
  const double first_area = *prepare_tissue(config).acceptance.wound_area;
  config.wound.minimum_area = first_area + 1e-9;
  config.packing.attempts = 20;
  const Preparation later = prepare_tissue(config);
  CHECK(later.attempt > 0);
  CHECK(later.refused.size() == static_cast<std::size_t>(later.attempt));
  CHECK(*later.acceptance.wound_area > first_area);
}

TEST_CASE("The membrane's width is that of the whole tissue, also when the large cells are ablated", "[unit]") {
  Config config = small_config();
  config.cell_types = {{.name = "large", .cells = 2, .rest_area = 3.0}};
  const double width = *with_contact_distance(config).contact.distance;
  CHECK(width == Approx(make_tissue(config).mean_initial_rest_length()));
  CHECK(width > 1.01 * make_tissue(config).initial_rest_length(6 * 16));
  config.contact.distance = 0.2;
  CHECK(*with_contact_distance(config).contact.distance == 0.2);
}
