#include <catch2/catch.hpp>

#include "suture/io/nearest_name.hpp"

using namespace suture;

TEST_CASE("the edit distance counts insertions, deletions, substitutions and swaps", "[unit]") {
  CHECK(edit_distance("", "") == 0);
  CHECK(edit_distance("tau", "tau") == 0);
  CHECK(edit_distance("", "tau") == 3);
  CHECK(edit_distance("tau", "") == 3);
  CHECK(edit_distance("tau", "ta") == 1);
  CHECK(edit_distance("tau", "taux") == 1);
  CHECK(edit_distance("tau", "tao") == 1);
  CHECK(edit_distance("tau", "tua") == 1);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance("ca", "abc") == 3);  // restricted: no letter is edited twice
}

TEST_CASE("the nearest name is found, also in the wrong section, and nonsense has none", "[unit]") {
  const std::vector<std::string> names{"plasticity.tau", "plasticity.memory", "area.stiffness", "bending.stiffness"};
  CHECK(nearest_name("plasticty.tau", names) == "plasticity.tau");
  CHECK(nearest_name("plasticity.tua", names) == "plasticity.tau");
  CHECK(nearest_name("tau", names) == "plasticity.tau");
  CHECK(nearest_name("tissue.memory", names) == "plasticity.memory");
  CHECK(nearest_name("bending.stifness", names) == "bending.stiffness");
  CHECK(nearest_name("zzzzzzzz", names).empty());
  CHECK(suggestion("zzzzzzzz", names).empty());
  CHECK(suggestion("tau", names) == ", did you mean 'plasticity.tau'?");
}
