#include "integrate/minimising_newton.hpp"

#include <algorithm>
#include <cmath>

namespace suture {

MinimisingNewton::MinimisingNewton(GradientFlowSystem& system, const NewtonOptions& options)
    : system_(&system), operations_(system.workers()), options_(options) {
  allocate();
}

void MinimisingNewton::allocate() {
  n_ = system_->position_count();
  padded_ = (n_ + 7) / 8 * 8;
  buffer_ = {};  // before it is taken anew
  buffer_ = AlignedBuffer(7 * padded_);
  for (double** v : {&q_, &f_, &trial_, &z_, &d_, &r_, &p_}) *v = buffer_.take(n_);
}

void MinimisingNewton::system_changed() {
  if (n_ != static_cast<std::size_t>(system_->position_count())) allocate();
  preconditioner_gamma_ = 0.0;
}

Evaluation MinimisingNewton::residual(std::span<const double> q, double* f) {
  ++counts_.residuals;
  return system_->residual(q, span(f));
}

double MinimisingNewton::norm(double squared) const {
  return options_.weight * std::sqrt(std::max(squared, 0.0) / static_cast<double>(n_));
}

bool MinimisingNewton::preconditioner_aged(double gamma) const {
  // Between events the step changes by factors of two; up to three a set-up costs more than the iterations it saves.
  constexpr double most = 3.0;
  const double ratio = gamma / preconditioner_gamma_;
  return preconditioner_gamma_ == 0.0 || ratio > most || ratio < 1.0 / most || preconditioner_age_ > 40 ||
         last_linear_ > 3 * std::max(fresh_linear_, 2);
}

void MinimisingNewton::refresh(double gamma) {
  system_->set_up_preconditioner();
  ++counts_.setups;
  preconditioner_gamma_ = gamma;
  preconditioner_age_ = 0;
  fresh_linear_ = 0;
  last_linear_ = 0;
}

double MinimisingNewton::precondition_residual() {
  system_->precondition(span(f_), span(z_));
  return operations_.dot(padded_, f_, z_);
}

double MinimisingNewton::linearise(double gamma, double fz, bool renew) {
  system_->linearise();
  ++counts_.hessians;
  if (!options_.always_set_up && !(renew && preconditioner_age_ > 1)) return fz;
  refresh(gamma);
  return precondition_residual();
}

bool MinimisingNewton::too_long(std::span<const double> prediction, const NewtonTarget& target) {
  operations_.linear_sum(n_, 1.0, q_, -1.0, prediction.data(), trial_);  // beyond n_ all is zero
  return norm(operations_.dot(padded_, trial_, trial_)) > target.give_up;
}

NewtonResult MinimisingNewton::given_up() {
  std::copy_n(trial_, n_, z_);
  ++counts_.early_exits;
  return NewtonResult::too_long;
}

bool MinimisingNewton::secants(double& fz, double wanted) {
  const VectorOperations& k = operations_;
  constexpr double shortest = 0.05, longest = 3.0;  // a step beyond these, or one uphill, tells of contacts that P does not know
  constexpr double most_growth = 4.0;                // of the squared error, which need not fall in every iteration
  bool moved = false;
  double* const change = d_;  // of the residual
  k.linear_sum(padded_, -1.0, z_, 0.0, z_, p_);
  for (int iteration = 1; iteration <= options_.maximum_secants; ++iteration) {
    if (k.add_and_largest(padded_, q_, p_, trial_) > options_.largest_move || residual(span(trial_), r_) != Evaluation::ok) break;
    ++counts_.iterations;
    const double step = fz / k.subtract_and_dot(padded_, r_, f_, p_, change);
    if (!(step > shortest && step < longest)) break;
    k.add_scaled_twice(padded_, step, p_, q_, change, f_);
    moved = true;
    const double before = fz;
    fz = precondition_residual();
    last_linear_ = iteration;
    if (fresh_linear_ == 0) fresh_linear_ = iteration;
    if (norm(fz) <= wanted || !(fz <= most_growth * before)) break;
    k.linear_sum(padded_, std::max(0.0, step * k.dot(padded_, z_, change) / before), p_, -1.0, z_, p_);
  }
  return moved;
}

void MinimisingNewton::conjugate_gradients(double fz, double target) {
  const VectorOperations& k = operations_;
  double* const product = trial_;
  std::fill_n(d_, n_, 0.0);
  k.linear_sum(padded_, -1.0, f_, 0.0, f_, r_);
  k.linear_sum(padded_, -1.0, z_, 0.0, z_, p_);
  constexpr int most = 200;
  int iteration = 0;
  double rz = fz;
  for (; iteration < most && norm(rz) > target; ++iteration) {
    system_->product(span(p_), span(product));
    const double curvature = k.dot(padded_, p_, product);
    if (curvature <= 0.0) {  // keep what there is; at the start that is the preconditioned gradient
      if (iteration == 0) std::copy_n(p_, n_, d_);
      break;
    }
    const double step = rz / curvature;
    k.linear_sum(padded_, 1.0, d_, step, p_, d_);
    k.linear_sum(padded_, 1.0, r_, -step, product, r_);
    system_->precondition(span(r_), span(z_));
    const double next = k.dot(padded_, r_, z_);
    k.linear_sum(padded_, 1.0, z_, next / rz, p_, p_);
    rz = next;
  }
  counts_.linear_iterations += iteration;
  last_linear_ = iteration;
  if (fresh_linear_ == 0) fresh_linear_ = iteration;
}

/// Shortening the step at some segments only may turn it uphill; then all of it is shortened.
void MinimisingNewton::limit_step() {
  const VectorOperations& k = operations_;
  constexpr double least_descent = 0.3;  // of that of the step as it was
  const double descent = k.dot(padded_, f_, d_);
  double* const whole = trial_;
  std::copy_n(d_, n_, whole);
  system_->limit_step(span(q_), span(d_));
  if (!(k.dot(padded_, f_, d_) <= least_descent * descent))
    k.linear_sum(padded_, system_->step_limit(span(q_), span(whole)), whole, 0.0, whole, d_);
}

bool MinimisingNewton::line_search() {
  const VectorOperations& k = operations_;
  limit_step();
  const double longest = k.add_and_largest(padded_, q_, d_, trial_);
  if (longest > options_.largest_move) k.linear_sum(padded_, options_.largest_move / longest, d_, 0.0, d_, d_);
  // The derivative along d is piecewise linear, so secants are nearly exact. Where a contact closes on the way it rises steeply behind
  // that point, and a secant over the point ends before it, where nothing is known of the contact: so the search goes on.
  const double slope = k.dot(padded_, f_, d_), enough = 0.5 * std::abs(slope);
  double low = 0.0, at_low = slope, high = 0.0, at_high = 0.0, step = 1.0;  // high = 0: none yet
  constexpr int most = 10;
  for (int trial = 1; trial <= most; ++trial) {
    if (trial == most && low > 0.0) step = low;  // nothing better is known
    k.linear_sum(padded_, 1.0, q_, step, d_, trial_);
    if (residual(span(trial_), r_) != Evaluation::ok) {
      step = low + 0.25 * (step - low);
      continue;
    }
    const double end = k.dot(padded_, r_, d_);
    if (end <= enough && (end >= -enough || high == 0.0 || trial == most)) {
      std::swap(q_, trial_);
      std::swap(f_, r_);
      return true;
    }
    if (step < 1e-4) break;
    if (end < 0.0) {
      if (low > 0.0) at_high *= 0.5;
      low = step, at_low = end;
    } else {
      high = step, at_high = end;
    }
    const double part = at_low / (at_low - at_high);
    step = low + std::clamp(part, 0.1, 0.9) * (high - low);
  }
  return false;
}

/// A segment that shrinks to nothing leaves the potential without a gradient to vanish: what has not been reached after
/// many iterations is not reached by more of them, and the shorter step that a failure asks for has the same trouble.
double MinimisingNewton::allowance(int iteration) {
  return iteration < 6 ? 1.0 : iteration < 10 ? 3.0 : 6.0;
}

NewtonResult MinimisingNewton::failed() {
  ++counts_.failures;
  return NewtonResult::not_converged;
}

NewtonResult MinimisingNewton::solve(double gamma, std::span<double> q, const NewtonTarget& target) {
  const VectorOperations& k = operations_;
  const double wanted = 0.5 * target.tolerance;
  std::copy_n(q.data(), n_, q_);
  if (residual(span(q_), f_) != Evaluation::ok) {
    std::fill_n(z_, n_, 0.0);
    return failed();
  }
  ++preconditioner_age_;
  bool linearised = false;
  if (preconditioner_aged(gamma)) {
    system_->linearise();
    ++counts_.hessians;
    refresh(gamma);
    linearised = true;
  }
  double fz = precondition_residual();
  const bool tried = options_.maximum_secants > 0 && !options_.always_set_up && norm(fz) > wanted;
  if (tried && secants(fz, wanted)) {
    const bool far = too_long(q, target);
    if (norm(fz) > wanted) {  // f_ is interpolated
      linearised = false;
      if (far) std::copy_n(q.data(), n_, q_);  // led astray by contacts that P does not know
      if (residual(span(q_), f_) != Evaluation::ok) return failed();
      fz = precondition_residual();
    } else if (far) {
      return given_up();
    }
  }
  for (int iteration = 0;; ++iteration) {
    const double error = norm(fz);
    const bool last = iteration == options_.maximum_iterations;
    if (error <= allowance(iteration) * wanted) {
      k.linear_sum(padded_, 1.0, q_, -1.0, z_, q_);  // a free correction, already paid for
      std::copy_n(q_, n_, q.data());
      return NewtonResult::converged;
    }
    if (last || !std::isfinite(error)) return failed();
    if (!linearised) fz = linearise(gamma, fz, tried && iteration == 0);
    linearised = false;
    ++counts_.iterations;
    conjugate_gradients(fz, std::max(options_.forcing * error, wanted));
    if (!line_search()) return failed();
    if (too_long(q, target)) return given_up();
    fz = precondition_residual();
  }
}

}  // namespace suture
