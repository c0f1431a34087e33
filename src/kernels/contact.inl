// Forces and second derivatives of the smooth-membrane contact from its live terms.

/// u'(d)/d at squared distance d2 < cutoff2.
SUTURE_INLINE Double8 force_over_distance(const ContactScalars& c, Double8 d2) {
  const Mask8 inner = less(d2, c.inner2);
  return select(inner, broadcast(c.inner_a), broadcast(c.outer_a)) * inverse_square_root(d2) +
         select(inner, broadcast(c.inner_b), broadcast(c.outer_b));
}

/// Adds the forces of the terms collected, in their order.
void apply(const Shell& s, const ContactScalars& c, const LiveTerms& terms) {
  typedef double Pair __attribute__((vector_size(16), may_alias));
  alignas(64) double on_vertex[2 * LiveTerms::room], on_first[2 * LiveTerms::room],
      on_second[2 * LiveTerms::room];  // dU/dr of the vertex, and minus that of the segment's ends
  for (int k = 0; k < terms.count; k += lanes) {
    const Double8 x = load(terms.rx + k), y = load(terms.ry + k), t = load(terms.t + k);
    const Double8 f = with_sign_of(force_over_distance(c, x * x + y * y), t);
    const Double8 fx = f * x, fy = f * y;
    store_even_odd(on_vertex + 2 * k, fx, fy);
    store_even_odd(on_second + 2 * k, t * fx, t * fy);
    store_even_odd(on_first + 2 * k, fx - t * fx, fy - t * fy);
  }
  const auto add = [&](int k, int pair) {
    const TermSlots at = terms.at(k);
    Pair *p = reinterpret_cast<Pair*>(s.gradient) + at.p, *q = reinterpret_cast<Pair*>(s.gradient) + at.q;
    p[0] += *reinterpret_cast<const Pair*>(on_vertex + pair);
    q[0] -= *reinterpret_cast<const Pair*>(on_first + pair);
    q[1] -= *reinterpret_cast<const Pair*>(on_second + pair);
  };
  int k = 0;
  for (; k + lanes <= terms.count; k += lanes)
    for (int m = 0; m < lanes; m += 2) {
      add(k + m, 2 * k + m);
      add(k + m + 1, 2 * k + lanes + m);
    }
  for (int m = 0; k + m < terms.count; ++m) add(k + m, 2 * k + m % 2 * lanes + m - m % 2);
}

void contact_gradient(const Shell& s, const ContactScalars& c, const WindowGroup* groups, std::size_t windows,
                      const SelfPair* pairs, std::size_t pair_count) {
  for_live_terms(s, c, groups, windows, [&](const LiveTerms& terms) { apply(s, c, terms); });
  for (std::size_t k = 0; k < pair_count; ++k) {
    const auto [i, j] = pairs[k];
    const double dx = s.x[i] - s.x[j], dy = s.y[i] - s.y[j], d2 = dx * dx + dy * dy;
    if (d2 >= c.self2) continue;
    const double f = c.inner_a / std::sqrt(d2) + c.inner_b;
    s.gradient[2 * i] += f * dx, s.gradient[2 * i + 1] += f * dy;
    s.gradient[2 * j] -= f * dx, s.gradient[2 * j + 1] -= f * dy;
  }
}

/// A point term: u'' along n, u'/d across it.
inline ContactFactor point_factor(const ContactScalars& c, int p, int q, double dx, double dy, double sign,
                                  double lowest) {
  const double d2 = dx * dx + dy * dy, inverse = 1.0 / std::sqrt(d2);
  const bool inner = d2 < c.inner2;
  const double second = inner ? c.inner_b : c.outer_b;
  const double over = (inner ? c.inner_a : c.outer_a) * inverse + second;
  return {dx * inverse,
          dy * inverse,
          0.0,
          std::fmax(sign * second, lowest),
          std::fmax(sign * over, lowest),
          0.0,
          0.0,
          p,
          q};
}

