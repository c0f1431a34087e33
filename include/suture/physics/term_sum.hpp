// What is done with a list of terms as a whole: sums, energies by name, the assembled Hessian.
#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "suture/physics/term.hpp"

namespace suture {

using TermList = std::vector<std::shared_ptr<const EnergyTerm>>;

/// The terms of the cells that [area], [membrane], [bending] and [contact] ask for: area, membrane, bending, contact
/// and, unless contact.self_contact is off, self_contact. Throws InputError.
TermList make_cell_terms(const Tissue& tissue, const Config& config);

/// Energy of every term, in the order of the list; equal names are added up.
std::vector<std::pair<std::string, double>> energy_by_term(const TermList& terms, double t, const StateView& state);

/// d2U/dr2 of the sum at fixed rest lengths: symmetric, of size 2 points (x of all points first, then y). Reference
/// implementation for tests and the direct solver; integrators use products.
Eigen::SparseMatrix<double> assemble_hessian(const TermList& terms, double t, const StateView& state);

}  // namespace suture
