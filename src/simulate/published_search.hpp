// The captures of the published program (tandrewton/dpm, epi2D::updatePurseStringContacts): a list of the vertices beside
// the wound, made by a flood fill every so many steps; those of it that have no tether are offered to the ring every
// so many steps, in the order of their numbers. Offered after every step, a tether that breaks is made anew one step later.
#pragma once

#include <vector>

#include "suture/measure/grid_wound.hpp"
#include "suture/ode/purse_string_events.hpp"
#include "suture/physics/purse_string_operations.hpp"

namespace suture {

class PublishedSearch {
 public:
  PublishedSearch(const Membrane& membrane, int steps_between_fills, int steps_between_offers)
      : wound_(membrane), fill_interval_(steps_between_fills), offer_interval_(steps_between_offers) {}

  /// After a step of the integrator that ended at `t`; false if this step has been counted already.
  bool step(double t, const TissueState& state, const StateView& view);
  /// Whether it is time for an offer and some vertex of the list has no tether.
  bool offers_untethered(const PurseString& string) const;
  /// Offers them to the ring, one after the other; true if any was captured.
  bool capture(TissueState& state, const CaptureRule& rule, std::vector<EventRecord>& log) const;

  template <class Archive>
  void fields(Archive& archive) {
    archive(wound_, steps_, last_time_, cells_, vertices_);
  }

 private:
  void start(const TissueState& state, const StateView& view);

  GridWound wound_;
  int fill_interval_, offer_interval_;
  long steps_ = 0;
  double last_time_ = -1e300;
  std::vector<char> cells_;    // at the wound when the string formed: no others are captured
  std::vector<int> vertices_;  // beside the wound at the last flood fill
};

}  // namespace suture
