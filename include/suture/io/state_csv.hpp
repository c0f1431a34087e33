// One configuration as text, in and out: the files of `suture forces` (design.md section 3).
#pragma once

#include <string>
#include <vector>

#include "suture/model/state.hpp"
#include "suture/physics/term_forces.hpp"

namespace suture {

/// Cells in order, vertices counter-clockwise within a cell; model units.
struct StateTable {
  std::vector<int> vertex_counts;   ///< per cell
  std::vector<double> x, y;         ///< per vertex
  std::vector<double> rest_length;  ///< of the segment from this vertex to the next
};

/// Reads columns cell, vertex, x, y, l0, found by the names in the first line; other columns are ignored.
/// Strict: cells and vertices are numbered 0, 1, ... without gaps and in order, numbers are finite, l0 > 0, every cell
/// has at least 3 vertices and runs counter-clockwise. Throws InputError beginning with "path:line: ".
StateTable read_state_csv(const std::string& path);

/// The tissue and state of a table. Materials and initial rest lengths l0(0) are those config gives to cells of these
/// vertex counts: [[cell_type]] tables take the first cells, in order; tissue.cells and tissue.vertices are not read.
/// The table's l0 are current rest lengths. Throws InputError when the cell types ask for more cells than the table
/// has.
TissueState make_state(const StateTable& table, const Config& config);

/// Columns cell, vertex, x, y, l0, then <term>_fx, <term>_fy for every term; 17 significant digits. Throws FileError.
void write_forces_csv(const std::string& path, const TissueState& state, const std::vector<TermForces>& forces);

/// Columns term, energy; 17 significant digits. Throws FileError.
void write_energy_csv(const std::string& path, const std::vector<TermForces>& forces);

/// "OUT.csv" -> "OUT_energy.csv"; a path without that ending gets "_energy.csv" appended.
std::string energy_csv_path(const std::string& forces_path);

}  // namespace suture
