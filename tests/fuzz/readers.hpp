// The readers that are fuzzed. What they must do with any input: an InputError or FileError, or a result; never a crash, a
// hang or an allocation beyond all measure.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>

namespace suture::test {

struct Reader {
  std::function<void(const std::filesystem::path& input)> read;
  /// Sets hashes and lengths right again, else most changes would only ever meet the hash. May be empty.
  std::function<void(std::string& bytes)> mend = {};
};

/// toml, state_csv, trajectory, journal, checkpoint.
const std::map<std::string, Reader>& fuzzed_readers();

/// True when the input was accepted, false when it was refused as it should be.
bool try_input(const Reader& reader, const std::filesystem::path& input);

}  // namespace suture::test
