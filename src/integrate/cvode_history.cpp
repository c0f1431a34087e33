#include "integrate/cvode_history.hpp"

#include <cvode/cvode.h>

#include <algorithm>
#include <cmath>

namespace suture {

CvodeHistory::CvodeHistory(void* cvode, const VectorFamily& family) : cvode_(cvode), family_(&family) {}

bool CvodeHistory::verified(N_Vector scratch, bool known) {
  double now, gamma, rl1;
  N_Vector zn0, y, f, zn1;
  void* user;
  int order = 0;
  zn_.clear();
  if (CVodeGetNonlinearSystemData(cvode_, &now, &zn0, &y, &f, &gamma, &rl1, &zn1, &user) != CV_SUCCESS) return false;
  if (CVodeGetLastOrder(cvode_, &order) != CV_SUCCESS || CVodeGetLastStep(cvode_, &h_) != CV_SUCCESS) return false;
  const auto first = std::find(family_->members.begin(), family_->members.end(), zn0);
  if (order < 1 || family_->members.end() - first <= order || *(first + 1) != zn1) return false;
  zn_.assign(first, first + order + 1);
  double scale = 1.0;  // j!/h^j
  for (int j = 0; j <= order; scale *= ++j / h_)
    if ((j == order || !known) && !has_derivative(now, j, scale, scratch)) return false;
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
