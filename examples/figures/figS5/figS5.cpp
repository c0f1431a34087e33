// Fig. S5: a cell pulled by a force dipole. At every point of the published table: the final shape parameter by the overdamped
// motion with both membrane laws, and with unit vertex mass and unit damping, as the published data were made.
#include <memory>

#include "../csv.hpp"
#include "suture/integrate/integrator.hpp"
#include "suture/io/config.hpp"
#include "suture/measure/cell_shape.hpp"
#include "suture/ode/tissue_ode.hpp"
#include "suture/physics/constant_load.hpp"
#include "suture/simulate/cell_experiment.hpp"

using namespace suture;
using namespace suture::figures;

namespace {

/// The overdamped system with inertia: y = [r | v | l0], dr/dt = v, dv/dt = (F - b v)/m with m = b = 1. TissueOde's rate
/// of positions is F/b.
class InertialOde final : public OdeSystem {
 public:
  explicit InertialOde(TissueOde& overdamped)
      : overdamped_(overdamped), positions_(overdamped.position_count()), y_(overdamped.size()), rate_(overdamped.size()) {}

  int size() const override { return overdamped_.size() + positions_; }
  int position_count() const override { return positions_; }
  std::string refusal() const override { return overdamped_.refusal(); }
  std::string component_name(int i) const override { return fmt::format("component {}", i); }

  Evaluation rate(double t, std::span<const double> y, std::span<double> out) override {
    const int memory = overdamped_.size() - positions_;
    for (int i = 0; i < positions_; ++i) y_[i] = y[i];
    for (int i = 0; i < memory; ++i) y_[positions_ + i] = y[2 * positions_ + i];
    if (const Evaluation result = overdamped_.rate(t, y_, rate_); result != Evaluation::ok) return result;
    for (int i = 0; i < positions_; ++i) out[i] = y[positions_ + i];
    for (int i = 0; i < positions_; ++i) out[positions_ + i] = rate_[i] - y[positions_ + i];
    for (int i = 0; i < memory; ++i) out[2 * positions_ + i] = rate_[positions_ + i];
    return Evaluation::ok;
  }

 private:
  TissueOde& overdamped_;
  int positions_;
  std::vector<double> y_, rate_;
};

double inertial_shape(const Config& config) {
  TissueState cell = make_round_cell(config);
  TissueOdeOptions options{.membrane_law = config.membrane.law, .contact = config.contact};
  options.contact.distance = cell.tissue.mean_initial_rest_length();
  const auto load = std::make_shared<ConstantLoad>(dipole_forces(config, cell), std::vector<double>(cell.tissue.vertex_count()));
  TissueOde overdamped(cell.tissue, 0, options, {load});
  InertialOde system(overdamped);
  const int positions = overdamped.position_count();
  std::vector<double> y(system.size(), 0.0);
  for (int i = 0; i < positions; ++i) y[i] = cell.values[i];
  for (int i = positions; i < overdamped.size(); ++i) y[positions + i] = cell.values[i];
  // The fastest vibration has a period of about 0.4; a quarter of this step changes the shape by less than 1e-5.
  const IntegratorOptions method{.method = Method::rk4, .time_step = 0.02};
  const auto integrator = make_integrator(system, method, 0.0, y);
  while (integrator->time() < config.dipole.duration) integrator->step(config.dipole.duration);
  const auto end = integrator->state();
  for (int i = 0; i < positions; ++i) cell.values[i] = end[i];
  return cell_shapes(cell.tissue, cell.view()).front().shape_parameter();
}

double overdamped_shape(Config config, SpringLaw law) {
  config.membrane.law = law;
  const CellExperimentResult result = run_cell_experiment(config);
  if (result.failure) throw NumericalError(*result.failure);
  return result.samples.back().shape_parameter;
}

}  // namespace

int main(int argc, char** argv) {
  return figure_main(argc, argv, [](const auto& out, const auto& published, const auto&) {
    Config config = read_config(published / "../../examples/dipole.toml");
    config.output.interval = config.output.frame_interval = 100.0;
    config.integrator.tolerance = config.integrator.rest_length_tolerance = 1e-5;
    CsvFile file(out / "dipole.csv", "k_a,tau,tau_over_T,published,relative,quadratic,inertial");
    for (const CsvRow& row : read_csv(published / "figS5_dipole.csv")) {
      config.area.stiffness = number(row, "ka_star");
      config.plasticity.tau = number(row, "tau_star");
      config.dipole.duration = number(row, "t_last");
      file.row(config.area.stiffness, config.plasticity.tau, number(row, "tau_over_T_nominal500"), number(row, "shape_A_T"),
               overdamped_shape(config, SpringLaw::relative), overdamped_shape(config, SpringLaw::quadratic), inertial_shape(config));
    }
  });
}
