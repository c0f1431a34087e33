// Who touches whom, neighbour exchanges (T1 transitions) and rosettes.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "suture/measure/membrane.hpp"
#include "suture/model/state.hpp"

namespace suture {

using CellPair = std::pair<int, int>;  ///< first < second

/// Cells in contact.
class ContactGraph {
 public:
  ContactGraph() = default;
  /// Pairs in any order, repeated or not. Throws InputError for a pair (a, a) or an index outside 0 .. cells - 1.
  ContactGraph(int cells, std::vector<CellPair> pairs);

  int cell_count() const { return cells_; }
  std::span<const CellPair> pairs() const { return pairs_; }  ///< ascending, each once
  bool contains(int a, int b) const;
  void insert(CellPair pair);
  void erase(CellPair pair);
  /// Number of connected components; component[i] labels cell i, 0, 1, ... by first appearance.
  int components(std::vector<int>& component) const;
  /// For checkpoints (byte_archive.hpp).
  template <class Archive>
  void fields(Archive& archive) {
    archive(cells_, pairs_);
  }

 private:
  int cells_ = 0;
  std::vector<CellPair> pairs_;
};

/// Cells are in contact when a vertex of one is within s(1 + l2) of the membrane of the other.
ContactGraph contact_graph(const Tissue& tissue, const StateView& state, const Membrane& membrane);
/// The same with hysteresis: pairs in contact in `previous` stay so until they are more than release_distance apart
/// (>= s(1 + l2), model units of length).
ContactGraph contact_graph(const Tissue& tissue, const StateView& state, const Membrane& membrane,
                           const ContactGraph& previous, double release_distance);

/// Two cells part and their two common neighbours meet.
struct Exchange {
  CellPair lost, gained;
  friend bool operator==(const Exchange&, const Exchange&) = default;
};

/// Exchanges that lead from `before` to `after`: a pair lost and a pair gained, each of the gained touching both of the
/// lost in `after`. Each lost and each gained pair is used once.
std::vector<Exchange> neighbour_exchanges(const ContactGraph& before, const ContactGraph& after);

/// Counts exchanges along a run. A contact that is only lost (to the wound) or only gained (across it) is no exchange;
/// the loss and the gain need not be seen at the same time. Feed it graphs with hysteresis so that flicker is not
/// counted.
class ExchangeCounter {
 public:
  /// Returns the exchanges completed since the last call. The first graph is the reference.
  std::vector<Exchange> update(const ContactGraph& graph);
  long count() const { return count_; }
  /// For checkpoints (byte_archive.hpp).
  template <class Archive>
  void fields(Archive& archive) {
    archive(reference_, started_, count_);
  }

 private:
  ContactGraph reference_;
  bool started_ = false;
  long count_ = 0;
};

/// Largest number of cells that have membrane within `radius` of one and the same vertex, its own cell included:
/// 3 at an ordinary junction, more in a rosette. A radius of about twice s(1 + l2) looks across a junction.
int rosette_order(const Tissue& tissue, const StateView& state, double radius);

}  // namespace suture
