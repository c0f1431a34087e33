#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <vector>

#include "support/file_bytes.hpp"
#include "support/program.hpp"
#include "suture/errors.hpp"
#include "suture/io/trajectory_check.hpp"
#include "suture/io/wound_csv.hpp"

using namespace suture;
using namespace suture::test;

namespace {

const UnitScales scales(UnitParameters{.rest_area_um2 = 25.0, .constriction_rate_um_per_s = 0.3125});

std::vector<std::vector<std::string>> table(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> row{""};
    for (const char letter : line)
      if (letter == ',')
        row.emplace_back();
      else
        row.back() += letter;
    rows.push_back(row);
  }
  return rows;
}

const std::vector<WoundSample> samples{{.time = 0.1,
                                        .wound_area = 4.0,
                                        .mean_shape = 1.0 / 3.0,
                                        .perimeter = 8.0,
                                        .ring_size = 63,
                                        .parts = 1,
                                        .energy = -2.5},
                                       {.time = 0.6, .wound_area = 5.0, .parts = 1},
                                       {.time = 1.1}};

}  // namespace

TEST_CASE("wound.csv has a header, full precision and empty fields for what is unknown", "[unit]") {
  const auto rows = table(to_csv(samples, scales));
  REQUIRE(rows.size() == 4);
  CHECK(rows[0] == std::vector<std::string>{"time", "time_min", "wound_area", "wound_area_um2", "wound_area_fraction",
                                            "mean_shape", "perimeter", "perimeter_um", "ring_size", "parts",
                                            "shortest_segment", "energy"});
  for (const auto& row : rows) CHECK(row.size() == rows[0].size());
  CHECK(rows[1][0] == "0.1");
  CHECK(std::strtod(rows[1][1].c_str(), nullptr) == Approx(0.1 * 16.0 / 60.0));
  CHECK(rows[1][3] == "100");
  CHECK(rows[1][4] == "0.8");
  CHECK(std::strtod(rows[1][5].c_str(), nullptr) == 1.0 / 3.0);
  CHECK(rows[1][7] == "40");
  CHECK(rows[1][8] == "63");
  CHECK(rows[2][4] == "1");
  CHECK(rows[2][5].empty());
  CHECK(rows[3][2].empty());
  CHECK(rows[3][4].empty());
}

TEST_CASE("wound.csv can be checked", "[unit]") {
  const TemporaryDirectory folder;
  const auto path = folder.path() / "wound.csv";
  write_wound_csv(samples, scales, path);
  CHECK(check_file(path).verdict == FileVerdict::valid);
  CHECK(check_file(path).content == "wound table: 3 samples");
  const std::string good = read_bytes(path);
  write_bytes(path, good + good.substr(good.find("0.1,")));
  CHECK(check_file(path).problems == std::vector<std::string>{"line 5: time does not increase"});
  write_bytes(path, good + "2,nan,,,,,,,0,0,0,0\n");
  CHECK(check_file(path).verdict == FileVerdict::invalid);
  write_bytes(path, good + "2,1\n");
  CHECK(check_file(path).verdict == FileVerdict::invalid);
  write_bytes(path, "a,b\n1,2\n");
  CHECK(check_file(path).verdict == FileVerdict::unreadable);
}

TEST_CASE("the series of a wound.csv read back to the same bits, and a damaged file is refused", "[io]") {
  const TemporaryDirectory directory;
  const auto file = directory.path() / "wound.csv";
  write_wound_csv(samples, scales, file);
  const WoundColumns columns = read_wound_csv(file);
  REQUIRE(columns.time.size() == samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    CHECK(columns.time[i] == samples[i].time);
    if (samples[i].wound_area) CHECK(columns.wound_area[i] == *samples[i].wound_area);
    CHECK(std::isnan(columns.wound_area[i]) == !samples[i].wound_area.has_value());
    CHECK(std::isnan(columns.mean_shape[i]) == !samples[i].mean_shape.has_value());
  }
  CHECK(columns.mean_shape[0] == 1.0 / 3.0);
  const std::string whole = read_bytes(file);
  write_bytes(file, whole.substr(0, whole.size() - 20));
  CHECK_THROWS_AS(read_wound_csv(file), InputError);
  write_bytes(file, "time,area\n1,2\n");
  CHECK_THROWS_AS(read_wound_csv(file), InputError);
}
