#include "ode/sparse_direct.hpp"

#include <algorithm>
#include <array>

namespace suture {

template <class Value>
void SparseDirect::add_element(std::span<const int> at, Value&& value) {
  for (std::size_t a = 0; a < at.size(); ++a)
    for (std::size_t b = 0; b < at.size(); ++b)
      if (at[a] >= at[b]) entries_.emplace_back(at[a], at[b], value(a, b));
}

template <class... Point>
auto SparseDirect::freedoms(Point... point) const {
  std::array<int, 2 * sizeof...(point)> at;
  int* next = at.data();
  ((*next++ = point, *next++ = points_ + point), ...);
  return at;
}

/// Membrane, bending and area of one cell, term by term: numerics.md and shell.inl say what each is.
void SparseDirect::add_shell(double gamma, int cell) {
  const kernels::ShellHessian& h = padded_->hessian;
  const int n = tissue_->vertex_count(cell), first = tissue_->first_vertex(cell), base = padded_->shell.base[cell] + 1;
  const double bending = gamma * padded_->shell.bending_stiffness[cell], half = 0.5 * gamma * h.pressure[cell];
  std::vector<int> all;
  std::vector<double> area_gradient;
  for (int i = 0; i < n; ++i) {
    const int s = base + i, here = first + i, next = first + (i + 1) % n, before = first + (i + n - 1) % n;
    const double segment[2][2] = {{gamma * h.sxx[s], gamma * h.sxy[s]}, {gamma * h.sxy[s], gamma * h.syy[s]}};
    add_element(freedoms(here, next), [&](std::size_t a, std::size_t b) {
      const bool same = a / 2 == b / 2;
      const double pressure = same || a % 2 == b % 2 ? 0.0 : (a / 2 == a % 2 ? half : -half);
      return (same ? 1.0 : -1.0) * segment[a % 2][b % 2] + pressure;
    });
    const double ux = h.nx[s - 1], uy = h.ny[s - 1], wx = h.nx[s], wy = h.ny[s];
    const double turning[6] = {ux, uy, -ux - wx, -uy - wy, wx, wy};  // d(theta_i)/dr
    add_element(freedoms(before, here, next), [&](std::size_t a, std::size_t b) { return bending * turning[a] * turning[b]; });
    for (const int k : freedoms(here)) all.push_back(k);
    area_gradient.insert(area_gradient.end(), {h.ax[s], h.ay[s]});
  }
  const double stiffness = gamma * h.area_curvature[cell];
  add_element(all, [&](std::size_t a, std::size_t b) { return stiffness * area_gradient[a] * area_gradient[b]; });
}

void SparseDirect::add_contact(double gamma, const kernels::ContactFactor& f) {
  const double s = 1.0 - f.t;
  const double along[6] = {f.nx, f.ny, -s * f.nx, -s * f.ny, -f.t * f.nx, -f.t * f.ny};
  add_element(freedoms(padded_->vertex(f.p), padded_->vertex(f.q), padded_->vertex(f.q + 1)),
              [&](std::size_t a, std::size_t b) { return gamma * along[a] * along[b]; });
}

void SparseDirect::add_extra(double gamma, const BlockList& extra) {
  for (const auto& [i, j, block] : extra.blocks) {
    const auto at = freedoms(i, j);
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b) {
        const int row = at[a], column = at[2 + b];
        if (i == j && row < column) continue;
        entries_.emplace_back(std::max(row, column), std::min(row, column), gamma * block[2 * a + b]);
      }
  }
  for (const BlockList::RankOne& r : extra.rank_ones) {
    std::vector<int> at;
    std::vector<double> gradient;
    for (std::size_t k = 0; k < r.gx.size(); ++k) {
      for (const int freedom : freedoms(r.first + static_cast<int>(k))) at.push_back(freedom);
      gradient.insert(gradient.end(), {r.gx[k], r.gy[k]});
    }
    add_element(at, [&](std::size_t a, std::size_t b) { return gamma * r.coefficient * gradient[a] * gradient[b]; });
  }
}

bool SparseDirect::factor(double gamma, int points, const ContactFactors& contacts, const BlockList& extra) {
  points_ = points;
  entries_.clear();
  for (int k = 0; k < 2 * points; ++k) entries_.emplace_back(k, k, 1.0);
  for (int cell = 0; cell < tissue_->cell_count(); ++cell) add_shell(gamma, cell);
  contacts.for_each([&](const kernels::ContactFactor& contact) { add_contact(gamma, contact); });
  add_extra(gamma, extra);
  Eigen::SparseMatrix<double> matrix(2 * points, 2 * points);
  matrix.setFromTriplets(entries_.begin(), entries_.end());
  solver_.compute(matrix);
  return solver_.info() == Eigen::Success && solver_.vectorD().minCoeff() > 0.0;
}

void SparseDirect::solve(std::span<const double> r, std::span<double> z) const {
  const Eigen::Map<const Eigen::VectorXd> rhs(r.data(), static_cast<Eigen::Index>(r.size()));
  Eigen::Map<Eigen::VectorXd>(z.data(), static_cast<Eigen::Index>(z.size())) = solver_.solve(rhs);
}

}  // namespace suture
