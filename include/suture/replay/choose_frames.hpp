// Which frames of a run, as people write it.
#pragma once

#include <string>
#include <vector>

namespace suture {

/// Frames that a text chooses among `count`: "all", "last", single ones and ranges first:last[:step], last included,
/// separated by commas; negative numbers count from the end. Ascending, each once. Throws InputError.
std::vector<int> choose_frames(const std::string& text, int count);

}  // namespace suture
