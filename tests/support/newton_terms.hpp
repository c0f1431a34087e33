// What the Newton matrix is made of, term by term and without any list: the cells' terms with their whole second derivatives,
// of the contacts the repulsion along the normal only (ContactFactor in kernels.hpp).
#pragma once

#include "suture/physics/term_sum.hpp"

namespace suture::test {

TermList newton_terms(const Tissue& tissue, const Config& config);

}  // namespace suture::test
