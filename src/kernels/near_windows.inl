// The windows of the contact list: the boxes that a vertex is in, distances to their segments, runs of near segments, and where to cut
// them. Each pass goes over many vertices, and what nearly always happens has no branch that depends on distances: mispredicted
// branches took most of the time.

constexpr int most = suture::kernels::window_segments;

/// Squared distances of (px, py) from the eight segments that begin at slot q.
SUTURE_INLINE Double8 squared_distances(const Shell& s, int q, double px, double py) {
  const Double8 dx = px - load(s.x + q), dy = py - load(s.y + q);
  const Double8 ex = load(s.ex + q), ey = load(s.ey + q);
  const Double8 inverse = load(s.inverse_length + q);
  Double8 t = (dx * ex + dy * ey) * (inverse * inverse);
  t = select(less(0.0, t), select(less(t, 1.0), t, broadcast(1.0)), Double8{});
  const Double8 rx = dx - t * ex, ry = dy - t * ey;
  return rx * rx + ry * ry;
}

/// Rows and columns of eight by eight bits, a row a byte.
SUTURE_INLINE std::uint64_t transposed(std::uint64_t bits) {
  const auto swap = [&](int distance, std::uint64_t which) {
    const std::uint64_t differ = (bits ^ bits >> distance) & which;
    bits ^= differ ^ differ << distance;
  };
  swap(7, 0x00aa00aa00aa00aa), swap(14, 0x0000cccc0000cccc), swap(28, 0x00000000f0f0f0f0);
  return bits;
}

/// Which boxes have one of the eight vertices from `slot` on inside, and a bit for each vertex and each of them: of the first vertex
/// first, as many bytes a vertex as the function returns.
SUTURE_INLINE int find_boxes(const NearQuery& query, int slot, int vertices) {
  const NearBoxes& near = query.near;
  const Double8 px = load(query.shell.x + slot), py = load(query.shell.y + slot);
  const Box8 box = box_of(px, py);
  const unsigned own = vertices < lanes ? (1u << vertices) - 1 : 0xffu;
  auto* const rows = reinterpret_cast<unsigned char*>(query.rows);
  int found = 0;
  for (int first = 0; first < near.count; first += lanes)
    for (unsigned left = boxes_meeting(box, near.boxes, first, near.count - first); left != 0; left &= left - 1) {
      const int k = first + __builtin_ctz(left);
      const Mask8 outside = less(px, near.boxes.x0[k]) | less(near.boxes.x1[k], px) | less(py, near.boxes.y0[k]) | less(near.boxes.y1[k], py);
      const unsigned inside = bits(~outside) & own;
      query.found[found] = k;
      rows[found] = static_cast<unsigned char>(inside);
      found += inside != 0;
    }
  const int words = (found + lanes - 1) / lanes;
  std::fill(rows + found, rows + lanes * words, 0);
  auto* const columns = reinterpret_cast<unsigned char*>(query.columns);
  for (int w = 0; w < words; ++w) {
    const std::uint64_t column = transposed(query.rows[w]);
    for (int v = 0; v < lanes; ++v) columns[words * v + w] = static_cast<unsigned char>(column >> lanes * v);
  }
  return words;
}

/// Bits of the near segments and squared distances of every vertex and box it is in, by vertex and box; returns the number of groups,
/// of one vertex and one cell. Boxes that follow one another in their cell have successive places, between others is one that stays
/// empty: no run goes on there.
SUTURE_INLINE int measure(const NearQuery& query, int slot, int vertices) {
  const NearBoxes& near = query.near;
  int groups = 0, place = -1;
  for (int first = 0; first < vertices; first += lanes) {
    const int words = find_boxes(query, slot + first, vertices - first);
    int before = -2, cell = -1, vertex = -1;
    for (int w = 0; w < words; ++w)
      for (std::uint64_t left = query.columns[w]; left != 0; left &= left - 1) {
        const int bit = 64 * w + __builtin_ctzll(left), byte = bit / lanes, v = words == 1 ? byte : byte / words;
        const int box = query.found[lanes * (byte - words * v) + bit % lanes], p = slot + first + v;
        const NearBoxes::Of& of = near.of[box];
        const bool same = v == vertex && of.cell == cell;
        place += same && of.follows && box == before + 1 ? 1 : 2;
        query.groups[groups] = {p, box, place};
        groups += !same;
        const Double8 d2 = squared_distances(query.shell, of.first_slot + of.segment, query.shell.x[p], query.shell.y[p]);
        store(query.distance2 + lanes * place, d2);
        query.bits[place] = static_cast<unsigned char>(bits(less(d2, query.reach2) & first_lanes(of.count - of.segment)));
        query.bits[place + 1] = 0;
        query.segments[place] = of.segment;
        before = box, cell = of.cell, vertex = v;
      }
  }
  query.groups[groups].place = place + 2;
  return groups;
}

