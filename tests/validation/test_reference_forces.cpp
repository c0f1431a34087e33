// Every term against the published implementation of the model, on the configurations of data/reference_forces.
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "suture/io/state_csv.hpp"

using namespace suture;

namespace {

/// The shared data beside the source tree, or the one configuration that is kept in it.
std::filesystem::path reference_folder() {
  const std::filesystem::path source = SUTURE_SOURCE_DIR;
  for (const auto& folder : {source / "../shared/data/reference_forces", source / "../../shared/data/reference_forces"})
    if (std::filesystem::exists(folder)) return folder;
  return source / "tests/data";
}

using Columns = std::map<std::string, std::vector<std::string>>;

Columns read_columns(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line, field;
  std::vector<std::string> names;
  Columns columns;
  for (bool header = true; std::getline(file, line); header = false) {
    std::istringstream fields(line);
    for (std::size_t k = 0; std::getline(fields, field, ','); ++k)
      header ? names.push_back(field) : columns[names.at(k)].push_back(field);
  }
  return columns;
}

double largest_difference(const std::vector<double>& ours, const std::vector<std::string>& theirs) {
  REQUIRE(ours.size() == theirs.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const double difference = std::abs(ours[i] - std::stod(theirs[i]));
    if (!(difference <= largest)) largest = difference;
  }
  return largest;
}

/// How the reference data were made (its README).
Config reference_config() {
  Config config;
  config.area.stiffness = 1.0;
  config.membrane = {.law = SpringLaw::relative, .stiffness = 1.0};
  config.bending.stiffness = 1.0;
  config.contact = {.energy = 0.5, .distance = 0.12967913341208, .adhesion = 0.1, .range = 0.3, .self_contact = true};
  return config;
}

}  // namespace

TEST_CASE("the forces and energies of the published implementation are reproduced", "[validation]") {
  int compared = 0;
  for (const std::string name : {"packing", "perturbed_small", "perturbed_large"}) {
    const auto path = reference_folder() / (name + ".csv");
    if (!std::filesystem::exists(path)) continue;
    const Columns forces = read_columns(path), energies = read_columns(reference_folder() / (name + "_energy.csv"));
    const TissueState state = make_state(read_state_csv(path.string()), reference_config());
    REQUIRE(state.tissue.vertex_count() == 1500);
    for (const TermForces& term : evaluate_forces(state, reference_config())) {
      INFO(name << ", " << term.term);
      CHECK(largest_difference(term.fx, forces.at(term.term + "_fx")) < 1e-11);
      CHECK(largest_difference(term.fy, forces.at(term.term + "_fy")) < 1e-11);
      const auto& terms = energies.at("term");
      const auto row = std::find(terms.begin(), terms.end(), term.term) - terms.begin();
      const double expected = std::stod(energies.at("energy").at(row));
      CHECK(std::abs(term.energy - expected) < 1e-11 * std::abs(expected));
      ++compared;
    }
  }
  CHECK(compared >= 4);
}

TEST_CASE("the defaults of a tissue with the reference's shape are the reference's contact law", "[validation]") {
  const TissueState state = make_state(
      read_state_csv((std::filesystem::path(SUTURE_SOURCE_DIR) / "tests/data/perturbed_large.csv").string()), Config{});
  CHECK(state.tissue.mean_initial_rest_length() == Approx(0.12967913341208).epsilon(1e-13));
}
