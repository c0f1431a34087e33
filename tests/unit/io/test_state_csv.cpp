#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "support/random_tissue.hpp"
#include "suture/errors.hpp"
#include "suture/io/state_csv.hpp"

using namespace suture;

namespace {

/// A file that disappears with the test.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& content = {}) {
    static int number = 0;
    path_ = (std::filesystem::temp_directory_path() /
             fmt::format("suture_state_csv_{}_{}", reinterpret_cast<std::uintptr_t>(&number), number++))
                .string() +
            ".csv";
    std::ofstream(path_) << content;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  const std::string& path() const { return path_; }
  std::string content() const {
    std::ostringstream text;
    text << std::ifstream(path_).rdbuf();
    return text.str();
  }

 private:
  std::string path_;
};

const std::string triangle = "cell,vertex,x,y,l0\n0,0,0,0,1\n0,1,1,0,1\n0,2,0,1,1\n";

void refuses(const std::string& content, int line, const std::string& words) {
  const TemporaryFile file(content);
  INFO(content);
  CHECK_THROWS_AS(read_state_csv(file.path()), InputError);
  CHECK_THROWS_WITH(read_state_csv(file.path()),
                    Catch::StartsWith(fmt::format("{}:{}: ", file.path(), line)) && Catch::Contains(words));
}

}  // namespace

TEST_CASE("columns are found by name, others ignored", "[unit]") {
  const TemporaryFile file("l0, y,area_fx,x,vertex,cell\r\n0.5,0,9,0,0,0\r\n0.6,0,9,1,1,0\r\n0.7,1,9,0,2,0\r\n\r\n");
  const StateTable table = read_state_csv(file.path());
  CHECK(table.vertex_counts == std::vector<int>{3});
  CHECK(table.x == std::vector<double>{0, 1, 0});
  CHECK(table.y == std::vector<double>{0, 0, 1});
  CHECK(table.rest_length == std::vector<double>{0.5, 0.6, 0.7});
}

TEST_CASE("mistakes in a state file are refused with file and line", "[unit]") {
  refuses("", 0, "no cells");
  refuses("cell,vertex,x,y,l0\n", 1, "no cells");
  refuses("cell,vertex,x,y\n", 1, "column 'l0' is missing");
  refuses("cell,vertex,x,y,l0,x\n", 1, "column 'x' appears 2 times");
  refuses(triangle + "1,0,5,5\n", 5, "4 fields where the header has 5");
  refuses(triangle + "1,0,5,five,1\n", 5, "column y: 'five' is not a number");
  refuses(triangle + "1,0,5,5x,1\n", 5, "column y: '5x' is not a number");
  refuses(triangle + "1,0,5,,1\n", 5, "column y: '' is not a number");
  refuses(triangle + "1,0.5,5,5,1\n", 5, "column vertex: '0.5' is not a whole number");
  refuses(triangle + "1,0,5,nan,1\n", 5, "column y: 'nan' is not finite");
  refuses(triangle + "1,0,inf,5,1\n", 5, "column x: 'inf' is not finite");
  refuses(triangle + "1,0,5,5,0\n", 5, "column l0: the rest length 0 is not positive");
  refuses(triangle + "1,0,5,5,-1\n", 5, "column l0: the rest length -1 is not positive");
  refuses(triangle + "0,4,5,5,1\n", 5,
          "found cell 0, vertex 4 where cell 0, vertex 3 or cell 1, vertex 0 was expected");
  refuses(triangle + "2,0,5,5,1\n", 5, "found cell 2, vertex 0");
  refuses("cell,vertex,x,y,l0\n1,0,0,0,1\n", 2, "found cell 1, vertex 0 where cell 0, vertex 0 was expected");
  refuses(triangle + "1,0,5,5,1\n1,1,6,5,1\n", 6, "cell 1 has 2 vertices");
  refuses("cell,vertex,x,y,l0\n0,0,0,0,1\n0,1,0,1,1\n0,2,1,0,1\n", 4, "must run counter-clockwise");
  CHECK_THROWS_AS(read_state_csv("/nonexistent/state.csv"), InputError);
}

TEST_CASE("cells of a state file take the material and rest lengths the configuration gives them", "[unit]") {
  const TemporaryFile file(triangle + "1,0,5,5,1\n1,1,6,5,1\n1,2,6,6,1\n1,3,5,6,1\n");
  Config config;
  config.cell_types.push_back({.name = "soft", .cells = 1, .area_stiffness = 3.0});
  const TissueState state = make_state(read_state_csv(file.path()), config);
  CHECK(state.tissue.vertex_count() == 7);
  CHECK(state.tissue.material(0).area_stiffness == 3.0);
  CHECK(state.tissue.material(1).area_stiffness == config.area.stiffness);
  CHECK(state.tissue.initial_rest_length(3) == regular_rest_length(4, 1.0, config.tissue.shape_parameter));
  CHECK(state.view().rest_length[6] == 1.0);
  CHECK(state.values.size() == 21);
  config.cell_types[0].cells = 3;
  CHECK_THROWS_AS(make_state(read_state_csv(file.path()), config), InputError);
}

TEST_CASE("written forces can be read back as a state, bit by bit", "[unit]") {
  const TissueState state = suture::test::random_tissue(4);
  const std::vector<TermForces> forces = evaluate_forces(state, Config{});
  REQUIRE(forces.size() == 4);
  const TemporaryFile file, energies;
  write_forces_csv(file.path(), state, forces);
  const StateTable table = read_state_csv(file.path());
  std::vector<double> values = table.x;
  values.insert(values.end(), table.y.begin(), table.y.end());
  values.insert(values.end(), table.rest_length.begin(), table.rest_length.end());
  CHECK(values == state.values);
  CHECK(file.content().starts_with(
      "cell,vertex,x,y,l0,area_fx,area_fy,membrane_fx,membrane_fy,bending_fx,bending_fy,contact_fx,contact_fy\n"));
  write_energy_csv(energies.path(), forces);
  CHECK(energies.content().starts_with(fmt::format("term,energy\narea,{:.17g}\nmembrane,", forces[0].energy)));
  CHECK_THROWS_AS(write_energy_csv("/nonexistent/out.csv", forces), FileError);
  CHECK(energy_csv_path("a/OUT.csv") == "a/OUT_energy.csv");
  CHECK(energy_csv_path("OUT") == "OUT_energy.csv");
}

TEST_CASE("the energies of a configuration belong to its forces", "[unit]") {
  const TissueState state = suture::test::random_tissue(4);
  const double step = 1e-6;
  TissueState forward = state, backward = state;
  forward.values[5] += step, backward.values[5] -= step;
  const auto here = evaluate_forces(state, Config{}), ahead = evaluate_forces(forward, Config{}),
             behind = evaluate_forces(backward, Config{});
  for (std::size_t k = 0; k < here.size(); ++k)
    CHECK(-(ahead[k].energy - behind[k].energy) / (2 * step) == Approx(here[k].fx[5]).epsilon(1e-5).margin(1e-7));
}