/// Runs of a group one segment after the other, with copies of the distances. Numbering is cyclic: a run over the end comes first and
/// is not cut there.
NearRun* find_runs(const NearQuery& query, const NearGroup& group, int places, int& room, NearRun* out) {
  const NearBoxes::Of& of = query.near.of[group.box];
  const int n = of.count;
  double* const d2 = query.distance2 + room;
  int* const numbers = query.numbers;
  int count = 0;
  for (int place = group.place; place < group.place + places; ++place)
    for (unsigned left = query.bits[place]; left != 0; left &= left - 1, ++count) {
      d2[count] = query.distance2[lanes * place + __builtin_ctz(left)];
      numbers[count] = query.segments[place] + __builtin_ctz(left);
    }
  if (count > 0 && count < n && numbers[0] == 0 && numbers[count - 1] == n - 1) {
    int lead = count - 1;  // where the run over the end begins
    while (numbers[lead - 1] == numbers[lead] - 1) --lead;
    std::rotate(numbers, numbers + lead, numbers + count);
    std::rotate(d2, d2 + lead, d2 + count);
  }
  for (int first = 0, last; first < count; first = last) {
    for (last = first + 1; last < count && numbers[last] == (numbers[last - 1] + 1) % n;) ++last;
    *out++ = {group.slot, of.first_slot + numbers[first], room + first, last - first, n - numbers[first], n, of.cell};
  }
  room += count;
  return out;
}

/// Runs of near segments of all groups, in their order.
SUTURE_INLINE NearRun* list_runs(const NearQuery& query, int groups) {
  NearRun* out = query.runs;
  int room = lanes * query.groups[groups].place;
  for (int g = 0; g < groups; ++g) {
    const auto [slot, box, place] = query.groups[g];
    const int last = query.groups[g + 1].place - 2, places = last - place + 1;
    const NearBoxes::Of& of = query.near.of[box];
    const int tail = of.count - 1 - query.segments[last];  // where the cell's last segment is
    const bool over_end = query.segments[place] == 0 && tail < lanes && (query.bits[place] & query.bits[last] >> tail & 1u) != 0;
    if (over_end || places > 8) [[unlikely]] {
      out = find_runs(query, query.groups[g], places, room, out);
      continue;
    }
    std::uint64_t near;
    __builtin_memcpy(&near, query.bits + place, sizeof near);
    near &= ~std::uint64_t{0} >> (64 - lanes * places);
    const auto put = [&, slot = slot, place = place] {
      const int at = near != 0 ? __builtin_ctzll(near) : 0;
      const std::uint64_t beyond = ~(near >> at);
      const int length = beyond != 0 ? __builtin_ctzll(beyond) : 64;
      const int segment = query.segments[place + at / lanes] + at % lanes;
      *out = {slot, of.first_slot + segment, lanes * place + at, length, of.count - segment, of.count, of.cell};
      near &= at + length < 64 ? ~std::uint64_t{0} << (at + length) : 0;
    };
    const bool any = near != 0;
    put();
    out += any;
    for (; near != 0; ++out) [[unlikely]] put();
  }
  return out;
}

