// The journal keeps every block that was written, and shows nothing that was not.
#include <algorithm>
#include <catch2/catch.hpp>

#include "io/journal.hpp"
#include "support/file_bytes.hpp"
#include "support/program.hpp"
#include "suture/errors.hpp"

using namespace suture;
using namespace suture::test;
using Catch::Matchers::Contains;

namespace {

const std::vector<std::string> payloads{"first", "", std::string(5000, '\x7f'), "SUTR_BLK is the mark of a block", "last"};

/// Ends of the blocks.
std::vector<std::uint64_t> write_journal(const std::filesystem::path& path) {
  Journal journal = Journal::create(path);
  std::vector<std::uint64_t> ends;
  for (const std::string& payload : payloads) {
    journal.append(payload);
    ends.push_back(journal.size());
  }
  return ends;
}

std::vector<std::string> read_all(const std::filesystem::path& path, OnDamage on_damage = OnDamage::stop) {
  JournalReader reader(path, on_damage);
  std::vector<std::string> found;
  for (std::string payload; reader.next(payload);) found.push_back(payload);
  return found;
}

}  // namespace

TEST_CASE("a journal cut anywhere shows exactly the blocks before the cut", "[unit][journal]") {
  const TemporaryDirectory folder;
  const auto path = folder.path() / "run.journal", cut = folder.path() / "cut.journal";
  const std::vector<std::uint64_t> ends = write_journal(path);
  CHECK(read_all(path) == payloads);
  const std::string bytes = read_bytes(path);
  REQUIRE(bytes.size() == ends.back());
  for (std::size_t length = 0; length <= bytes.size(); length += length > 200 && length < 5000 ? 131 : 1) {
    write_bytes(cut, bytes.substr(0, length));
    if (length < 16) {
      CHECK_THROWS_AS(read_all(cut), FileError);
      continue;
    }
    const auto whole = static_cast<std::size_t>(std::count_if(ends.begin(), ends.end(), [&](auto end) { return end <= length; }));
    REQUIRE(read_all(cut) == std::vector<std::string>(payloads.begin(), payloads.begin() + static_cast<std::ptrdiff_t>(whole)));
  }
}

TEST_CASE("a damaged byte costs its block and, when asked to skip it, no other", "[unit][journal]") {
  const TemporaryDirectory folder;
  const auto path = folder.path() / "run.journal";
  const std::vector<std::uint64_t> ends = write_journal(path);
  const std::string bytes = read_bytes(path);
  for (std::size_t position = 16; position < bytes.size(); position += 37) {
    std::string damaged = bytes;
    damaged[position] = static_cast<char>(damaged[position] ^ 0x10);
    write_bytes(path, damaged);
    const auto hit = std::upper_bound(ends.begin(), ends.end(), position) - ends.begin();
    CAPTURE(position, hit);
    CHECK(read_all(path) == std::vector<std::string>(payloads.begin(), payloads.begin() + hit));
    std::vector<std::string> others = payloads;
    others.erase(others.begin() + hit);
    CHECK(read_all(path, OnDamage::skip) == others);
  }
}

TEST_CASE("a journal is continued where it was cut, and remains of what was cut do not count", "[unit][journal]") {
  const TemporaryDirectory folder;
  const auto path = folder.path() / "run.journal";
  const std::vector<std::uint64_t> ends = write_journal(path);
  {
    Journal journal = Journal::reopen(path, ends[1]);
    CHECK_THROWS_WITH(Journal::reopen(path, ends[1]), Contains("another process is writing"));
    CHECK_THROWS_WITH(Journal::create(path), Contains("another process is writing"));
    journal.append("new");
    journal.sync();
  }
  CHECK(read_all(path) == std::vector<std::string>{"first", "", "new"});
  // The same blocks at another place are not blocks.
  const std::string bytes = read_bytes(path);
  write_bytes(path, bytes + bytes.substr(16));
  CHECK(read_all(path, OnDamage::skip) == std::vector<std::string>{"first", "", "new"});
}

TEST_CASE("what is no journal is refused", "[unit][journal]") {
  const TemporaryDirectory folder;
  CHECK_THROWS_WITH(JournalReader(folder.path() / "absent"), Contains("No such file"));
  folder.write("text", "this is something else altogether");
  CHECK_THROWS_WITH(JournalReader(folder.path() / "text"), Contains("not a suture journal"));
  CHECK(!is_journal(folder.path() / "text"));
  CHECK(!is_journal(folder.path()));
}
