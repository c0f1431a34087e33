// The packings of the published simulations: 50 cells that stay one confluent patch when the wall goes and whose wound
// has the published size (model.md section 6). `test_validation "[packings]"` prints the table of
// docs/explanation/protocol.md.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <cstring>

#include "suture/setup/protocol.hpp"

using namespace suture;

namespace {

struct Row {
  Preparation preparation;
  double packing_seconds = 0.0, total_seconds = 0.0, hole_before = 0.0;
};

Row prepare(double area_stiffness, double tau, std::uint64_t seed) {
  Config config;
  config.area.stiffness = area_stiffness;
  config.plasticity.tau = tau;
  config.tissue.seed = seed;
  config.packing.attempts = 1;
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  Row row;
  row.preparation = prepare_tissue(config, {}, [&](Stage stage, const TissueState& state) {
    if (stage == Stage::packing) row.packing_seconds = seconds();
    if (stage == Stage::anneal) row.hole_before = judge_annealed(config, state).largest_hole;
  });
  row.total_seconds = seconds();
  return row;
}

void check(const Row& row) {
  const Acceptance& verdict = row.preparation.acceptance;
  CHECK(row.preparation.packing.fraction == Approx(PackingParameters{}.final_fraction).margin(5e-3));
  CHECK(verdict.accepted);
  CHECK(verdict.largest_hole < 0.05);
  REQUIRE(verdict.wound_area);
  CHECK(*verdict.wound_area > 5.0);
  CHECK(*verdict.wound_area < 6.5);
  CHECK(row.preparation.state.tissue.cell_count() == 45);
}

}  // namespace

TEST_CASE("Embryo and wing-disc packings are accepted at the first attempt", "[validation]") {
  check(prepare(16.0, 9.6, 1));
  check(prepare(32.0, 1228.8, 2));
}

TEST_CASE("The whole preparation gives the same bits twice", "[validation]") {
  const Row row = prepare(16.0, 9.6, 3);
  check(row);
  const Preparation &first = row.preparation, second = prepare(16.0, 9.6, 3).preparation;
  REQUIRE(first.state.values.size() == second.state.values.size());
  CHECK(std::memcmp(first.state.values.data(), second.state.values.data(),
                    first.state.values.size() * sizeof(double)) == 0);
}

TEST_CASE("All 25 packings of both tissues are accepted at the first attempt", "[.slow][packings]") {
  struct Tissue {
    const char* name;
    double area_stiffness, tau;
  };
  fmt::print(
      "| tissue | seed | packing fraction | packing s | all stages s | largest hole annealed | ablated | wound area "
      "|\n");
  fmt::print("|---|---|---|---|---|---|---|---|\n");
  for (const Tissue& tissue : {Tissue{"embryo", 16.0, 9.6}, Tissue{"wing disc", 32.0, 1228.8}})
    for (std::uint64_t seed = 1; seed <= 25; ++seed) {
      const Row row = prepare(tissue.area_stiffness, tissue.tau, seed);
      const Acceptance& verdict = row.preparation.acceptance;
      fmt::print("| {} | {} | {:.4f} | {:.2f} | {:.2f} | {:.3f} | {:.3f} | {:.3f} |\n", tissue.name, seed,
                 row.preparation.packing.fraction, row.packing_seconds, row.total_seconds, row.hole_before,
                 verdict.largest_hole, *verdict.wound_area);
      check(row);
    }
}
