#include "io/file_seal.hpp"

#include <fcntl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

#include "io/content_hash.hpp"
#include "io/posix_file.hpp"
#include "suture/errors.hpp"

namespace suture {
namespace {

constexpr std::uint64_t mark = 0x4b4f455255545553;  // "SUTUREOK"
using Seal = std::array<std::uint64_t, 2>;

std::uint64_t hash_of(const PosixFile& file, std::uint64_t length) {
  std::vector<std::byte> chunk(std::size_t{1} << 20);
  std::uint64_t hash = length;
  for (std::uint64_t at = 0; at < length;) {
    const std::size_t wanted = static_cast<std::size_t>(std::min<std::uint64_t>(chunk.size(), length - at));
    const std::size_t got = file.read_at(at, std::span(chunk).first(wanted));
    if (got != wanted) throw FileError("it shrinks while it is read");
    hash = content_hash(std::span<const std::byte>(chunk).first(got), hash);
    at += got;
  }
  return hash;
}

}  // namespace

void seal_file(const std::filesystem::path& path) {
  PosixFile file(path, O_RDWR | O_APPEND);
  const Seal seal{mark, hash_of(file, file.size())};
  file.append(std::as_bytes(std::span(seal)));
  file.sync();
  file.close();
}

void expect_unbroken_seal(const std::filesystem::path& path) {
  const PosixFile file(path, O_RDONLY);
  const std::uint64_t size = file.size();
  Seal seal{};
  if (size < sizeof seal) return;
  file.read_at(size - sizeof seal, std::as_writable_bytes(std::span(seal)));
  if (seal[0] == mark && seal[1] != hash_of(file, size - sizeof seal))
    throw FileError("it is damaged: its bytes are not those that were written");
}

}  // namespace suture
