// Who is made of what: cells, their vertices and their material. Immutable after construction.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "suture/model/parameters.hpp"

namespace suture {

/// Material of one cell, in model units.
struct CellMaterial {
  double rest_area = 1.0;           ///< a0_i
  double area_stiffness = 16.0;     ///< k_a
  double membrane_stiffness = 1.0;  ///< k_l
  double bending_stiffness = 0.01;  ///< k_b
  double tau = 9.6;                 ///< plastic relaxation time (may be infinity)
  double memory = 0.0;              ///< xi
  friend bool operator==(const CellMaterial&, const CellMaterial&) = default;
};

/// Closed, counter-clockwise polygonal cells. Vertices are numbered cell after cell; segment v joins v to next(v).
/// Copies share their arrays: a closure keeps half a dozen of them, and the arrays never change.
class Tissue {
 public:
  Tissue() = default;
  /// vertex_counts: one per cell, each >= 3. materials: one per cell.
  /// initial_rest_lengths: l0(0), one per segment, all > 0. Throws InputError.
  Tissue(const std::vector<int>& vertex_counts, std::vector<CellMaterial> materials,
         std::vector<double> initial_rest_lengths);
  // Moved from, a tissue stays what it is: moving copies.
  Tissue(const Tissue&) = default;
  Tissue& operator=(const Tissue&) = default;

  int cell_count() const { return static_cast<int>(materials_.size()); }
  int vertex_count() const { return static_cast<int>(cell_of_.size()); }

  int first_vertex(int cell) const { return first_[cell]; }
  int end_vertex(int cell) const { return first_[cell + 1]; }
  int vertex_count(int cell) const { return first_[cell + 1] - first_[cell]; }

  int cell_of(int vertex) const { return cell_of_[vertex]; }
  int next(int vertex) const { return vertex + 1 == end_vertex(cell_of_[vertex]) ? first_vertex(cell_of_[vertex]) : vertex + 1; }
  int previous(int vertex) const { return vertex == first_vertex(cell_of_[vertex]) ? end_vertex(cell_of_[vertex]) - 1 : vertex - 1; }

  const CellMaterial& material(int cell) const { return materials_[cell]; }
  double initial_rest_length(int segment) const { return initial_rest_lengths_[segment]; }  ///< l0(0)
  /// Valid as long as a copy of this tissue lives.
  std::span<const double> initial_rest_lengths() const { return initial_rest_lengths_; }
  double mean_initial_rest_length() const { return mean_initial_rest_length_; }

  /// "cell 12, vertex 3" (vertex counted within its cell).
  std::string vertex_name(int vertex) const;

  /// The same tissue without some cells. keep: indices of the surviving cells, ascending.
  Tissue subset(const std::vector<int>& keep) const;
  /// The same tissue with other materials (one per cell).
  Tissue with_materials(std::vector<CellMaterial> materials) const;

 private:
  struct Segments;
  void hold(std::vector<CellMaterial> materials);

  std::shared_ptr<const Segments> segments_;
  std::shared_ptr<const std::vector<CellMaterial>> held_materials_;
  // Windows on the two, so that no look-up goes through two pointers.
  static constexpr int no_cells = 0;
  std::span<const int> first_{&no_cells, 1}, cell_of_;
  std::span<const CellMaterial> materials_;
  std::span<const double> initial_rest_lengths_;
  double mean_initial_rest_length_ = 0.0;
};

/// Rest length that gives a regular n-gon of area rest_area the circular-equivalent shape parameter
/// `shape_parameter` after the n-gon correction: l0 = sqrt(4 n tan(pi/n) A a0)/n (model.md section 6).
double regular_rest_length(int vertices, double rest_area, double shape_parameter);

/// The tissue a configuration describes (one material per cell from [area], [membrane], ... and [[cell_type]]).
Tissue make_tissue(const Config& config);

}  // namespace suture
