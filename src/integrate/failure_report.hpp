// A failed step in physical words.
#pragma once

#include <span>
#include <string>

#include "suture/integrate/integrator.hpp"

namespace suture {

/// "WHAT at t = ..., step ..., order ...; worst: cell 12, vertex 3, x (...); ...; last refusal: ...".
std::string failure_report(const OdeSystem& system, const std::string& what, double t, double step, int order,
                           std::span<const double> local_errors, const IntegratorOptions& options);

}  // namespace suture
