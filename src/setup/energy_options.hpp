// Shared by the stages of the protocol: what the cells feel, as TissueOde wants to hear it.
#pragma once

#include <span>

#include "suture/model/parameters.hpp"
#include "suture/ode/tissue_ode.hpp"
#include "suture/setup/fire.hpp"

namespace suture {

/// The width of the membrane: contact.distance, or the mean initial rest length of the configured tissue. It must not
/// change when cells are removed, so it comes from the configuration, never from the tissue at hand.
double contact_distance(const Config& config);

/// Elastic cells with the given adhesion l1.
TissueOdeOptions elastic_options(const Config& config, double adhesion);

/// sqrt(1/largest curvature) of U, estimated from the stiffest springs: explicit motion of unit mass is stable for time
/// steps below twice this.
double fastest_time(const Tissue& tissue, const ContactParameters& contact);

/// FIRE settings for vertices of unit mass.
FireOptions fire_options(const Tissue& tissue, const ContactParameters& contact, double force_tolerance,
                         int maximum_iterations);

/// Minimises the energy of `ode` from `state` with its rest lengths frozen.
FireReport minimise_energy(Fire& fire, TissueOde& ode, TissueState& state, const FireOptions& options,
                           const std::function<void()>& between_steps = {});

}  // namespace suture
