// Area, membrane and bending of every cell. With e_i = r_{i+1} - r_i, length l_i, direction angle phi_i and turning
// angle theta_i = phi_i - phi_{i-1}, the energy depends on the positions through e and the area only:
//     dU/de_i = T_i e_i/l_i + k_b (theta_i - theta_{i+1}) n_i/l_i,   n_i = e_i rotated by +90 degrees / l_i,
//     dU/dr_i = dU/de_{i-1} - dU/de_i + dU/da da/dr_i.

// A cell's slots 1 .. n fill whole vectors, aligned; the last one may go on into the slots that repeat the first vertices.
inline int padded_lanes(int n) { return (n + lanes - 1) / lanes * lanes; }

struct Tension {
  Double8 force, stiffness;
};

/// dU/dl at rest length `rest`, and its derivative along a line of rest lengths of slope b.
SUTURE_INLINE Tension tension(bool relative, Double8 k, Double8 rest, Double8 b, Double8 l) {
  if (!relative) return {k * (l - rest), k * (1.0 - b)};
  const Double8 over_rest = inverse(rest);
  const Double8 ratio = l * over_rest;
  const Double8 scale = k * over_rest * over_rest;
  return {k * over_rest * (ratio - 1.0), scale * (1.0 + b * (1.0 - 2.0 * ratio))};
}

/// tan(theta/4) of the signed turning angle from (ex0, ey0) to (ex1, ey1), lengths l0, l1.
SUTURE_INLINE Double8 quarter_tangent(Double8 ex0, Double8 ey0, Double8 l0, Double8 ex1, Double8 ey1, Double8 l1) {
  const Double8 cross = ex0 * ey1 - ey0 * ex1;
  const Double8 d = l0 * l1 + (ex0 * ex1 + ey0 * ey1);
  const Double8 h = d * d + cross * cross;
  return cross * inverse(d + h * inverse_square_root(h));
}

/// Lanes whose angle is beyond a right one, or degenerate: the polynomial does not serve them.
SUTURE_INLINE unsigned beyond_right_angle(Double8 quarter) { return bits(~(less(quarter, 0.4143) & less(-0.4143, quarter))); }

/// vector(k) for vectors of eight that begin at k and cover 0 .. n-1, the last two overlapping; one(k) for n < 8.
template <class Vector, class One>
SUTURE_INLINE void for_vectors(int n, Vector&& vector, One&& one) {
  if (n < lanes) {
    for (int k = 0; k < n; ++k) one(k);
    return;
  }
  for (int k = 0; k + lanes < n; k += lanes) vector(k);
  vector(n - lanes);
}

/// Slots 1 .. n of a cell and those that repeat them.
SUTURE_INLINE void fill_slots(const double* vertices, double* a, int n) {
  static_assert(suture::kernels::halo == lanes + 2);
  if (n <= lanes) {
    for (int k = 0; k < n; ++k) a[1 + k] = vertices[k];
    for (int k = 1; k < suture::kernels::halo; ++k) a[n + k] = a[k];
  } else {
    for (int k = 0; k + lanes <= n; k += lanes) store(a + 1 + k, load(vertices + k));
    store(a + 1 + n - lanes, load(vertices + n - lanes));
    store(a + n + 1, load(vertices));
    a[n + lanes + 1] = vertices[lanes];
  }
  a[0] = vertices[n - 1];
}

inline void segments_and_area(const Shell& s, int cell) {
  const int b = s.base[cell] + 1, n = s.count[cell];
  const Double8 x0 = broadcast(s.x[b]), y0 = broadcast(s.y[b]);
  Double8 twice_area{};
  for (int k = 0; k < n; k += lanes) {
    const int j = b + k;
    const Double8 x = load(s.x + j), y = load(s.y + j);
    const Double8 ex = load(s.x + j + 1) - x, ey = load(s.y + j + 1) - y;
    const Double8 l2 = ex * ex + ey * ey;
    const Double8 inverse = inverse_square_root(l2);
    store(s.ex + j, ex);
    store(s.ey + j, ey);
    store(s.length + j, select(less(0.0, l2), l2 * inverse, l2));  // an exact zero is reported as such
    store(s.inverse_length + j, inverse);
    twice_area += only(first_lanes(n - k), (x - x0) * ey - (y - y0) * ex);
  }
  s.area[cell] = 0.5 * sum(twice_area);
  for (double* a : {s.ex + b, s.ey + b, s.length + b}) a[-1] = a[n - 1];
}

