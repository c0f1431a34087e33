#include "suture/physics/purse_string_operations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "suture/errors.hpp"

namespace suture {

namespace {

/// The ring with the positions of its vertices: what an operation edits before it is written back.
struct Ring {
  PurseString string;
  std::vector<double> x, y;
};

Ring take_ring(TissueState& state) {
  const StateView view = state.view();
  const int first = state.tissue.vertex_count();
  Ring ring{{}, {view.x.begin() + first, view.x.end()}, {view.y.begin() + first, view.y.end()}};
  ring.string = state.purse_string;
  return ring;
}

/// Lays the flat vector out anew around `ring`.
TissueState with_ring(TissueState state, Ring ring) {
  const StateView old = state.view();
  const int vertices = state.tissue.vertex_count();
  std::vector<double> values;
  values.reserve(StateLayout{vertices, ring.string.size()}.size());
  values.insert(values.end(), old.x.begin(), old.x.begin() + vertices);
  values.insert(values.end(), ring.x.begin(), ring.x.end());
  values.insert(values.end(), old.y.begin(), old.y.begin() + vertices);
  values.insert(values.end(), ring.y.begin(), ring.y.end());
  values.insert(values.end(), old.rest_length.begin(), old.rest_length.end());
  state.values = std::move(values);
  state.purse_string = std::move(ring.string);
  return state;
}

double distance(const StateView& state, int point, int other) {
  const double dx = state.x[point] - state.x[other], dy = state.y[point] - state.y[other];
  return std::sqrt(dx * dx + dy * dy);
}

double distance(const Ring& ring, int j, int k) {
  const double dx = ring.x[j] - ring.x[k], dy = ring.y[j] - ring.y[k];
  return std::sqrt(dx * dx + dy * dy);
}

void check_boundary(const Tissue& tissue, const std::vector<int>& boundary) {
  if (static_cast<int>(boundary.size()) < smallest_ring)
    throw NumericalError(fmt::format("a purse string needs a wound boundary of at least {} vertices; {} found",
                                     smallest_ring, boundary.size()));
  std::unordered_set<int> seen;
  for (const int v : boundary)
    if (!seen.insert(v).second)
      throw NumericalError(fmt::format("the wound boundary passes {} twice", tissue.vertex_name(v)));
}

/// One of `parts` equal parts of spring j as it is at time t.
ChainSpring part_of(const PurseString& string, int j, int parts, double t) {
  return {string.rest_length(j, t) / parts, t, string.spring[j].reference_length / std::sqrt(parts)};
}

/// Adds the purse-string vertex of `vertex` behind ring vertex j; its spring is `spring`.
void insert_vertex(Ring& ring, int j, int vertex, const ChainSpring& spring, const StateView& cells) {
  ring.string.vertex.insert(ring.string.vertex.begin() + j + 1, vertex);
  ring.string.spring.insert(ring.string.spring.begin() + j + 1, spring);
  ring.string.mode.insert(ring.string.mode.begin() + j + 1, TetherMode::attached);
  ring.x.insert(ring.x.begin() + j + 1, cells.x[vertex]);
  ring.y.insert(ring.y.begin() + j + 1, cells.y[vertex]);
}

/// Rest length with which one of `parts` springs, `length` long, carries the tension of the whole, whose length and rest
/// length are `whole` and `rest`. The quadratic law shares the extension. The relative law, whose parts are as stiff as
/// the whole, solves (length/x - 1)/x = (whole/rest - 1)/rest; beyond the most it can be compressed, it is compressed as far.
double tense_length(SpringLaw law, double length, double whole, double rest, int parts) {
  if (law == SpringLaw::quadratic) return length - (whole - rest) / parts;
  const double tension = (whole / rest - 1.0) / rest;
  return 2.0 * length / (1.0 + std::sqrt(std::max(0.0, 1.0 + 4.0 * tension * length)));
}

/// All captures of one spring j at once, but for CaptureLaw::slip.
void split_spring(Ring& ring, int j, std::span<const Capture> group, const CaptureRule& rule, const StateView& cells, double t) {
  const int count = static_cast<int>(group.size()), parts = count + 1;
  const double whole = distance(ring, j, (j + 1) % ring.string.size()), rest = ring.string.rest_length(j, t);
  const ChainSpring part = part_of(ring.string, j, parts, t);
  ring.string.spring[j] = part;
  for (int k = 0; k < count; ++k) insert_vertex(ring, j + k, group[k].vertex, part, cells);
  if (rule.law == CaptureLaw::split) return;
  for (int k = j; k <= j + count; ++k) {
    const double length = distance(ring, k, (k + 1) % ring.string.size());
    const double free = rule.law == CaptureLaw::tension_free ? length : tense_length(rule.springs, length, whole, rest, parts);
    ring.string.spring[k].rest_length = std::max(free, ring.string.minimum_rest_length);
  }
}

/// CaptureLaw::slip.
void insert_with_slip(Ring& ring, int j, const Capture& capture, const StateView& cells, double t) {
  const int successor = (j + 1) % ring.string.size();
  const ChainSpring half = part_of(ring.string, successor, 2, t);
  ring.string.spring[successor] = half;
  insert_vertex(ring, j, capture.vertex, half, cells);
}

}  // namespace

TissueState create_purse_string(TissueState state, const std::vector<int>& boundary,
                                const PurseStringParameters& parameters, double contact_distance) {
  check_boundary(state.tissue, boundary);
  const StateView cells = state.view();
  const std::size_t count = boundary.size();
  Ring ring;
  ring.string.vertex = boundary;
  ring.string.mode.assign(count, TetherMode::attached);
  ring.string.shrink_rate = parameters.constriction_rate / static_cast<double>(count);
  ring.string.minimum_rest_length = parameters.minimum_rest_length * contact_distance;
  for (std::size_t j = 0; j < count; ++j) {
    const int v = boundary[j], next = boundary[(j + 1) % count];
    const double length = distance(cells, v, next);
    if (!(length > 0.0))
      throw NumericalError(fmt::format("{} and {} are at the same place; a purse string cannot be laid over them",
                                       state.tissue.vertex_name(v), state.tissue.vertex_name(next)));
    ring.string.spring.push_back({length, state.time, length});
    ring.x.push_back(cells.x[v]);
    ring.y.push_back(cells.y[v]);
  }
  return with_ring(std::move(state), std::move(ring));
}

TissueState yield_tethers(TissueState state, const std::vector<int>& ring_indices, GapLaw law) {
  if (ring_indices.empty()) return state;
  const Ring old = take_ring(state);
  const int count = old.string.size();
  std::vector<char> yields(count, 0);
  for (const int j : ring_indices) {
    SUTURE_EXPECTS(0 <= j && j < count);
    yields[j] = 1;
  }
  std::vector<int> kept;
  for (int j = 0; j < count; ++j)
    if (!yields[j]) kept.push_back(j);
  if (static_cast<int>(kept.size()) < smallest_ring) return with_ring(std::move(state), {});

  Ring ring;
  ring.string.shrink_rate = old.string.shrink_rate;
  ring.string.minimum_rest_length = old.string.minimum_rest_length;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const int j = kept[k], next = kept[(k + 1) % kept.size()];
    ring.string.vertex.push_back(old.string.vertex[j]);
    ring.string.mode.push_back(old.string.mode[j]);
    ring.x.push_back(old.x[j]);
    ring.y.push_back(old.y[j]);
    ChainSpring spring = old.string.spring[j];
    if ((j + 1) % count != next) {
      double squares = 0.0;
      for (int i = j; i != next; i = (i + 1) % count)
        squares += old.string.spring[i].reference_length * old.string.spring[i].reference_length;
      const int far = law == GapLaw::span ? next : (j + 2) % count;
      spring = {distance(state.view(), old.string.vertex[j], old.string.vertex[far]), state.time, std::sqrt(squares)};
    }
    ring.string.spring.push_back(spring);
  }
  return with_ring(std::move(state), std::move(ring));
}

