// Is this file what it claims to be? The library behind `suture check`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace suture {

enum class FileVerdict {
  valid,
  unreadable,  ///< not one of our files, or damaged beyond reading
  invalid,     ///< readable, but its content is wrong or the run did not finish
};

struct FileReport {
  FileVerdict verdict = FileVerdict::valid;
  std::string content;                ///< "trajectory: 12 frames, ..."
  std::vector<std::string> problems;  ///< in words, worst first; empty when valid
};

/// Checks a trajectory (.h5), its journal, a checkpoint, a summary (.json) or a wound table (.csv). A trajectory is valid
/// when it carries the commit mark of a finished run, its content has the recorded hashes, times increase, numbers are
/// finite, sizes agree, and every cell of every frame and stage is a counter-clockwise polygon of positive area; a
/// journal need not be finished, but every block of it must be whole.
FileReport check_file(const std::filesystem::path& path);

}  // namespace suture
