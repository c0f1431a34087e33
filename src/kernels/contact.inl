// The smooth-membrane contact as one inclusion-exclusion sum (model.md section 3). Segment k of the chain contributes
//     [0 < t_k < 1] u(segment k)  -  [t_k > 0] u(point k)  +  [t_k >= 1] u(point k + 1),
// which is zero when the segment is out of reach, so a window may hold any superset of the segments that matter.

// A window holds at most three segments and their last end point, four lanes: two windows fill a vector.

/// u'(d)/d at squared distance d2 < cutoff2.
SUTURE_INLINE Double8 force_over_distance(const ContactScalars& c, Double8 d2) {
  const Mask8 inner = less(d2, c.inner2);
  return select(inner, broadcast(c.inner_a), broadcast(c.outer_a)) * inverse_square_root(d2) +
         select(inner, broadcast(c.inner_b), broadcast(c.outer_b));
}

struct WindowState {
  Double8 dx, dy;               ///< from the first end of the segment to the vertex
  Double8 along, rx, ry;        ///< the nearest point short of the far end: where on the segment, from it to the vertex
  Mask8 segment, point, added;  ///< live terms; whether the point's is added, not subtracted
};

SUTURE_INLINE WindowState classify(const Shell& s, const ContactScalars& c, const Window& a, const Window& b) {
  WindowState v;
  const Mask8 listed = first_lanes_halves(a.segments, b.segments);
  v.dx = broadcast_halves(s.x[a.p], s.x[b.p]) - load_halves(s.x + a.q, s.x + b.q);
  v.dy = broadcast_halves(s.y[a.p], s.y[b.p]) - load_halves(s.y + a.q, s.y + b.q);
  const Double8 ex = load_halves(s.ex + a.q, s.ex + b.q), ey = load_halves(s.ey + a.q, s.ey + b.q);
  const Double8 inverse_length = load_halves(s.inverse_length + a.q, s.inverse_length + b.q);
  const Double8 t = (v.dx * ex + v.dy * ey) * (inverse_length * inverse_length);
  const Mask8 after_start = less(0.0, t) & listed;
  const Mask8 after_end = ~less(t, 1.0) & listed;
  const Mask8 beside = after_start & ~after_end;
  v.added = shift_up_halves(after_end);
  v.along = only(beside, t);
  v.rx = v.dx - v.along * ex;
  v.ry = v.dy - v.along * ey;
  v.segment = beside & less(v.rx * v.rx + v.ry * v.ry, c.cutoff2);
  v.point = (after_start ^ v.added) & less(v.dx * v.dx + v.dy * v.dy, c.cutoff2);
  return v;
}

// Nearly every window has one live term. The gradient has one window per lane, finds that term, and packs terms, so that
// forces are worked out with all lanes in use. The few windows with several terms follow at the end. Linearising works on
// two windows at a time, a segment per lane.

/// Slots of a term: vertex and first end of the segment, or the point. The layout of Window, so that two loads fetch
/// four lanes.
using TermSlots = WindowGroup::Slots;
alignas(64) constexpr long long next_slots[lanes] = {0, 1ll << 32, 2ll << 32, 3ll << 32,
                                                     0, 1ll << 32, 2ll << 32, 3ll << 32};
static_assert(offsetof(Window, p) == offsetof(TermSlots, p) && offsetof(Window, q) == offsetof(TermSlots, q) &&
              sizeof(TermSlots) == 8);

/// TermSlots as bit patterns, lane k of each half at slot q + k.
SUTURE_INLINE Double8 slots_of(const Window& a, const Window& b) {
  double first, second;
  __builtin_memcpy(&first, &a, sizeof first);
  __builtin_memcpy(&second, &b, sizeof second);
  return add_bits(broadcast_halves(first, second), load_bits(next_slots));
}

