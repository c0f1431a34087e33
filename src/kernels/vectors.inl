// Fused vector operations. Lengths are rounded up to whole cache lines by the owners, whose padding is zero.

double weighted_square_sum(std::size_t n, const double* x, const double* w) {
  Double8 s0{}, s1{};
  for (std::size_t k = 0; k < n; k += lanes) {
    const Double8 a = load(x + k) * load(w + k);
    (k & lanes ? s1 : s0) += a * a;
  }
  return sum(s0 + s1);
}

double dot(std::size_t n, const double* x, const double* y) {
  Double8 s0{}, s1{};
  for (std::size_t k = 0; k < n; k += lanes) (k & lanes ? s1 : s0) += load(x + k) * load(y + k);
  return sum(s0 + s1);
}

/// z = a x + b y
void linear_sum(std::size_t n, double a, const double* x, double b, const double* y, double* z) {
  for (std::size_t k = 0; k < n; k += lanes) store(z + k, a * load(x + k) + b * load(y + k));
}

/// z = sum of c[j] x[j]
void linear_combination(std::size_t n, int count, const double* c, const double* const* x, double* z) {
  for (std::size_t k = 0; k < n; k += lanes) {
    Double8 a = c[0] * load(x[0] + k);
    for (int j = 1; j < count; ++j) a += c[j] * load(x[j] + k);
    store(z + k, a);
  }
}

/// z[j] = a[j] x + y[j]
void scale_add_multi(std::size_t n, int count, const double* a, const double* x, const double* const* y, double* const* z) {
  for (std::size_t k = 0; k < n; k += lanes) {
    const Double8 v = load(x + k);
    for (int j = 0; j < count; ++j) store(z[j] + k, a[j] * v + load(y[j] + k));
  }
}
