// The parts of a trajectory's HDF5 form, read one at a time: whoever takes frame after frame needs no memory for them all.
#pragma once

#include "io/hdf5_file.hpp"
#include "suture/io/trajectory.hpp"

namespace suture {

/// Everything but the frames, which stay empty; tissue and reference rest lengths are those of the frames. Throws FileError,
/// also when another number of frames is there than the commit mark says.
Trajectory read_all_but_frames(const Hdf5Group& root);

/// The number of frames according to the commit mark.
int marked_frames(const Hdf5Group& root);

/// The group of one frame. frames: the group of them all. Throws FileError.
Hdf5Group frame_group(const Hdf5Group& frames, int index);

/// Throws FileError, which names the frame.
TrajectoryFrame read_frame(const Hdf5Group& frames, int index, const Tissue& tissue);

TissueState state_of(const Trajectory& trajectory, TrajectoryFrame frame);

}  // namespace suture
