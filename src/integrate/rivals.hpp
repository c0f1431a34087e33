// The explicit rivals of CVODE, behind the same face.
#pragma once

#include <memory>

#include "suture/integrate/integrator.hpp"

namespace suture {

/// Adaptive stabilised Runge-Kutta-Chebyshev method of order 2 (Sommeijer, Shampine and Verwer 1998).
std::unique_ptr<Integrator> make_rkc2(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y);

/// Adaptive explicit Runge-Kutta method of order 3 (Bogacki and Shampine 1989) from ARKODE.
std::unique_ptr<Integrator> make_arkode(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y);

/// CVODE's Adams formulas, up to options.maximum_order, solved by Anderson-accelerated fixed-point iteration.
std::unique_ptr<Integrator> make_adams(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y);

/// RKC2 while its steps take at most options.switch_stages evaluations on average, CVODE otherwise.
std::unique_ptr<Integrator> make_automatic(GradientFlowSystem& system, const IntegratorOptions& options, double t,
                                           std::span<const double> y);

/// Fixed steps of options.time_step: forward Euler (order 1), the classical Runge-Kutta method (order 4), or the modified
/// velocity Verlet method (order 2), which gives every vertex the mass options.vertex_mass and so solves another equation:
/// m r'' = -dU/dr - b r', whose solution differs from the overdamped one by O(m/b).
std::unique_ptr<Integrator> make_euler(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y);
std::unique_ptr<Integrator> make_verlet(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y);
std::unique_ptr<Integrator> make_rk4(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y);

}  // namespace suture
