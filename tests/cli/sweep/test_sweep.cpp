// `suture sweep` as a user meets it, on tiny wounds: tables, sharing of packings, failures, and kills at any time.
#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <map>
#include <random>
#include <sstream>

#include "support/file_bytes.hpp"
#include "support/program.hpp"
#include "suture/io/config.hpp"
#include "suture/setup/protocol.hpp"
#include "suture/sweep/preparation_cache.hpp"

using namespace suture::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

const std::string small = std::string(SUTURE_SOURCE_DIR) + "/examples/small.toml";

const std::string tiny = "base = \"" + small + R"("
seeds = "1-2"
[set]
output.pictures = 0
output.frame_interval = 1000
run.end_time = 3
[grid]
area.stiffness = [8, 16]
plasticity.tau = [4.8, 9.6]
)";

using Rows = std::vector<std::map<std::string, std::string>>;

Rows read_csv(const fs::path& file) {
  std::istringstream stream(read_bytes(file));
  const auto split = [](const std::string& line) {
    std::vector<std::string> fields(1);
    for (const char letter : line)
      if (letter == ',')
        fields.emplace_back();
      else
        fields.back() += letter;
    return fields;
  };
  std::string line;
  std::getline(stream, line);
  const std::vector<std::string> names = split(line);
  Rows rows;
  while (std::getline(stream, line)) {
    const std::vector<std::string> fields = split(line);
    rows.emplace_back();
    for (std::size_t k = 0; k < names.size() && k < fields.size(); ++k) rows.back()[names[k]] = fields[k];
  }
  return rows;
}

Outcome sweep(const TemporaryDirectory& directory, const std::string& out, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"sweep", "sweep.toml", "--quiet", "--jobs", "2", "--out", out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_suture(SUTURE_PROGRAM, arguments, directory.path());
}

/// The sweep in the background, in `directory`.
pid_t start_sweep(const TemporaryDirectory& directory, const std::string& out, const std::string& tables_every = "60") {
  const pid_t child = fork();
  if (child != 0) return child;
  if (chdir(directory.path().c_str()) == 0)
    execl(SUTURE_PROGRAM, SUTURE_PROGRAM, "sweep", "sweep.toml", "--quiet", "--jobs", "2", "--tables-every", tables_every.c_str(), "--out", out.c_str(), nullptr);
  _exit(127);
}

int exit_code_of(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

int finished_runs(const TemporaryDirectory& directory, const std::string& out) {
  int count = 0;
  std::error_code error;
  for (const auto& run : fs::directory_iterator(directory.path() / out / "runs", error)) count += fs::exists(run.path() / "done.json");
  return count;
}

/// Kills the sweep at `kills` random times, lets it finish, and compares with an uninterrupted one.
void survives_kills(int kills, unsigned seed) {
  const TemporaryDirectory directory;
  directory.write("sweep.toml", tiny);
  REQUIRE(sweep(directory, "whole").exit_code == 0);
  std::mt19937 random(seed);
  int killed = 0, rounds = 0;
  for (; killed < kills && rounds < 10 * kills; ++rounds) {
    if (finished_runs(directory, "killed") == 8) fs::remove_all(directory.path() / "killed");
    const pid_t child = start_sweep(directory, "killed");
    usleep(20000 + random() % 700000);
    kill(child, SIGKILL);
    killed += exit_code_of(child) == -SIGKILL;
  }
  REQUIRE(killed == kills);
  REQUIRE(sweep(directory, "killed", {"--resume"}).exit_code == 0);
  CHECK(read_bytes(directory.path() / "killed/nodes.csv") == read_bytes(directory.path() / "whole/nodes.csv"));
  CHECK(finished_runs(directory, "killed") == 8);
}

}  // namespace

TEST_CASE("a sweep makes one row per run and one per node, and repeats nothing", "[cli][sweep]") {
  const TemporaryDirectory directory;
  directory.write("sweep.toml", tiny);
  REQUIRE(sweep(directory, "out").exit_code == 0);
  const Rows runs = read_csv(directory.path() / "out/sweep.csv"), nodes = read_csv(directory.path() / "out/nodes.csv");
  REQUIRE(runs.size() == 8);
  REQUIRE(nodes.size() == 4);
  CHECK(nodes[1].at("area.stiffness") == "8.0");
  CHECK(nodes[1].at("plasticity.tau") == "9.6");
  CHECK(nodes[1].at("runs") == "2");
  const double mean = 0.5 * (std::stod(runs[2].at("healed_shape")) + std::stod(runs[3].at("healed_shape")));
  CHECK(std::stod(nodes[1].at("healed_shape_mean")) == Approx(mean).epsilon(1e-14));
  CHECK(std::stod(nodes[1].at("healed_shape_sem")) ==
        Approx(0.5 * std::abs(std::stod(runs[2].at("healed_shape")) - std::stod(runs[3].at("healed_shape")))).epsilon(1e-12));
  CHECK(fs::file_size(directory.path() / "out/sweep.h5") > 1000);
  const std::string log = read_bytes(directory.path() / "out/log.txt");
  CHECK(std::count(log.begin(), log.end(), '\n') == 8);
  REQUIRE(sweep(directory, "out").exit_code == 0);
  CHECK(read_bytes(directory.path() / "out/log.txt") == log);
}

