// What happens to the purse string at discrete events: creation, yield, capture (model.md section 5). Pure functions
// from one TissueState to the next, at state.time. The cell vertices and rest lengths, and the purse-string vertices
// that stay, are carried over bit for bit; only their offsets in the flat vector move. Pass the state with std::move:
// nothing is copied or allocated when there is nothing to do.
//
// With SpringLaw::quadratic a spring's compliance is reference_length^2/k_ps. Splitting shares it among the parts and
// closing a gap adds up what it replaces, so the chain's total compliance is conserved: a tether that breaks and is
// recaptured leaves the chain as stiff as before. SpringLaw::relative reads only the rest lengths.
#pragma once

#include <optional>
#include <vector>

#include "suture/model/state.hpp"

namespace suture {

/// A ring of fewer purse-string vertices encloses nothing; it is removed.
inline constexpr int smallest_ring = 3;

/// The string on the wound boundary, one purse-string vertex on top of each cell vertex of `boundary` (distinct, in
/// counter-clockwise order around the wound). Rest and reference lengths are the initial lengths (no tension);
/// shrink_rate = omega/N_p; the floor is parameters.minimum_rest_length x contact_distance (s, model units). A string
/// that is already there is replaced. Throws NumericalError on fewer than smallest_ring vertices, on a repeated
/// vertex, and on neighbours at the same place.
TissueState create_purse_string(TissueState state, const std::vector<int>& boundary,
                                const PurseStringParameters& parameters, double contact_distance);

/// Removes the tethers and purse-string vertices `ring_indices` (any order; repeats allowed) and closes the chain over
/// each gap, however many consecutive vertices it swallows, with one spring: rest length = the present distance of the
/// cell vertices on either side, shrinking from now on; reference_length^2 = the sum over the springs it replaces.
/// GapLaw::first takes the distance of the cell vertices on either side of the first vertex of the gap instead, also
/// where the one behind it yields too: then the spring is short of its gap and pulls.
/// When fewer than smallest_ring vertices remain the whole string is removed (purse_string.empty()).
TissueState yield_tethers(TissueState state, const std::vector<int>& ring_indices, GapLaw law = GapLaw::span);

/// A cell vertex to be tethered: its purse-string vertex goes between ring vertices `after` and after + 1 (cyclic).
struct Capture {
  int vertex = 0;
  int after = 0;
  friend bool operator==(const Capture&, const Capture&) = default;
};

/// Where to insert the vertices of `boundary` (cyclic, counter-clockwise) that have no tether yet. Each goes behind the
/// last ring vertex that precedes it along the boundary, several of them in boundary order: captures with equal `after`
/// are listed in the order in which the ring will pass them. Ring vertices that are no longer on the boundary are
/// skipped over; if none is on it, nothing can be placed and the result is empty. A vertex listed twice counts once,
/// where it first comes. Depends on nothing but the two orders.
std::vector<Capture> captures(const PurseString& purse_string, const std::vector<int>& boundary);

/// The same, but where ring vertices that left the boundary lie between the two that enclose a new vertex, it goes
/// into the spring between them that it lengthens least (distances between cell vertices; the first such spring on a
/// tie), never before one placed earlier. Keeps the chain from folding back at crevices.
std::vector<Capture> captures(const TissueState& state, const std::vector<int>& boundary);

/// The ring vertex behind which the published simulations insert cell vertex `vertex`: beside a neighbour of its own
/// membrane, else between two of the three ring vertices whose cell vertices are nearest, under their conditions;
/// nothing when they refuse it. `vertex` is not in the ring. For CaptureSearch::published.
std::optional<int> published_insertion(const TissueState& state, int vertex);

/// What a capture does to the spring it splits, and the elastic law of the springs, which tension_kept depends on.
struct CaptureRule {
  CaptureLaw law = CaptureLaw::tension_kept;
  SpringLaw springs = SpringLaw::quadratic;
};

/// Inserts the captured vertices at the positions of their cell vertices, attached. The springs, with lambda0 their
/// rest lengths now and m captures in the same spring:
///   split         m + 1 parts of rest length lambda0/(m + 1) and reference_length/sqrt(m + 1): (m + 1) times as stiff
///                 (quadratic law), so that equal parts of the length would carry the tension of the whole. A vertex
///                 beside the spring makes the parts longer, and the tension rises;
///   tension_kept  as split, but each part's rest length is such that it carries the tension of the whole, at least
///                 minimum_rest_length; with the quadratic law extension and energy stay what they were too;
///   tension_free  as split, but each part's rest length is its actual length;
///   slip          one capture after the other: the split spring keeps everything, its rest length included; the
///                 spring after the new vertex's successor is halved, and the new vertex's own spring to its successor
///                 is the other half (a slip of the published simulations).
TissueState capture_vertices(TissueState state, const std::vector<Capture>& captures, const CaptureRule& rule);

/// Tether length l of ring vertex j, model units.
double tether_length(const PurseString& purse_string, const StateView& state, int j);

}  // namespace suture
