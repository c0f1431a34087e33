// The smooth-membrane contact as one inclusion-exclusion sum (model.md section 3). Segment k of the chain contributes
//     [0 < t_k < 1] u(segment k)  -  [t_k > 0] u(point k)  +  [t_k >= 1] u(point k + 1),
// which is zero when the segment is out of reach, so a window may hold any superset of the segments that matter.

/// u'(d)/d and u''(d) of the law at squared distance d2 < cutoff2.
inline Double8 force_over_distance(const ContactScalars& c, Double8 d2) {
  const Mask8 inner = d2 < c.inner2;
  const Double8 inverse = 1.0 / square_root(d2);
  return select(inner, broadcast(c.inner_a), broadcast(c.outer_a)) * inverse +
         select(inner, broadcast(c.inner_b), broadcast(c.outer_b));
}

struct WindowState {
  Double8 dx, dy, ex, ey, t, segment_d2, point_d2, sign;
  Mask8 segment, point;  ///< live lanes
};

inline WindowState classify(const Shell& s, const ContactScalars& c, const Window& w, double px, double py) {
  WindowState v;
  const Mask8 lane = Mask8{0, 1, 2, 3, 4, 5, 6, 7};
  const Mask8 listed = lane < static_cast<long long>(w.segments);
  v.dx = px - load(s.x + w.q);
  v.dy = py - load(s.y + w.q);
  v.ex = load(s.ex + w.q);
  v.ey = load(s.ey + w.q);
  const Double8 inverse2 = load(s.inverse_length2 + w.q);
  v.t = (v.dx * v.ex + v.dy * v.ey) * inverse2;
  const Mask8 after_start = (v.t > 0.0) & listed;
  const Mask8 after_end = (v.t >= 1.0) & listed;
  const Mask8 previous_after_end = shift_up(after_end);
  const Double8 cross = v.dx * v.ey - v.dy * v.ex;
  v.segment_d2 = cross * cross * inverse2;
  v.point_d2 = v.dx * v.dx + v.dy * v.dy;
  v.segment = after_start & ~after_end & (v.segment_d2 < c.cutoff2);
  v.point = (after_start ^ previous_after_end) & (v.point_d2 < c.cutoff2);
  v.sign = select(previous_after_end, broadcast(1.0), broadcast(-1.0));
  return v;
}

void contact_gradient(const Shell& s, const ContactScalars& c, const Window* windows, std::size_t window_count,
                      const SelfPair* pairs, std::size_t pair_count) {
  Double8 sum_x{}, sum_y{};  // of the windows of one vertex, which follow one another
  for (std::size_t k = 0; k < window_count; ++k) {
    const Window& w = windows[k];
    if (k > 0 && w.p != windows[k - 1].p) {
      s.gx[windows[k - 1].p] += sum(sum_x);
      s.gy[windows[k - 1].p] += sum(sum_y);
      sum_x = sum_y = Double8{};
    }
    const WindowState v = classify(s, c, w, s.x[w.p], s.y[w.p]);
    const Mask8 live = v.segment | v.point;
    if (!any(live)) continue;
    // A lane is mostly a segment or a point; the rare lane that is both gets its point added below.
    const Double8 t = select(v.segment, v.t, Double8{});
    Double8 f = force_over_distance(c, select(v.segment, v.segment_d2, v.point_d2));
    f = select(live, select(v.segment, f, f * v.sign), Double8{});
    Double8 fx = f * (v.dx - t * v.ex), fy = f * (v.dy - t * v.ey);
    const Double8 ahead_x = t * fx, ahead_y = t * fy;
    Double8 on_x = fx - ahead_x, on_y = fy - ahead_y;
    const Mask8 both = v.segment & v.point;
    if (any(both)) {
      const Double8 g = select(both, force_over_distance(c, v.point_d2) * v.sign, Double8{});
      const Double8 hx = g * v.dx, hy = g * v.dy;
      fx += hx, fy += hy, on_x += hx, on_y += hy;
    }
    sum_x += fx;
    sum_y += fy;
    store(s.gx + w.q, load(s.gx + w.q) - (on_x + shift_up(ahead_x)));
    store(s.gy + w.q, load(s.gy + w.q) - (on_y + shift_up(ahead_y)));
  }
  if (window_count > 0) {
    s.gx[windows[window_count - 1].p] += sum(sum_x);
    s.gy[windows[window_count - 1].p] += sum(sum_y);
  }
  for (std::size_t k = 0; k < pair_count; ++k) {
    const auto [i, j] = pairs[k];
    const double dx = s.x[i] - s.x[j], dy = s.y[i] - s.y[j], d2 = dx * dx + dy * dy;
    if (d2 >= c.self2) continue;
    const double f = c.inner_a / std::sqrt(d2) + c.inner_b;
    s.gx[i] += f * dx, s.gy[i] += f * dy;
    s.gx[j] -= f * dx, s.gy[j] -= f * dy;
  }
}

