// Factorisation of symmetric cyclic block-pentadiagonal matrices of 2 x 2 blocks, L D L^T with the last two block rows
// as a border that absorbs the cyclic corners. T is Double8 (eight matrices at once, one per lane),
// Float16 or double.

template <class T>
struct Block2 {
  T xx, xy, yx, yy;
};

template <class T>
inline Block2<T> times(const Block2<T>& a, const Block2<T>& b) {
  return {a.xx * b.xx + a.xy * b.yx, a.xx * b.xy + a.xy * b.yy, a.yx * b.xx + a.yy * b.yx, a.yx * b.xy + a.yy * b.yy};
}
template <class T>
inline Block2<T> times_transpose(const Block2<T>& a, const Block2<T>& b) {
  return {a.xx * b.xx + a.xy * b.xy, a.xx * b.yx + a.xy * b.yy, a.yx * b.xx + a.yy * b.xy, a.yx * b.yx + a.yy * b.yy};
}
template <class T>
inline Block2<T> operator-(const Block2<T>& a, const Block2<T>& b) {
  return {a.xx - b.xx, a.xy - b.xy, a.yx - b.yx, a.yy - b.yy};
}

inline double square_root(double a) { return std::sqrt(a); }
inline double maximum(double a, double b) { return a > b ? a : b; }

inline double select(bool m, double a, double b) { return m ? a : b; }
inline bool less(double a, double b) { return a < b; }
inline bool any(bool a) { return a; }

/// Inverse of the pivot `a`. One whose lowest eigenvalue is below `floor` shows an indefinite matrix: it is lifted to the
/// scale of the diagonal block it came from, which keeps the factors definite and bounded (lifted to the floor only,
/// they grow by coupling/floor with every row).
template <class T>
inline Block2<T> safe_inverse(Block2<T> a, const Block2<T>& original, double floor) {
  const T above_x = a.xx - floor, above_y = a.yy - floor;
  const auto weak = less(above_x + above_y, T{}) | less(above_x * above_y, a.xy * a.xy);
  if (any(weak)) [[unlikely]] {  // square roots are slow, and every row waits for the one before
    const T mean = 0.5 * (a.xx + a.yy), half = 0.5 * (a.xx - a.yy);
    const T lowest = mean - square_root(half * half + a.xy * a.xy);
    const T scale = maximum(0.5 * (original.xx + original.yy), T{} + 1.0);
    const T lift = select(weak, scale - lowest, T{});
    a.xx += lift, a.yy += lift;
  }
  const T inverse = 1.0 / (a.xx * a.yy - a.xy * a.xy);
  return {a.yy * inverse, -a.xy * inverse, -a.xy * inverse, a.xx * inverse};
}

/// The border's elimination, column by column behind the band's.
template <class T>
struct BorderRows {
  Block2<T>* row[2];
  Block2<T> pivot[2], coupling;
  Block2<T> w1[2]{}, w2[2]{};  ///< the two previous blocks before scaling by the pivot

  inline void eliminate(int j, const Block2<T>* d, const Block2<T>* l1, const Block2<T>* l2) {
    Block2<T> w[2];
    for (int k = 0; k < 2; ++k) {
      w[k] = row[k][j];
      if (j >= 1) w[k] = w[k] - times_transpose(w1[k], l1[j]);
      if (j >= 2) w[k] = w[k] - times_transpose(w2[k], l2[j]);
      row[k][j] = times(w[k], d[j]);
      // What the next columns subtract is (scaled block) D (L row)^T = (unscaled block)(L row)^T.
      pivot[k] = pivot[k] - times_transpose(row[k][j], w[k]);
      w2[k] = w1[k];
      w1[k] = w[k];
    }
    coupling = coupling - times_transpose(row[1][j], w[0]);
  }
};

