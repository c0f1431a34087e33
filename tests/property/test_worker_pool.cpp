// Every task once, whoever takes it; what a task throws arrives.
#include <catch2/catch.hpp>
#include <stdexcept>
#include <thread>
#include <vector>

#include "integrate/vector_operations.hpp"
#include "threads/ranges.hpp"
#include "threads/worker_pool.hpp"

using namespace suture;

TEST_CASE("a pool runs every task once", "[property][threads]") {
  for (const int threads : {1, 2, 3, 5}) {
    WorkerPool pool(threads);
    CHECK(pool.threads() == threads);
    std::vector<int> done(100, 0);
    long wrong = 0;
    for (int run = 1; run <= 3000; ++run) {  // more runs than sleeping threads can follow
      const int count = run % 100;
      pool.for_each(count, [&](int k) { ++done[k]; });
      for (int k = 0; k < 100; ++k) wrong += done[k] != (k < count ? 1 : 0);
      done.assign(100, 0);
    }
    CHECK(wrong == 0);
  }
  CHECK(WorkerPool(0).threads() == static_cast<int>(std::thread::hardware_concurrency()));
  CHECK(WorkerPool::alone().threads() == 1);
}

TEST_CASE("what a task throws is thrown by the pool, which stays usable", "[property][threads]") {
  for (const int threads : {1, 3}) {
    WorkerPool pool(threads);
    for (int run = 0; run < 50; ++run) {
      CHECK_THROWS_AS(pool.for_each(40, [&](int k) { if (k == run % 40) throw std::runtime_error("task"); }), std::runtime_error);
      std::vector<int> done(40, 0);
      pool.for_each(40, [&](int k) { done[k] = 1; });
      CHECK(done == std::vector<int>(40, 1));
    }
  }
}

TEST_CASE("ranges cover everything once, and short vectors are not divided", "[property][threads]") {
  for (const std::size_t n : {0u, 1u, 8u, 98303u, 98304u, 500001u, 40000003u}) {
    const Ranges ranges = vector_ranges(n);
    REQUIRE(ranges.count() <= most_vector_ranges);
    CHECK((ranges.count() > 1) == (n >= 3u * divided_from_vertices));
    std::size_t end = 0;
    for (int k = 0; k < ranges.count(); ++k) {
      CHECK(ranges[k].begin == end);
      CHECK((ranges[k].end > end && (ranges.count() == 1 || ranges[k].begin % 8 == 0)));
      end = ranges[k].end;
    }
    CHECK(end == n);
  }
}

TEST_CASE("long vector operations have the same bits for every number of threads", "[property][threads]") {
  constexpr std::size_t n = 200000;
  std::vector<double> x(n), y(n), z(n), expected(n);
  for (std::size_t k = 0; k < n; ++k) x[k] = std::sin(1.3 * static_cast<double>(k)), y[k] = std::cos(0.7 * static_cast<double>(k));
  const VectorOperations alone(WorkerPool::alone());
  const double dot = alone.dot(n, x.data(), y.data()), norm = alone.weighted_square_sum(n, x.data(), y.data());
  const double coefficients[] = {0.3, -1.7};
  const double* const vectors[] = {x.data(), y.data()};
  alone.linear_combination(n, 2, coefficients, vectors, expected.data());
  CHECK(expected[n - 1] == Approx(0.3 * x[n - 1] - 1.7 * y[n - 1]));
  for (const int threads : {2, 3, 5}) {
    WorkerPool pool(threads);
    const VectorOperations shared(pool);
    for (int again = 0; again < 20; ++again) {
      CHECK(shared.dot(n, x.data(), y.data()) == dot);
      CHECK(shared.weighted_square_sum(n, x.data(), y.data()) == norm);
      shared.linear_combination(n, 2, coefficients, vectors, z.data());
      CHECK(z == expected);
    }
  }
}
