// Fused vector operations, of any length: whole vectors of eight, then what is left one by one.

double weighted_square_sum(std::size_t n, const double* x, const double* w) {
  Double8 s0{}, s1{};
  std::size_t k = 0;
  for (; k + lanes <= n; k += lanes) {
    const Double8 a = load(x + k) * load(w + k);
    (k & lanes ? s1 : s0) += a * a;
  }
  double rest = 0.0;
  for (; k < n; ++k) rest += x[k] * w[k] * (x[k] * w[k]);
  return sum(s0 + s1) + rest;
}

double dot(std::size_t n, const double* x, const double* y) {
  Double8 s0{}, s1{};
  std::size_t k = 0;
  for (; k + lanes <= n; k += lanes) (k & lanes ? s1 : s0) += load(x + k) * load(y + k);
  double rest = 0.0;
  for (; k < n; ++k) rest += x[k] * y[k];
  return sum(s0 + s1) + rest;
}

/// z = a x + b y
void linear_sum(std::size_t n, double a, const double* x, double b, const double* y, double* z) {
  std::size_t k = 0;
  for (; k + lanes <= n; k += lanes) store(z + k, a * load(x + k) + b * load(y + k));
  for (; k < n; ++k) z[k] = a * x[k] + b * y[k];
}

/// z = sum of c[j] x[j]
void linear_combination(std::size_t n, int count, const double* c, const double* const* x, double* z) {
  std::size_t k = 0;
  for (; k + lanes <= n; k += lanes) {
    Double8 a = c[0] * load(x[0] + k);
    for (int j = 1; j < count; ++j) a += c[j] * load(x[j] + k);
    store(z + k, a);
  }
  for (; k < n; ++k) {
    double a = c[0] * x[0][k];
    for (int j = 1; j < count; ++j) a += c[j] * x[j][k];
    z[k] = a;
  }
}

/// z[j] = a[j] x + y[j]
void scale_add_multi(std::size_t n, int count, const double* a, const double* x, const double* const* y, double* const* z) {
  std::size_t k = 0;
  for (; k + lanes <= n; k += lanes) {
    const Double8 v = load(x + k);
    for (int j = 0; j < count; ++j) store(z[j] + k, a[j] * v + load(y[j] + k));
  }
  for (; k < n; ++k) {
    const double v = x[k];
    for (int j = 0; j < count; ++j) z[j][k] = a[j] * v + y[j][k];
  }
}

/// The largest (x - x0)^2 + (y - y0)^2; what is not a number does not count.
double largest_move2(std::size_t n, const double* x, const double* y, const double* x0, const double* y0) {
  Double8 largest{};
  std::size_t k = 0;
  for (; k + lanes <= n; k += lanes) {
    const Double8 dx = load(x + k) - load(x0 + k), dy = load(y + k) - load(y0 + k);
    largest = maximum(largest, dx * dx + dy * dy);
  }
  double result = 0.0;
  for (int i = 0; i < lanes; ++i) result = std::fmax(result, largest[i]);
  for (; k < n; ++k) {
    const double dx = x[k] - x0[k], dy = y[k] - y0[k];
    result = std::fmax(result, dx * dx + dy * dy);
  }
  return result;
}

constexpr double huge = 1e300;

bool finite(std::size_t n, const double* x) {
  Mask8 fine = first_lanes(lanes);
  std::size_t k = 0;
  for (; k + lanes <= n; k += lanes) fine = fine & less(load(x + k), huge) & less(-huge, load(x + k));
  bool tail = true;
  for (; k < n; ++k) tail &= std::fabs(x[k]) < huge;
  return bits(~fine) == 0 && tail;
}

/// x = -x; returns what finite would.
bool negate(std::size_t n, double* x) {
  Mask8 fine = first_lanes(lanes);
  std::size_t k = 0;
  for (; k + lanes <= n; k += lanes) {
    const Double8 a = load(x + k);
    fine = fine & less(a, huge) & less(-huge, a);
    store(x + k, -a);
  }
  bool tail = true;
  for (; k < n; ++k) {
    tail &= std::fabs(x[k]) < huge;
    x[k] = -x[k];
  }
  return bits(~fine) == 0 && tail;
}
