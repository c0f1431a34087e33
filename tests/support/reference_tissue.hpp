// The 50-cell configuration of tests/data as a TissueState with the parameters of a closure run.
#pragma once

#include "suture/io/state_csv.hpp"
#include "suture/model/state.hpp"

namespace suture::test {

inline Config reference_config(SpringLaw law = SpringLaw::quadratic) {
  Config config;
  config.membrane.law = law;
  config.contact.distance = 0.12967913341208;
  return config;
}

inline TissueState reference_state(const Config& config) {
  return make_state(read_state_csv(std::string(SUTURE_SOURCE_DIR) + "/tests/data/perturbed_large.csv"), config);
}

}  // namespace suture::test