struct LiveTerms {
  static constexpr int full = 64, most = WindowGroup::windows * (2 * suture::kernels::window_segments + 1),
                       room = most + lanes;  ///< packing writes beyond
  int count = 0;
  /// From the nearest point to the vertex; where on the segment that is, 0 for a point, with the sign bit for a term
  /// that is subtracted.
  alignas(64) double rx[room], ry[room], t[room];
  alignas(64) double slots[room];

  TermSlots at(int k) const {
    TermSlots found;
    __builtin_memcpy(&found, slots + k, sizeof found);
    return found;
  }
  SUTURE_INLINE void put(int place, unsigned mask, Double8 x, Double8 y, Double8 where, Double8 at) {
    store_packed(rx + place, mask, x);
    store_packed(ry + place, mask, y);
    store_packed(t + place, mask, where);
    store_packed(slots + place, mask, at);
  }
};

/// Returns the number of terms with those of two windows. Their order does not depend on which windows come together.
SUTURE_INLINE int collect(const Shell& s, const ContactScalars& c, const Window& a, const Window& b, LiveTerms& terms,
                          int count) {
  const WindowState v = classify(s, c, a, b);
  const Double8 at = slots_of(a, b), t = negate(~(v.segment | v.added), v.along);
  const unsigned live = bits(v.segment | v.point);
  const Mask8 both = v.segment & v.point;  // at concave corners
  if (!any(both)) [[likely]] {
    terms.put(count, live, v.rx, v.ry, t, at);
    return count + set_bits(live);
  }
  for (const unsigned window : {0x0fu, 0xf0u}) {
    terms.put(count, live & window, v.rx, v.ry, t, at);
    count += set_bits(live & window);
    terms.put(count, bits(both) & window, v.dx, v.dy, negate(~v.added, Double8{}), at);
    count += set_bits(bits(both) & window);
  }
  return count;
}

/// Calls use(terms, count) with all live terms, at most `full` and a few at a time, in the order of the windows.
template <typename Use>
SUTURE_INLINE void for_live_terms(const Shell& s, const ContactScalars& c, const Window* windows,
                                  std::size_t window_count, Use&& use) {
  const std::size_t even = window_count & ~std::size_t{1};
  LiveTerms terms;
  int count = 0;
  for (std::size_t k = 0; k < even; k += 2) {
    count = collect(s, c, windows[k], windows[k + 1], terms, count);
    if (count < LiveTerms::full) continue;
    use(terms, count);
    count = 0;
  }
  if (even < window_count) {
    const Window& last = windows[even];
    count = collect(s, c, last, {last.p, last.q, 0, 0}, terms, count);
  }
  use(terms, count);
}

constexpr int segments = suture::kernels::window_segments, points = segments + 1;
constexpr int batches = WindowGroup::windows / lanes;

/// One bit per window of a group, made and used as bytes of one batch of eight windows.
struct Bits {
  std::uint64_t all = 0;
  SUTURE_INLINE void put(int batch, Mask8 m) { reinterpret_cast<unsigned char*>(&all)[batch] = static_cast<unsigned char>(bits(m)); }
  SUTURE_INLINE Mask8 of(int batch) const { return from_bits(reinterpret_cast<const unsigned char*>(&all)[batch]); }
};

/// Where the vertices of a group's windows are: after the start and before the end of a segment, near the points at the ends of
/// the window; from each point to the vertex.
struct GroupPlaces {
  Bits after_start[segments], before_end[segments], near_first, near_last;
  alignas(64) double dx[batches][points][lanes], dy[batches][points][lanes];
};

