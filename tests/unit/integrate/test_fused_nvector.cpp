// Our N_Vector against plain loops, through the interface CVODE uses.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "integrate/fused_nvector.hpp"

using namespace suture;

namespace {

struct Fixture {
  explicit Fixture(std::size_t n) {
    SUNContext_Create(nullptr, &context);
    for (N_Vector* v : {&x, &y, &z, &w}) *v = make_fused_vector(n, context, std::make_shared<VectorFamily>());
    for (std::size_t k = 0; k < n; ++k) {
      values(x)[k] = std::sin(k + 1.0);
      values(y)[k] = 2.0 + std::cos(2.0 * k);
      values(w)[k] = 1.0 + 0.01 * k;
    }
  }
  ~Fixture() {
    for (N_Vector v : {x, y, z, w}) N_VDestroy(v);
    SUNContext_Free(&context);
  }
  template <class F>
  void check(F expected, double tolerance = 1e-14) {
    for (std::size_t k = 0; k < values(z).size(); ++k) CHECK(values(z)[k] == Approx(expected(k)).margin(tolerance));
  }
  SUNContext context = nullptr;
  N_Vector x = nullptr, y = nullptr, z = nullptr, w = nullptr;
};

}  // namespace

TEST_CASE("vector operations equal plain loops at every length", "[unit]") {
  for (const std::size_t n : {1, 7, 8, 9, 23, 64}) {
    Fixture f(n);
    CAPTURE(n);
    const auto x = values(f.x), y = values(f.y), w = values(f.w);
    CHECK(N_VGetLength(f.x) == static_cast<sunindextype>(n));
    CHECK(x.size() == n);
    N_VLinearSum(2.0, f.x, -0.5, f.y, f.z);
    f.check([&](auto k) { return 2.0 * x[k] - 0.5 * y[k]; });
    N_VProd(f.x, f.y, f.z);
    f.check([&](auto k) { return x[k] * y[k]; });
    N_VDiv(f.x, f.y, f.z);
    f.check([&](auto k) { return x[k] / y[k]; });
    N_VScale(-3.0, f.x, f.z);
    f.check([&](auto k) { return -3.0 * x[k]; });
    N_VAbs(f.x, f.z);
    f.check([&](auto k) { return std::abs(x[k]); });
    N_VInv(f.y, f.z);
    f.check([&](auto k) { return 1.0 / y[k]; });
    N_VAddConst(f.x, 4.0, f.z);
    f.check([&](auto k) { return x[k] + 4.0; });
    N_VConst(2.5, f.z);
    f.check([&](auto) { return 2.5; });
    CHECK(N_VWrmsNorm(f.z, f.w) > 0.0);  // a constant fill leaves no trace in the padding:
    double squares = 0.0, dot = 0.0, largest = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      squares += 2.5 * w[k] * 2.5 * w[k];
      dot += x[k] * y[k];
      largest = std::max(largest, std::abs(x[k]));
    }
    CHECK(N_VWrmsNorm(f.z, f.w) == Approx(std::sqrt(squares / n)).epsilon(1e-14));
    CHECK(N_VDotProd(f.x, f.y) == Approx(dot).epsilon(1e-13));
    CHECK(N_VMaxNorm(f.x) == largest);
  }
}

TEST_CASE("fused operations equal plain loops, in place too", "[unit]") {
  for (const std::size_t n : {5, 24, 33}) {
    Fixture f(n);
    const std::vector<double> x(values(f.x).begin(), values(f.x).end()), y(values(f.y).begin(), values(f.y).end()),
        w(values(f.w).begin(), values(f.w).end());
    double c[3] = {0.5, -1.5, 2.0};
    N_Vector terms[3] = {f.x, f.y, f.w};
    REQUIRE(N_VLinearCombination(3, c, terms, f.z) == 0);
    f.check([&](auto k) { return 0.5 * x[k] - 1.5 * y[k] + 2.0 * w[k]; });
    N_Vector clone = N_VClone(f.x);
    N_Vector results[2] = {f.z, clone};
    N_Vector sources[2] = {f.y, f.w};
    REQUIRE(N_VScaleAddMulti(2, c, f.x, sources, results) == 0);
    f.check([&](auto k) { return 0.5 * x[k] + y[k]; });
    for (std::size_t k = 0; k < n; ++k) CHECK(values(clone)[k] == Approx(-1.5 * x[k] + w[k]).margin(1e-14));
    N_VDestroy(clone);
    REQUIRE(N_VLinearCombination(3, c, terms, f.x) == 0);  // CVODE writes into the first term
    for (std::size_t k = 0; k < n; ++k)
      CHECK(values(f.x)[k] == Approx(0.5 * x[k] - 1.5 * y[k] + 2.0 * w[k]).margin(1e-14));
    N_Vector many[17];
    double ones[17];
    for (int j = 0; j < 17; ++j) many[j] = f.y, ones[j] = 1.0;
    CHECK(N_VLinearCombination(17, ones, many, f.z) != 0);  // refused, not overrun
  }
}

TEST_CASE("sums that wait have the bits of sums made at once", "[unit]") {
  for (const std::size_t n : {7, 512, 1300, 2048}) {
    CAPTURE(n);
    SUNContext context = nullptr;
    SUNContext_Create(nullptr, &context);
    const auto family = std::make_shared<VectorFamily>();
    constexpr int count = 5;
    std::vector<N_Vector> zn;
    std::vector<std::vector<double>> expected(count, std::vector<double>(n));
    for (int j = 0; j < count; ++j) {
      zn.push_back(make_fused_vector(n, context, family));
      for (std::size_t k = 0; k < n; ++k) values(zn[j])[k] = expected[j][k] = std::sin(k + 10.0 * j);
    }
    const auto same = [&](int j) {
      const std::span<const double> v = values(zn[j]);
      return std::equal(v.begin(), v.end(), expected[j].begin());
    };
    double scale = 0.7;
    for (int j = 1; j < count; ++j, scale *= 0.7) {  // as CVODE changes its step
      N_VScale(scale, zn[j], zn[j]);
      for (double& e : expected[j]) e = scale * e;
    }
    for (int again = 0; again < 4; ++again)  // and predicts: more sums than may wait
      for (int low = 1; low < count; ++low)
        for (int j = count - 1; j >= low; --j) {
          N_VLinearSum(1.0, zn[j - 1], 1.0, zn[j], zn[j - 1]);
          for (std::size_t k = 0; k < n; ++k) expected[j - 1][k] += expected[j][k];
        }
    for (int j = 0; j < count; ++j) CHECK(same(j));
    // Whoever writes a vector that a sum reads, or frees it, has that made first.
    N_VLinearSum(1.0, zn[0], 1.0, zn[1], zn[2]);
    for (std::size_t k = 0; k < n; ++k) expected[2][k] = expected[0][k] + expected[1][k];
    values(zn[0])[0] = expected[0][0] = 3.0;
    CHECK(same(2));
    N_VLinearSum(1.0, zn[0], 1.0, zn[1], zn[3]);
    for (std::size_t k = 0; k < n; ++k) expected[3][k] = expected[0][k] + expected[1][k];
    N_VConst(5.0, zn[1]);
    N_VDestroy(zn[0]);
    CHECK(same(3));
    N_VScale(2.0, zn[1], zn[2]);
    std::vector<int> source(n + 9, 0);
    family->rearrange(source);
    CHECK(values(zn[2]).size() == n + 9);
    CHECK(values(zn[2])[n + 8] == 10.0);
    for (int j = 1; j < count; ++j) N_VDestroy(zn[j]);
    SUNContext_Free(&context);
  }
}
