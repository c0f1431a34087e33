// Does the content of a trajectory still have the fingerprints it was written with?
#pragma once

#include <string>
#include <vector>

#include "io/hdf5_file.hpp"
#include "suture/io/trajectory.hpp"

namespace suture {

/// One line for every stage, frame, series and for the events whose content differs from its content_hash, and for every
/// one without a hash in a file that has any (files of version 0.1.0 have none).
std::vector<std::string> hash_problems(const Hdf5Group& root, const Trajectory& trajectory);

}  // namespace suture
