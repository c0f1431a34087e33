#include "fuzz/readers.hpp"

#include <cstdint>
#include <cstring>
#include <string_view>

#include "io/checkpoint_file.hpp"
#include "io/content_hash.hpp"
#include "simulate/run_checkpoint.hpp"
#include "support/file_bytes.hpp"
#include "suture/errors.hpp"
#include "suture/io/config.hpp"
#include "suture/io/state_csv.hpp"
#include "suture/io/trajectory_check.hpp"

namespace suture::test {
namespace {

void mend_checkpoint(std::string& bytes) {
  if (bytes.size() < 40) return;
  std::memcpy(bytes.data() + 8, &checkpoint_version, 8);
  const std::uint64_t length = bytes.size() - 32;
  std::memcpy(bytes.data() + 16, &length, 8);
  const std::uint64_t hash = content_hash(std::string_view(bytes).substr(0, bytes.size() - 8));
  std::memcpy(bytes.data() + bytes.size() - 8, &hash, 8);
}

void mend_journal(std::string& bytes) {
  // One block as long as it goes: the payload is a sequence of items anyway.
  if (bytes.size() < 48) return;
  const std::uint64_t length = bytes.size() - 40;
  std::memcpy(bytes.data() + 24, &length, 8);
  const std::uint64_t hash = content_hash(std::string_view(bytes).substr(32, length), 16 * 0x9e3779b97f4a7c15 + length);
  std::memcpy(bytes.data() + bytes.size() - 8, &hash, 8);
}

void read_checkpoint_file(const std::filesystem::path& path) {
  const std::string payload = read_checkpoint(path);
  RunCheckpoint checkpoint;
  ByteReader reader(payload);
  reader(checkpoint);
  if (!checkpoint.resolved_config.empty()) expect_same_configuration(path, checkpoint.resolved_config, Config{});
}

}  // namespace

const std::map<std::string, Reader>& fuzzed_readers() {
  static const std::map<std::string, Reader> all{
      {"toml", {[](const auto& path) { parse_config(read_bytes(path), "fuzz.toml"); }}},
      {"state_csv", {[](const auto& path) { read_state_csv(path); }}},
      {"trajectory", {[](const auto& path) { check_file(path); }}},
      {"journal", {[](const auto& path) { check_file(path); }, mend_journal}},
      {"checkpoint", {read_checkpoint_file, mend_checkpoint}},
  };
  return all;
}

bool try_input(const Reader& reader, const std::filesystem::path& input) {
  try {
    reader.read(input);
    return true;
  } catch (const InputError&) {
  } catch (const FileError&) {
  }
  return false;
}

}  // namespace suture::test
