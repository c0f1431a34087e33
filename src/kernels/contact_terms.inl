// The live terms of the smooth-membrane contact, an inclusion-exclusion sum (model.md section 3). Segment k of the chain
// contributes
//     [0 < t_k < 1] u(segment k)  -  [t_k > 0] u(point k)  +  [t_k >= 1] u(point k + 1),
// which is zero when the segment is out of reach, so a window may hold any superset of the segments that matter.
//
// Windows are cut so that the nearest segment is the middle one. So nearly every window in reach has one term, u of the point of the
// middle segment that is nearest to the vertex: inside it, or one of its ends, which is added where the segment beyond it does not
// begin. These are worked out for all windows, in their places. What else there is, at concave corners and where windows meet, is
// found with bits of 64 windows at once and follows one by one.

/// Slots of a term: vertex and first end of the segment, or the point.
using TermSlots = WindowGroup::Slots;

constexpr int segments = suture::kernels::window_segments, points = segments + 1, middle = segments / 2;
constexpr int batches = WindowGroup::windows / lanes;

/// From the nearest point to the vertex; where on the segment that is, 0 for a point, with the sign bit for a term that is
/// subtracted.
template <int room>
struct Terms {
  alignas(64) double rx[room], ry[room], t[room];
};

/// The live terms of one group.
struct LiveTerms {
  static constexpr int windows = WindowGroup::windows;
  static constexpr int room = windows * suture::kernels::window_terms + lanes;  ///< read in whole vectors
  const WindowGroup* group = nullptr;
  int batches = 0;               ///< of the group that are in use
  std::uint64_t middle_live = 0; ///< one bit per window
  Terms<windows> of_middle;      ///< by window, live or not
  int count = 0;                 ///< of the others
  Terms<room> others;
  TermSlots other_slots[room];

  /// use(slots, number of the term in of_middle).
  template <class Use>
  SUTURE_INLINE void for_each_middle(Use&& use) const {
    for (std::uint64_t m = middle_live; m != 0; m &= m - 1) {
      const int window = __builtin_ctzll(m);
      const TermSlots& slots = group->slots[window];
      use(TermSlots{slots.p, slots.q + middle}, window);
    }
  }
};

/// Where a group's vertices are: one bit per window, made as bytes of one batch of eight windows.
struct GroupPlaces {
  enum Question { after_start, before_end = after_start + segments, near_first = before_end + segments, near_last, near_middle, questions };
  unsigned char bytes[questions][batches];

  SUTURE_INLINE void put(int question, int batch, Mask8 m) { bytes[question][batch] = static_cast<unsigned char>(bits(m)); }
  std::uint64_t operator[](int question) const {
    std::uint64_t all;
    __builtin_memcpy(&all, bytes[question], sizeof all);
    return all;
  }
};

SUTURE_INLINE void place(const Shell& s, double reach2, const WindowGroup& group, int batch, GroupPlaces& places, LiveTerms& terms) {
  const WindowGroup::Slots* slots = group.slots + batch * lanes;
  Double8 dx[points], dy[points];  // from the points to the vertex
  load_quads(s.x, &slots->q, dx);
  load_quads(s.y, &slots->q, dy);
  const Double8 px = load_each(s.x, &slots->p), py = load_each(s.y, &slots->p);
  for (int k = 0; k < points; ++k) dx[k] = px - dx[k], dy[k] = py - dy[k];
  for (int k = 0; k < segments; ++k) {
    const Double8 ex = dx[k] - dx[k + 1], ey = dy[k] - dy[k + 1];
    const Double8 along = dx[k] * ex + dy[k] * ey, length2 = ex * ex + ey * ey;
    places.put(GroupPlaces::after_start + k, batch, less(0.0, along));
    places.put(GroupPlaces::before_end + k, batch, less(along, length2));
    if (k != middle) continue;
    const Double8 t = minimum(maximum(along * inverse(length2), Double8{}), broadcast(1.0));
    const Double8 rx = dx[k] - t * ex, ry = dy[k] - t * ey;
    store(terms.of_middle.rx + batch * lanes, rx);
    store(terms.of_middle.ry + batch * lanes, ry);
    store(terms.of_middle.t + batch * lanes, t);
    places.put(GroupPlaces::near_middle, batch, less(rx * rx + ry * ry, reach2));
  }
  const auto near = [&](int k) { return less(dx[k] * dx[k] + dy[k] * dy[k], reach2); };
  places.put(GroupPlaces::near_first, batch, near(0));
  places.put(GroupPlaces::near_last, batch, near(segments));
}

/// Which windows have a segment's and a point's term besides the middle one, number by number (segment k goes from point k to
/// k + 1), and where the point's is added and not subtracted. Segments out of reach are among them.
struct OtherTerms {
  std::uint64_t segment[segments], point[points], added[points];
  std::uint64_t any;
};