TissueState capture_vertices(TissueState state, const std::vector<Capture>& captures, const CaptureRule& rule) {
  if (captures.empty()) return state;
  SUTURE_EXPECTS(!state.purse_string.empty());
  Ring ring = take_ring(state);
  const StateView cells = state.view();
  std::vector<Capture> ordered = captures;
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const Capture& a, const Capture& b) { return a.after < b.after; });
  // `inserted` vertices lie before the present spring, whose index has moved by as many.
  int inserted = 0;
  for (auto begin = ordered.begin(); begin != ordered.end();) {
    const auto end = std::find_if(begin, ordered.end(), [&](const Capture& c) { return c.after != begin->after; });
    if (rule.law == CaptureLaw::slip)
      for (auto c = begin; c != end; ++c) insert_with_slip(ring, c->after + inserted++, *c, cells, state.time);
    else {
      split_spring(ring, begin->after + inserted, {begin, end}, rule, cells, state.time);
      inserted += static_cast<int>(end - begin);
    }
    begin = end;
  }
  return with_ring(std::move(state), std::move(ring));
}

double tether_length(const PurseString& purse_string, const StateView& state, int j) {
  const int first_point = static_cast<int>(state.rest_length.size());
  return distance(state, purse_string.vertex[j], first_point + j);
}

}  // namespace suture
