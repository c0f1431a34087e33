#include <catch2/catch.hpp>
#include <cmath>

#include "suture/errors.hpp"
#include "suture/physics/contact_law.hpp"

using namespace suture;

TEST_CASE("the contact potential has the printed values", "[unit]") {
  const ContactLaw law(0.5, 2.0, 0.1, 0.3);
  CHECK(law.value(0.0) == Approx(0.5 * (1.0 - 0.03)));
  CHECK(law.value(2.0) == Approx(-0.5 * 0.03));
  CHECK(law.value(2.0 * 1.2) == Approx(-0.5 * 0.1 / 0.2 * 0.01));
  CHECK(law.value(2.0 * 1.3) == 0.0);
  CHECK(law.reach() == Approx(2.6));
  CHECK(law.first_derivative(2.0) == 0.0);
  CHECK(law.first_derivative(1.0) == Approx(-2.0 * 0.5 * 0.5 / 2.0));
  CHECK(law.second_derivative(1.0) == Approx(0.25));
  CHECK(law.second_derivative(2.4) == Approx(-0.125));
}

TEST_CASE("the contact potential is C1 at its joins and its derivatives belong to it", "[unit]") {
  for (const double adhesion : {0.0, 0.1, 0.25}) {
    const ContactLaw law(0.5, 0.13, adhesion, 0.3);
    const double tiny = 1e-9;
    for (const double join : {0.13 * (1.0 + adhesion), 0.13 * 1.3}) {
      CHECK(std::abs(law.value(join - tiny) - law.value(join + tiny)) < 1e-8);
      CHECK(std::abs(law.first_derivative(join - tiny) - law.first_derivative(join + tiny)) < 1e-6);
    }
    const double step = 1e-6;
    for (double d = 0.0101; d < 0.2; d += 0.0101) {
      INFO("adhesion " << adhesion << ", d " << d);
      CHECK((law.value(d + step) - law.value(d - step)) / (2 * step) == Approx(law.first_derivative(d)).margin(1e-8));
      CHECK((law.first_derivative(d + step) - law.first_derivative(d - step)) / (2 * step) ==
            Approx(law.second_derivative(d)).margin(1e-7));
    }
  }
}

TEST_CASE("without adhesion the law is pure repulsion and may have no range", "[unit]") {
  const ContactLaw law(0.5, 1.0, 0.0, 0.0);
  CHECK(law.reach() == 1.0);
  CHECK(law.value(0.5) == Approx(0.125));
  CHECK(law.value(1.0) == 0.0);
  CHECK(law.first_derivative(1.1) == 0.0);
  CHECK(law.second_derivative(1.1) == 0.0);
}

TEST_CASE("impossible contact laws are refused", "[unit]") {
  CHECK_THROWS_AS(ContactLaw(0.5, 1.0, 0.3, 0.3), InputError);
  CHECK_THROWS_AS(ContactLaw(0.5, 1.0, 0.4, 0.3), InputError);
  CHECK_THROWS_AS(ContactLaw(0.5, 1.0, -0.1, 0.3), InputError);
  CHECK_THROWS_AS(ContactLaw(0.5, 0.0, 0.1, 0.3), InputError);
  CHECK_THROWS_AS(ContactLaw(-0.5, 1.0, 0.1, 0.3), InputError);
  CHECK_THROWS_AS(ContactLaw(0.5, 1.0, std::nan(""), 0.3), InputError);
  CHECK_THROWS_WITH(ContactLaw(0.5, 1.0, 0.4, 0.3), Catch::Contains("contact.adhesion is 0.4"));
}

TEST_CASE("an unset contact distance is the mean initial rest length", "[unit]") {
  const Tissue tissue({3}, {CellMaterial{}}, {0.2, 0.3, 0.4});
  CHECK(make_contact_law(tissue, {}).distance() == Approx(0.3));
  CHECK(make_contact_law(tissue, {.distance = 0.7}).distance() == 0.7);
}
