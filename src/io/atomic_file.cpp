#include "io/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <system_error>
#include <vector>

#include "io/posix_file.hpp"
#include "suture/errors.hpp"

namespace suture {

// The process id keeps two runs that share a directory from writing into the same temporary file.
std::filesystem::path temporary_beside(const std::filesystem::path& path) {
  return fmt::format("{}.{}.partial", path.string(), ::getpid());
}

void write_temporary(const std::filesystem::path& temporary, std::span<const std::byte> bytes) {
  try {
    PosixFile file(temporary, O_WRONLY | O_CREAT | O_TRUNC);
    file.append(bytes);
    file.sync();
    file.close();
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
}

void publish_temporary(const std::filesystem::path& temporary, const std::filesystem::path& path) {
  try {
    rename_file(temporary, path);
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
  sync_folder_of(path);
}

void remove_partial_files(const std::filesystem::path& directory) {
  std::error_code ignored;
  std::vector<std::filesystem::path> partial;
  for (const auto& entry : std::filesystem::directory_iterator(directory, ignored))
    if (entry.path().extension() == ".partial") partial.push_back(entry.path());
  for (const auto& path : partial) std::filesystem::remove(path, ignored);
}

void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  const std::filesystem::path temporary = temporary_beside(path);
  write_temporary(temporary, bytes);
  publish_temporary(temporary, path);
}

void write_file_atomically(const std::filesystem::path& path,
                           const std::function<void(const std::filesystem::path& temporary)>& write) {
  const std::filesystem::path temporary = temporary_beside(path);
  try {
    write(temporary);
  } catch (const FileError& error) {
    ::unlink(temporary.c_str());
    throw FileError(fmt::format("{}: cannot write: {}", path.string(), error.what()));
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
  publish_temporary(temporary, path);
}

void write_file_atomically(const std::filesystem::path& path, std::string_view text) {
  write_file_atomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace suture
