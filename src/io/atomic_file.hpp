// Replacing a file so that a reader, or a restart after a kill, finds the old or the new one, never a part.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace suture {

/// Temporary file beside `path`, fsync, rename, fsync of the directory. Throws FileError; then `path` is untouched and
/// the temporary file is gone.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

}  // namespace suture
