// Fig. S5: a cell pulled by a force dipole. At every point of the published table: the final shape parameter by the overdamped
// motion with both membrane laws, with inertia of the vertices, with inertia of vertices and rest lengths, the same from the published
// start, and by the published scheme step by step.
#include <memory>

#include "../csv.hpp"
#include "published_scheme.hpp"
#include "suture/integrate/integrator.hpp"
#include "suture/io/config.hpp"
#include "suture/physics/constant_load.hpp"

using namespace suture;
using namespace suture::figures;

namespace {

/// Unit mass and unit damping for the first components q of y: y = [all components | velocities], q'' + q' = their overdamped rate.
class InertialOde final : public OdeSystem {
 public:
  InertialOde(TissueOde& overdamped, int inertial)
      : overdamped_(overdamped), components_(overdamped.size()), inertial_(inertial), rate_(components_) {}

  int size() const override { return components_ + inertial_; }
  int position_count() const override { return overdamped_.position_count(); }
  std::string refusal() const override { return overdamped_.refusal(); }
  std::string component_name(int i) const override { return fmt::format("component {}", i); }

  Evaluation rate(double t, std::span<const double> y, std::span<double> out) override {
    if (const Evaluation result = overdamped_.rate(t, y.first(components_), rate_); result != Evaluation::ok) return result;
    for (int i = 0; i < components_; ++i) out[i] = i < inertial_ ? y[components_ + i] : rate_[i];
    for (int i = 0; i < inertial_; ++i) out[components_ + i] = rate_[i] - y[components_ + i];
    return Evaluation::ok;
  }

 private:
  TissueOde& overdamped_;
  int components_, inertial_;
  std::vector<double> rate_;
};

double inertial_shape(const Config& config, TissueState cell, bool rest_lengths) {
  const auto load = std::make_shared<ConstantLoad>(dipole_forces(config, cell), std::vector<double>(cell.tissue.vertex_count()));
  TissueOde overdamped(cell.tissue, 0, dipole_options(config, cell), {load});
  InertialOde system(overdamped, rest_lengths ? overdamped.size() : overdamped.position_count());
  std::vector<double> y = cell.values;
  y.resize(system.size(), 0.0);
  // The fastest vibration has a period of about 0.4; a quarter of this step changes the shape by less than 1e-5.
  const IntegratorOptions method{.method = Method::rk4, .time_step = 0.02};
  const auto integrator = make_integrator(system, method, 0.0, y);
  while (integrator->time() < config.dipole.duration) integrator->step(config.dipole.duration);
  for (std::size_t i = 0; i < cell.values.size(); ++i) cell.values[i] = integrator->state()[i];
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
    CsvFile file(out / "dipole.csv", "k_a,tau,tau_over_T,published,relative,quadratic,vertex_inertia,inertia,published_start,published_scheme,"
                                    "published_area,published_perimeter,scheme_area,scheme_perimeter");
    for (const CsvRow& row : read_csv(published / "figS5_dipole.csv")) {
      config.area.stiffness = number(row, "ka_star");
      config.plasticity.tau = number(row, "tau_star");
      config.dipole.duration = number(row, "t_last");
      const CellShape scheme = published_dipole(config);
      file.row(config.area.stiffness, config.plasticity.tau, number(row, "tau_over_T_nominal500"), number(row, "shape_A_T"),
               overdamped_shape(config, SpringLaw::relative), overdamped_shape(config, SpringLaw::quadratic),
               inertial_shape(config, make_round_cell(config), false), inertial_shape(config, make_round_cell(config), true),
               inertial_shape(config, published_start(config), true), scheme.shape_parameter(), number(row, "area_T"),
               number(row, "perimeter_T"), scheme.area, scheme.perimeter);
    }
  });
}