template <class T>
void cyclic_factor(const CyclicBatch& m) {
  auto* d = reinterpret_cast<Block2<T>*>(m.diagonal);
  auto* l1 = reinterpret_cast<Block2<T>*>(m.lower1);
  auto* l2 = reinterpret_cast<Block2<T>*>(m.lower2);
  const int n = m.rows, p = n - 2;  // p band rows, then the border
  auto* rows = reinterpret_cast<Block2<T>*>(m.border);
  BorderRows<T> border{{rows, rows + n}, {d[p], d[p + 1]}, l1[n - 1]};
  for (int i = 0; i < p; ++i) {
    const Block2<T> original = d[i];
    if (i >= 1) {
      Block2<T> w = l1[i];
      if (i >= 2) {
        const Block2<T> a2 = l2[i];
        w = w - times_transpose(a2, l1[i - 1]);
        l2[i] = times(a2, d[i - 2]);
        d[i] = d[i] - times_transpose(l2[i], a2);
      }
      l1[i] = times(w, d[i - 1]);
      d[i] = d[i] - times_transpose(l1[i], w);
    }
    d[i] = safe_inverse(d[i], original, m.floor);
    border.eliminate(i, d, l1, l2);  // independent of the next band row: the processor does both at a time
  }
  d[p] = safe_inverse(border.pivot[0], d[p], m.floor);
  l1[n - 1] = times(border.coupling, d[p]);
  d[p + 1] = safe_inverse(border.pivot[1] - times_transpose(l1[n - 1], border.coupling), d[p + 1], m.floor);
}

template <class T>
struct Vector2 {
  T x, y;
};
/// r - a v, one operation behind the other: v is what the next row waits for.
template <class T>
inline Vector2<T> minus(const Vector2<T>& r, const Block2<T>& a, const Vector2<T>& v) {
  return {r.x - a.xx * v.x - a.xy * v.y, r.y - a.yx * v.x - a.yy * v.y};
}
template <class T>
inline Vector2<T> minus_transpose(const Vector2<T>& r, const Block2<T>& a, const Vector2<T>& v) {
  return {r.x - a.xx * v.x - a.yx * v.y, r.y - a.xy * v.x - a.yy * v.y};
}
template <class T>
inline Vector2<T> times(const Block2<T>& a, const Vector2<T>& v) {
  return {a.xx * v.x + a.xy * v.y, a.yx * v.x + a.yy * v.y};
}

/// Factors as CyclicBatch or CellFactors hold them. The blocks of neighbours that a row does not have are zero.
template <class T, class Factors, class Number>
void cyclic_solve(const Factors& m, Number* rhs) {
  const auto blocks = [](const Number* p) { return reinterpret_cast<const Block2<T>*>(p); };
  const Block2<T>*d = blocks(m.diagonal), *l1 = blocks(m.lower1), *l2 = blocks(m.lower2);
  const int n = m.rows, p = n - 2;
  const Block2<T>* border[2] = {blocks(m.border), blocks(m.border) + n};
  auto* r = reinterpret_cast<Vector2<T>*>(rhs);
  Vector2<T> last[2] = {r[p], r[p + 1]}, before{}, v{};
  for (int i = 0; i < p; ++i) {
    const Vector2<T> next = minus(minus(r[i], l2[i], before), l1[i], v);
    before = v, v = next;
    r[i] = v;
    last[0] = minus(last[0], border[0][i], v);
    last[1] = minus(last[1], border[1][i], v);
  }
  last[1] = times(d[p + 1], minus(last[1], l1[n - 1], last[0]));
  last[0] = minus_transpose(times(d[p], last[0]), l1[n - 1], last[1]);
  before = v = {};
  for (int i = p - 1; i >= 0; --i) {
    Vector2<T> next = minus_transpose(minus_transpose(times(d[i], r[i]), border[0][i], last[0]), border[1][i], last[1]);
    if (i + 2 < p) next = minus_transpose(next, l2[i + 2], before);
    if (i + 1 < p) next = minus_transpose(next, l1[i + 1], v);
    before = v, v = next;
    r[i] = v;
  }
  r[p] = last[0], r[p + 1] = last[1];
}

void cyclic_factor1(const CyclicBatch& m) { cyclic_factor<double>(m); }
void cyclic_factor8(const CyclicBatch& m) { cyclic_factor<Double8>(m); }
void cyclic_solve1(const CyclicBatch& m, double* rhs) { cyclic_solve<double>(m, rhs); }
void cyclic_solve8(const CyclicBatch& m, double* rhs) { cyclic_solve<Double8>(m, rhs); }
