#include "io/checkpoint_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <cstring>
#include <system_error>

#include "io/atomic_file.hpp"
#include "io/content_hash.hpp"
#include "io/posix_file.hpp"
#include "suture/errors.hpp"

namespace suture {
namespace {

constexpr std::uint64_t mark = 0x5043455255545553;  // "SUTURECP"
constexpr std::size_t head_size = 24, tail_size = 8;

void append_number(std::string& out, std::uint64_t value) { out.append(reinterpret_cast<const char*>(&value), sizeof value); }

std::uint64_t number_at(const std::string& bytes, std::size_t offset) {
  std::uint64_t value = 0;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

}  // namespace

std::filesystem::path checkpoint_path(const std::filesystem::path& directory) { return directory / "checkpoint"; }
std::filesystem::path previous_checkpoint_path(const std::filesystem::path& directory) {
  return directory / "checkpoint.previous";
}

void write_checkpoint(const std::filesystem::path& directory, std::string_view payload) {
  std::string bytes;
  bytes.reserve(head_size + payload.size() + tail_size);
  append_number(bytes, mark);
  append_number(bytes, checkpoint_version);
  append_number(bytes, payload.size());
  bytes += payload;
  append_number(bytes, content_hash(bytes));
  const std::filesystem::path path = checkpoint_path(directory), temporary = temporary_beside(path);
  write_temporary(temporary, std::as_bytes(std::span(bytes.data(), bytes.size())));
  // A damaged checkpoint must not displace the previous one, which may be the only good one.
  const bool good = std::filesystem::exists(path) && [&path] {
    try {
      read_checkpoint(path);
      return true;
    } catch (const FileError&) {
      return false;
    }
  }();
  try {
    if (good) rename_file(path, previous_checkpoint_path(directory));
  } catch (const FileError&) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw;
  }
  publish_temporary(temporary, path);
}

std::string read_checkpoint(const std::filesystem::path& path) {
  const PosixFile file(path, O_RDONLY);
  std::string bytes(file.size(), '\0');
  bytes.resize(file.read_at(0, std::as_writable_bytes(std::span(bytes.data(), bytes.size()))));
  const auto refuse = [&path](const char* why) { throw FileError(fmt::format("{}: {}", path.string(), why)); };
  if (bytes.size() < head_size + tail_size || number_at(bytes, 0) != mark) refuse("it is not a checkpoint, or cut short");
  if (number_at(bytes, 8) != checkpoint_version) refuse("it was written by another version of suture");
  if (number_at(bytes, 16) != bytes.size() - head_size - tail_size) refuse("it is cut short");
  const std::uint64_t hash = number_at(bytes, bytes.size() - tail_size);
  bytes.resize(bytes.size() - tail_size);
  if (hash != content_hash(bytes)) refuse("it is damaged: its content does not have the recorded hash");
  return bytes.substr(head_size);
}

bool use_newest_checkpoint(const std::filesystem::path& directory, const std::function<void(std::string_view)>& use,
                           std::vector<std::string>& problems) {
  for (const auto& path : {checkpoint_path(directory), previous_checkpoint_path(directory)}) {
    if (!std::filesystem::exists(path)) continue;
    try {
      use(read_checkpoint(path));
      return true;
    } catch (const FileError& error) {
      problems.emplace_back(error.what());
    }
  }
  return false;
}

void remove_checkpoints(const std::filesystem::path& directory) {
  std::error_code ignored;  // leftovers are refused later by their content
  for (const auto& path : {previous_checkpoint_path(directory), checkpoint_path(directory)})
    std::filesystem::remove(path, ignored);
}

}  // namespace suture