SUTURE_INLINE OtherTerms find_terms(const GroupPlaces& places, LiveTerms& terms) {
  const std::uint64_t known = ~std::uint64_t{0} >> (WindowGroup::windows - terms.batches * lanes);
  OtherTerms found{};
  std::uint64_t start[points]{};
  for (int k = 0; k < segments; ++k) {
    start[k] = places[GroupPlaces::after_start + k] & terms.group->segments[k] & known;
    found.added[k + 1] = start[k] & ~places[GroupPlaces::before_end + k];
    found.segment[k] = start[k] & ~found.added[k + 1];
  }
  for (int k = 0; k < points; ++k) found.point[k] = start[k] ^ found.added[k];
  // Where the nearest point of the middle segment is its first end (even if the window does not have that segment), and its second.
  const std::uint64_t first = found.added[middle] & ~places[GroupPlaces::after_start + middle];
  const std::uint64_t second = found.added[middle + 1] & found.point[middle + 1];
  terms.middle_live = (found.segment[middle] | first | second) & places[GroupPlaces::near_middle];
  found.segment[middle] = 0;
  // Where the middle segment is out of reach, so are its ends.
  found.point[middle] &= ~first & places[GroupPlaces::near_middle];
  found.point[middle + 1] &= ~second & places[GroupPlaces::near_middle];
  found.point[0] &= places[GroupPlaces::near_first];
  found.point[segments] &= places[GroupPlaces::near_last];
  for (const std::uint64_t term : found.segment) found.any |= term;
  for (const std::uint64_t term : found.point) found.any |= term;
  return found;
}

/// All terms in reach of a window but for that of the middle segment.
SUTURE_INLINE void append_window(const Shell& s, double reach2, int window, const OtherTerms& found, LiveTerms& terms) {
  const TermSlots slots = terms.group->slots[window];
  const double px = s.x[slots.p], py = s.y[slots.p];
  const double *x = s.x + slots.q, *y = s.y + slots.q;
  const auto has = [window](std::uint64_t bits) { return (bits >> window & 1u) != 0; };
  const auto put = [&](int k, double rx, double ry, double t) {
    if (!(rx * rx + ry * ry < reach2)) return;
    const int at = terms.count++;
    terms.others.rx[at] = rx, terms.others.ry[at] = ry, terms.others.t[at] = t;
    terms.other_slots[at] = {slots.p, slots.q + k};
  };
  for (int k = 0; k < points; ++k) {
    if (has(found.point[k])) put(k, px - x[k], py - y[k], has(found.added[k]) ? 0.0 : -0.0);
    if (k == segments || !has(found.segment[k])) continue;
    const double ex = x[k + 1] - x[k], ey = y[k + 1] - y[k], rx = px - x[k], ry = py - y[k];
    const double t = std::max(0.0, (rx * ex + ry * ey) / (ex * ex + ey * ey));  // bits say that it is positive; rounded otherwise here
    put(k, rx - t * ex, ry - t * ey, t);
  }
}

SUTURE_INLINE void choose(const Shell& s, double reach2, const GroupPlaces& places, LiveTerms& terms) {
  const OtherTerms found = find_terms(places, terms);
  terms.count = 0;
  for (std::uint64_t m = found.any; m != 0; m &= m - 1) append_window(s, reach2, __builtin_ctzll(m), found, terms);
}

/// Calls use(terms) with the terms of each group that are nearer than the root of reach2, which is at most the contact's reach.
template <class Use>
SUTURE_INLINE void for_live_terms(const Shell& s, double reach2, const WindowGroup* groups, std::size_t windows, Use&& use) {
  const int count = static_cast<int>((windows + WindowGroup::windows - 1) / WindowGroup::windows);
  const auto used = [&](int k) {
    const std::size_t left = windows - static_cast<std::size_t>(k) * WindowGroup::windows;
    return static_cast<int>((std::min(left, std::size_t{WindowGroup::windows}) + lanes - 1) / lanes);
  };
  // What a pass stores the next one reads in other pieces, which a store just made would hold up. So the passes work on
  // successive groups.
  GroupPlaces places[2];
  LiveTerms terms[3];
  for (int k = 0; k < count + 2; ++k) {
    if (k < count) {
      LiveTerms& here = terms[k % 3];
      here.group = groups + k, here.batches = used(k);
      for (int batch = 0; batch < here.batches; ++batch) place(s, reach2, groups[k], batch, places[k % 2], here);
    }
    if (k >= 1 && k <= count) choose(s, reach2, places[(k - 1) % 2], terms[(k - 1) % 3]);
    if (k >= 2) use(terms[(k - 2) % 3]);
  }
}
