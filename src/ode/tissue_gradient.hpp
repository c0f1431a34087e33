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
  /// blocks at once, as soon as the entries of points_of(block) are final; it returns whether they are finite.
  template <class Finish>
  Evaluation evaluate(double t, const StateView& state, std::span<double> gx, std::span<double> gy, const Finish& finish) {
    if (!add_cells(state)) return Evaluation::refused;
    std::fill(gx.begin() + layout.vertices, gx.end(), 0.0);
    std::fill(gy.begin() + layout.vertices, gy.end(), 0.0);
    const bool at_once = extra.empty();  // a block is finished while it is in the cache
    if (!at_once) {
      workers.for_each(padded.blocks(), [&](int block) { padded.pack_gradient(gx, gy, block); });
      add_terms(t, state, gx, gy);
    }
    std::atomic<bool> bad = false;
    workers.for_each(padded.blocks(), [&](int block) {
      if (at_once) padded.pack_gradient(gx, gy, block);
      if (!finish(block)) bad = true;
    });
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
  bool add_cells(const StateView& state);
  /// keep: segments and angles stay in the padded arrays.
  bool add_shell(const StateView& state, int block, bool keep);
  double largest_move2(const StateView& state, int block) const;
  void add_contacts(int list);
  /// False if somebody has moved too far for the list; what has been added is void then.
  bool add_by_old_list(const StateView& state, std::atomic<bool>& unhealthy);
  void add_by_new_list(const StateView& state, std::atomic<bool>& unhealthy);
  void add_terms(double t, const StateView& state, std::span<double> gx, std::span<double> gy);
  void explain_unhealthy(const StateView& state);
  void explain_infinite(std::span<const double> gx, std::span<const double> gy);
  void rebuild(const StateView& state);

  std::vector<double> built_x_, built_y_;  // positions the list was built for
  std::vector<double> moved2_;             // per block: how far somebody is from there, squared
  const double* held_ = nullptr;           // rest lengths of a plain evaluation
  kernels::RestLengthFlow flow_;           // of a plain evaluation
  std::size_t room_stride_ = 0;            // of kernels::SegmentRoom
};

}  // namespace suture
