// No memory is asked for in the loops that run millions of times.
#include <atomic>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <new>

#include "support/integration.hpp"
#include "support/random_tissue.hpp"

namespace {

std::atomic<long> allocations{0};

void* counted(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size > 0 ? size : 1);
}

void* counted(std::size_t size) {
  if (void* p = counted(size, std::nothrow)) return p;
  throw std::bad_alloc();
}

}  // namespace

// Replaced for the whole executable: every new is counted, and none behaves differently. All forms without alignment, because
// the address sanitizer has its own of those that are missing and refuses what these delete.
void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void* operator new(std::size_t size, const std::nothrow_t& tag) noexcept { return counted(size, tag); }
void* operator new[](std::size_t size, const std::nothrow_t& tag) noexcept { return counted(size, tag); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }

using namespace suture;
using namespace suture::test;

namespace {

void check_evaluations(const TissueState& state, const ContactParameters& contact, double skin, int threads) {
  TissueOdeOptions options = ode_options(contact, SpringLaw::quadratic, true, skin);
  options.threads = threads;
  TissueOde ode(state.tissue, 0, options, {});
  const int n = ode.position_count();
  std::vector<double> out(state.values.size()), a(n, 0.1), b(n);
  const auto step = random_direction(state, 1, 0.02);
  auto there = state.values;
  for (std::size_t k = 0; k < there.size(); ++k) there[k] += step[k];
  const auto everything = [&](std::span<const double> y) {
    Evaluation worst = ode.rate(0.0, y, out);
    ode.begin_implicit_step(0.0, 0.01, y);
    if (ode.residual(y.first(n), b) != Evaluation::ok) worst = Evaluation::refused;
    ode.linearise();
    ode.product(a, b);
    ode.set_up_preconditioner();
    ode.precondition(a, b);
    return worst;
  };
  REQUIRE(everything(state.values) == Evaluation::ok);  // warm: both configurations, whose lists differ
  REQUIRE(everything(there) == Evaluation::ok);
  const long rebuilds = ode.list_rebuilds(), before = allocations;
  for (int k = 0; k < 3; ++k) {
    everything(state.values);
    everything(there);
  }
  const long during = allocations - before;
  CHECK(during == 0);
  CHECK(ode.list_rebuilds() == rebuilds + 6);  // rebuilding the list was part of it
}

}  // namespace

TEST_CASE("rate, residual, product and preconditioner allocate nothing once warm", "[unit]") {
  check_evaluations(random_tissue(12, {.rows = 3, .columns = 3, .minimum_vertices = 10, .maximum_vertices = 30, .roughness = 0.1}),
                    contact_law(0.2), 0.02, 1);
  const long start = allocations;
  const std::vector<double> one(3);
  const long counted_one = allocations - start;
  CHECK(counted_one == 1);
}

TEST_CASE("nor do they when threads share a large tissue", "[unit][threads]") {
  const TissueState state = random_tissue(
      5, {.rows = 38, .columns = 38, .minimum_vertices = 20, .maximum_vertices = 28, .spacing = 1.0, .roughness = 0.03});
  REQUIRE(state.tissue.vertex_count() > 32768);
  check_evaluations(state, contact_law(0.12), 0.02, 3);
}

TEST_CASE("steps of the integrators allocate nothing once warm", "[unit]") {
  const TissueState state = wavy_cell(20, {.tau = 1.0});
  for (const Method method : {Method::cvode, Method::rkc2, Method::rk4}) {
    TissueOde ode(state.tissue, 0, ode_options(contact_law(0.02)), {});
    IntegratorOptions options = with_tolerance(method, 1e-6);
    options.time_step = 1e-4;
    const auto integrator = make_integrator(ode, options, 0.0, state.values);
    for (int k = 0; k < 40; ++k) integrator->step(1e9);
    const long before = allocations;
    for (int k = 0; k < 40; ++k) integrator->step(1e9);
    const long during = allocations - before;  // the test's own words allocate
    CAPTURE(static_cast<int>(method));
    CHECK(during == 0);
    CHECK(integrator->statistics().steps == 80);
  }
}