/// Angles in (-pi, pi]. First all tangents, then the angles: one long chain of dependent operations per vector holds more of them
/// waiting than the processor has room for.
inline void turning_angles(const Shell& s, int cell) {
  const int b = s.base[cell] + 1, n = s.count[cell];
  for (int j = b; j < b + n; j += lanes)
    store(s.theta + j, quarter_tangent(load(s.ex + j - 1), load(s.ey + j - 1), load(s.length + j - 1), load(s.ex + j), load(s.ey + j),
                                       load(s.length + j)));
  for (int j = b; j < b + n; j += lanes) {
    const Double8 quarter = load(s.theta + j);
    store(s.theta + j, four_arctangents(quarter));
    for (unsigned left = beyond_right_angle(quarter); left != 0; left &= left - 1) [[unlikely]] {
      const int k = j + __builtin_ctz(left);
      s.theta[k] = std::atan2(s.ex[k - 1] * s.ey[k] - s.ey[k - 1] * s.ex[k], s.ex[k - 1] * s.ex[k] + s.ey[k - 1] * s.ey[k]);
    }
  }
  s.theta[b + n] = s.theta[b];
}

/// dU/dr from dU/de; false if a length or rest length is not positive.
inline bool segment_forces(const Shell& s, int cell, bool rest_lengths_held) {
  const int b = s.base[cell] + 1, n = s.count[cell], last = padded_lanes(n) - lanes;
  const Double8 kb = broadcast(s.bending_stiffness[cell]);
  const double strain = s.area[cell] / s.rest_area[cell] - 1.0;
  const Double8 half_pressure = broadcast(0.5 * s.area_stiffness[cell] * strain / s.rest_area[cell]);
  Mask8 positive = first_lanes(lanes);  // slots beyond the vertices repeat them: no need to leave them out
  const auto of_segments = [&](int j) -> Pairs8 {
    const Double8 ex = load(s.ex + j), ey = load(s.ey + j), inverse = load(s.inverse_length + j), l = load(s.length + j);
    const Double8 rest = rest_lengths_held ? load(s.rest_a + j) : load(s.rest_a + j) + load(s.rest_b + j) * l;
    positive = positive & less(0.0, l) & less(0.0, rest);
    const Double8 along = tension(s.relative_law, load(s.stiffness + j), rest, Double8{}, l).force * inverse;
    const Double8 across = kb * (load(s.theta + j) - load(s.theta + j + 1)) * inverse * inverse;
    return {along * ex - across * ey, along * ey + across * ex};
  };
  const Pairs8 at_end = of_segments(b + last);
  Pairs8 before{broadcast(at_end.x[n - 1 - last]), broadcast(at_end.y[n - 1 - last])};  // of its last lane
  for (int k = 0; k <= last; k += lanes) {
    const int j = b + k;
    const Pairs8 here = k == last ? at_end : of_segments(j);
    const Double8 ex = load(s.ex + j) + load(s.ex + j - 1), ey = load(s.ey + j) + load(s.ey + j - 1);
    const Mask8 own = first_lanes(n - k);
    store_pairs(s.gradient + 2 * j, only(own, shift_in(before.x, here.x) - here.x + half_pressure * ey),
                only(own, shift_in(before.y, here.y) - here.y - half_pressure * ex));
    before = here;
  }
  static_assert(2 * contact_halo == lanes);
  if (last + lanes < n + contact_halo) store(s.gradient + 2 * (b + last + lanes), Double8{});
  return bits(~positive) == 0;
}

inline void rest_length_rate(const Shell& s, int cell, const double* rest, const RestLengthFlow& flow, std::size_t vertex) {
  const double *length = s.length + s.base[cell] + 1, *reference = flow.reference + vertex;
  double* rate = flow.rate + vertex;
  const double inverse_tau = flow.inverse_tau[cell], memory = flow.memory[cell];
  if (memory == 0.0) {  // the same value, and the reference is not read
    for_vectors(
        s.count[cell], [&](int k) { store(rate + k, -inverse_tau * (load(rest + k) - load(length + k))); },
        [&](int k) { rate[k] = -inverse_tau * (rest[k] - length[k]); });
    return;
  }
  for_vectors(
      s.count[cell],
      [&](int k) {
        const Double8 l = load(length + k);
        store(rate + k, -inverse_tau * ((load(rest + k) - l) + memory * (l - load(reference + k))));
      },
      [&](int k) { rate[k] = -inverse_tau * ((rest[k] - length[k]) + memory * (length[k] - reference[k])); });
}

/// The shell with its segments in `room`, which begins with the slots of cell `first`.
inline Shell in_room(Shell s, const ShellInput& in, int first) {
  if (in.room.data == nullptr) return s;
  double* array = in.room.data + 7 - s.base[first];  // slot 1 is aligned here, too
  for (double** own : {&s.ex, &s.ey, &s.length, &s.inverse_length, &s.theta}) {
    *own = array;
    array += in.room.stride;
  }
  if (in.rest_length != nullptr) s.rest_a = array;
  return s;
}

