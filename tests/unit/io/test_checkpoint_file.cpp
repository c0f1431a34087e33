// A checkpoint that is cut short or changed in any bit is noticed, and the one before it used.
#include <catch2/catch.hpp>

#include "io/checkpoint_file.hpp"
#include "support/file_bytes.hpp"
#include "support/program.hpp"
#include "suture/errors.hpp"

using namespace suture;
using namespace suture::test;

namespace {

std::string newest(const std::filesystem::path& folder, std::vector<std::string>* problems = nullptr) {
  std::vector<std::string> ignored;
  std::string found;
  use_newest_checkpoint(folder, [&](std::string_view payload) { found = payload; }, problems ? *problems : ignored);
  return found;
}

}  // namespace

TEST_CASE("the previous checkpoint is always the one before the newest", "[unit][checkpoint]") {
  const TemporaryDirectory folder;
  CHECK(newest(folder.path()).empty());
  for (int i = 0; i < 5; ++i) {
    write_checkpoint(folder.path(), "payload " + std::to_string(i));
    CHECK(newest(folder.path()) == "payload " + std::to_string(i));
    if (i > 0) CHECK(read_checkpoint(previous_checkpoint_path(folder.path())) == "payload " + std::to_string(i - 1));
    CHECK(folder.contents().size() == (i == 0 ? 1u : 2u));
  }
  remove_checkpoints(folder.path());
  CHECK(folder.contents().empty());
}

TEST_CASE("a checkpoint with any bit flipped or any length cut is refused and the previous one used", "[unit][checkpoint]") {
  const TemporaryDirectory folder;
  write_checkpoint(folder.path(), "the older");
  write_checkpoint(folder.path(), "the newer, somewhat longer");
  const auto path = checkpoint_path(folder.path());
  const std::string bytes = read_bytes(path);
  int refused = 0;
  for (std::size_t position = 0; position < bytes.size(); ++position)
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = bytes;
      damaged[position] = static_cast<char>(damaged[position] ^ (1 << bit));
      write_bytes(path, damaged);
      std::vector<std::string> problems;
      REQUIRE(newest(folder.path(), &problems) == "the older");
      REQUIRE(problems.size() == 1);
      ++refused;
    }
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    write_bytes(path, bytes.substr(0, length));
    REQUIRE(newest(folder.path()) == "the older");
    ++refused;
  }
  CHECK(refused > 400);
  // A damaged one does not displace the good one before it.
  write_checkpoint(folder.path(), "the newest");
  CHECK(read_checkpoint(previous_checkpoint_path(folder.path())) == "the older");
  write_bytes(previous_checkpoint_path(folder.path()), "");
  write_bytes(path, "");
  CHECK(newest(folder.path()).empty());
}

TEST_CASE("a checkpoint that its user refuses counts as damaged", "[unit][checkpoint]") {
  const TemporaryDirectory folder;
  write_checkpoint(folder.path(), "good");
  write_checkpoint(folder.path(), "bad");
  std::string used;
  std::vector<std::string> problems;
  const auto use = [&](std::string_view payload) {
    if (payload == "bad") throw FileError("makes no sense");
    used = payload;
  };
  CHECK(use_newest_checkpoint(folder.path(), use, problems));
  CHECK(used == "good");
  CHECK(problems == std::vector<std::string>{"makes no sense"});
}
