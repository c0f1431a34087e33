// Replacing a file so that a reader, or a restart after a kill, finds the old or the new one, never a part.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string_view>

namespace suture {

/// Temporary file beside `path`, fsync, rename, fsync of the directory. Throws FileError; then `path` is untouched and
/// the temporary file is gone.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

/// The same for a file that `write` makes under the temporary name it is given, and flushes to the disk. What it throws
/// removes the temporary file; a FileError is thrown on with the name of the file.
void write_file_atomically(const std::filesystem::path& path,
                           const std::function<void(const std::filesystem::path& temporary)>& write);

/// Its parts, for a file that something else writes, or that has to be put in place with others.
std::filesystem::path temporary_beside(const std::filesystem::path& path);
/// Written and flushed to the disk, or gone. Throws FileError.
void write_temporary(const std::filesystem::path& temporary, std::span<const std::byte> bytes);
/// rename, fsync of the directory. Throws FileError; when the rename fails, `temporary` is gone.
void publish_temporary(const std::filesystem::path& temporary, const std::filesystem::path& path);

/// Removes temporary files that killed processes have left in `directory`. Only for whoever alone writes there.
void remove_partial_files(const std::filesystem::path& directory);

}  // namespace suture