SUTURE_INLINE void place(const Shell& s, const ContactScalars& c, const WindowGroup& group, int batch, GroupPlaces& places) {
  const WindowGroup::Slots* slots = group.slots + batch * lanes;
  Double8 dx[points], dy[points];
  load_quads(s.x, &slots->q, dx);
  load_quads(s.y, &slots->q, dy);
  const Double8 px = load_each(s.x, &slots->p), py = load_each(s.y, &slots->p);
  for (int k = 0; k < points; ++k) {
    dx[k] = px - dx[k], dy[k] = py - dy[k];
    store(places.dx[batch][k], dx[k]);
    store(places.dy[batch][k], dy[k]);
  }
  for (int k = 0; k < segments; ++k) {
    const Double8 ex = dx[k] - dx[k + 1], ey = dy[k] - dy[k + 1];
    places.after_start[k].put(batch, less(0.0, dx[k] * ex + dy[k] * ey));
    places.before_end[k].put(batch, less(dx[k + 1] * ex + dy[k + 1] * ey, 0.0));
  }
  const auto near = [&](int k) { return less(dx[k] * dx[k] + dy[k] * dy[k], c.cutoff2); };
  places.near_first.put(batch, near(0));
  places.near_last.put(batch, near(segments));
}

/// Which windows have a segment's and a point's term, number by number (segment k goes from point k to k + 1), and where the
/// point's is added and not subtracted. Terms out of reach are among them, if not those of the first and the last point.
struct GroupTerms {
  Bits segment[segments], point[points], added[points];
  Bits one, several;   ///< windows with one term, with more
  Bits here[points], any_segment, any_added;  ///< for windows with one term: its number, its kind
};

SUTURE_INLINE GroupTerms find_terms(const GroupPlaces& places, const WindowGroup& group, int used) {
  const std::uint64_t known = ~std::uint64_t{0} >> (WindowGroup::windows - used * lanes);
  GroupTerms found;
  std::uint64_t any = 0;
  const auto take = [&](Bits& kind, int k, std::uint64_t term) {
    kind.all = term;
    found.several.all |= any & term;
    any |= term;
    found.here[k].all |= term;
  };
  for (int k = 0; k < segments; ++k) {
    const std::uint64_t start = places.after_start[k].all & group.segments[k] & known, end = start & ~places.before_end[k].all;
    const std::uint64_t near = k == 0 ? places.near_first.all : ~std::uint64_t{0};
    take(found.point[k], k, (start ^ found.added[k].all) & near);
    take(found.segment[k], k, start & ~end);
    found.added[k + 1].all = end;
    found.any_segment.all |= start & ~end;
    found.any_added.all |= found.point[k].all & found.added[k].all;
  }
  take(found.point[segments], segments, found.added[segments].all & places.near_last.all);
  found.any_added.all |= found.point[segments].all | found.any_segment.all;
  found.one.all = any & ~found.several.all;
  return found;
}

/// Returns the number of terms with those of one batch.
SUTURE_INLINE int pack_batch(const ContactScalars& c, const WindowGroup& group, int batch, const GroupPlaces& places,
                       const GroupTerms& found, LiveTerms& terms, int count) {
  const double(*x)[lanes] = places.dx[batch], (*y)[lanes] = places.dy[batch];
  Double8 rx = load(x[0]), ry = load(y[0]), nx = load(x[1]), ny = load(y[1]), next{};  // from this point and the next
  for (int k = 1; k < points; ++k) {
    const Mask8 here = found.here[k].of(batch);
    rx = select(here, load(x[k]), rx), ry = select(here, load(y[k]), ry);
    if (k < segments) nx = select(here, load(x[k + 1]), nx), ny = select(here, load(y[k + 1]), ny);
    next = select(here, bit_pattern(static_cast<long long>(k) << 32), next);
  }
  const Double8 ex = rx - nx, ey = ry - ny;
  const Double8 t = only(found.any_segment.of(batch), (rx * ex + ry * ey) * inverse(ex * ex + ey * ey));
  rx = rx - t * ex;
  ry = ry - t * ey;
  const unsigned live = bits(found.one.of(batch) & less(rx * rx + ry * ry, c.cutoff2));
  terms.put(count, live, rx, ry, negate(~found.any_added.of(batch), t), add_bits(load_bits(group.slots + batch * lanes), next));
  return count + set_bits(live);
}

