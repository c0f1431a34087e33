#include "support/setup_tissues.hpp"

#include <limits>

#include "suture/setup/protocol.hpp"

namespace suture::test {

Config small_config() {
  Config config;
  config.tissue.cells = 7;
  config.tissue.vertices = 16;
  config.packing.initial_fraction = 0.7;
  config.packing.increment = 0.02;
  config.anneal.relaxation_time = 10.0;
  config.wound.cells = 1;
  config.wound.relaxation_time = 10.0;
  config.wound.minimum_area = 0.0;
  config.wound.maximum_hole = std::numeric_limits<double>::infinity();
  return config;
}

const Packing& packed_small_tissue() {
  static const Packing packing = make_packing(small_config());
  return packing;
}

Config small_closing_config(Method method) {
  Config config = with_contact_distance(small_config());
  config.run.closed_area = 1e-3;
  config.plasticity.tau = 3.0;
  config.integrator.method = method;
  return config;
}

TissueState small_wound(const Config& config) {
  static const TissueState wounded = [] {
    Config preparation = small_config();
    preparation.run.last_stage = Stage::ablation;
    return prepare_tissue(preparation).state;
  }();
  TissueState state = wounded;
  state.tissue = state.tissue.with_materials(std::vector<CellMaterial>(state.tissue.cell_count(), make_tissue(config).material(0)));
  return state;
}

MakeOde elastic_forces(const Config& config, const Tissue& tissue) {
  TissueOdeOptions options;
  options.membrane_law = config.membrane.law;
  options.contact = config.contact;
  options.contact.distance = tissue.mean_initial_rest_length();
  options.plastic = false;
  return [tissue, options] {
    return std::make_unique<TissueOde>(tissue, 0, options, std::vector<std::shared_ptr<const EnergyTerm>>{});
  };
}

}  // namespace suture::test
