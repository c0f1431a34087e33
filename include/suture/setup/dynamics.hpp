// The two motions of the protocol without plasticity and without purse string: at constant energy, and overdamped.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include "suture/integrate/integrator.hpp"
#include "suture/model/state.hpp"
#include "suture/ode/tissue_ode.hpp"
#include "suture/physics/term_sum.hpp"
#include "suture/setup/step_watch.hpp"

namespace suture {

/// Maxwell velocities of the cell vertices (unit mass; all x, then all y) at `temperature`: no total momentum, no total
/// angular momentum about the centre of mass, and a kinetic energy of exactly temperature per vertex (kT/2 per
/// component). Bit-identical for the same seed and positions.
std::vector<double> maxwell_velocities(const TissueState& state, double temperature, std::uint64_t seed,
                                       int attempt = 0);

struct EnergyReport {
  double initial = 0.0;  ///< kinetic plus potential
  double final = 0.0;
  double largest_deviation = 0.0;  ///< from `initial`, over the samples
};

/// A constant-energy motion on its way.
struct ConstantEnergyState {
  TissueState state;
  std::vector<double> velocities;
  double start = 0.0;  ///< time at its beginning
  std::int64_t steps_done = 0;
  EnergyReport report;
};

using MakeOde = std::function<std::unique_ptr<TissueOde>()>;

/// Constant-energy motion of unit masses by velocity Verlet (Swope, Andersen, Berens & Wilson 1982), second order in
/// the step; `duration` is covered in equal steps of at most `time_step`. Updates positions, velocities and time.
/// make_ode: the forces; called at the beginning and at every multiple of `checkpoint_interval`, so that no contact list is
/// older than the checkpoint taken there. energies: the terms it is the gradient of; their sum is sampled about ten times on
/// the way. Throws NumericalError when the forces cannot be computed.
EnergyReport move_at_constant_energy(const MakeOde& make_ode, const TermList& energies, TissueState& state,
                                     std::vector<double>& velocities, double duration, double time_step,
                                     double checkpoint_interval = std::numeric_limits<double>::infinity(),
                                     const StepWatch<ConstantEnergyState>& watch = {});

/// Told how far a motion is: fraction from 0 to 1, and one line for a person.
using MotionProgress = std::function<void(double fraction, std::string_view text)>;

/// An overdamped motion on its way.
struct RelaxationState {
  TissueState state;
  double start = 0.0;         ///< time at its beginning
  double initial_step = 0.0;  ///< with which the integrator starts afresh
  Statistics statistics;      ///< of the integrators so far
};

/// Overdamped motion of elastic cells without plasticity for `duration`, always by cvode, to anneal.tolerance.
/// Throws NumericalError when it fails.
Statistics relax_overdamped(const Config& config, TissueState& state, double duration,
                            const MotionProgress& progress = {}, const StepWatch<RelaxationState>& watch = {});

}  // namespace suture
