// The batched factorisation of cyclic block-pentadiagonal matrices against dense Cholesky.
#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "kernels/aligned_buffer.hpp"
#include "support/runnable_tables.hpp"

using namespace suture;
using namespace suture::test;

namespace {

/// I + G^T G with second differences of random 2 x 2 blocks along a closed chain: symmetric, definite, cyclic band 2.
Eigen::MatrixXd random_cyclic(int n, std::mt19937& engine) {
  std::normal_distribution<double> normal;
  Eigen::MatrixXd m = Eigen::MatrixXd::Identity(2 * n, 2 * n);
  for (int i = 0; i < n; ++i) {
    Eigen::MatrixXd g = Eigen::MatrixXd::Zero(2, 2 * n);
    for (const int k : {0, 1, 2})
      for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b) g(a, 2 * ((i + k) % n) + b) += normal(engine);
    m += g.transpose() * g;
  }
  return m;
}

struct Batch {
  Batch(int rows, int lanes_in) : lanes(lanes_in), buffer(5u * rows * 4 * lanes_in + 64) {
    const std::size_t blocks = static_cast<std::size_t>(rows) * 4 * lanes;
    matrix.rows = rows;
    matrix.diagonal = buffer.take(blocks);
    matrix.lower1 = buffer.take(blocks);
    matrix.lower2 = buffer.take(blocks);
    matrix.border = buffer.take(2 * blocks);
  }
  void set(double* array, int block, int lane, const Eigen::Matrix2d& m) const {
    double* p = array + block * 4 * lanes + lane;
    p[0] = m(0, 0), p[lanes] = m(0, 1), p[2 * lanes] = m(1, 0), p[3 * lanes] = m(1, 1);
  }
  /// Stores a dense matrix by the layout kernels.hpp describes.
  void fill(int lane, const Eigen::MatrixXd& m) const {
    const int n = matrix.rows;
    const auto block = [&](int i, int j) -> Eigen::Matrix2d { return m.block<2, 2>(2 * i, 2 * j); };
    for (int i = 0; i < n; ++i) set(matrix.diagonal, i, lane, block(i, i));
    for (int i = 1; i < n - 2; ++i) set(matrix.lower1, i, lane, block(i, i - 1));
    for (int i = 2; i < n - 2; ++i) set(matrix.lower2, i, lane, block(i, i - 2));
    for (int k = 0; k < 2; ++k)
      for (int j = 0; j < n - 2; ++j) set(matrix.border, k * n + j, lane, block(n - 2 + k, j));
    set(matrix.lower1, n - 1, lane, block(n - 1, n - 2));
  }
  int lanes;
  AlignedBuffer buffer;
  kernels::CyclicBatch matrix;
};

}  // namespace

TEST_CASE("cyclic block-pentadiagonal systems are solved exactly, one or eight at once", "[unit]") {
  std::mt19937 engine(17);
  std::normal_distribution<double> normal;
  for (const kernels::Table* table : runnable_tables())
    for (const int n : {3, 4, 5, 6, 7, 8, 30, 31})
      for (const int lanes : {1, 8}) {
        const Batch batch(n, lanes);
        AlignedBuffer rhs(2u * n * lanes);
        std::vector<Eigen::VectorXd> expected;
        for (int lane = 0; lane < lanes; ++lane) {
          const Eigen::MatrixXd m = random_cyclic(n, engine);
          Eigen::VectorXd b(2 * n);
          for (double& v : b) v = normal(engine);
          batch.fill(lane, m);
          for (int k = 0; k < 2 * n; ++k) rhs.data()[k * lanes + lane] = b[k];
          expected.push_back(m.llt().solve(b));
        }
        (lanes == 1 ? table->cyclic_factor1 : table->cyclic_factor8)(batch.matrix);
        (lanes == 1 ? table->cyclic_solve1 : table->cyclic_solve8)(batch.matrix, rhs.data());
        double worst = 0.0;
        for (int lane = 0; lane < lanes; ++lane)
          for (int k = 0; k < 2 * n; ++k)
            worst = std::max(worst, std::abs(rhs.data()[k * lanes + lane] - expected[lane][k]));
        CAPTURE(table->name, n, lanes);
        CHECK(expected[0].norm() > 0.1);
        CHECK(worst < 1e-11);
      }
}

TEST_CASE("cells of different size share a batch when padded with identity rows", "[unit]") {
  std::mt19937 engine(3);
  const int rows = 12;
  const Batch batch(rows, 8);
  AlignedBuffer rhs(2u * rows * 8);
  std::vector<Eigen::VectorXd> expected;
  for (int lane = 0; lane < 8; ++lane) {
    const int n = 3 + lane, lead = rows - n;
    Eigen::MatrixXd m = Eigen::MatrixXd::Identity(2 * rows, 2 * rows);
    m.bottomRightCorner(2 * n, 2 * n) = random_cyclic(n, engine);
    batch.fill(lane, m);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(2 * rows);
    for (int k = 2 * lead; k < 2 * rows; ++k) b[k] = std::sin(k + lane);
    for (int k = 0; k < 2 * rows; ++k) rhs.data()[k * 8 + lane] = b[k];
    expected.push_back(m.llt().solve(b));
  }
  kernels::best().cyclic_factor8(batch.matrix);
  kernels::best().cyclic_solve8(batch.matrix, rhs.data());
  for (int lane = 0; lane < 8; ++lane)
    for (int k = 0; k < 2 * rows; ++k) CHECK(rhs.data()[k * 8 + lane] == Approx(expected[lane][k]).margin(1e-11));
}

TEST_CASE("an indefinite matrix still gives a definite preconditioner", "[unit]") {
  std::mt19937 engine(5);
  const int n = 9;
  const Batch batch(n, 1);
  const Eigen::MatrixXd m = random_cyclic(n, engine) - 1.5 * Eigen::MatrixXd::Identity(2 * n, 2 * n);
  REQUIRE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m).eigenvalues()[0] < -0.1);
  batch.fill(0, m);
  kernels::best().cyclic_factor1(batch.matrix);
  Eigen::MatrixXd inverse(2 * n, 2 * n);
  for (int k = 0; k < 2 * n; ++k) {
    AlignedBuffer rhs(2u * n);
    rhs.data()[k] = 1.0;
    kernels::best().cyclic_solve1(batch.matrix, rhs.data());
    for (int j = 0; j < 2 * n; ++j) inverse(j, k) = rhs.data()[j];
  }
  CHECK((inverse - inverse.transpose()).norm() < 1e-9 * inverse.norm());
  const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(inverse).eigenvalues();
  CHECK(eigenvalues[0] > 0.0);
}
