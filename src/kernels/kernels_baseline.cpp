#include <algorithm>
#include <cstddef>
#include <utility>

#include "kernels/kernels.hpp"
#include "kernels/vector16.hpp"
#include "kernels/vector8.hpp"
#include "kernels/lane_moves.hpp"

namespace {

using namespace suture::kernels;

#include "kernels/cell_rows.inl"
#include "kernels/contact_terms.inl"
#include "kernels/contact.inl"
#include "kernels/cyclic.inl"
#include "kernels/cell_factors.inl"
#include "kernels/near_boxes.inl"
#include "kernels/near_windows.inl"
#include "kernels/shell.inl"
#include "kernels/vectors.inl"

}  // namespace

namespace suture::kernels {

const Table baseline{"baseline",           shell_gradient,    shell_segments,  shell_linearise, shell_product, fold_cells, fold_gradient, rest_lengths,
                    contact_gradient, contact_linearise, contact_product, contact_diagonal, cell_rows8, segment_boxes, near_boxes, near_windows, near_pairs,
                    narrow_cells,     apply_cells,
                    cyclic_factor1,   cyclic_factor8,    cyclic_solve1,   cyclic_solve8,
                    weighted_square_sum, dot, subtract_and_dot, add_and_largest, add_scaled_twice, linear_sum, linear_combination, scale_add_multi, largest_move2, finite,
                    implicit_residual, negate};

}  // namespace suture::kernels
