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
  const auto make = [&](int k) {
    const Double8 x = load(terms.rx + k), y = load(terms.ry + k), t = load(terms.t + k);
    const Double8 f = with_sign_of(force_over_distance(c, x * x + y * y), t);
    const Double8 fx = f * x, fy = f * y;
    store_even_odd(on_vertex + 2 * k, fx, fy);
    store_even_odd(on_second + 2 * k, t * fx, t * fy);
    store_even_odd(on_first + 2 * k, fx - t * fx, fy - t * fy);
  };
  const auto add = [&](int k, int pair) {
    const TermSlots at = terms.at(k);
    Pair *p = reinterpret_cast<Pair*>(s.gradient) + at.p, *q = reinterpret_cast<Pair*>(s.gradient) + at.q;
    p[0] += *reinterpret_cast<const Pair*>(on_vertex + pair);
    q[0] -= *reinterpret_cast<const Pair*>(on_first + pair);
    q[1] -= *reinterpret_cast<const Pair*>(on_second + pair);
  };
  // The next eight are made beside these being added, which leaves lanes idle.
  if (terms.count > 0) make(0);
  int k = 0;
  for (; k + lanes <= terms.count; k += lanes) {
    if (k + lanes < terms.count) make(k + lanes);
    for (int m = 0; m < lanes; m += 2) {
      add(k + m, 2 * k + m);
      add(k + m + 1, 2 * k + lanes + m);
    }
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

/// Appends the repulsive terms of those collected.
ContactFactor* append_factors(const ContactScalars& c, const LiveTerms& terms, ContactFactor* out) {
  const double root = std::sqrt(c.inner_b);
  for (int k = 0; k < terms.count; k += lanes) {
    const Double8 x = load(terms.rx + k), y = load(terms.ry + k), d2 = x * x + y * y, scale = root * inverse_square_root(d2);
    const Mask8 added = less(0.0, with_sign_of(broadcast(1.0), load(terms.t + k)));
    alignas(64) double nx[lanes], ny[lanes];
    store(nx, scale * x);
    store(ny, scale * y);
    for (unsigned left = bits(less(d2, c.inner2) & added & first_lanes(terms.count - k)); left != 0; left &= left - 1) {
      const int lane = __builtin_ctz(left);
      const TermSlots slots = terms.at(k + lane);
      *out++ = {nx[lane], ny[lane], terms.t[k + lane], slots.p, slots.q};
    }
  }
  return out;
}

std::size_t contact_linearise(const Shell& s, const ContactScalars& c, const WindowGroup* groups, std::size_t windows,
                              const SelfPair* pairs, std::size_t pair_count, ContactFactor* factors) {
  ContactFactor* out = factors;
  for_live_terms(s, c, groups, windows, [&](const LiveTerms& terms) { out = append_factors(c, terms, out); });
  for (std::size_t k = 0; k < pair_count; ++k) {
    const auto [i, j] = pairs[k];
    const double dx = s.x[i] - s.x[j], dy = s.y[i] - s.y[j], d2 = dx * dx + dy * dy;
    if (d2 >= c.self2) continue;
    const double scale = std::sqrt(c.inner_b / d2);
    *out++ = {scale * dx, scale * dy, 0.0, i, j};
  }
  return static_cast<std::size_t>(out - factors);
}

void contact_product(const ContactFactor* factors, std::size_t count, const double* vx, const double* vy, double* ox,
                     double* oy) {
  for (std::size_t k = 0; k < count; ++k) {
    const ContactFactor& f = factors[k];
    const int p = f.p, a = f.q, b = f.q + 1;
    const double wx = vx[p] - vx[a] - f.t * (vx[b] - vx[a]), wy = vy[p] - vy[a] - f.t * (vy[b] - vy[a]);
    const double along = f.nx * wx + f.ny * wy, fx = along * f.nx, fy = along * f.ny;
    ox[p] += fx, oy[p] += fy;
    ox[b] -= f.t * fx, oy[b] -= f.t * fy;
    ox[a] -= (1.0 - f.t) * fx, oy[a] -= (1.0 - f.t) * fy;
  }
}

void contact_diagonal(const ContactFactor* factors, std::size_t count, double* blocks) {
  typedef double Pair __attribute__((vector_size(16), may_alias));  // a register everywhere
  auto* at = reinterpret_cast<Pair*>(blocks);
  for (std::size_t k = 0; k < count; ++k) {
    const ContactFactor& f = factors[k];
    const double s = 1.0 - f.t;
    const Pair first = {f.nx * f.nx, f.nx * f.ny}, second = {f.ny * f.ny, 0.0};
    const auto add = [&](int slot, double weight) {
      at[2 * slot] += weight * first;
      at[2 * slot + 1] += weight * second;
    };
    add(f.p, 1.0);
    add(f.q, s * s);
    add(f.q + 1, f.t * f.t);
  }
}
