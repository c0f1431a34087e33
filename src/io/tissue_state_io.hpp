// TissueState and its parts as HDF5 groups; bit-exact both ways. The names here are the file layout
// (docs/reference/output-format.md).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/hdf5_file.hpp"
#include "suture/model/state.hpp"

namespace suture {

inline constexpr const char* trajectory_schema = "suture-trajectory";
inline constexpr int trajectory_schema_version = 1;

/// first_vertex, initial_rest_length, reference_rest_length and one dataset per material property.
void write_tissue(const Hdf5Group& group, const Tissue& tissue, std::span<const double> reference_rest_length);

struct StoredTissue {
  Tissue tissue;
  std::vector<double> reference_rest_length;
};
/// Throws FileError when the sizes do not agree, InputError when Tissue refuses its arguments.
StoredTissue read_tissue(const Hdf5Group& group);

/// time, position, rest_length and the group purse_string.
void write_configuration(const Hdf5Group& group, const TissueState& state);

struct StoredConfiguration {
  double time = 0.0;
  PurseString purse_string;
  std::vector<double> values;
};
/// vertices: of the tissue it belongs to. Throws FileError when the sizes do not agree.
StoredConfiguration read_configuration(const Hdf5Group& group, int vertices);

std::string stage_name(Stage stage);

}  // namespace suture