bool shell_gradient(const Shell& all, const ShellInput& in) {
  // Every pass reads its predecessor's results at shifted addresses, which a store just made would hold up. A few cells at
  // a time, pass after pass, leave time for it, and stay in the first-level cache.
  bool healthy = true;
  std::size_t vertex = 0, flowing = 0;
  for (int first = 0; first < all.cells; first += SegmentRoom::cells) {
    const int end = std::min(first + SegmentRoom::cells, all.cells);
    const Shell s = in_room(all, in, first);
    for (int cell = first; cell < end; ++cell) {
      const int b = s.base[cell], n = s.count[cell];
      fill_slots(in.x + vertex, s.x + b, n);
      fill_slots(in.y + vertex, s.y + b, n);
      if (in.rest_length != nullptr) fill_slots(in.rest_length + vertex, s.rest_a + b, n);
      vertex += n;
    }
    for (int cell = first; cell < end; ++cell) segments_and_area(s, cell);
    for (int cell = first; cell < end; ++cell) turning_angles(s, cell);
    for (int cell = first; cell < end; ++cell) healthy &= segment_forces(s, cell, in.rest_length != nullptr) & (s.area[cell] > 0.0);
    if (in.flow.rate == nullptr) continue;
    for (int cell = first; cell < end; flowing += s.count[cell++]) rest_length_rate(s, cell, in.rest_length + flowing, in.flow, flowing);
  }
  return healthy;
}

void shell_segments(const Shell& s) {
  for (int cell = 0; cell < s.cells; ++cell) {
    segments_and_area(s, cell);
    turning_angles(s, cell);
  }
}

/// d2U/de_i2 = K m m^T + (T/l) n n^T - (M/l^2)(m n^T + n m^T) + (bending: k_b along d(theta)), with m = e/l and
/// M = dU/dphi. A compressed segment's negative T/l is left out: the Newton matrix stays definite, the gradient is exact.
void shell_linearise(const Shell& s, const ShellHessian& h) {
  for (int cell = 0; cell < s.cells; ++cell) {
    const int b = s.base[cell] + 1, n = s.count[cell];
    const Double8 kb = broadcast(s.bending_stiffness[cell]);
    for (int j = b; j < b + n; j += lanes) {
      const Double8 inverse = load(s.inverse_length + j);
      const Double8 mx = load(s.ex + j) * inverse, my = load(s.ey + j) * inverse;
      const Double8 l = load(s.length + j), slope = load(s.rest_b + j);
      const Tension t = tension(s.relative_law, load(s.stiffness + j), load(s.rest_a + j) + slope * l, slope, l);
      const Double8 geometric = maximum(t.force, Double8{}) * inverse;
      const Double8 moment = kb * (load(s.theta + j) - load(s.theta + j + 1)) * inverse * inverse;
      store(h.sxx + j, t.stiffness * mx * mx + geometric * my * my + 2.0 * moment * mx * my);
      store(h.sxy + j, (t.stiffness - geometric) * mx * my - moment * (mx * mx - my * my));
      store(h.syy + j, t.stiffness * my * my + geometric * mx * mx - 2.0 * moment * mx * my);
      store(h.nx + j, -my * inverse);
      store(h.ny + j, mx * inverse);
      store(h.ax + j, 0.5 * (load(s.ey + j) + load(s.ey + j - 1)));
      store(h.ay + j, -0.5 * (load(s.ex + j) + load(s.ex + j - 1)));
    }
    for (double* a : {h.nx + b, h.ny + b}) a[-1] = a[n - 1], a[n] = a[0];
    const double a0 = s.rest_area[cell];
    h.area_curvature[cell] = s.area_stiffness[cell] / (a0 * a0);
    h.pressure[cell] = s.area_stiffness[cell] * (s.area[cell] / a0 - 1.0) / a0;
  }
}

