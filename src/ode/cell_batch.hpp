// Sixteen cells' part of the preconditioner. Factored in double precision, eight at a time; the factors are kept and
// applied in single precision.
#pragma once

#include <span>
#include <vector>

#include "kernels/aligned_buffer.hpp"
#include "kernels/kernels.hpp"
#include "ode/padded_tissue.hpp"
#include "suture/model/tissue.hpp"

namespace suture {

/// Room to factor eight cells of up to `rows` vertices, and to apply sixteen.
class FactorRoom {
 public:
  explicit FactorRoom(int rows);

  kernels::CyclicBatch matrix;
  kernels::CellRows rows;
  double *area_gradient = nullptr, *area_solution = nullptr;
  float* rhs = nullptr;

 private:
  AlignedBuffer buffer_;
};

class CellBatch {
 public:
  static constexpr int most_cells = kernels::CellFactors::cells;

  /// At most most_cells cells, of similar size.
  CellBatch(std::span<const int> cells, const Tissue& tissue);

  /// Factors I + gamma H at the linearisation held by `padded`. diagonal: (xx, xy, yy, unused) per slot, of everything that is
  /// not in the shells.
  void set_up(double gamma, const PaddedTissue& padded, const double* diagonal, const kernels::Table& kernel, FactorRoom& room);
  /// z = P^-1 r on the cells' vertices; `points`: from x to y.
  void apply(const double* r, double* z, std::size_t points, const kernels::Table& kernel, FactorRoom& room) const;

 private:
  struct Half {
    int begin, end;  ///< lanes with cells
  };
  void gather(Half half, const PaddedTissue& padded, const double* diagonal, FactorRoom& room) const;
  void close_ring(int lane, double gamma, const PaddedTissue& padded, FactorRoom& room) const;
  void factor_area(Half half, double gamma, const PaddedTissue& padded, const kernels::Table& kernel, FactorRoom& room);

  std::vector<int> cells_, counts_;
  kernels::CellLanes lanes_;
  kernels::CellFactors factors_;
  AlignedBuffer buffer_;
};

}  // namespace suture
