// The live terms of the smooth-membrane contact, an inclusion-exclusion sum (model.md section 3). Segment k of the chain
// contributes
//     [0 < t_k < 1] u(segment k)  -  [t_k > 0] u(point k)  +  [t_k >= 1] u(point k + 1),
// which is zero when the segment is out of reach, so a window may hold any superset of the segments that matter.
//
// Nearly every window has one live term. First terms are found with one window per lane and packed one behind the other, so that
// what is made of them has all lanes in use; the others, at concave corners, follow one by one.

/// Slots of a term: vertex and first end of the segment, or the point.
using TermSlots = WindowGroup::Slots;

constexpr int segments = suture::kernels::window_segments, points = segments + 1;
constexpr int batches = WindowGroup::windows / lanes;

/// The live terms of one group, those that are not the first of their window before the others.
struct LiveTerms {
  static constexpr int room = WindowGroup::windows * suture::kernels::window_terms + lanes;  ///< packing writes beyond the last
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
  SUTURE_INLINE void put(unsigned mask, Double8 x, Double8 y, Double8 where, Double8 at) {
    store_packed(rx + count, mask, x);
    store_packed(ry + count, mask, y);
    store_packed(t + count, mask, where);
    store_packed(slots + count, mask, at);
    count += set_bits(mask);
  }
};

/// One bit per window of a group, made and used as bytes of one batch of eight windows.
struct Bits {
  std::uint64_t all = 0;
  SUTURE_INLINE void put(int batch, Mask8 m) { reinterpret_cast<unsigned char*>(&all)[batch] = static_cast<unsigned char>(bits(m)); }
  SUTURE_INLINE Mask8 of(int batch) const { return from_bits(reinterpret_cast<const unsigned char*>(&all)[batch]); }
  bool has(int window) const { return all >> window & 1u; }
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
  Bits any, several;   ///< windows with terms, with more than one
  Bits here[points], first_segment, first_added;  ///< of the first term of a window: its number, its kind
};

SUTURE_INLINE GroupTerms find_terms(const GroupPlaces& places, const WindowGroup& group, int used) {
  const std::uint64_t known = ~std::uint64_t{0} >> (WindowGroup::windows - used * lanes);
  GroupTerms found;
  const auto take = [&](Bits& kind, int k, std::uint64_t term) {
    const std::uint64_t first = term & ~found.any.all;
    kind.all = term;
    found.several.all |= found.any.all & term;
    found.any.all |= term;
    found.here[k].all |= first;
    return first;
  };
  for (int k = 0; k < segments; ++k) {
    const std::uint64_t start = places.after_start[k].all & group.segments[k] & known, end = start & ~places.before_end[k].all;
    const std::uint64_t near = k == 0 ? places.near_first.all : ~std::uint64_t{0};
    found.first_added.all |= take(found.point[k], k, (start ^ found.added[k].all) & near) & found.added[k].all;
    found.first_segment.all |= take(found.segment[k], k, start & ~end);
    found.added[k + 1].all = end;
  }
  found.first_added.all |= take(found.point[segments], segments, found.added[segments].all & places.near_last.all) | found.first_segment.all;
  return found;
}

SUTURE_INLINE void pack_batch(const ContactScalars& c, const WindowGroup& group, int batch, const GroupPlaces& places,
                              const GroupTerms& found, LiveTerms& terms) {
  const double(*x)[lanes] = places.dx[batch], (*y)[lanes] = places.dy[batch];
  Double8 rx = load(x[0]), ry = load(y[0]), nx = load(x[1]), ny = load(y[1]), next{};  // from this point and the next
  for (int k = 1; k < points; ++k) {
    const Mask8 here = found.here[k].of(batch);
    rx = select(here, load(x[k]), rx), ry = select(here, load(y[k]), ry);
    if (k < segments) nx = select(here, load(x[k + 1]), nx), ny = select(here, load(y[k + 1]), ny);
    next = select(here, bit_pattern(static_cast<long long>(k) << 32), next);
  }
  const Double8 ex = rx - nx, ey = ry - ny;
  const Double8 t = only(found.first_segment.of(batch), (rx * ex + ry * ey) * inverse(ex * ex + ey * ey));
  rx = rx - t * ex;
  ry = ry - t * ey;
  const Mask8 live = found.any.of(batch) & less(rx * rx + ry * ry, c.cutoff2);
  terms.put(bits(live), rx, ry, negate(~found.first_added.of(batch), t), add_bits(load_bits(group.slots + batch * lanes), next));
}

/// All terms in reach of a window with several, but for the first.
SUTURE_INLINE void append_window(const ContactScalars& c, const WindowGroup& group, int window, const GroupPlaces& places,
                                 const GroupTerms& found, LiveTerms& terms) {
  const int batch = window / lanes, lane = window % lanes;
  const auto x = [&](int k) { return places.dx[batch][k][lane]; };
  const auto y = [&](int k) { return places.dy[batch][k][lane]; };
  bool first = true;
  const auto put = [&](int k, double rx, double ry, double t) {
    if (!(rx * rx + ry * ry < c.cutoff2)) return;
    const TermSlots slots{group.slots[window].p, group.slots[window].q + k};
    const int at = terms.count++;
    terms.rx[at] = rx, terms.ry[at] = ry, terms.t[at] = t;
    __builtin_memcpy(terms.slots + at, &slots, sizeof slots);
  };
  for (int k = 0; k < points; ++k) {
    if (found.point[k].has(window) && !std::exchange(first, false)) put(k, x(k), y(k), found.added[k].has(window) ? 0.0 : -0.0);
    if (k == segments || !found.segment[k].has(window) || std::exchange(first, false)) continue;
    const double ex = x(k) - x(k + 1), ey = y(k) - y(k + 1);
    const double t = (x(k) * ex + y(k) * ey) / (ex * ex + ey * ey);
    put(k, x(k) - t * ex, y(k) - t * ey, t);
  }
}

SUTURE_INLINE void pack(const ContactScalars& c, const WindowGroup& group, int used, const GroupPlaces& places, LiveTerms& terms) {
  const GroupTerms found = find_terms(places, group, used);
  terms.count = 0;
  for (std::uint64_t m = found.several.all; m != 0; m &= m - 1)
    append_window(c, group, __builtin_ctzll(m), places, found, terms);
  for (int batch = 0; batch < used; ++batch) pack_batch(c, group, batch, places, found, terms);
}

/// Calls use(terms) with the live terms of each group.
template <class Use>
SUTURE_INLINE void for_live_terms(const Shell& s, const ContactScalars& c, const WindowGroup* groups, std::size_t windows, Use&& use) {
  const int count = static_cast<int>((windows + WindowGroup::windows - 1) / WindowGroup::windows);
  const auto used = [&](int k) {
    const std::size_t left = windows - static_cast<std::size_t>(k) * WindowGroup::windows;
    return static_cast<int>((std::min(left, std::size_t{WindowGroup::windows}) + lanes - 1) / lanes);
  };
  // What a pass stores the next one reads in other pieces, which a store just made would hold up. So the passes work on
  // successive groups.
  GroupPlaces places[2];
  LiveTerms terms[2];
  for (int k = 0; k < count + 2; ++k) {
    if (k < count)
      for (int batch = 0; batch < used(k); ++batch) place(s, c, groups[k], batch, places[k % 2]);
    if (k >= 1 && k <= count) pack(c, groups[k - 1], used(k - 1), places[(k - 1) % 2], terms[(k - 1) % 2]);
    if (k >= 2) use(terms[k % 2]);
  }
}
