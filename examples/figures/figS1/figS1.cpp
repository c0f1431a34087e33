// Fig. S1: contact potential and force against distance for several depths of the adhesive well, at the distances of the
// published figure. Published convention: prefactor 1, distances in units of the contact distance.
#include "../csv.hpp"
#include "suture/physics/contact_law.hpp"

using namespace suture;
using namespace suture::figures;

int main(int argc, char** argv) {
  return figure_main(argc, argv, [](const auto& out, const auto& published, const auto&) {
    CsvFile file(out / "potential.csv", "l1,d,u,f,published_u,published_f");
    for (const CsvRow& row : read_csv(published / "figS1_potential.csv")) {
      const double l1 = number(row, "l1_over_sigma"), d = number(row, "d_over_sigma");
      const ContactLaw law(1.0, 1.0, l1, 0.3);
      file.row(l1, d, law.value(d), -law.first_derivative(d), number(row, "u_over_eps"), number(row, "f_sigma_over_eps"));
    }
  });
}
