// A short closure, preconditioned cell by cell and with every matrix assembled and factored.
#include <catch2/catch.hpp>

#include "support/integration.hpp"
#include "support/setup_tissues.hpp"
#include "suture/setup/protocol.hpp"
#include "suture/simulate/closure.hpp"

using namespace suture;
using namespace suture::test;

namespace {

struct Unwatched final : ClosureObserver {
  void sample(const ClosureSample&) override {}
  void event(const EventRecord&) override { ++events; }
  int events = 0;
};

}  // namespace

TEST_CASE("a short closure comes out the same with both linear solvers", "[unit]") {
  Config config = small_config();
  config.run.last_stage = Stage::ablation;
  const TissueState wounded = prepare_tissue(config).state;
  config = with_contact_distance(config);
  config.run.end_time = 5.0;
  config.plasticity.tau = 3.0;
  config.integrator.tolerance = config.integrator.rest_length_tolerance = 1e-5;
  std::vector<ClosureResult> results;
  for (const LinearSolver solver : {LinearSolver::structured, LinearSolver::sparse_direct}) {
    config.integrator.linear_solver = solver;
    Unwatched observer;
    TissueState last_good;
    results.push_back(run_closure(config, wounded, observer, last_good));
    CAPTURE(static_cast<int>(solver), observer.events);
    CHECK(results.back().status == ClosureStatus::reached_end);
    CHECK(results.back().statistics.steps > 50);
  }
  const ClosureResult &structured = results[0], &direct = results[1];
  const double l0 = wounded.tissue.mean_initial_rest_length();
  CHECK(structured.state.values != direct.state.values);  // two ways were taken
  // The string is new, so only the cell vertices can be compared with what it began with.
  const auto vertices = static_cast<std::size_t>(wounded.tissue.vertex_count());
  CHECK(largest_difference(structured.state.view().x.first(vertices), wounded.view().x.first(vertices)) > 0.05 * l0);
  REQUIRE(structured.state.values.size() == direct.state.values.size());
  CHECK(rms_difference(structured.state.values, direct.state.values) < 10.0 * config.integrator.tolerance * l0);
  CHECK(direct.statistics.preconditioner_setups == direct.statistics.hessian_builds);
  CHECK(direct.statistics.linear_iterations < 1.1 * direct.statistics.newton_iterations);
}
