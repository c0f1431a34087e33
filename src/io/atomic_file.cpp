#include "io/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "suture/errors.hpp"

namespace suture {
namespace {

class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags) : id_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (id_ >= 0) ::close(id_);
  }
  int id() const { return id_; }
  /// close() can report a write error that was delayed until then.
  bool close() { return ::close(std::exchange(id_, -1)) == 0; }

 private:
  int id_;
};

[[noreturn]] void fail(const std::filesystem::path& path, const char* action) {
  throw FileError(fmt::format("{}: cannot {}: {}", path.string(), action, std::strerror(errno)));
}

void write_all(int descriptor, std::span<const std::byte> bytes, const std::filesystem::path& path) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(path, "write");
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

}  // namespace

void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  // The process id keeps two runs that share a directory from writing into the same temporary file.
  const std::filesystem::path temporary = fmt::format("{}.{}.partial", path.string(), ::getpid());
  try {
    Descriptor file(temporary, O_WRONLY | O_CREAT | O_TRUNC);
    if (file.id() < 0) fail(temporary, "create");
    write_all(file.id(), bytes, temporary);
    if (::fsync(file.id()) != 0) fail(temporary, "flush");
    if (!file.close()) fail(temporary, "close");
    if (::rename(temporary.c_str(), path.c_str()) != 0) fail(path, "replace");
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  Descriptor directory(folder, O_RDONLY | O_DIRECTORY);
  // Some file systems cannot flush a directory (EINVAL); the data itself is already safe.
  if (directory.id() >= 0 && ::fsync(directory.id()) != 0 && errno != EINVAL) fail(folder, "flush");
}

void write_file_atomically(const std::filesystem::path& path, std::string_view text) {
  write_file_atomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace suture
