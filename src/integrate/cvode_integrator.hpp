// CVODE (BDF) with our own nonlinear solver and vectors. SUNDIALS is seen only by this source and fused_nvector.
#pragma once

#include <memory>

#include "suture/integrate/integrator.hpp"

namespace suture {

/// Throws NumericalError when CVODE cannot be created or started.
std::unique_ptr<Integrator> make_cvode(GradientFlowSystem& system, const IntegratorOptions& options, double t,
                                       std::span<const double> y);

}  // namespace suture
