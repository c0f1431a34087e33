#include "integrate/cvode_history.hpp"

#include <cvode/cvode.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace suture {

std::optional<NonlinearSystem> nonlinear_system(void* cvode) {
  NonlinearSystem s;
  N_Vector y;
  void* user;
  if (CVodeGetNonlinearSystemData(cvode, &s.t, &s.predicted, &y, &s.rate, &s.gamma, &s.rl1, &s.zn1, &user) != CV_SUCCESS) return std::nullopt;
  return s;
}

CvodeHistory::CvodeHistory(void* cvode, const VectorFamily& family) : cvode_(cvode), family_(&family) {}

bool CvodeHistory::find() {
  const std::optional<NonlinearSystem> system = nonlinear_system(cvode_);
  int order = 0;
  zn_.clear();
  if (!system) return false;
  now_ = system->t;
  if (CVodeGetLastOrder(cvode_, &order) != CV_SUCCESS || CVodeGetLastStep(cvode_, &h_) != CV_SUCCESS) return false;
  const auto first = std::find(family_->members.begin(), family_->members.end(), system->predicted);
  if (order < 1 || family_->members.end() - first <= order || *(first + 1) != system->zn1) return false;
  zn_.assign(first, first + order + 1);
  return true;
}

bool CvodeHistory::verified(N_Vector scratch, bool known) {
  if (!find()) return false;
  const int order = static_cast<int>(zn_.size()) - 1;
  double scale = 1.0;  // j!/h^j
  for (int j = 0; j <= order; scale *= ++j / h_)
    if ((j == order || !known) && !has_derivative(now_, j, scale, scratch)) return false;
  return true;
}

/// The sum over j of s^j zn[j], from the highest on as CVODE adds them, in whole vectors of eight.
bool CvodeHistory::interpolate(double t, std::span<const int> components, std::span<double> y, std::vector<double>& room) {
  if (!find()) return false;
  const std::size_t terms = zn_.size(), n = (components.size() + 7) / 8 * 8;
  const double s = (t - now_) / h_;
  room.assign((terms + 1) * n, 0.0);
  std::array<double, VectorOperations::most_vectors> power;
  std::array<const double*, VectorOperations::most_vectors> term;
  for (std::size_t i = 0; i < terms; ++i) {
    const std::size_t j = terms - 1 - i;
    const std::span<const double> all = values(zn_[j]);
    double* const some = room.data() + i * n;
    for (std::size_t k = 0; k < components.size(); ++k) some[k] = all[components[k]];
    term[i] = some;
    power[i] = 1.0;
    for (std::size_t m = 0; m < j; ++m) power[i] *= s;
  }
  double* const sum = room.data() + terms * n;
  family_->operations.linear_combination(n, static_cast<int>(terms), power.data(), term.data(), sum);
  for (std::size_t k = 0; k < components.size(); ++k) y[components[k]] = sum[k];
  return true;
}

bool CvodeHistory::has_derivative(double t, int j, double scale, N_Vector scratch) const {
  if (CVodeGetDky(cvode_, t, j, scratch) != CV_SUCCESS) return false;
  const std::span<const double> derivative = values(scratch), term = values(zn_[j]);
  bool differs = false;
  for (std::size_t k = 0; k < term.size(); ++k) differs |= std::abs(derivative[k] - scale * term[k]) > 1e-12 * std::abs(derivative[k]);
  return !differs;
}

/// zn'[k] = sum over j >= k of binomial(j, k) s^(j-k) zn[j], s = shift/h, by repeated Horner steps.
void CvodeHistory::shift(double shift) {
  const double s = shift / h_;
  if (s == 0.0) return;
  for (std::size_t k = 0; k + 1 < zn_.size(); ++k)
    for (std::size_t j = zn_.size() - 1; j > k; --j) N_VLinearSum(1.0, zn_[j - 1], s, zn_[j], zn_[j - 1]);
}

double CvodeHistory::set_rate(N_Vector f, N_Vector weights) {
  N_VLinearSum(1.0, f, -1.0 / h_, zn_[1], zn_[1]);
  const double jump = N_VWrmsNorm(zn_[1], weights);
  N_VScale(h_, f, zn_[1]);
  return jump;
}

}  // namespace suture
