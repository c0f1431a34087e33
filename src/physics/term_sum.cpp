#include "suture/physics/term_sum.hpp"

#include <algorithm>

#include "suture/physics/area_elasticity.hpp"
#include "suture/physics/bending_elasticity.hpp"
#include "suture/physics/contact.hpp"
#include "suture/physics/membrane_elasticity.hpp"
#include "suture/physics/self_contact.hpp"

namespace suture {

namespace {

/// Collects blocks as triplets, which the sparse matrix sums.
class AssemblySink final : public HessianSink {
 public:
  explicit AssemblySink(int points) : points_(points) {}

  void add_block(int i, int j, const Block& block) override {
    add(i, j, block);
    if (i != j) add(j, i, {block[0], block[2], block[1], block[3]});
  }

  void add_rank_one(int first, double coefficient, std::span<const double> gx, std::span<const double> gy) override {
    const int count = static_cast<int>(gx.size());
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j)
        add(first + i, first + j,
            {coefficient * gx[i] * gx[j], coefficient * gx[i] * gy[j], coefficient * gy[i] * gx[j],
             coefficient * gy[i] * gy[j]});
  }

  Eigen::SparseMatrix<double> matrix() const {
    Eigen::SparseMatrix<double> result(2 * points_, 2 * points_);
    result.setFromTriplets(entries_.begin(), entries_.end());
    return result;
  }

 private:
  void add(int i, int j, const Block& block) {
    entries_.emplace_back(i, j, block[0]);
    entries_.emplace_back(i, points_ + j, block[1]);
    entries_.emplace_back(points_ + i, j, block[2]);
    entries_.emplace_back(points_ + i, points_ + j, block[3]);
  }

  int points_;
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace

TermList make_cell_terms(const Tissue& tissue, const Config& config) {
  TermList terms{std::make_shared<AreaElasticity>(tissue),
                 std::make_shared<MembraneElasticity>(tissue, config.membrane.law),
                 std::make_shared<BendingElasticity>(tissue), std::make_shared<Contact>(tissue, config.contact)};
  if (config.contact.self_contact) terms.push_back(std::make_shared<SelfContact>(tissue, config.contact));
  return terms;
}

std::vector<std::pair<std::string, double>> energy_by_term(const TermList& terms, double t, const StateView& state) {
  std::vector<std::pair<std::string, double>> energies;
  for (const auto& term : terms) {
    const double energy = term->energy(t, state);
    const auto found =
        std::find_if(energies.begin(), energies.end(), [&](const auto& entry) { return entry.first == term->name(); });
    if (found == energies.end())
      energies.emplace_back(term->name(), energy);
    else
      found->second += energy;
  }
  return energies;
}

Eigen::SparseMatrix<double> assemble_hessian(const TermList& terms, double t, const StateView& state) {
  AssemblySink sink(static_cast<int>(state.x.size()));
  for (const auto& term : terms) term->add_hessian(t, state, sink);
  return sink.matrix();
}

}  // namespace suture