/// How far before its first segment the first window over a run begins, so that the nearest is the middle of one: what is in reach
/// lies beside it, and at a cut in reach the windows on either side would have a term each that cancel.
constexpr int lead_of(int nearest) { return (2 * nearest + 1) % most; }

/// Windows over any run; returns how many.
int cut_any_run(const NearQuery& query, const NearRun& run, Window* out) {
  const double* const d2 = query.distance2 + run.at;
  int count = 0;
  for (int first = -lead_of(static_cast<int>(std::min_element(d2, d2 + run.length) - d2)); first < run.length; first += most) {
    const int begin = std::max(first, 0), end = std::min(first + most, run.length);
    const double closest = *std::min_element(d2 + begin, d2 + end);
    int band = 0;
    for (const double edge2 : query.edge2) band += closest >= edge2;
    out[count++] = {run.slot, run.q + begin - (begin < run.before_end ? 0 : run.count), static_cast<std::int16_t>(end - begin),
                    static_cast<std::int16_t>(band)};
  }
  return count;
}

/// The windows over up to eight segments: how many; where each begins and how many segments it has.
struct Cut {
  static constexpr int windows = (lanes + 2 * (most - 1)) / most;
  int count;
  int begin[windows];
  std::int16_t segments[windows];
};
constexpr Cut cut(int length, int nearest) {
  Cut result{};
  for (int first = -lead_of(nearest); first < length; first += most) {
    const int begin = std::max(first, 0);
    result.begin[result.count] = begin;
    result.segments[result.count++] = static_cast<std::int16_t>(std::min(first + most, length) - begin);
  }
  return result;
}
struct Cuts {
  Cut of[lanes + 1][lanes];
};
constexpr Cuts cuts = [] {
  Cuts all{};
  for (int length = 1; length <= lanes; ++length)
    for (int nearest = 0; nearest < length; ++nearest) all.of[length][nearest] = cut(length, nearest);
  return all;
}();

/// Whether a run has at most eight segments and does not go over the end.
SUTURE_INLINE bool simple(const NearRun& run) { return run.length <= std::min(lanes, run.before_end); }

/// The number of a run's nearest segment and how near the windows about it are: bits 3 k .. 3 k + 2 say for window k how many of bands
/// 1, 2, ... it is nearer than.
SUTURE_INLINE void look_at(const NearQuery& query, NearRun& run) {
  static_assert(most == 3 && suture::kernels::window_bands - 1 < 1 << most);
  const Double8 d2 = select(first_lanes(run.length), load(query.distance2 + run.at), broadcast(INFINITY));
  run.nearest = __builtin_ctz(bits(~less(least(d2), d2)));
  run.nearer = 0;
  for (const double edge2 : query.edge2) {
    const unsigned within = bits(less(d2, edge2)) << lead_of(run.nearest);
    run.nearer += (within | within >> 1 | within >> 2) & 0111111;
  }
}

/// The same as cut_any_run for simple runs, without branches that depend on distances. Writes three windows at least.
SUTURE_INLINE int cut_simple_run(const NearRun& run, Window* out) {
  const Cut& cut = cuts.of[run.length][run.nearest];
  const auto put = [&](int k) {
    out[k] = {run.slot, run.q + cut.begin[k], cut.segments[k],
              static_cast<std::int16_t>(suture::kernels::window_bands - 1 - static_cast<int>(run.nearer >> (most * k) & 7u))};
  };
  put(0), put(1), put(2);
  if (cut.count > 3) [[unlikely]] put(3);
  return cut.count;
}

int near_windows(const NearQuery& query_of_cell, int slot, int vertices, Window* out) {
  const NearQuery query = query_of_cell;
  const int groups = measure(query, slot, vertices);
  NearRun* const end = list_runs(query, groups);
  for (NearRun* run = query.runs; run != end; ++run)
    if (simple(*run)) look_at(query, *run);
  for (NearRun* run = query.runs; run != end; ++run) {
    run->windows = simple(*run) ? cut_simple_run(*run, out) : cut_any_run(query, *run, out);
    out += run->windows;
  }
  return static_cast<int>(end - query.runs);
}