/// All terms in reach of window `number` of the group.
SUTURE_INLINE int append(const ContactScalars& c, const WindowGroup& group, int number, const GroupPlaces& places,
                         const GroupTerms& found, LiveTerms& terms, int count) {
  const int batch = number / lanes, lane = number % lanes;
  const auto x = [&](int k) { return places.dx[batch][k][lane]; };
  const auto y = [&](int k) { return places.dy[batch][k][lane]; };
  const auto put = [&](int k, double rx, double ry, double t) {
    if (!(rx * rx + ry * ry < c.cutoff2)) return;
    terms.rx[count] = rx, terms.ry[count] = ry, terms.t[count] = t;
    const TermSlots slots{group.slots[number].p, group.slots[number].q + k};
    __builtin_memcpy(terms.slots + count, &slots, sizeof slots);
    ++count;
  };
  for (int k = 0; k < points; ++k) {
    if (found.point[k].all >> number & 1u) put(k, x(k), y(k), found.added[k].all >> number & 1u ? 0.0 : -0.0);
    if (k == segments || !(found.segment[k].all >> number & 1u)) continue;
    const double ex = x(k) - x(k + 1), ey = y(k) - y(k + 1);
    const double t = (x(k) * ex + y(k) * ey) / (ex * ex + ey * ey);
    put(k, x(k) - t * ex, y(k) - t * ey, t);
  }
  return count;
}

SUTURE_INLINE void pack(const ContactScalars& c, const WindowGroup& group, int used, const GroupPlaces& places, LiveTerms& terms) {
  const GroupTerms found = find_terms(places, group, used);
  int count = 0;
  for (std::uint64_t m = found.several.all; m != 0; m &= m - 1)
    count = append(c, group, __builtin_ctzll(m), places, found, terms, count);
  for (int batch = 0; batch < used; ++batch) count = pack_batch(c, group, batch, places, found, terms, count);
  terms.count = count;
}

/// Adds the forces of the terms collected, in their order.
void apply(const Shell& s, const ContactScalars& c, const LiveTerms& terms, int count) {
  typedef double Pair __attribute__((vector_size(16), may_alias));
  alignas(64) double on_vertex[2 * LiveTerms::room], on_first[2 * LiveTerms::room],
      on_second[2 * LiveTerms::room];  // dU/dr of the vertex, and minus that of the segment's ends
  for (int k = 0; k < count; k += lanes) {
    const Double8 x = load(terms.rx + k), y = load(terms.ry + k), t = load(terms.t + k);
    const Double8 f = with_sign_of(force_over_distance(c, x * x + y * y), t);
    const Double8 fx = f * x, fy = f * y;
    store_pairs(on_vertex + 2 * k, fx, fy);
    store_pairs(on_second + 2 * k, t * fx, t * fy);
    store_pairs(on_first + 2 * k, fx - t * fx, fy - t * fy);
  }
  const auto add = [&](int k, int pair) {
    const TermSlots at = terms.at(k);
    Pair *p = reinterpret_cast<Pair*>(s.contact) + at.p, *q = reinterpret_cast<Pair*>(s.contact) + at.q;
    p[0] += *reinterpret_cast<const Pair*>(on_vertex + pair);
    q[0] -= *reinterpret_cast<const Pair*>(on_first + pair);
    q[1] -= *reinterpret_cast<const Pair*>(on_second + pair);
  };
  int k = 0;
  for (; k + lanes <= count; k += lanes)
    for (int m = 0; m < lanes; m += 2) {
      add(k + m, 2 * k + m);
      add(k + m + 1, 2 * k + lanes + m);
    }
  for (int m = 0; k + m < count; ++m) add(k + m, 2 * k + m % 2 * lanes + m - m % 2);
}

