// The contact law against the published plot of it (supplement of Ton et al. 2023, Fig. S1).
#include <catch2/catch.hpp>

#include "suture/physics/contact_law.hpp"

using namespace suture;

TEST_CASE("potential and force are the plotted ones", "[validation]") {
  // Rows of data/published/figS1_potential.csv: l1, d/sigma, u/eps, f sigma/eps. The plot has prefactor 1, range sigma
  // and l2 = 0.3; it is digitised to about 1e-5.
  struct Row {
    double adhesion, distance, energy, force;
  };
  constexpr Row plotted[] = {
      {0, 0.61612, 0.14737, 0.76777},    {0, 0.97648, 0.00055, 0.04704},      {0, 1.09660, 0, 0},
      {0.05, 0.61612, 0.13237, 0.76777}, {0.05, 0.97648, -0.01445, 0.04704},  {0.05, 1.09660, -0.00827, -0.08136},
      {0.1, 0.61612, 0.11737, 0.76777},  {0.1, 0.97648, -0.02945, 0.04704},   {0.1, 1.14064, -0.01270, -0.15936},
      {0.15, 0.61612, 0.10237, 0.76777}, {0.15, 1.09660, -0.03567, -0.19320}, {0.2, 1.09660, -0.05067, -0.19320},
  };
  for (const Row& row : plotted) {
    const ContactLaw law(1.0, 1.0, row.adhesion, 0.3);
    INFO("l1 " << row.adhesion << ", d " << row.distance);
    CHECK(law.value(row.distance) == Approx(row.energy).margin(1e-5));
    CHECK(-law.first_derivative(row.distance) == Approx(row.force).margin(2e-5));
  }
}
