// The matrices of eight cells at once, from the second derivatives of their shells in lane order. theta_i depends on the
// vertices i-1, i, i+1 through N_{i-1}, -(N_{i-1} + N_i), N_i with N = dphi/de, so that row i of H is
//     (i, i)     S_{i-1} + S_i + k_b (N_{i-1} N_{i-1}^T + V_i V_i^T + N_i N_i^T),      V_i = -(N_{i-1} + N_i)
//     (i, i-1)   -S_{i-1} + k_b (V_{i-1} N_{i-1}^T + N_{i-1} V_i^T)^T + half the pressure, antisymmetric
//     (i, i-2)   k_b N_{i-1} N_{i-2}^T.

struct Direction8 {
  Double8 x, y;
};

SUTURE_INLINE void store_where(Mask8 keep, double* at, Double8 xx, Double8 xy, Double8 yx, Double8 yy) {
  const Double8 zero{};
  store(at, select(keep, xx, zero));
  store(at + lanes, select(keep, xy, zero));
  store(at + 2 * lanes, select(keep, yx, zero));
  store(at + 3 * lanes, select(keep, yy, zero));
}

/// Where CyclicBatch keeps block (row, row - distance), distance 1 or 2.
SUTURE_INLINE double* below_diagonal(const CyclicBatch& m, int row, int distance) {
  const int column = row - distance, border = row - (m.rows - 2);
  if (border < 0 || (border == 1 && distance == 1)) return (distance == 1 ? m.lower1 : m.lower2) + row * 4 * lanes;
  return m.border + (border * m.rows + column) * 4 * lanes;
}

void cell_rows8(const CellRows& c, double gamma, const CyclicBatch& m) {
  const Double8 lead = load(c.lead), kb = gamma * load(c.bending_stiffness), turn = 0.5 * gamma * load(c.pressure);
  std::fill_n(m.border, 2 * m.rows * 4 * lanes, 0.0);
  Double8 sxx = gamma * load(c.sxx - lanes), sxy = gamma * load(c.sxy - lanes), syy = gamma * load(c.syy - lanes);
  Direction8 n{load(c.nx - lanes), load(c.ny - lanes)}, n_before{}, v_before{};
  Mask8 used_once = first_lanes(0), used_twice = used_once;  // is this row's neighbour, the one before it, a vertex?
  for (int row = 0, at = 0; row < m.rows; ++row, at += lanes) {
    const Mask8 used = ~less(broadcast(row), lead);
    const Direction8 next{load(c.nx + at), load(c.ny + at)}, v{-n.x - next.x, -n.y - next.y};
    if (row >= 1)
      store_where(used_once, below_diagonal(m, row, 1), kb * (v_before.x * n.x + n.x * v.x) - sxx,
                  kb * (v_before.y * n.x + n.y * v.x) - sxy - turn, kb * (v_before.x * n.y + n.x * v.y) - sxy + turn,
                  kb * (v_before.y * n.y + n.y * v.y) - syy);
    if (row >= 2) {
      const Direction8 bend{kb * n_before.x, kb * n_before.y};
      store_where(used_twice, below_diagonal(m, row, 2), bend.x * n.x, bend.y * n.x, bend.x * n.y, bend.y * n.y);
    }
    const Double8 here_xx = gamma * load(c.sxx + at), here_xy = gamma * load(c.sxy + at), here_yy = gamma * load(c.syy + at);
    const Double8 xx = sxx + here_xx + kb * (n.x * n.x + v.x * v.x + next.x * next.x) + gamma * load(c.diagonal_xx + at);
    const Double8 xy = sxy + here_xy + kb * (n.x * n.y + v.x * v.y + next.x * next.y) + gamma * load(c.diagonal_xy + at);
    const Double8 yy = syy + here_yy + kb * (n.y * n.y + v.y * v.y + next.y * next.y) + gamma * load(c.diagonal_yy + at);
    double* diagonal = m.diagonal + 4 * at;
    store_where(used, diagonal, xx, xy, xy, yy);
    store(diagonal, load(diagonal) + 1.0);
    store(diagonal + 3 * lanes, load(diagonal + 3 * lanes) + 1.0);
    sxx = here_xx, sxy = here_xy, syy = here_yy;
    n_before = n, n = next, v_before = v;
    used_twice = used_once, used_once = used;
  }
}
