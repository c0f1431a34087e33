// A failed step in physical words.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "suture/integrate/integrator.hpp"

namespace suture {

/// A component of y and its error in units of its tolerance.
struct WorstComponent {
  int index;
  double error;
};

/// Those with the largest errors, at most five, the largest first; none whose error is zero or not a number.
std::vector<WorstComponent> worst_components(const OdeSystem& system, std::span<const double> errors, const IntegratorOptions& options);

/// "WHAT at t = ..., step ..., order ...; worst: cell 12, vertex 3, x (...); ...; last refusal: ...".
std::string failure_report(const OdeSystem& system, const std::string& what, double t, double step, int order,
                           std::span<const WorstComponent> worst);

}  // namespace suture
