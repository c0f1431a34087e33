#include <catch2/catch.hpp>
#include <regex>

#include "io/hdf5_file.hpp"
#include "support/file_bytes.hpp"
#include "support/program.hpp"
#include "support/sample_run.hpp"
#include "suture/export/export.hpp"

using namespace suture;
using namespace suture::test;
using Catch::Matchers::Contains;

TEST_CASE("every number an XDMF file refers to is in its HDF5 file", "[unit]") {
  const TemporaryDirectory folder;
  write_sample_run(folder.path() / "run.h5");
  const Replay replay(folder.path() / "run.h5");
  const auto files = export_xdmf(replay, {.frames = {0, 1, 3}}, folder.path() / "out");
  REQUIRE(files.size() == 4);
  const Hdf5Group data = Hdf5File::open(folder.path() / "out" / "data.h5").root();
  int references = 0;
  for (const auto& file : files) {
    const std::string text = read_bytes(file);
    const std::regex reference("Dimensions=\"([0-9 ]+)\">data\\.h5:/([0-9]+)/([a-z_]+)/([A-Za-z_0-9]+)<");
    for (auto at = std::sregex_iterator(text.begin(), text.end(), reference); at != std::sregex_iterator(); ++at) {
      const Hdf5Group group = data.group((*at)[2]).group((*at)[3]);
      INFO((*at)[0]);
      CHECK(group.has((*at)[4]));
      ++references;
    }
    CHECK_THAT(text, Contains("<Time Value=\"10\"/>") && Contains("<Time Value=\"30\"/>"));
  }
  CHECK(references > 60);
  // The last frame has no purse string: one element without extent stands in for it.
  CHECK(data.group("000003").group("purse_string").integers("topology") == std::vector<int>{0, 1});
}

TEST_CASE("a VTP export lists its files with their times", "[unit]") {
  const TemporaryDirectory folder;
  write_sample_run(folder.path() / "run.h5");
  const Replay replay(folder.path() / "run.h5");
  const auto files = export_vtp(replay, {.frames = {0, 2}, .units = ExportUnits::physical}, folder.path() / "out");
  REQUIRE(files.size() == 4);
  for (const auto& file : files) {
    const std::string text = read_bytes(file), series = file.stem().string();
    CHECK_THAT(text, Contains("timestep=\"0\"") && Contains("file=\"" + series + "/" + series + "_000002.vtp\""));
    CHECK(std::filesystem::exists(folder.path() / "out" / series / (series + "_000002.vtp")));
    CHECK_THAT(read_bytes(folder.path() / "out" / (series + ".visit")), Contains(series + "/" + series + "_000000.vtp\n"));
  }
  const std::string cells = read_bytes(folder.path() / "out" / "cells" / "cells_000000.vtp");
  for (const char* name : {"\"area_um2\"", "\"perimeter_um\"", "\"contacts\"", "\"force_nN\" NumberOfComponents=\"3\""})
    CHECK_THAT(cells, Contains(name));
}
