// Does the content of a trajectory still have the fingerprints it was written with?
#pragma once

#include <string>
#include <vector>

#include "io/hdf5_file.hpp"
#include "suture/io/trajectory.hpp"

namespace suture {

/// False for files of version 0.1.0, which have no hashes.
bool has_hashes(const Hdf5Group& root);

/// One line for every stage and series and for the events whose content differs from its content_hash or that have none.
std::vector<std::string> hash_problems(const Hdf5Group& root, const Trajectory& trajectory);

/// The same for one frame. group: that of the frame.
std::vector<std::string> hash_problems(const Hdf5Group& group, int index, const TrajectoryFrame& frame);

}  // namespace suture