TEST_CASE("single runs of the list add up to the sweep", "[cli][sweep]") {
  const TemporaryDirectory directory;
  directory.write("sweep.toml", tiny);
  const Outcome list = run_suture(SUTURE_PROGRAM, {"sweep", "sweep.toml", "--out", "out", "--list"}, directory.path());
  REQUIRE(list.exit_code == 0);
  CHECK(std::count(list.output.begin(), list.output.end(), '\n') == 9);
  CHECK_FALSE(fs::exists(directory.path() / "out"));
  REQUIRE(sweep(directory, "out", {"--run-index", "3"}).exit_code == 0);
  CHECK(finished_runs(directory, "out") == 1);
  CHECK_THAT(run_suture(SUTURE_PROGRAM, {"sweep", "sweep.toml", "--out", "out", "--list"}, directory.path()).output,
             Contains("9.6,2,reached_t_end"));
  CHECK(sweep(directory, "out", {"--run-index", "8"}).exit_code == 2);
  CHECK_FALSE(fs::exists(directory.path() / "out/nodes.csv"));
  REQUIRE(sweep(directory, "out", {"--tables"}).exit_code == 0);
  CHECK(finished_runs(directory, "out") == 1);
  const Rows nodes = read_csv(directory.path() / "out/nodes.csv");
  REQUIRE(nodes.size() == 4);
  CHECK(nodes[1].at("runs") == "1");
  CHECK(nodes[0].at("runs") == "0");
}

TEST_CASE("a run that starts from a shared preparation is the run from the beginning, bit for bit", "[cli][sweep]") {
  const TemporaryDirectory directory;
  directory.write("sweep.toml", tiny);
  REQUIRE(sweep(directory, "out", {"--seeds", "2"}).exit_code == 0);
  int compared = 0;
  for (const auto& run : fs::directory_iterator(directory.path() / "out/runs")) {
    const std::string config = (run.path() / "config.toml").string();
    REQUIRE(run_suture(SUTURE_PROGRAM, {"run", config, "--quiet", "--out", "alone"}, directory.path()).exit_code == 0);
    CHECK(read_bytes(run.path() / "wound.csv") == read_bytes(directory.path() / "alone/wound.csv"));
    ++compared;
  }
  CHECK(compared == 4);
  int prepared = 0;  // two stiffnesses, one seed
  for (const auto& file : fs::directory_iterator(directory.path() / "out/prepared")) prepared += file.path().extension() == ".h5";
  CHECK(prepared == 2);
}

TEST_CASE("keys that a shared preparation leaves out do not change it, and those it keeps do", "[cli][sweep]") {
  using namespace suture;
  const auto prepared = [](std::vector<std::string> overrides) {
    overrides.push_back("run.last_stage=ablation");
    return prepare_tissue(read_config(small, overrides)).state.values;
  };
  const auto key = [](const std::vector<std::string>& overrides) {
    return write_config(preparation_config(read_config(small, overrides)));
  };
  const auto plain = prepared({});
  using Overrides = std::vector<std::string>;
  for (const Overrides& overrides :
       {Overrides{"plasticity.tau=0.7", "plasticity.memory=3"},
        Overrides{"purse_string.law=relative", "purse_string.minimum_rest_length=0.1", "purse_string.yield_length=5"},
        Overrides{"purse_string.stiffness=7", "purse_string.crevice_depth=3", "purse_string.tether_law=ramp"},
        Overrides{"run.end_time=17", "run.closed_area=0.1", "output.interval=7", "output.frame_interval=70"},
        Overrides{"integrator.method=euler", "integrator.time_step=1e-5"},
        Overrides{"integrator.tolerance=1e-7", "integrator.rest_length_tolerance=1e-7"},
        Overrides{"integrator.maximum_order=2", "integrator.maximum_step=0.01"},
        Overrides{"units.rest_area=16", "compression.gap=0.2", "dipole.force=3"}}) {
    INFO(overrides.front());
    CHECK(key(overrides) == key({}));
    CHECK(prepared(overrides) == plain);
  }
  for (const char* override : {"area.stiffness=17", "membrane.law=relative", "bending.stiffness=0.02", "contact.adhesion=0.12",
                               "anneal.tolerance=1e-4", "packing.shape_noise=0.02", "tissue.seed=5", "wound.relaxation_time=9"}) {
    INFO(override);
    CHECK(key({override}) != key({}));
    CHECK(prepared({override}) != plain);
  }
}

