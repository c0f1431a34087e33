// Small problems and short ways to integrate them, for the tests of the solvers.
#pragma once

#include <span>
#include <vector>

#include "suture/integrate/integrator.hpp"
#include "suture/model/state.hpp"
#include "suture/ode/tissue_ode.hpp"

namespace suture::test {

/// Every point of a regular polygon of `vertices` corners on the circle of `radius` around the origin; rest lengths are
/// the side, rest area the area, so that the cell is in equilibrium whatever its other material.
TissueState regular_cell(int vertices, double radius, CellMaterial material);

/// The same cell with its outline deformed by smooth waves: relaxes far from any kink of the contact law.
TissueState wavy_cell(int vertices, CellMaterial material, double amplitude = 0.08);

/// Two triangles of no stiffness whose apices face each other across `gap` along x; only the two apices come near the
/// other cell. Vertex 0 is the first apex at the origin, vertex 3 the second.
TissueState facing_triangles(double gap);

/// Contact parameters with every field set; `distance` is s.
ContactParameters contact_law(double distance, double adhesion = 0.1, bool self_contact = true);

TissueOdeOptions ode_options(const ContactParameters& contact, SpringLaw law = SpringLaw::quadratic,
                             bool plastic = true, double skin = 0.13);

/// Tolerances in model units of length, for positions and rest lengths alike.
IntegratorOptions with_tolerance(Method method, double tolerance);
IntegratorOptions with_step(Method method, double step);

/// y at t1, starting from y at t0.
std::vector<double> integrate(OdeSystem& system, const IntegratorOptions& options, double t0, std::span<const double> y,
                              double t1, Statistics* statistics = nullptr);

/// Root mean square and largest absolute difference. The spans have equal, positive length.
double rms_difference(std::span<const double> a, std::span<const double> b);
double largest_difference(std::span<const double> a, std::span<const double> b);
double largest(std::span<const double> a);

}  // namespace suture::test
