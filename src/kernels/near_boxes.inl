// Boxes around eight consecutive segments each, widened by the reach: which segments can be near a cell or a vertex, and which
// vertices of one cell are near each other.

SUTURE_INLINE double least(Double8 a) {
#if defined(__AVX512F__)
  return _mm512_reduce_min_pd(a.r[0]);
#else
  const auto lower = [](double one, double two) { return two < one ? two : one; };
  return lower(lower(lower(a[0], a[4]), lower(a[2], a[6])), lower(lower(a[1], a[5]), lower(a[3], a[7])));
#endif
}

void segment_boxes(const Shell& s, int cell, double margin, const SegmentBoxes& boxes, int first, double* box) {
  const int b = s.base[cell] + 1, n = s.count[cell];
  double x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY;
  for (int k = 0; k < n; k += lanes) {
    const int at = first + k / lanes;
    const Double8 x = load(s.x + b + k), y = load(s.y + b + k), next_x = load(s.x + b + k + 1), next_y = load(s.y + b + k + 1);
    const double low_x = least(minimum(x, next_x)), high_x = -least(minimum(-x, -next_x));
    const double low_y = least(minimum(y, next_y)), high_y = -least(minimum(-y, -next_y));
    boxes.x0[at] = low_x - margin, boxes.y0[at] = low_y - margin, boxes.x1[at] = high_x + margin, boxes.y1[at] = high_y + margin;
    x0 = std::fmin(x0, low_x), y0 = std::fmin(y0, low_y), x1 = std::fmax(x1, high_x), y1 = std::fmax(y1, high_y);
  }
  box[0] = x0, box[1] = y0, box[2] = x1, box[3] = y1;
}

/// Appends the boxes of `other` that meet the box of a cell.
void near_boxes(const Shell& s, const double* box, const SegmentBoxes& all, int first, int other, int number, NearBoxes& near) {
  const int n = s.count[other], boxes = (n + lanes - 1) / lanes;
  for (int k = 0; k < boxes; k += lanes) {
    const Double8 x0 = load(all.x0 + first + k), y0 = load(all.y0 + first + k), x1 = load(all.x1 + first + k), y1 = load(all.y1 + first + k);
    const Mask8 apart = less(box[2], x0) | less(x1, box[0]) | less(box[3], y0) | less(y1, box[1]);
    const unsigned meet = bits(first_lanes(boxes - k) & ~apart);
    store_packed(near.boxes.x0 + near.count, meet, x0), store_packed(near.boxes.y0 + near.count, meet, y0);
    store_packed(near.boxes.x1 + near.count, meet, x1), store_packed(near.boxes.y1 + near.count, meet, y1);
    for (unsigned left = meet; left != 0; left &= left - 1) {
      const int segment = lanes * (k + __builtin_ctz(left));
      for (const double* a : {s.x, s.y, s.ex, s.ey, s.inverse_length}) __builtin_prefetch(a + s.base[other] + 1 + segment);
      near.of[near.count] = {number, segment, s.base[other] + 1, n, near.count > 0 && near.of[near.count - 1].cell == number &&
                                                                        near.of[near.count - 1].segment == segment - lanes};
      ++near.count;
    }
  }
}

/// Box of the eight vertices from `slot` on.
struct Box8 {
  double x0, y0, x1, y1;
};
SUTURE_INLINE Box8 box_of(Double8 x, Double8 y) { return {least(x), least(y), -least(-x), -least(-y)}; }

/// Bit k: whether box first + k of `count` <= 8 meets `box`.
SUTURE_INLINE unsigned boxes_meeting(const Box8& box, const SegmentBoxes& boxes, int first, int count) {
  const Mask8 apart = less(box.x1, load(boxes.x0 + first)) | less(load(boxes.x1 + first), box.x0) | less(box.y1, load(boxes.y0 + first)) |
                      less(load(boxes.y1 + first), box.y0);
  return bits(first_lanes(count) & ~apart);
}

bool near_pairs(const Shell& s, int cell, int first, const SegmentBoxes& boxes, int first_box, double reach2, std::uint64_t* words) {
  const int b = s.base[cell] + 1, n = s.count[cell], begin = first / lanes, end = (n + lanes - 1) / lanes;
  const Box8 box = box_of(load(s.x + b + first), load(s.y + b + first));
  constexpr std::uint64_t beyond_next = 0x0080c0e0f0f8fc, all = ~std::uint64_t{0};  // byte i: lanes i + 2 and later
  std::uint64_t any = 0;
  std::fill_n(words + begin, end - begin, 0);
  for (int c = begin; c < end; c += lanes)
    for (unsigned left = boxes_meeting(box, boxes, first_box + c, end - c); left != 0; left &= left - 1) {
      const int k = c + __builtin_ctz(left), j = lanes * k;
      const Double8 x = load(s.x + b + j), y = load(s.y + b + j);
      std::uint64_t word = 0;
      for (int i = 0; i < lanes; ++i) {
        const Double8 dx = s.x[b + first + i] - x, dy = s.y[b + first + i] - y;
        word |= std::uint64_t{bits(less(dx * dx + dy * dy, reach2))} << lanes * i;
      }
      if (n - j < lanes) word &= 0x0101010101010101 * ((1u << (n - j)) - 1);
      if (n - first < lanes) word &= all >> lanes * (lanes - (n - first));
      if (k == begin) word &= beyond_next;
      if (k == begin + 1) word &= ~(std::uint64_t{1} << 56);
      if (first == 0 && k == end - 1) word &= ~(std::uint64_t{1} << (n - 1 - j));
      words[k] = word;
      any |= word;
    }
  return any != 0;
}
