// Layout of the flat ODE vector, and typed windows on it. The only place that knows the offsets:
//
//     y = [ x of all points | y of all points | rest lengths l0 ]
//
// "Points" are the V cell vertices followed by the P purse-string vertices, so that every position term sees one
// index range and the positions, which are all that remains once the rest lengths are eliminated, are contiguous.
#pragma once

#include <span>
#include <vector>

#include "suture/model/purse_string.hpp"
#include "suture/model/shared_values.hpp"
#include "suture/model/tissue.hpp"

namespace suture {

struct StateLayout {
  int vertices = 0;  ///< V
  int ring = 0;      ///< P, purse-string vertices

  int points() const { return vertices + ring; }
  int positions() const { return 2 * points(); }          ///< length of the position part
  int size() const { return 2 * points() + vertices; }    ///< length of y
  int x(int point) const { return point; }
  int y(int point) const { return points() + point; }
  int rest_length(int segment) const { return positions() + segment; }
  int ring_point(int j) const { return vertices + j; }
  friend bool operator==(const StateLayout&, const StateLayout&) = default;
};

/// Read-only window: x, y of V + P points, l0 of V segments.
struct StateView {
  std::span<const double> x, y, rest_length;
  StateView() = default;
  StateView(const StateLayout& layout, std::span<const double> state)
      : x(state.subspan(0, layout.points())),
        y(state.subspan(layout.points(), layout.points())),
        rest_length(state.subspan(layout.positions(), layout.vertices)) {}
};

/// Writable window of the same shape (state, rate or gradient).
struct MutableStateView {
  std::span<double> x, y, rest_length;
  MutableStateView() = default;
  MutableStateView(const StateLayout& layout, std::span<double> state)
      : x(state.subspan(0, layout.points())),
        y(state.subspan(layout.points(), layout.points())),
        rest_length(state.subspan(layout.positions(), layout.vertices)) {}
  operator StateView() const {
    StateView view;
    view.x = x, view.y = y, view.rest_length = rest_length;
    return view;
  }
};

/// A complete configuration at one time: everything needed to continue.
struct TissueState {
  Tissue tissue;
  PurseString purse_string;                    ///< empty when there is none
  SharedValues reference_rest_length;          ///< l0_ref of shape memory, one per segment; empty: l0(0)
  double time = 0.0;
  std::vector<double> values;                  ///< y

  StateLayout layout() const { return {tissue.vertex_count(), purse_string.size()}; }
  StateView view() const { return {layout(), values}; }
  MutableStateView mutable_view() { return {layout(), values}; }
};

}  // namespace suture