/// Works in gx, gy.
void shell_product(const Shell& s, const ShellHessian& h) {
  for (int cell = 0; cell < s.cells; ++cell) {
    const int b = s.base[cell] + 1, n = s.count[cell];
    const Double8 kb = broadcast(s.bending_stiffness[cell]);
    Double8 area_change{};
    double* turn = h.ox;                  // change of direction of each segment, until the last pass
    for (int k = 0; k < n; k += lanes) {
      const int j = b + k;
      const Double8 wx = load(h.vx + j + 1) - load(h.vx + j), wy = load(h.vy + j + 1) - load(h.vy + j);
      store(turn + j, load(h.nx + j) * wx + load(h.ny + j) * wy);
      area_change += only(first_lanes(n - k), load(h.ax + j) * load(h.vx + j) + load(h.ay + j) * load(h.vy + j));
    }
    turn[b - 1] = turn[b + n - 1];
    turn[b + n] = turn[b];
    for (int j = b; j < b + n; j += lanes) {
      const Double8 wx = load(h.vx + j + 1) - load(h.vx + j), wy = load(h.vy + j + 1) - load(h.vy + j);
      const Double8 bend = kb * (2.0 * load(turn + j) - load(turn + j - 1) - load(turn + j + 1));
      store(s.gx + j, load(h.sxx + j) * wx + load(h.sxy + j) * wy + bend * load(h.nx + j));
      store(s.gy + j, load(h.sxy + j) * wx + load(h.syy + j) * wy + bend * load(h.ny + j));
    }
    s.gx[b - 1] = s.gx[b + n - 1];
    s.gy[b - 1] = s.gy[b + n - 1];
    const Double8 rank_one = broadcast(h.area_curvature[cell] * sum(area_change));
    const Double8 half_pressure = broadcast(0.5 * h.pressure[cell]);
    for (int j = b; j < b + n; j += lanes) {
      const Double8 turn_x = load(h.vx + j + 1) - load(h.vx + j - 1), turn_y = load(h.vy + j + 1) - load(h.vy + j - 1);
      store(h.ox + j, load(s.gx + j - 1) - load(s.gx + j) + rank_one * load(h.ax + j) + half_pressure * turn_y);
      store(h.oy + j, load(s.gy + j - 1) - load(s.gy + j) + rank_one * load(h.ay + j) - half_pressure * turn_x);
    }
    for (double* o : {h.ox + b, h.oy + b}) {
      o[-1] = 0.0;
      for (int k = 0; k < suture::kernels::halo - 1; ++k) o[n + k] = 0.0;
    }
  }
}

/// values <- slots 1 .. n with what was added to the slots that repeat them.
void fold_cells(const Shell& s, double* padded, double* values) {
  for (int cell = 0; cell < s.cells; ++cell) {
    double* a = padded + s.base[cell];
    const int n = s.count[cell];
    if (n <= lanes) {
      for (int k = suture::kernels::halo - 1; k >= 1; --k) a[k] += a[n + k];
      a[n] += a[0];
      for (int k = 0; k < n; ++k) values[k] = a[1 + k];
    } else {
      const Double8 folded = load(a + 1) + load(a + n + 1);
      a[lanes + 1] += a[n + lanes + 1];
      a[n] += a[0];
      store(values, folded);
      for (int k = lanes; k + lanes <= n; k += lanes) store(values + k, load(a + 1 + k));
      for (int k = n - n % lanes; k < n; ++k) values[k] = a[1 + k];
    }
    values += n;
  }
}

void fold_gradient(const Shell& s, double* gx, double* gy) {
  for (int cell = 0; cell < s.cells; ++cell) {
    const int b = s.base[cell] + 1, n = s.count[cell];
    double* g = s.gradient + 2 * b;
    if (n >= contact_halo) {
      static_assert(2 * contact_halo == lanes);
      store(g, load(g) + load(g + 2 * n));
    } else {
      for (int k = 2 * contact_halo - 1; k >= 0; --k) g[k] += g[2 * n + k];
    }
    for_vectors(
        n,
        [&](int k) {
          const Pairs8 pairs = load_pairs(g + 2 * k);
          store(gx + k, pairs.x);
          store(gy + k, pairs.y);
        },
        [&](int k) { gx[k] = g[2 * k], gy[k] = g[2 * k + 1]; });
    gx += n, gy += n;
  }
}

void rest_lengths(const Shell& s, const RestLengthLine& line) {
  std::size_t first = 0;
  for (int cell = 0; cell < s.cells; ++cell) {
    const int n = s.count[cell];
    const double *x = line.x + first, *y = line.y + first, *a = s.rest_a + s.base[cell] + 1, *b = s.rest_b + s.base[cell] + 1;
    double* out = line.rest_length + first;
    const auto one = [&](int k, int next) {
      const double dx = x[next] - x[k], dy = y[next] - y[k];
      out[k] = a[k] + b[k] * std::sqrt(dx * dx + dy * dy);
    };
    for_vectors(
        n - 1,
        [&](int k) {
          const Double8 dx = load(x + k + 1) - load(x + k), dy = load(y + k + 1) - load(y + k);
          store(out + k, load(a + k) + load(b + k) * square_root(dx * dx + dy * dy));
        },
        [&](int k) { one(k, k + 1); });
    one(n - 1, 0);
    first += n;
  }
}
