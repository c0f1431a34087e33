// Making something readable of what an unfinished run has left.
#pragma once

#include <filesystem>
#include <string>

namespace suture {

/// Makes run.h5 (marked unfinished) and wound.csv of DIR/run.journal, leaving out damaged stretches, and returns a report
/// of several lines for a person. The journal and the checkpoints stay; a run that is going on is not disturbed. Throws
/// InputError when there is no journal or nothing in it, FileError when the files cannot be written.
std::string recover_run(const std::filesystem::path& directory);

}  // namespace suture
