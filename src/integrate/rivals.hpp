// The explicit rivals of CVODE, behind the same face.
#pragma once

#include <memory>

#include "suture/integrate/integrator.hpp"

namespace suture {

/// Adaptive stabilised Runge-Kutta-Chebyshev method of order 2 (Sommeijer, Shampine and Verwer 1998).
std::unique_ptr<Integrator> make_rkc2(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y);

/// Fixed steps of options.time_step: forward Euler (order 1) or the classical Runge-Kutta method (order 4).
std::unique_ptr<Integrator> make_euler(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y);
std::unique_ptr<Integrator> make_rk4(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y);

}  // namespace suture
