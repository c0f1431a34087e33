// Gradient and Hessian of chain and tethers, against Taylor's theorem; invariances; action and reaction.
#include <catch2/catch.hpp>
#include <functional>
#include <memory>
#include <numeric>

#include "suture/errors.hpp"
#include "suture/physics/purse_string_chain.hpp"
#include "suture/physics/purse_string_tethers.hpp"
#include "unit/purse_string/ring_fixture.hpp"

using namespace suture;
using namespace suture::test;

namespace {

/// Dense symmetric matrix over (all x, all y).
class DenseSink final : public HessianSink {
 public:
  explicit DenseSink(int points) : points_(points), matrix_(4ul * points * points, 0.0) {}
  void add_block(int i, int j, const Block& b) override {
    add(i, j, b);
    if (i != j) add(j, i, {b[0], b[2], b[1], b[3]});
  }
  void add_rank_one(int, double, std::span<const double>, std::span<const double>) override { FAIL("not expected"); }
  std::vector<double> times(const std::vector<double>& v) const {
    const int n = 2 * points_;
    std::vector<double> out(n, 0.0);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) out[i] += matrix_[i * n + j] * v[j];
    return out;
  }

 private:
  void add(int i, int j, const Block& b) {
    const int n = 2 * points_;
    matrix_[i * n + j] += b[0];
    matrix_[i * n + points_ + j] += b[1];
    matrix_[(points_ + i) * n + j] += b[2];
    matrix_[(points_ + i) * n + points_ + j] += b[3];
  }
  int points_;
  std::vector<double> matrix_;
};

std::vector<double> gradient_of(const EnergyTerm& term, double t, const TissueState& state) {
  std::vector<double> gradient(state.values.size(), 0.0);
  term.add_gradient(t, state.view(), MutableStateView(state.layout(), gradient));
  return gradient;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.begin() + static_cast<long>(std::min(a.size(), b.size())), b.begin(), 0.0);
}

std::vector<double> random_direction(std::size_t size, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> v(size);
  for (double& c : v) c = uniform(engine);
  return v;
}

struct Remainders {
  double energy = 0.0;    ///< |U(r + e v) - U - e g.v - e^2/2 v.H v|, of order e^3
  double gradient = 0.0;  ///< max |g(r + e v) - g - e H v|, of order e^2
};

Remainders taylor_remainders(const EnergyTerm& term, double t, const TissueState& state, double step) {
  const int points = state.layout().points();
  const std::vector<double> v = random_direction(2 * points, 11);
  DenseSink hessian(points);
  term.add_hessian(t, state.view(), hessian);
  const std::vector<double> curvature = hessian.times(v), gradient = gradient_of(term, t, state);
  TissueState moved = state;
  for (int i = 0; i < 2 * points; ++i) moved.values[i] += step * v[i];
  const std::vector<double> moved_gradient = gradient_of(term, t, moved);
  Remainders r;
  r.energy = std::abs(term.energy(t, moved.view()) - term.energy(t, state.view()) - step * dot(v, gradient) -
                      0.5 * step * step * dot(v, curvature));
  for (int i = 0; i < 2 * points; ++i)
    r.gradient = std::max(r.gradient, std::abs(moved_gradient[i] - gradient[i] - step * curvature[i]));
  return r;
}

/// Both remainders shrink at least as fast as they must when the step is halved, or are rounding errors.
bool derivatives_match(const EnergyTerm& term, double t, const TissueState& state) {
  const double step = 1e-4, rounding = 1e-13;
  const Remainders coarse = taylor_remainders(term, t, state, step), fine = taylor_remainders(term, t, state, step / 2);
  return (fine.gradient < coarse.gradient / 3.5 || coarse.gradient < rounding) &&
         (fine.energy < coarse.energy / 6.0 || coarse.energy < rounding);
}

/// Tethers of all lengths (in units of l_y, away from the kinks at 0.5 and 1) in all directions, some slipped.
TissueState stretched_state(const PurseStringParameters& parameters) {
  TissueState state = with_string(parameters, 3);
  const double lengths[] = {0.08, 0.2, 0.4, 0.62, 0.75, 0.9, 1.3};
  for (int j = 0; j < state.purse_string.size(); ++j) {
    stretch_tether(state, j, lengths[j % 7] * parameters.yield_length * contact_distance, 0.35 + 1.3 * j);
    if (j % 2) state.purse_string.mode[j] = TetherMode::slipped;
  }
  return state;
}

