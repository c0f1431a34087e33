// A checkpoint on disk: bytes with a fingerprint, and the one before it in case this one is damaged.
//
//     DIR/checkpoint, DIR/checkpoint.previous:
//     8 bytes "SUTURECP", u64 version, u64 length, the payload, u64 hash of everything before it
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace suture {

/// To be raised whenever something is stored that was not before.
inline constexpr std::uint64_t checkpoint_version = 4;

std::filesystem::path checkpoint_path(const std::filesystem::path& directory);
std::filesystem::path previous_checkpoint_path(const std::filesystem::path& directory);

/// Temporary file, fsync, the present checkpoint becomes the previous one, rename, fsync of the directory: at every
/// moment at least one whole checkpoint carries one of the two names. Throws FileError; then the present one is intact.
void write_checkpoint(const std::filesystem::path& directory, std::string_view payload);

/// The payload of one file. Throws FileError when it is missing, cut short, damaged or of another version.
std::string read_checkpoint(const std::filesystem::path& file);

/// Tries the checkpoint and then the previous one: `use` is given each payload that is whole, and may refuse it by
/// throwing FileError. False when none was used; `problems` says what was wrong with those that were not.
bool use_newest_checkpoint(const std::filesystem::path& directory, const std::function<void(std::string_view)>& use,
                           std::vector<std::string>& problems);

void remove_checkpoints(const std::filesystem::path& directory);

}  // namespace suture