/// Appends the second derivatives of the terms collected.
ContactFactor* append_factors(const Shell& s, const ContactScalars& c, const LiveTerms& terms, double lowest, ContactFactor* out) {
  struct Column {
    alignas(64) double at[LiveTerms::room];
  };
  Column ex, ey, inverse_length, nx, ny, t, na, gg, gb, bb;
  for (int k = 0; k < terms.count; ++k) {
    const int q = terms.at(k).q;
    ex.at[k] = s.ex[q], ey.at[k] = s.ey[q], inverse_length.at[k] = s.inverse_length[q];
  }
  for (int k = 0; k < terms.count; k += lanes) {
    const Double8 x = load(terms.rx + k), y = load(terms.ry + k), where = load(terms.t + k);
    const Double8 d2 = x * x + y * y, inverse = inverse_square_root(d2), d = d2 * inverse;
    const Mask8 inner = less(d2, c.inner2), segment = less(0.0, where);
    const Double8 second = select(inner, broadcast(c.inner_b), broadcast(c.outer_b));              // u''
    const Double8 slope = select(inner, broadcast(c.inner_a), broadcast(c.outer_a)) + second * d;  // u'
    const Double8 n_x = x * inverse, n_y = y * inverse;
    // The tangent of a factor is n rotated by -90 degrees; signed along the segment.
    const Double8 along = negate(less(n_x * load(ey.at + k), n_y * load(ex.at + k)), load(inverse_length.at + k));
    store(nx.at + k, n_x);
    store(ny.at + k, n_y);
    store(t.at + k, only(segment, where));
    store(na.at + k, maximum(with_sign_of(second, where), broadcast(lowest)));
    store(gg.at + k, only(~segment, maximum(with_sign_of(slope * inverse, where), broadcast(lowest))));
    store(gb.at + k, only(segment, slope * along));
    store(bb.at + k, only(segment, -slope * d * (along * along)));
  }
  for (int k = 0; k < terms.count; ++k) {
    const TermSlots slots = terms.at(k);
    *out++ = {nx.at[k], ny.at[k], t.at[k], na.at[k], gg.at[k], gb.at[k], bb.at[k], slots.p, slots.q};
  }
  return out;
}

std::size_t contact_linearise(const Shell& s, const ContactScalars& c, const WindowGroup* groups, std::size_t windows,
                              const SelfPair* pairs, std::size_t pair_count, double lowest, ContactFactor* factors) {
  ContactFactor* out = factors;
  for_live_terms(s, c, groups, windows, [&](const LiveTerms& terms) { out = append_factors(s, c, terms, lowest, out); });
  for (std::size_t k = 0; k < pair_count; ++k) {
    const auto [i, j] = pairs[k];
    const double dx = s.x[i] - s.x[j], dy = s.y[i] - s.y[j];
    if (dx * dx + dy * dy < c.self2) *out++ = point_factor(c, i, j, dx, dy, 1.0, lowest);
  }
  return static_cast<std::size_t>(out - factors);
}

void contact_product(const ContactFactor* factors, std::size_t count, const double* vx, const double* vy, double* ox,
                     double* oy) {
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

void contact_diagonal(const ContactFactor* factors, std::size_t count, double* blocks) {
  typedef double Pair __attribute__((vector_size(16), may_alias));  // a register everywhere
  auto* at = reinterpret_cast<Pair*>(blocks);
  for (std::size_t k = 0; k < count; ++k) {
    const ContactFactor& f = factors[k];
    const double ax = f.na * f.nx, s = 1.0 - f.t;
    const Pair first = {ax * f.nx, ax * f.ny}, second = {f.na * f.ny * f.ny, 0.0};
    const auto add = [&](int slot, double weight) {
      at[2 * slot] += weight * first;
      at[2 * slot + 1] += weight * second;
    };
    add(f.p, 1.0);
    add(f.q, s * s);
    add(f.q + 1, f.t * f.t);
  }
}