TissueState rotated(TissueState state, double angle) {
  const MutableStateView view = state.mutable_view();
  for (std::size_t i = 0; i < view.x.size(); ++i) {
    const double x = view.x[i], y = view.y[i];
    view.x[i] = std::cos(angle) * x - std::sin(angle) * y;
    view.y[i] = std::sin(angle) * x + std::cos(angle) * y;
  }
  return state;
}

const TetherLaw all_tether_laws[] = {TetherLaw::saturating_force, TetherLaw::saturating_energy, TetherLaw::published,
                                     TetherLaw::ramp};

struct Case {
  std::string label;
  TissueState state;
  std::unique_ptr<EnergyTerm> term;
  bool central = true;
};

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const SpringLaw law : {SpringLaw::relative, SpringLaw::quadratic}) {
    const PurseStringParameters parameters = ring_parameters(law);
    TissueState state = stretched_state(parameters);
    auto term = std::make_unique<PurseStringChain>(state.tissue, state.purse_string, parameters);
    cases.push_back(
        {law == SpringLaw::relative ? "chain, relative" : "chain, quadratic", std::move(state), std::move(term)});
  }
  for (const TetherLaw law : all_tether_laws) {
    PurseStringParameters parameters = ring_parameters();
    parameters.tether_law = law;
    TissueState state = stretched_state(parameters);
    auto term = std::make_unique<PurseStringTethers>(state.tissue, state.purse_string, parameters, contact_distance);
    cases.push_back({"tether law " + std::to_string(static_cast<int>(law)), std::move(state), std::move(term),
                     law != TetherLaw::published});
  }
  return cases;
}

/// A term whose gradient is off by one part in a thousand.
class Wrong final : public EnergyTerm {
 public:
  explicit Wrong(const EnergyTerm& right) : right_(right) {}
  std::string_view name() const override { return "wrong"; }
  double energy(double t, const StateView& s) const override { return 1.001 * right_.energy(t, s); }
  void add_gradient(double t, const StateView& s, MutableStateView g) const override { right_.add_gradient(t, s, g); }
  void add_hessian(double t, const StateView& s, HessianSink& h) const override { right_.add_hessian(t, s, h); }

 private:
  const EnergyTerm& right_;
};

}  // namespace

TEST_CASE("purse-string gradients and Hessians obey Taylor's theorem", "[property]") {
  const std::vector<Case> cases = all_cases();
  REQUIRE(cases.size() == 6);
  for (const Case& c : cases) {
    INFO(c.label);
    const double t = c.state.time + 0.4;
    REQUIRE(c.term->energy(t, c.state.view()) > 0.0);
    CHECK(derivatives_match(*c.term, t, c.state));
    CHECK_FALSE(derivatives_match(Wrong(*c.term), t, c.state));
  }
}

TEST_CASE("the rest lengths of the state take no part in the purse string", "[property]") {
  for (const Case& c : all_cases()) {
    const std::vector<double> gradient = gradient_of(*c.term, c.state.time, c.state);
    for (int s = 0; s < c.state.tissue.vertex_count(); ++s) CHECK(gradient[c.state.layout().rest_length(s)] == 0.0);
  }
}

TEST_CASE("chain and tethers exert no net force and no net torque", "[property]") {
  for (const Case& c : all_cases()) {
    INFO(c.label);
    std::vector<double> gradient = gradient_of(*c.term, c.state.time + 0.4, c.state);
    const MutableStateView g(c.state.layout(), gradient);
    const StateView r = c.state.view();
    double fx = 0.0, fy = 0.0, torque = 0.0, largest = 0.0;
    for (std::size_t i = 0; i < g.x.size(); ++i) {
      fx += g.x[i], fy += g.y[i], torque += r.x[i] * g.y[i] - r.y[i] * g.x[i];
      largest = std::max(largest, std::abs(g.x[i]));
    }
    REQUIRE(largest > 0.1);
    CHECK(std::abs(fx) < 1e-13);
    CHECK(std::abs(fy) < 1e-13);
    if (c.central)
      CHECK(std::abs(torque) < 1e-12);
    else
      CHECK(std::abs(torque) > 1e-3);
  }
}

TEST_CASE("all purse-string terms but the published tether are rotation invariant", "[property]") {
  for (const Case& c : all_cases()) {
    INFO(c.label);
    const double t = c.state.time + 0.4, angle = 1.1;
    const TissueState turned = rotated(c.state, angle);
    const double before = c.term->energy(t, c.state.view()), after = c.term->energy(t, turned.view());
    if (!c.central) {
      CHECK(std::abs(after - before) > 1e-3 * before);
      continue;
    }
    CHECK(after == Approx(before).epsilon(1e-13));
    TissueState gradient = c.state;
    gradient.values = gradient_of(*c.term, t, c.state);
    const std::vector<double> expected = rotated(gradient, angle).values, got = gradient_of(*c.term, t, turned);
    for (std::size_t i = 0; i < got.size(); ++i) CHECK(std::abs(got[i] - expected[i]) < 1e-12);
  }
}

