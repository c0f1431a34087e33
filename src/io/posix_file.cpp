#include "io/posix_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "suture/errors.hpp"

namespace suture {
namespace {

[[noreturn]] void fail_at(const std::filesystem::path& path, const char* action) {
  throw FileError(fmt::format("{}: cannot {}: {}", path.string(), action, std::strerror(errno)));
}

}  // namespace

PosixFile::PosixFile(std::filesystem::path path, int flags) : path_(std::move(path)) {
  id_ = ::open(path_.c_str(), flags | O_CLOEXEC, 0666);
  if (id_ < 0) fail((flags & O_CREAT) != 0 ? "create" : "open");
}

PosixFile::PosixFile(PosixFile&& other) noexcept : path_(std::move(other.path_)), id_(std::exchange(other.id_, -1)) {}

PosixFile& PosixFile::operator=(PosixFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(id_, other.id_);
  return *this;
}

PosixFile::~PosixFile() {
  if (id_ >= 0) ::close(id_);
}

void PosixFile::fail(const char* action) const { fail_at(path_, action); }

std::uint64_t PosixFile::size() const {
  struct stat status {};
  if (::fstat(id_, &status) != 0) fail("examine");
  return static_cast<std::uint64_t>(status.st_size);
}

void PosixFile::append(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(id_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("write");
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

std::size_t PosixFile::read_at(std::uint64_t offset, std::span<std::byte> bytes) const {
  std::size_t total = 0;
  while (total < bytes.size()) {
    const ssize_t got = ::pread(id_, bytes.data() + total, bytes.size() - total, static_cast<off_t>(offset + total));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail("read");
    if (got == 0) break;
    total += static_cast<std::size_t>(got);
  }
  return total;
}

void PosixFile::truncate(std::uint64_t size) {
  if (::ftruncate(id_, static_cast<off_t>(size)) != 0) fail("shorten");
}

void PosixFile::sync() {
  if (::fsync(id_) != 0) fail("flush");
}

bool PosixFile::try_lock() { return ::flock(id_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK; }

void PosixFile::close() {
  if (::close(std::exchange(id_, -1)) != 0) fail("close");
}

void sync_folder_of(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  const int id = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (id < 0) return;  // a folder that may be written but not read
  // Some file systems cannot flush a directory (EINVAL); the data itself is already safe.
  const bool failed = ::fsync(id) != 0 && errno != EINVAL;
  const int reason = errno;
  ::close(id);
  errno = reason;
  if (failed) fail_at(folder, "flush");
}

void rename_file(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (::rename(from.c_str(), to.c_str()) != 0) fail_at(to, "replace");
}

}  // namespace suture