void contact_gradient(const Shell& s, const ContactScalars& c, const WindowGroup* groups, std::size_t windows,
                      const SelfPair* pairs, std::size_t pair_count) {
  // What a pass stores the next one reads in other pieces, which a store just made would hold up. So the passes work on
  // successive groups.
  const int count = static_cast<int>((windows + WindowGroup::windows - 1) / WindowGroup::windows);
  const auto used = [&](int k) {
    const std::size_t left = windows - static_cast<std::size_t>(k) * WindowGroup::windows;
    return static_cast<int>((std::min(left, std::size_t{WindowGroup::windows}) + lanes - 1) / lanes);
  };
  GroupPlaces places[2];
  LiveTerms terms[2];
  for (int k = 0; k < count + 2; ++k) {
    if (k < count)
      for (int batch = 0; batch < used(k); ++batch) place(s, c, groups[k], batch, places[k % 2]);
    if (k >= 1 && k <= count) pack(c, groups[k - 1], used(k - 1), places[(k - 1) % 2], terms[(k - 1) % 2]);
    if (k >= 2) apply(s, c, terms[k % 2], terms[k % 2].count);
  }
  for (std::size_t k = 0; k < pair_count; ++k) {
    const auto [i, j] = pairs[k];
    const double dx = s.x[i] - s.x[j], dy = s.y[i] - s.y[j], d2 = dx * dx + dy * dy;
    if (d2 >= c.self2) continue;
    const double f = c.inner_a / std::sqrt(d2) + c.inner_b;
    s.contact[2 * i] += f * dx, s.contact[2 * i + 1] += f * dy;
    s.contact[2 * j] -= f * dx, s.contact[2 * j + 1] -= f * dy;
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
ContactFactor* append_factors(const Shell& s, const ContactScalars& c, const LiveTerms& terms, int count, double lowest,
                              ContactFactor* out) {
  struct Column {
    alignas(64) double at[LiveTerms::room];
  };
  Column ex, ey, inverse_length, nx, ny, t, na, gg, gb, bb;
  for (int k = 0; k < count; ++k) {
    const int q = terms.at(k).q;
    ex.at[k] = s.ex[q], ey.at[k] = s.ey[q], inverse_length.at[k] = s.inverse_length[q];
  }
  for (int k = 0; k < count; k += lanes) {
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
  for (int k = 0; k < count; ++k) {
    const TermSlots slots = terms.at(k);
    *out++ = {nx.at[k], ny.at[k], t.at[k], na.at[k], gg.at[k], gb.at[k], bb.at[k], slots.p, slots.q};
  }
  return out;
}

std::size_t contact_linearise(const Shell& s, const ContactScalars& c, const Window* windows, std::size_t window_count,
                              const SelfPair* pairs, std::size_t pair_count, double lowest, ContactFactor* factors) {
  ContactFactor* out = factors;
  for_live_terms(s, c, windows, window_count,
                 [&](const LiveTerms& terms, int count) { out = append_factors(s, c, terms, count, lowest, out); });
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

void near_segments(const Shell& s, int cell, double px, double py, double reach2, unsigned long long* words,
                   double* distance2) {
  const int b = s.base[cell] + 1, n = s.count[cell];
  for (int k = 0; k < n; k += lanes) {
    const Double8 dx = px - load(s.x + b + k), dy = py - load(s.y + b + k);
    const Double8 ex = load(s.ex + b + k), ey = load(s.ey + b + k);
    const Double8 inverse = load(s.inverse_length + b + k);
    Double8 t = (dx * ex + dy * ey) * (inverse * inverse);
    t = select(less(0.0, t), select(less(t, 1.0), t, broadcast(1.0)), Double8{});
    const Double8 rx = dx - t * ex, ry = dy - t * ey;
    const Double8 d2 = rx * rx + ry * ry;
    store(distance2 + k, d2);
    unsigned long long mask = bits(less(d2, reach2));
    if (n - k < lanes) mask &= (1ull << (n - k)) - 1;
    if (k % 64 == 0) words[k / 64] = 0;
    words[k / 64] |= mask << (k % 64);
  }
}