TEST_CASE("splitting a straight spring in the middle keeps every force", "[property]") {
  const PurseStringParameters parameters = ring_parameters();
  TissueState state = with_string(parameters, 5);
  state.time += 0.6;  // under tension
  const int j = 4, V = state.tissue.vertex_count(), new_vertex = 1;
  MutableStateView view = state.mutable_view();
  view.x[new_vertex] = 0.5 * (view.x[V + j] + view.x[V + j + 1]);
  view.y[new_vertex] = 0.5 * (view.y[V + j] + view.y[V + j + 1]);
  const PurseStringChain whole(state.tissue, state.purse_string, parameters);
  const std::vector<double> before = whole.tensions(state.time, state.view());
  REQUIRE(before[j] > 0.01);
  const TissueState split = capture_vertices(state, {{new_vertex, j}}, {CaptureLaw::split});
  const PurseStringChain parts(split.tissue, split.purse_string, parameters);
  const std::vector<double> after = parts.tensions(split.time, split.view());
  CHECK(after[j] == Approx(before[j]).epsilon(1e-12));
  CHECK(after[j + 1] == Approx(before[j]).epsilon(1e-12));
  CHECK(parts.energy(split.time, split.view()) == Approx(whole.energy(state.time, state.view())).epsilon(1e-12));
  for (int k = 0; k < state.purse_string.size(); ++k)
    if (k != j) CHECK(after[k < j ? k : k + 1] == before[k]);

  const TissueState slack = capture_vertices(state, {{new_vertex, j}}, {CaptureLaw::tension_free});
  const std::vector<double> none =
      PurseStringChain(slack.tissue, slack.purse_string, parameters).tensions(slack.time, slack.view());
  CHECK(std::abs(none[j]) < 1e-13);
  CHECK(std::abs(none[j + 1]) < 1e-13);
}

TEST_CASE("tension_kept keeps the tension wherever the captured vertex lies, with both laws", "[property]") {
  for (const SpringLaw law : {SpringLaw::quadratic, SpringLaw::relative})
    for (const double wait : {0.6, -0.6}) {  // under tension, and compressed
      PurseStringParameters parameters = ring_parameters();
      parameters.law = law;
      parameters.minimum_rest_length = 0.01;
      TissueState state = with_string(parameters, 5);
      state.time += wait;
      const int j = 4, V = state.tissue.vertex_count(), first = 1, second = 2;
      MutableStateView view = state.mutable_view();
      const double dx = view.x[V + j + 1] - view.x[V + j], dy = view.y[V + j + 1] - view.y[V + j];
      view.x[first] = view.x[V + j] + 0.2 * dx - 0.7 * dy;  // far beside the spring, near one of its ends
      view.y[first] = view.y[V + j] + 0.2 * dy + 0.7 * dx;
      view.x[second] = view.x[V + j] + 0.8 * dx + 0.3 * dy;
      view.y[second] = view.y[V + j] + 0.8 * dy - 0.3 * dx;
      const PurseStringChain whole(state.tissue, state.purse_string, parameters);
      const std::vector<double> before = whole.tensions(state.time, state.view());
      REQUIRE(std::abs(before[j]) > 0.01);
      const auto captured = [&](CaptureLaw capture) {
        return capture_vertices(state, {{first, j}, {second, j}}, {capture, law});
      };
      const TissueState kept = captured(CaptureLaw::tension_kept);
      const PurseStringChain parts(kept.tissue, kept.purse_string, parameters);
      const std::vector<double> after = parts.tensions(kept.time, kept.view());
      for (int k = j; k <= j + 2; ++k) CHECK(after[k] == Approx(before[j]).epsilon(1e-11));
      if (law == SpringLaw::quadratic)
        CHECK(parts.energy(kept.time, kept.view()) == Approx(whole.energy(state.time, state.view())).epsilon(1e-11));
      // The halved spring does not: this is what the test must be able to see.
      const TissueState split = captured(CaptureLaw::split);
      const std::vector<double> raised =
          PurseStringChain(split.tissue, split.purse_string, parameters).tensions(split.time, split.view());
      CHECK(std::abs(raised[j] - before[j]) > 0.1 * std::abs(before[j]));
    }
}
