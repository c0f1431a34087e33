// The preconditioner of sixteen cells in single precision: it only has to be near the inverse, and what it reads, more than
// the first-level cache holds, is what its application waits for.

/// Rounds what eight cells were factored to into lanes 8 half .. 8 half + 7.
void narrow_cells(const CyclicBatch& m, const double* area_gradient, const double* area_solution, int half, const CellFactors& out) {
  const auto narrow = [&](const double* from, int count, float* to) {
    for (int k = 0; k < count; ++k) store_narrow(to + float_lanes * k + lanes * half, load(from + lanes * k));
  };
  const int blocks = 4 * m.rows;
  narrow(m.diagonal, blocks, out.diagonal);
  narrow(m.lower1, blocks, out.lower1);
  narrow(m.lower2, blocks, out.lower2);
  narrow(m.border, 2 * blocks, out.border);
  narrow(area_gradient, blocks / 2, out.area_gradient);
  narrow(area_solution, blocks / 2, out.area_solution);
}

/// visit_row(row, lane) for rows begin .. end-1 of the cells in use; visit_block(row) for sixteen rows of all cells at once.
/// The last block may repeat rows of the one before.
template <class Row, class Block>
SUTURE_INLINE void visit_rows(const CellLanes& l, int rows, const Row& visit_row, [[maybe_unused]] const Block& visit_block) {
  int singly = rows;
#if defined(__AVX512F__)
  if (rows - l.common >= float_lanes) {
    singly = l.common;  // before it some cells have not begun
    for (int row = l.common; row < rows; row += float_lanes) visit_block(row < rows - float_lanes ? row : rows - float_lanes);
  }
#endif
  for (int lane = 0; lane < l.cells; ++lane)
    for (int row = l.lead[lane]; row < singly; ++row) visit_row(row, lane);
}

/// One component into lane order; rows before a cell's first and lanes without a cell keep what they have.
SUTURE_INLINE void to_lanes(const CellLanes& l, const double* r, int rows, float* out) {
  visit_rows(
      l, rows, [&](int row, int lane) { out[2 * row * float_lanes + lane] = static_cast<float>(r[l.first[lane] + row - l.lead[lane]]); },
      [&]([[maybe_unused]] int row) {
#if defined(__AVX512F__)
        Float16 block[float_lanes];
        for (int lane = 0; lane < float_lanes; ++lane) block[lane] = load_narrow(r + l.first[lane] + row - l.lead[lane]);
        transpose(block);
        for (int k = 0; k < float_lanes; ++k) store(out + 2 * (row + k) * float_lanes, block[k]);
#endif
      });
}

/// And back, less `area` times the area's solution.
SUTURE_INLINE void from_lanes(const CellLanes& l, const float* in, const float* solution, const float* area, int rows, double* z) {
  visit_rows(
      l, rows,
      [&](int row, int lane) {
        const int k = 2 * row * float_lanes + lane;
        z[l.first[lane] + row - l.lead[lane]] = in[k] - area[lane] * solution[k];
      },
      [&]([[maybe_unused]] int row) {
#if defined(__AVX512F__)
        Float16 block[float_lanes];
        for (int k = 0; k < float_lanes; ++k) {
          const int at = 2 * (row + k) * float_lanes;
          block[k] = load(in + at) - load(area) * load(solution + at);
        }
        transpose(block);
        for (int lane = 0; lane < l.cells; ++lane) store_wide(z + l.first[lane] + row - l.lead[lane], block[lane]);
#endif
      });
}

void apply_cells(const CellFactors& f, const CellLanes& l, const double* r, double* z, std::size_t y, float* rhs) {
  to_lanes(l, r, f.rows, rhs);
  to_lanes(l, r + y, f.rows, rhs + float_lanes);
  cyclic_solve<Float16>(f, rhs);
  Float16 x_product{}, y_product{};
  for (int row = 0, at = 0; row < f.rows; ++row, at += 2 * float_lanes) {
    x_product += load(f.area_gradient + at) * load(rhs + at);
    y_product += load(f.area_gradient + at + float_lanes) * load(rhs + at + float_lanes);
  }
  alignas(64) float area[float_lanes];
  store(area, load(f.gain) * (x_product + y_product));
  from_lanes(l, rhs, f.area_solution, area, f.rows, z);
  from_lanes(l, rhs + float_lanes, f.area_solution + float_lanes, area, f.rows, z + y);
}
