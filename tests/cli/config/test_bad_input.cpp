// Every kind of bad input: one clear line on stderr, exit code 2, nothing on stdout, nothing written.
#include <algorithm>
#include <catch2/catch.hpp>

#include "support/program.hpp"

using namespace suture::test;
using Catch::Matchers::Contains;

namespace {

// A configuration that must be refused, by every command that reads one.
struct BadConfig {
  const char* what;
  const char* text;
  std::vector<std::string> overrides;
  std::vector<std::string> expected;  // parts of the message
};

// The commands that read a configuration; each is given every BadConfig. {config} stands for the file.
const std::vector<std::vector<std::string>> reading_commands{
    {"validate", "{config}"},
    {"run", "{config}", "--out", "out"},
    {"converge", "{config}", "--out", "out"},
};

const std::vector<BadConfig> bad_configs{
    {"not TOML", "[tissue\ncells = 3", {}, {"config.toml:1:", "not valid TOML"}},
    {"missing value", "[tissue]\ncells =\n", {}, {"config.toml:2:", "not valid TOML"}},
    {"duplicate key", "[tissue]\ncells = 3\ncells = 4\n", {}, {"config.toml:3:", "not valid TOML"}},
    {"duplicate section", "[area]\n[tissue]\n[area]\n", {}, {"config.toml:3:"}},
    {"key and alias", "[area]\nstiffness = 1\nB = \"1 kPa\"\n", {}, {"config.toml:3:1", "second time"}},
    {"binary file", "\x01\x02\xff\xfe", {}, {"config.toml:1:", "not valid TOML"}},
    {"unknown key", "[plasticity]\ntua = 3\n", {}, {"config.toml:2:1", "did you mean 'plasticity.tau'?"}},
    {"key of another section", "[tissue]\ntau = 3\n", {}, {"'tissue.tau'", "did you mean 'plasticity.tau'?"}},
    {"key without section", "tau = 3\n", {}, {"did you mean 'plasticity.tau'?"}},
    {"unknown section", "[plasticty]\ntau = 3\n", {}, {"config.toml:1:", "did you mean 'plasticity'?"}},
    {"section as value", "tissue = 3\n", {}, {"found 3", "[tissue]"}},
    {"nested section", "[area.stiffness]\nx = 1\n", {}, {"'area.stiffness'", "found a table"}},
    {"[cell_type] once bracketed", "[cell_type]\ncells = 3\n", {}, {"[[cell_type]]"}},
    {"unknown key of a cell type", "[[cell_type]]\ncells = 3\ntua = 1\n", {}, {"config.toml:3:1", "'cell_type.tau'?"}},
    {"cell type without cells", "[[cell_type]]\nname = \"a\"\n", {}, {"'cell_type.cells'"}},
    {"text for a number", "[area]\nstiffness = \"stiff\"\n", {}, {"found \"stiff\"", "a number"}},
    {"number for a word", "[membrane]\nlaw = 1\n", {}, {"found 1", "relative, quadratic"}},
    {"number for a switch", "[contact]\nself_contact = 1\n", {}, {"true or false"}},
    {"fraction for an integer", "[tissue]\ncells = 50.5\n", {}, {"found 50.5", "an integer"}},
    {"array for a number", "[area]\nstiffness = [1, 2]\n", {}, {"found an array"}},
    {"date for a number", "[area]\nstiffness = 2023-05-12\n", {}, {"found 2023-05-12"}},
    {"not a number", "[area]\nstiffness = nan\n", {}, {"found nan"}},
    {"infinite stiffness", "[area]\nstiffness = inf\n", {}, {"found inf"}},
    {"negative stiffness", "[area]\nstiffness = -1.0\n", {}, {"config.toml:2:1", "found -1", ">= 0"}},
    {"zero tau", "[plasticity]\ntau = 0\n", {}, {"'plasticity.tau'", "> 0"}},
    {"too few vertices", "[tissue]\nvertices = 2\n", {}, {"'tissue.vertices'", "from 3"}},
    {"integer beyond 64 bits", "[tissue]\nseed = 99999999999999999999\n", {}, {"config.toml:2:"}},
    {"wrong word", "[membrane]\nlaw = \"quadratc\"\n", {}, {"did you mean 'quadratic'?"}},
    {"wrong method", "[integrator]\nmethod = \"cvod\"\n", {}, {"did you mean 'cvode'?"}},
    {"wrong preset", "preset = \"publishd_code\"\n", {}, {"did you mean 'published_code'?"}},
    {"unit of another dimension", "[plasticity]\ntau = \"85 kPa\"\n", {}, {"'kPa'", "s, min, h"}},
    {"unknown unit", "[plasticity]\ntau = \"85 minuets\"\n", {}, {"'minuets'", "s, min, h"}},
    {"quoted number without unit", "[plasticity]\ntau = \"85\"\n", {}, {"without a unit"}},
    {"bulk modulus without unit", "[area]\nB = 0.64\n", {}, {"without a unit", "kPa"}},
    {"unit where none belongs", "[contact]\nadhesion = \"0.1 um\"\n", {}, {"'contact.adhesion'", "a number"}},
    {"negative scale", "[units]\na0 = \"-25 um^2\"\n", {}, {"'units.rest_area'", "> 0"}},
    {"adhesion beyond its range", "[contact]\nadhesion = 0.4\n", {}, {"config.toml:2:1", "contact.range = 0.3"}},
    {"packing backwards", "[packing]\ninitial_fraction = 0.99\n", {}, {"packing.final_fraction = 0.985"}},
    {"wound larger than the tissue", "[tissue]\ncells = 4\n", {}, {"'wound.cells'", "tissue.cells = 4"}},
    {"relative chain without floor", "[purse_string]\nlaw = \"relative\"\n", {}, {"minimum_rest_length", "> 0"}},
    {"more typed cells than cells", "[[cell_type]]\ncells = 60\n", {}, {"config.toml:2:1", "tissue.cells = 50"}},
    {"two cell types of one name",
     "[[cell_type]]\nname=\"a\"\ncells=1\n[[cell_type]]\nname=\"a\"\ncells=1\n",
     {},
     {"'cell_type.name'"}},
    {"wound areas crossed", "[wound]\nminimum_area = 9\n", {}, {"wound.maximum_area = 6.5"}},
    {"many cells between plates", "[run]\nprotocol = \"compression\"\n", {}, {"'tissue.cells'", "allowed 1"}},
    {"too many vertices", "[tissue]\ncells = 1000000\nvertices = 10000\n", {}, {"'tissue.cells'", "vertices in all"}},
    {"override of an unknown key", "", {"area.stifness=3"}, {"command line: --set", "'area.stiffness'?"}},
    {"override without key", "", {"=3"}, {"command line: --set =3", "found no key"}},
    {"override without value", "", {"area.stiffness="}, {"found no value"}},
    {"override without equals sign", "", {"area.stiffness"}, {"found no '='"}},
    {"override out of range", "", {"area.stiffness=-3"}, {"command line: --set area.stiffness=-3", ">= 0"}},
    {"override of a section by a word", "", {"area=stiff"}, {"'area'", "found \"stiff\""}},
    {"override with two values", "", {"area.stiffness=1\nx=2"}, {"command line: --set area.stiffness="}},
};

// A command line that is wrong whatever the files say.
struct BadCommand {
  const char* what;
  std::vector<std::string> arguments;
  std::vector<std::string> expected;
};

const std::vector<BadCommand> bad_commands{
    {"no command", {}, {"subcommand"}},
    {"unknown command", {"vaildate", "good.toml"}, {"did you mean 'validate'?"}},
    {"unknown option", {"validate", "good.toml", "--sett", "a=1"}, {"--sett"}},
    {"unknown option of the program", {"--verson"}, {"--verson"}},
    {"no file", {"validate"}, {"CONFIG"}},
    {"missing file", {"validate", "absent.toml"}, {"absent.toml: no such file"}},
    {"directory for a file", {"validate", "."}, {"found a directory"}},
    {"two files", {"validate", "good.toml", "more.toml"}, {"more.toml"}},
    {"--set without value", {"validate", "good.toml", "--set"}, {"--set"}},
    {"run from a missing file",
     {"run", "good.toml", "--out", "out", "--set", "run.start_from=absent.h5"},
     {"absent.h5"}},
    {"run from a file of another kind",
     {"run", "good.toml", "--out", "out", "--set", "run.start_from=good.toml"},
     {"good.toml"}},
    {"forces without an output file", {"forces", "good.toml"}, {"--out"}},
    {"forces of a missing file", {"forces", "absent.csv", "--out", "out.csv"}, {"absent.csv"}},
    {"forces of another kind of file", {"forces", "good.toml", "--out", "out.csv"}, {"good.toml"}},
    {"forces with an unknown key",
     {"forces", "good.toml", "--out", "out.csv", "--set", "area.stifness=1"},
     {"command line: --set", "'area.stiffness'?"}},
    {"explain without key", {"config", "--explain"}, {"--explain"}},
    {"explain of an unknown key", {"config", "--explain", "area.stifness"}, {"did you mean 'area.stiffness'?"}},
    {"two things at once", {"config", "--defaults", "--explain", "area"}, {"excludes"}},
    {"defaults of an unknown preset", {"config", "--defaults", "--preset", "other"}, {"other", "published_code"}},
};

void check_refused(const Outcome& outcome, const std::vector<std::string>& expected) {
  INFO(outcome.errors);
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.output.empty());
  CHECK(outcome.errors.rfind("suture: error: ", 0) == 0);
  CHECK(std::count(outcome.errors.begin(), outcome.errors.end(), '\n') == 1);
  for (const std::string& part : expected) CHECK_THAT(outcome.errors, Contains(part));
}

}  // namespace

TEST_CASE("a bad configuration is refused in one line and leaves nothing behind", "[cli]") {
  REQUIRE(bad_configs.size() >= 30);
  for (const auto& command : reading_commands)
    for (const BadConfig& bad : bad_configs) {
      INFO(command.front() << ": " << bad.what);
      const TemporaryDirectory directory;
      directory.write("config.toml", bad.text);
      std::vector<std::string> arguments = command;
      std::replace(arguments.begin(), arguments.end(), std::string{"{config}"}, std::string{"config.toml"});
      for (const std::string& text : bad.overrides) arguments.insert(arguments.end(), {"--set", text});
      check_refused(run_suture(SUTURE_PROGRAM, arguments, directory.path()), bad.expected);
      CHECK(directory.contents() == std::vector<std::string>{"config.toml"});
    }
}

TEST_CASE("a bad command line is refused in one line", "[cli]") {
  for (const BadCommand& bad : bad_commands) {
    INFO(bad.what);
    const TemporaryDirectory directory;
    directory.write("good.toml", "");
    check_refused(run_suture(SUTURE_PROGRAM, bad.arguments, directory.path()), bad.expected);
    CHECK(directory.contents() == std::vector<std::string>{"good.toml"});
  }
}
