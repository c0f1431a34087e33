// Fused vector operations, of any length: whole vectors of eight, then what is left one by one.

/// Sum of eight(k), k + 7 < n, and one(k) for what is left. Two sums that do not wait for each other.
template <class Eight, class One>
SUTURE_INLINE double sum_over(std::size_t n, const Eight& eight, const One& one) {
  Double8 s0{}, s1{};
  std::size_t k = 0;
  for (; k + 2 * lanes <= n; k += 2 * lanes) {
    s0 += eight(k);
    s1 += eight(k + lanes);
  }
  if (k + lanes <= n) {
    s0 += eight(k);
    k += lanes;
  }
  double rest = 0.0;
  for (; k < n; ++k) rest += one(k);
  return sum(s0 + s1) + rest;
}

double weighted_square_sum(std::size_t n, const double* x, const double* w) {
  return sum_over(
      n,
      [=](std::size_t k) {
        const Double8 a = load(x + k) * load(w + k);
        return a * a;
      },
      [=](std::size_t k) { return x[k] * w[k] * (x[k] * w[k]); });
}

double dot(std::size_t n, const double* x, const double* y) {
  return sum_over(n, [=](std::size_t k) { return load(x + k) * load(y + k); }, [=](std::size_t k) { return x[k] * y[k]; });
}

/// z = x - y; returns the sum of p z.
double subtract_and_dot(std::size_t n, const double* x, const double* y, const double* p, double* z) {
  return sum_over(
      n,
      [=](std::size_t k) {
        const Double8 difference = load(x + k) - load(y + k);
        store(z + k, difference);
        return load(p + k) * difference;
      },
      [=](std::size_t k) {
        z[k] = x[k] - y[k];
        return p[k] * z[k];
      });
}

/// z = x + y; returns the largest |y|.
double add_and_largest(std::size_t n, const double* x, const double* y, double* z) {
  Double8 largest{};
  std::size_t k = 0;
  for (; k + lanes <= n; k += lanes) {
    const Double8 v = load(y + k);
    store(z + k, load(x + k) + v);
    largest = maximum(largest, maximum(v, -v));
  }
  double result = 0.0;
  for (int i = 0; i < lanes; ++i) result = std::fmax(result, largest[i]);
  for (; k < n; ++k) {
    z[k] = x[k] + y[k];
    result = std::fmax(result, std::fabs(y[k]));
  }
  return result;
}

/// y0 += a x0, y1 += a x1
void add_scaled_twice(std::size_t n, double a, const double* x0, double* y0, const double* x1, double* y1) {
  std::size_t k = 0;
  for (; k + lanes <= n; k += lanes) {
    store(y0 + k, load(y0 + k) + a * load(x0 + k));
    store(y1 + k, load(y1 + k) + a * load(x1 + k));
  }
  for (; k < n; ++k) y0[k] += a * x0[k], y1[k] += a * x1[k];
}

/// z = a x + b y
void linear_sum(std::size_t n, double a, const double* x, double b, const double* y, double* z) {
  std::size_t k = 0;
  for (; k + lanes <= n; k += lanes) store(z + k, a * load(x + k) + b * load(y + k));
  for (; k < n; ++k) z[k] = a * x[k] + b * y[k];
}

/// z = sum of c[j] x[j]; their number is known when this is compiled, so that factors and addresses stay in registers.
template <int count>
void combine(std::size_t n, const double* c, const double* const* x, double* z) {
  const double* from[count];
  double factor[count];
  for (int j = 0; j < count; ++j) from[j] = x[j], factor[j] = c[j];
  std::size_t k = 0;
  for (; k + lanes <= n; k += lanes) {
    Double8 a = factor[0] * load(from[0] + k);
    for (int j = 1; j < count; ++j) a += factor[j] * load(from[j] + k);
    store(z + k, a);
  }
  for (; k < n; ++k) {
    double a = factor[0] * from[0][k];
    for (int j = 1; j < count; ++j) a += factor[j] * from[j][k];
    z[k] = a;
  }
}

void linear_combination(std::size_t n, int count, const double* c, const double* const* x, double* z) {
  switch (count) {
    case 1: return combine<1>(n, c, x, z);
    case 2: return combine<2>(n, c, x, z);
    case 3: return combine<3>(n, c, x, z);
    default: break;
  }
  combine<4>(n, c, x, z);
  for (int j = 4; j < count; ++j) linear_sum(n, 1.0, z, c[j], x[j], z);
}

/// z[j] = a[j] x + y[j]
template <int count>
void add_scaled(std::size_t n, const double* a, const double* x, const double* const* y, double* const* z) {
  const double* from[count];
  double *to[count], factor[count];
  for (int j = 0; j < count; ++j) from[j] = y[j], to[j] = z[j], factor[j] = a[j];
  std::size_t k = 0;
  for (; k + lanes <= n; k += lanes) {
    const Double8 v = load(x + k);
    for (int j = 0; j < count; ++j) store(to[j] + k, factor[j] * v + load(from[j] + k));
  }
  for (; k < n; ++k) {
    const double v = x[k];
    for (int j = 0; j < count; ++j) to[j][k] = factor[j] * v + from[j][k];
  }
}

void scale_add_multi(std::size_t n, int count, const double* a, const double* x, const double* const* y, double* const* z) {
  for (; count > 4; count -= 4, a += 4, y += 4, z += 4) add_scaled<4>(n, a, x, y, z);
  switch (count) {
    case 1: return add_scaled<1>(n, a, x, y, z);
    case 2: return add_scaled<2>(n, a, x, y, z);
    case 3: return add_scaled<3>(n, a, x, y, z);
    default: return add_scaled<4>(n, a, x, y, z);
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

/// F of an implicit step from f = dU/dq: f <- (q - psi) + gamma f; returns whether f was finite.
bool implicit_residual(std::size_t n, const double* q, const double* psi, double gamma, double* f) {
  Mask8 fine = first_lanes(lanes);
  std::size_t k = 0;
  for (; k + lanes <= n; k += lanes) {
    const Double8 a = load(f + k);
    fine = fine & less(a, huge) & less(-huge, a);
    store(f + k, (load(q + k) - load(psi + k)) + gamma * a);
  }
  bool tail = true;
  for (; k < n; ++k) {
    tail &= std::fabs(f[k]) < huge;
    f[k] = (q[k] - psi[k]) + gamma * f[k];
  }
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
