#include "replay/fields.hpp"

#include <algorithm>

#include "suture/measure/cell_shape.hpp"
#include "suture/measure/neighbours.hpp"
#include "suture/physics/membrane_elasticity.hpp"
#include "suture/physics/purse_string_chain.hpp"
#include "suture/physics/purse_string_tethers.hpp"
#include "suture/physics/term_sum.hpp"

namespace suture {
namespace {

using Values = std::vector<double>;

Dimension dimension_of(const std::string& unit) {
  if (unit == "length") return Dimension::length;
  if (unit == "area") return Dimension::area;
  if (unit == "time") return Dimension::time;
  if (unit == "energy/length") return Dimension::force;
  return Dimension::none;
}

Field make_field(Place place, std::string name, std::string unit, std::string description, Values values) {
  const Dimension dimension = dimension_of(unit);
  return {{std::move(name), std::move(unit), std::move(description)}, place, dimension, std::move(values)};
}

Values contact_counts(const TissueState& state, const Membrane& membrane) {
  Values counts(state.tissue.cell_count(), 0.0);
  const ContactGraph graph = contact_graph(state.tissue, state.view(), membrane);
  for (const auto& [a, b] : graph.pairs()) counts[a] += 1, counts[b] += 1;
  return counts;
}

void add_cell_fields(const TissueState& state, const Membrane& membrane, const std::vector<CellField>& stored,
                     std::vector<Field>& fields) {
  Values shape, area, perimeter;
  for (const CellShape& cell : cell_shapes(state.tissue, state.view())) {
    shape.push_back(cell.shape_parameter());
    area.push_back(cell.area);
    perimeter.push_back(cell.perimeter);
  }
  constexpr Place cell = Place::cell;
  fields.push_back(make_field(cell, "shape_parameter", "1", "shape parameter p\xc2\xb2/4\xcf\x80" "a", shape));
  fields.push_back(make_field(cell, "area_strain", "1", "area strain a/a\xe2\x82\x80 \xe2\x88\x92 1",
                              area_strains(state.tissue, state.view())));
  fields.push_back(make_field(cell, "area", "area", "cell area", area));
  fields.push_back(make_field(cell, "perimeter", "length", "cell perimeter", perimeter));
  fields.push_back(make_field(cell, "contacts", "1", "cells in contact", contact_counts(state, membrane)));
  for (const CellField& extra : stored) {
    const auto known = [&](const Field& field) { return field.quantity.name == extra.quantity.name; };
    if (std::none_of(fields.begin(), fields.end(), known))
      fields.push_back({extra.quantity, cell, dimension_of(extra.quantity.unit), extra.values});
  }
}

void add_segment_fields(const TissueState& state, const Config& config, std::vector<Field>& fields) {
  const Tissue& tissue = state.tissue;
  const StateView view = state.view();
  Values length, rest_length, strain, tension;
  for (int v = 0; v < tissue.vertex_count(); ++v) {
    const int next = tissue.next(v);
    const double l = norm(Point{view.x[next] - view.x[v], view.y[next] - view.y[v]}), l0 = view.rest_length[v];
    length.push_back(l);
    rest_length.push_back(l0);
    strain.push_back(l0 / tissue.initial_rest_length(v) - 1.0);
    tension.push_back(spring_response(config.membrane.law, tissue.material(tissue.cell_of(v)).membrane_stiffness, l, l0,
                                      tissue.initial_rest_length(v))
                          .tension);
  }
  constexpr Place segment = Place::segment;
  fields.push_back(make_field(segment, "membrane_tension", "energy/length", "membrane tension", tension));
  fields.push_back(make_field(segment, "rest_length_strain", "1",
                              "rest-length strain l\xe2\x82\x80/l\xe2\x82\x80(0) \xe2\x88\x92 1", strain));
  fields.push_back(make_field(segment, "length", "length", "segment length", length));
  fields.push_back(make_field(segment, "rest_length", "length", "segment rest length", rest_length));
}

void add_vertex_fields(const TissueState& state, const Config& config, const Membrane& membrane,
                       std::vector<Field>& fields) {
  TermList terms = make_cell_terms(state.tissue, config);
  const PurseString& ring = state.purse_string;
  if (!ring.empty()) {
    terms.push_back(std::make_shared<PurseStringChain>(state.tissue, ring, config.purse_string));
    terms.push_back(
        std::make_shared<PurseStringTethers>(state.tissue, ring, config.purse_string, membrane.contact_distance));
  }
  Values gradient(state.layout().size(), 0.0);
  const MutableStateView slopes(state.layout(), gradient);
  for (const auto& term : terms) term->add_gradient(state.time, state.view(), slopes);
  const int vertices = state.tissue.vertex_count();
  Values x(vertices), y(vertices), tether(vertices, 0.0);
  for (int v = 0; v < vertices; ++v) x[v] = -slopes.x[v], y[v] = -slopes.y[v];
  for (int j = 0; j < ring.size(); ++j) tether[ring.vertex[j]] = ring.mode[j] == TetherMode::slipped ? 2.0 : 1.0;
  constexpr Place vertex = Place::vertex;
  const char* const force = "force of tissue and purse string (without plates and loads)";
  fields.push_back(make_field(vertex, "force_x", "energy/length", force, x));
  fields.push_back(make_field(vertex, "force_y", "energy/length", force, y));
  fields.push_back(make_field(vertex, "tether", "1", "0 free, 1 tethered to the purse string, 2 slipped", tether));
}

void add_ring_fields(const TissueState& state, const Config& config, const Membrane& membrane,
                     std::vector<Field>& fields) {
  const PurseString& ring = state.purse_string;
  if (ring.empty()) return;
  const StateView view = state.view();
  const int vertices = state.tissue.vertex_count();
  const auto point = [&](int i) { return Point{view.x[i], view.y[i]}; };
  Values stretch, slipped, length, rest_length;
  for (int j = 0; j < ring.size(); ++j) {
    stretch.push_back(norm(point(vertices + j) - point(ring.vertex[j])));
    slipped.push_back(ring.mode[j] == TetherMode::slipped ? 1.0 : 0.0);
    length.push_back(norm(point(vertices + (j + 1) % ring.size()) - point(vertices + j)));
    rest_length.push_back(ring.rest_length(j, state.time));
  }
  const PurseStringTethers tethers(state.tissue, ring, config.purse_string, membrane.contact_distance);
  const PurseStringChain chain(state.tissue, ring, config.purse_string);
  fields.push_back(make_field(Place::ring, "tether_length", "length", "length of the tether", stretch));
  fields.push_back(make_field(Place::ring, "tether_force", "energy/length", "force of the tether",
                              tethers.forces(view)));
  fields.push_back(make_field(Place::ring, "slipped", "1", "0 attached, 1 slipped", slipped));
  fields.push_back(make_field(Place::spring, "spring_length", "length", "length of the spring", length));
  fields.push_back(make_field(Place::spring, "spring_rest_length", "length", "its rest length", rest_length));
  fields.push_back(make_field(Place::spring, "spring_tension", "energy/length", "its tension",
                              chain.tensions(state.time, view)));
}

}  // namespace

std::vector<Field> compute_fields(const TissueState& state, const Config& config, const Membrane& membrane,
                                  const std::vector<CellField>& stored) {
  std::vector<Field> fields;
  add_cell_fields(state, membrane, stored, fields);
  add_segment_fields(state, config, fields);
  add_vertex_fields(state, config, membrane, fields);
  add_ring_fields(state, config, membrane, fields);
  return fields;
}

}  // namespace suture
