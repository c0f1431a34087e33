// Forces and second derivatives of the smooth-membrane contact from its live terms.

/// u'(d)/d at squared distance d2 < cutoff2.
SUTURE_INLINE Double8 force_over_distance(const ContactScalars& c, Double8 d2) {
  const Mask8 inner = less(d2, c.inner2);
  return select(inner, broadcast(c.inner_a), broadcast(c.outer_a)) * inverse_square_root(d2) +
         select(inner, broadcast(c.inner_b), broadcast(c.outer_b));
}

typedef double Pair __attribute__((vector_size(16), may_alias));  // a register everywhere

/// dU/dr of the vertices of `count` terms, in whole vectors.
template <int room>
SUTURE_INLINE void find_forces(const ContactScalars& c, const Terms<room>& terms, int count, double* pairs) {
  for (int k = 0; k < count; k += lanes) {
    const Double8 x = load(terms.rx + k), y = load(terms.ry + k);
    const Double8 f = with_sign_of(force_over_distance(c, x * x + y * y), load(terms.t + k));
    store_pairs(pairs + 2 * k, f * x, f * y);
  }
}

/// Adds the forces of the terms of a group. They are found for many terms before: what has just been stored is slow to read in
/// other pieces.
void apply(const Shell& s, const ContactScalars& c, const LiveTerms& terms) {
  alignas(64) double forces[2 * LiveTerms::room];
  const auto add = [&](TermSlots at, const double* force, double t) {
    const Pair on_vertex = *reinterpret_cast<const Pair*>(force), on_second = on_vertex * t;
    Pair *p = reinterpret_cast<Pair*>(s.gradient) + at.p, *q = reinterpret_cast<Pair*>(s.gradient) + at.q;
    p[0] += on_vertex;
    q[0] -= on_vertex - on_second;
    q[1] -= on_second;
  };
  find_forces(c, terms.of_middle, terms.batches * lanes, forces);
  terms.for_each_middle([&](TermSlots at, int k) { add(at, forces + 2 * k, terms.of_middle.t[k]); });
  find_forces(c, terms.others, terms.count, forces);
  for (int k = 0; k < terms.count; ++k) add(terms.other_slots[k], forces + 2 * k, terms.others.t[k]);
}

void contact_gradient(const Shell& s, const ContactScalars& c, const WindowGroup* groups, std::size_t windows,
                      const SelfPair* pairs, std::size_t pair_count) {
  for_live_terms(s, c.cutoff2, groups, windows, [&](const LiveTerms& terms) { apply(s, c, terms); });
  for (std::size_t k = 0; k < pair_count; ++k) {
    const auto [i, j] = pairs[k];
    const double dx = s.x[i] - s.x[j], dy = s.y[i] - s.y[j], d2 = dx * dx + dy * dy;
    if (d2 >= c.self2) continue;
    const double f = c.inner_a / std::sqrt(d2) + c.inner_b;
    s.gradient[2 * i] += f * dx, s.gradient[2 * i + 1] += f * dy;
    s.gradient[2 * j] -= f * dx, s.gradient[2 * j + 1] -= f * dy;
  }
}

/// Appends those of a group's terms, all repulsive, that are added.
ContactFactor* append_factors(const ContactScalars& c, const LiveTerms& terms, ContactFactor* out) {
  alignas(64) double on_middle[2 * LiveTerms::windows], on_others[2 * LiveTerms::room];
  const double root = std::sqrt(c.inner_b);
  const auto scale = [root](const auto& of, int count, double* pairs) {
    for (int k = 0; k < count; k += lanes) {
      const Double8 x = load(of.rx + k), y = load(of.ry + k), over_distance = root * inverse_square_root(x * x + y * y);
      store_pairs(pairs + 2 * k, over_distance * x, over_distance * y);
    }
  };
  scale(terms.of_middle, terms.batches * lanes, on_middle);
  scale(terms.others, terms.count, on_others);
  terms.for_each_middle([&](TermSlots at, int k) { *out++ = {on_middle[2 * k], on_middle[2 * k + 1], terms.of_middle.t[k], at.p, at.q}; });
  for (int k = 0; k < terms.count; ++k) {
    const TermSlots at = terms.other_slots[k];
    if (!std::signbit(terms.others.t[k])) *out++ = {on_others[2 * k], on_others[2 * k + 1], terms.others.t[k], at.p, at.q};
  }
  return out;
}

std::size_t contact_linearise(const Shell& s, const ContactScalars& c, const WindowGroup* groups, std::size_t windows,
                              const SelfPair* pairs, std::size_t pair_count, ContactFactor* factors) {
  ContactFactor* out = factors;
  for_live_terms(s, c.inner2, groups, windows, [&](const LiveTerms& terms) { out = append_factors(c, terms, out); });
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
