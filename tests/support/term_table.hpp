// The one table of all energy terms. Every property test runs over it; a new term adds a row to term_table.cpp.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "suture/model/state.hpp"
#include "suture/physics/term.hpp"

namespace suture::test {

struct TermCase {
  std::string name;
  /// No outer reference: energy invariant under motion and reflection, no net force or torque.
  bool internal = true;
  /// A configuration on which the term acts.
  std::function<TissueState(std::uint64_t seed)> make_state;
  /// The term for that configuration, or for a moved, reflected or renumbered copy of it.
  std::function<std::shared_ptr<const EnergyTerm>(const TissueState&)> make_term;
};

const std::vector<TermCase>& term_table();

}  // namespace suture::test
