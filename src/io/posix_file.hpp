// The few calls of the operating system that durable files need, with errors as FileError.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace suture {

/// Owns an open file.
class PosixFile {
 public:
  PosixFile() = default;
  /// flags: as for open(2); O_CLOEXEC is added. Throws FileError.
  PosixFile(std::filesystem::path path, int flags);
  PosixFile(PosixFile&& other) noexcept;
  PosixFile& operator=(PosixFile&& other) noexcept;
  ~PosixFile();

  bool is_open() const { return id_ >= 0; }
  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const;
  /// Everything, at the present end. Throws FileError, and then part of it may be in the file.
  void append(std::span<const std::byte> bytes);
  /// As many bytes as there are from `offset` on, at most `size`; returns how many.
  std::size_t read_at(std::uint64_t offset, std::span<std::byte> bytes) const;
  void truncate(std::uint64_t size);
  /// Until the data are on the disk.
  void sync();
  /// False when another process holds the lock. File systems without locks count as unlocked.
  bool try_lock();
  /// Reports what closing alone reveals (a delayed write error).
  void close();

 private:
  [[noreturn]] void fail(const char* action) const;
  std::filesystem::path path_;
  int id_ = -1;
};

/// Makes creations, renames and removals in the folder of `path` durable.
void sync_folder_of(const std::filesystem::path& path);
/// rename(2) that reports what went wrong. Throws FileError.
void rename_file(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace suture
