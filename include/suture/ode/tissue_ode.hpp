// The tissue as one ODE: overdamped motion down the energy gradient plus the flow of the rest lengths.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "suture/model/state.hpp"
#include "suture/ode/ode_system.hpp"
#include "suture/physics/term.hpp"

namespace suture {

/// What the cells feel. `extra` terms (confinement, purse string, loads) go through the EnergyTerm interface; area,
/// membrane, bending and contact of the cells are computed by vectorised kernels and must not be repeated there.
struct TissueOdeOptions {
  SpringLaw membrane_law = SpringLaw::quadratic;
  ContactParameters contact;      ///< contact.distance must be set
  bool plastic = true;            ///< false: rest lengths are frozen
  double skin = 0.13;             ///< Verlet-list skin, model units of length
  int threads = 1;                ///< that share the work of a large tissue; 0: one per core. Results do not depend on it
};

class TissueOde final : public GradientFlowSystem {
 public:
  /// reference_rest_length: l0_ref, one per segment (empty: l0(0)).
  TissueOde(const Tissue& tissue, int ring_size, TissueOdeOptions options,
            std::vector<std::shared_ptr<const EnergyTerm>> extra, SharedValues reference_rest_length = {});
  ~TissueOde() override;

  const StateLayout& layout() const;
  /// Replaces the extra terms and the number of ring points; keeps the cells, their arrays and the contact list.
  void replace_extra(int ring_size, std::vector<std::shared_ptr<const EnergyTerm>> extra);

  /// dU/dr of everything, into gradient.x and gradient.y (overwritten). Used by FIRE and velocity Verlet too.
  Evaluation gradient(double t, const StateView& state, MutableStateView gradient);

  // OdeSystem
  int size() const override;
  Evaluation rate(double t, std::span<const double> y, std::span<double> out) override;
  /// Whether a vertex has gone through the membrane of another cell by a move that no contact could resist.
  bool jumps(std::span<const double> before, std::span<const double> after) override;
  std::string component_name(int i) const override;
  int position_count() const override;
  std::string refusal() const override;
  WorkerPool& workers() override;

  // GradientFlowSystem
  void begin_implicit_step(double t, double gamma, std::span<const double> psi) override;
  Evaluation residual(std::span<const double> q, std::span<double> residual) override;
  void linearise() override;
  void product(std::span<const double> v, std::span<double> out) override;
  void choose_linear_solver(LinearSolver solver) override;
  void set_up_preconditioner() override;
  void precondition(std::span<const double> r, std::span<double> z) override;
  void limit_step(std::span<const double> q, std::span<double> d) const override;
  double step_limit(std::span<const double> q, std::span<const double> d) const override;
  void recover_memory(std::span<const double> q, std::span<double> memory) override;

  /// Verlet-list rebuilds so far.
  long list_rebuilds() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace suture
