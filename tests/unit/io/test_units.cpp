#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "suture/errors.hpp"
#include "suture/io/units.hpp"

using namespace suture;
using Catch::Matchers::Contains;

TEST_CASE("the scales are those of model.md section 1", "[unit]") {
  const UnitScales embryo{UnitParameters{.rest_area_um2 = 25.0}};
  CHECK(embryo.length_um() == Approx(5.0));
  CHECK(embryo.time_s() == Approx(16.6667).epsilon(1e-4));
  CHECK(embryo.to_physical(1.0, Dimension::modulus) == Approx(0.04));
  CHECK(embryo.to_physical(1.0, Dimension::area_rate) == Approx(90.0));
  const UnitScales wing_disc{UnitParameters{.rest_area_um2 = 16.0}};
  CHECK(wing_disc.time_s() == Approx(13.3333).epsilon(1e-4));
  CHECK(wing_disc.to_physical(1.0, Dimension::modulus) == Approx(0.0625));
  CHECK(wing_disc.to_physical(1.0, Dimension::area_rate) == Approx(72.0));
}

TEST_CASE("conversions invert each other and the constriction rate is the model's speed", "[unit]") {
  const UnitScales scales{
      UnitParameters{.rest_area_um2 = 18.0, .unsticking_force_nN = 2.5, .constriction_rate_um_per_s = 0.2}};
  for (const Dimension dimension : {Dimension::none, Dimension::energy, Dimension::length, Dimension::area,
                                    Dimension::time, Dimension::speed, Dimension::force, Dimension::modulus})
    CHECK(scales.to_model(scales.to_physical(0.37, dimension), dimension) == Approx(0.37));
  CHECK(scales.to_physical(1.0, Dimension::speed) == Approx(0.2));
  CHECK(scales.to_physical(1.0, Dimension::force) == Approx(2.5));
}

TEST_CASE("quantities are read in any unit of their dimension", "[unit]") {
  CHECK(parse_quantity("85 min", Dimension::time) == Approx(5100.0));
  CHECK(parse_quantity("85min", Dimension::time) == Approx(5100.0));
  CHECK(parse_quantity("  1.5e-1  h ", Dimension::time) == Approx(540.0));
  CHECK(parse_quantity("0.64 kPa", Dimension::modulus) == Approx(0.64));
  CHECK(parse_quantity("640 Pa", Dimension::modulus) == Approx(0.64));
  CHECK(parse_quantity("25 um^2", Dimension::area) == Approx(25.0));
  CHECK(parse_quantity("25 \xC2\xB5m\xC2\xB2", Dimension::area) == Approx(25.0));
  CHECK(parse_quantity("25 \xCE\xBCm^2", Dimension::area) == Approx(25.0));
  CHECK(parse_quantity("18 um/min", Dimension::speed) == Approx(0.3));
  CHECK(parse_quantity("500 pN", Dimension::force) == Approx(0.5));
  CHECK(parse_quantity("650 nm", Dimension::length) == Approx(0.65));
  CHECK(std::isinf(parse_quantity("inf s", Dimension::time)));
}

TEST_CASE("quantities that make no sense are refused with the allowed units", "[unit]") {
  CHECK_THROWS_AS(parse_quantity("85", Dimension::time), InputError);
  CHECK_THROWS_AS(parse_quantity("min", Dimension::time), InputError);
  CHECK_THROWS_AS(parse_quantity("", Dimension::time), InputError);
  CHECK_THROWS_WITH(parse_quantity("85 kPa", Dimension::time), Contains("another dimension") && Contains("s, min, h"));
  CHECK_THROWS_WITH(parse_quantity("85 fortnights", Dimension::time),
                    Contains("'fortnights'") && Contains("s, min, h"));
}

TEST_CASE("scales that are not positive are refused", "[unit]") {
  CHECK_THROWS_AS(UnitScales{UnitParameters{.rest_area_um2 = 0.0}}, InputError);
  CHECK_THROWS_AS(UnitScales{UnitParameters{.constriction_rate_um_per_s = 0.0}}, InputError);
  CHECK_THROWS_AS(UnitScales{UnitParameters{.unsticking_force_nN = -1.0}}, InputError);
}

TEST_CASE("physical text picks a readable unit", "[unit]") {
  const UnitScales scales{UnitParameters{}};
  CHECK(physical_text(9.6, Dimension::time, scales) == "2.67 min");
  CHECK(physical_text(1.0, Dimension::time, scales) == "16.7 s");
  CHECK(physical_text(1e4, Dimension::time, scales) == "46.3 h");
  CHECK(physical_text(16.0, Dimension::modulus, scales) == "0.64 kPa");
  CHECK(physical_text(std::numeric_limits<double>::infinity(), Dimension::time, scales) == "inf");
}