/// A point term: u'' along n, u'/d across it.
inline ContactFactor point_factor(const ContactScalars& c, int p, int q, double dx, double dy, double sign, double lowest) {
  const double d2 = dx * dx + dy * dy, inverse = 1.0 / std::sqrt(d2);
  const bool inner = d2 < c.inner2;
  const double second = inner ? c.inner_b : c.outer_b;
  const double over = (inner ? c.inner_a : c.outer_a) * inverse + second;
  return {dx * inverse, dy * inverse, 0.0, std::fmax(sign * second, lowest), std::fmax(sign * over, lowest), 0.0, 0.0, p, q};
}

std::size_t contact_linearise(const Shell& s, const ContactScalars& c, const Window* windows, std::size_t window_count,
                              const SelfPair* pairs, std::size_t pair_count, double lowest, ContactFactor* factors) {
  ContactFactor* out = factors;
  for (std::size_t k = 0; k < window_count; ++k) {
    const Window& w = windows[k];
    const WindowState v = classify(s, c, w, s.x[w.p], s.y[w.p]);
    for (unsigned m = bits(v.segment); m != 0; m &= m - 1) {
      const int j = __builtin_ctz(m);
      const double t = v.t[j], d2 = v.segment_d2[j];
      const double inverse = 1.0 / std::sqrt(d2), d = d2 * inverse;
      const double inverse_length2 = s.inverse_length2[w.q + j], inverse_length = std::sqrt(inverse_length2);
      const bool inner = d2 < c.inner2;
      const double second = inner ? c.inner_b : c.outer_b;
      const double slope = (inner ? c.inner_a : c.outer_a) + second * d;  // u'
      // The tangent below is n rotated by -90 degrees; sign it along the segment.
      const double nx = (v.dx[j] - t * v.ex[j]) * inverse, ny = (v.dy[j] - t * v.ey[j]) * inverse;
      const double along = (ny * v.ex[j] - nx * v.ey[j]) > 0.0 ? 1.0 : -1.0;
      *out++ = {nx, ny, t, std::fmax(second, lowest), 0.0, -slope * inverse_length * along, -slope * d * inverse_length2, w.p, w.q + j};
    }
    for (unsigned m = bits(v.point); m != 0; m &= m - 1) {
      const int j = __builtin_ctz(m);
      *out++ = point_factor(c, w.p, w.q + j, v.dx[j], v.dy[j], v.sign[j], lowest);
    }
  }
  for (std::size_t k = 0; k < pair_count; ++k) {
    const auto [i, j] = pairs[k];
    const double dx = s.x[i] - s.x[j], dy = s.y[i] - s.y[j];
    if (dx * dx + dy * dy < c.self2) *out++ = point_factor(c, i, j, dx, dy, 1.0, lowest);
  }
  return static_cast<std::size_t>(out - factors);
}

void contact_product(const ContactFactor* factors, std::size_t count, const double* vx, const double* vy, double* ox, double* oy) {
  for (std::size_t k = 0; k < count; ++k) {
    const ContactFactor& f = factors[k];
    const int p = f.p, a = f.q, b = f.q + 1;
    const double dx = vx[b] - vx[a], dy = vy[b] - vy[a];
    const double wx = vx[p] - vx[a] - f.t * dx, wy = vy[p] - vy[a] - f.t * dy;
    const double alpha = f.nx * wx + f.ny * wy;
    const double g = f.ny * wx - f.nx * wy;  // tangent (ny, -nx)
    const double beta = f.nx * dx + f.ny * dy;
    const double ca = f.na * alpha, cg = f.gg * g + f.gb * beta, cb = f.gb * g + f.bb * beta;
    const double fx = ca * f.nx + cg * f.ny, fy = ca * f.ny - cg * f.nx;
    ox[p] += fx, oy[p] += fy;
    const double bx = cb * f.nx - f.t * fx, by = cb * f.ny - f.t * fy;
    ox[b] += bx, oy[b] += by;
    ox[a] -= fx + bx, oy[a] -= fy + by;
  }
}

void near_segments(const Shell& s, int cell, double px, double py, double reach2, unsigned long long* words) {
  const int b = s.base[cell] + 1, n = s.count[cell];
  for (int k = 0; k < n; k += lanes) {
    const Double8 dx = px - load(s.x + b + k), dy = py - load(s.y + b + k);
    const Double8 ex = load(s.ex + b + k), ey = load(s.ey + b + k);
    Double8 t = (dx * ex + dy * ey) * load(s.inverse_length2 + b + k);
    t = select(t > 0.0, select(t < 1.0, t, broadcast(1.0)), Double8{});
    const Double8 rx = dx - t * ex, ry = dy - t * ey;
    unsigned long long mask = bits(rx * rx + ry * ry < reach2);
    if (n - k < lanes) mask &= (1ull << (n - k)) - 1;
    if (k % 64 == 0) words[k / 64] = 0;
    words[k / 64] |= mask << (k % 64);
  }
}