TEST_CASE("a failed run is reported with its reason and does not stop the others", "[cli][sweep]") {
  const TemporaryDirectory directory;
  directory.write("sweep.toml", tiny + "wound.minimum_area = [0.3, 2.0]\n");  // 2.0: no packing is accepted
  const Outcome outcome = sweep(directory, "out", {"--seeds", "1", "--set", "packing.attempts=1"});
  CHECK(outcome.exit_code == 3);
  CHECK_THAT(outcome.errors, Contains("4 of 8 runs failed; the reasons are in out/sweep.csv"));
  int failed = 0;
  for (const auto& row : read_csv(directory.path() / "out/sweep.csv")) failed += row.at("status") == "failed";
  CHECK(failed == 4);
  CHECK_THAT(read_bytes(directory.path() / "out/sweep.csv"), Contains("no acceptable tissue"));
  for (const auto& row : read_csv(directory.path() / "out/nodes.csv"))
    CHECK(row.at("runs_failed") == (row.at("wound.minimum_area") == "2.0" ? "1" : "0"));
}

TEST_CASE("every sweep of this repository can be planned", "[cli][sweep]") {
  const TemporaryDirectory directory;
  const std::map<std::string, int> runs{{"small_sweep.toml", 18},
                                        {"closure_table/sweep.toml", 55},
                                        {"figures/fig3/sweep.toml", 1575},
                                        {"figures/fig3/sweep_published_code.toml", 189},
                                        {"figures/fig4/sweep.toml", 126},
                                        {"figures/fig4/tolerance.toml", 100},
                                        {"figures/fig4/event_grid.toml", 150},
                                        {"figures/fig3/sensitivity.toml", 144},
                                        {"figures/fig4/sweep_published_code.toml", 66},
                                        {"emulation/sweep.toml", 85},
                                        {"emulation/first_pull.toml", 240},
                                        {"emulation/gap_law.toml", 109}};
  for (const auto& [file, count] : runs) {
    INFO(file);
    const Outcome list = run_suture(SUTURE_PROGRAM, {"sweep", std::string(SUTURE_SOURCE_DIR) + "/examples/" + file, "--list"}, directory.path());
    CHECK(list.exit_code == 0);
    CHECK(std::count(list.output.begin(), list.output.end(), '\n') == count + 1);
  }
}

TEST_CASE("one-cell experiments can be swept too", "[cli][sweep]") {
  const TemporaryDirectory directory;
  directory.write("sweep.toml", "base = \"" + std::string(SUTURE_SOURCE_DIR) + R"(/examples/dipole.toml"
set = { dipole.duration = 50 }
grid = { plasticity.tau = [1, 500] }
)");
  REQUIRE(sweep(directory, "out").exit_code == 0);
  const Rows nodes = read_csv(directory.path() / "out/nodes.csv");
  REQUIRE(nodes.size() == 2);
  CHECK(std::stod(nodes[0].at("shape_final_mean")) > 1.1 * std::stod(nodes[1].at("shape_final_mean")));
  CHECK(nodes[0].at("healed_shape_mean").empty());
  CHECK(nodes[0].at("runs") == "1");
}

TEST_CASE("Ctrl-C stops a sweep with exit code 75 and leaves no claim", "[cli][sweep]") {
  const TemporaryDirectory directory;
  directory.write("sweep.toml", tiny);
  const pid_t child = start_sweep(directory, "out");
  while (finished_runs(directory, "out") == 0) usleep(1000);
  kill(child, SIGINT);
  CHECK(exit_code_of(child) == 75);
  CHECK(finished_runs(directory, "out") < 8);
  CHECK(fs::is_empty(directory.path() / "out/claims"));
  CHECK(read_csv(directory.path() / "out/sweep.csv").size() == 8);
}

TEST_CASE("tables are written while a sweep goes on, unless that is not wanted", "[cli][sweep]") {
  const TemporaryDirectory directory;
  directory.write("sweep.toml", tiny);
  const fs::path often = directory.path() / "often/nodes.csv", never = directory.path() / "never/nodes.csv";
  pid_t child = start_sweep(directory, "often", "0");
  while (finished_runs(directory, "often") < 8 && !fs::exists(often)) usleep(1000);
  kill(child, SIGKILL);
  CHECK(exit_code_of(child) == -SIGKILL);
  const Rows nodes = read_csv(often);
  REQUIRE(nodes.size() == 4);
  CHECK(nodes[0].at("runs") != "0");
  CHECK(nodes[3].at("runs_waiting") == "2");
  child = start_sweep(directory, "never", "1e9");
  while (finished_runs(directory, "never") < 4) usleep(1000);
  kill(child, SIGKILL);
  CHECK(exit_code_of(child) == -SIGKILL);
  CHECK(!fs::exists(never));
}

TEST_CASE("two sweeps on one folder share the work", "[cli][sweep]") {
  const TemporaryDirectory directory;
  directory.write("sweep.toml", tiny);
  const pid_t one = start_sweep(directory, "out"), two = start_sweep(directory, "out");
  CHECK(exit_code_of(one) == 0);
  CHECK(exit_code_of(two) == 0);
  const std::string log = read_bytes(directory.path() / "out/log.txt");
  CHECK(std::count(log.begin(), log.end(), '\n') == 8);
}

TEST_CASE("a sweep killed at random times and resumed gives the same nodes.csv", "[cli][sweep]") { survives_kills(3, 1); }

TEST_CASE("a sweep killed twenty times and resumed gives the same nodes.csv", "[.][long][sweep]") { survives_kills(20, 2); }
