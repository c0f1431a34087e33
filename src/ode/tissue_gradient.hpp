// dU/dr of everything the cells feel, with the padded arrays and the contact list it needs. A large tissue is worked on in
// blocks of consecutive cells, which several threads share (contact_schedule.hpp).
#pragma once

#include <atomic>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "neighbors/contact_list.hpp"
#include "ode/padded_tissue.hpp"
#include "suture/model/state.hpp"
#include "suture/ode/tissue_ode.hpp"
#include "threads/worker_pool.hpp"

namespace suture {

class TissueGradient {
 public:
  TissueGradient(const Tissue& tissue, int ring, TissueOdeOptions options,
                 std::vector<std::shared_ptr<const EnergyTerm>> extra);

  /// Rest lengths as they are in a plain rate evaluation, and their rates, if wanted, with pointers to the whole tissue's arrays.
  void hold_rest_lengths(std::span<const double> rest_length, const kernels::RestLengthFlow& flow = {});
  /// Rest lengths as functions of the lengths, with the coefficients that are in padded.shell.
  void let_rest_lengths_follow();

  /// dU/dr at (x, y) with the rest lengths set before; gx, gy have one entry per point. finish(block) is called, for several
  /// blocks at once, as soon as the entries of points_of(block) have all they get; it returns whether they are finite. With a list
  /// that turns out to be worn all begins anew: state must not lie in gx, gy.
  template <class Finish>
  Evaluation evaluate(double t, const StateView& state, std::span<double> gx, std::span<double> gy, const Finish& finish) {
    std::atomic<bool> bad = false;
    const auto begin = [&] {
      bad = false;
      std::fill(gx.begin() + layout.vertices, gx.end(), 0.0);
      std::fill(gy.begin() + layout.vertices, gy.end(), 0.0);
    };
    const auto finish_block = [&](int block) {
      if (!finish(block)) bad = true;
    };
    const auto complete = [&](int block) {
      padded.pack_gradient(gx, gy, block);
      if (extra.empty()) finish_block(block);  // while it is in the cache
    };
    begin();
    if (!add_by_old_list(state, complete)) {
      begin();
      add_by_new_list(state, complete);
    }
    if (unhealthy_) {
      explain_unhealthy(state);
      return Evaluation::refused;
    }
    if (!extra.empty()) {
      add_terms(t, state, gx, gy);
      workers.for_each(padded.blocks(), finish_block);
    }
    if (!bad) return Evaluation::ok;
    explain_infinite(gx, gy);
    return Evaluation::refused;
  }
  bool finite(std::span<const double> gx, std::span<const double> gy, int block) const;

  /// Vertices of a block; with the last one, the points of the purse string.
  Range points_of(int block) const;
  std::string point_name(int point) const;

  Tissue tissue;
  StateLayout layout;
  TissueOdeOptions options;
  std::vector<std::shared_ptr<const EnergyTerm>> extra;
  const kernels::Table& kernel;
  WorkerPool workers;
  PaddedTissue padded;
  kernels::ContactScalars contact;
  ContactList list;
  long rebuilds = 0;
  std::string refusal;

 private:
  /// keep: segments and angles stay in the padded arrays.
  void add_shell(const StateView& state, int block, bool keep);
  double largest_move2(const StateView& state, int block) const;
  void add_contacts(int list);
  /// Shell, if it is the list of a block, and contacts; false if somebody has moved too far for the list.
  bool add_list(const StateView& state, int list, bool keep);
  /// Shells and contacts of all cells; complete(block) is called when a block has everything. False if somebody has moved too
  /// far for the list: all is void then.
  template <class Complete>
  bool add_by_old_list(const StateView& state, const Complete& complete) {
    unhealthy_ = false;
    if (rebuilds == 0) return false;
    // The linearisation of an implicit step reads segments; those of a large tissue it makes anew.
    const bool keep = held_ == nullptr && padded.blocks() == 1;
    std::atomic<bool> worn = false;
    list.schedule().for_each_list(workers, [&](int k) {
      if (worn) return;
      if (add_list(state, k, keep))
        for (const int block : list.entries(k).completes) complete(block);
      else
        worn = true;
    });
    return !worn;
  }
  /// A new list needs all segments first.
  template <class Complete>
  void add_by_new_list(const StateView& state, const Complete& complete) {
    unhealthy_ = false;
    workers.for_each(padded.blocks(), [&](int block) { add_shell(state, block, true); });
    if (unhealthy_) return;
    rebuild(state);
    list.schedule().for_each_list(workers, [&](int k) {
      add_contacts(k);
      for (const int block : list.entries(k).completes) complete(block);
    });
  }
  void add_terms(double t, const StateView& state, std::span<double> gx, std::span<double> gy);
  void explain_unhealthy(const StateView& state);
  void explain_infinite(std::span<const double> gx, std::span<const double> gy);
  void rebuild(const StateView& state);

  std::vector<double> built_x_, built_y_;  // positions the list was built for
  std::vector<double> moved2_;             // per block: how far somebody is from there, squared
  const double* held_ = nullptr;           // rest lengths of a plain evaluation
  kernels::RestLengthFlow flow_;           // of a plain evaluation
  std::atomic<bool> unhealthy_ = false;    // some cell has no forces
  std::size_t room_stride_ = 0;            // of kernels::SegmentRoom
};

}  // namespace suture
