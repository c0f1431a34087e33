#include "io/journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <array>
#include <cstring>

#include "io/content_hash.hpp"
#include "suture/errors.hpp"

namespace suture {
namespace {

constexpr std::string_view file_mark("SUTUREJ\0\1\0\0\0\0\0\0\0", 16);  // name, version 1, zero
constexpr std::uint64_t block_mark = 0x4b4c425f52545553;                // "SUTR_BLK"
constexpr std::size_t head_size = 16, tail_size = 8;

std::uint64_t block_hash(std::string_view payload, std::uint64_t place) {
  return content_hash(payload, place * 0x9e3779b97f4a7c15 + payload.size());
}

std::span<const std::byte> as_bytes(const std::string& text) { return std::as_bytes(std::span(text.data(), text.size())); }

template <class Number>
void append_number(std::string& out, Number value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

Journal::Journal(PosixFile file) : file_(std::move(file)) {
  if (!file_.try_lock())
    throw InputError(fmt::format("{}: another process is writing this run", file_.path().string()));
}

Journal Journal::create(const std::filesystem::path& path) {
  Journal journal(PosixFile(path, O_WRONLY | O_CREAT | O_APPEND));  // emptied only once it is locked
  journal.file_.truncate(0);
  journal.file_.append(as_bytes(std::string(file_mark)));
  journal.size_ = file_mark.size();
  sync_folder_of(path);
  return journal;
}

Journal Journal::reopen(const std::filesystem::path& path, std::uint64_t length) {
  Journal journal(PosixFile(path, O_WRONLY | O_APPEND));
  journal.file_.truncate(length);
  journal.size_ = length;
  return journal;
}

void Journal::append(std::string_view payload) {
  std::string block;
  block.reserve(head_size + payload.size() + tail_size);
  append_number(block, block_mark);
  append_number(block, static_cast<std::uint64_t>(payload.size()));
  block += payload;
  append_number(block, block_hash(payload, size_));
  try {
    file_.append(as_bytes(block));
  } catch (const FileError&) {
    try {
      file_.truncate(size_);  // so that a later attempt starts where this one did
    } catch (const FileError&) {  // the first failure is the one to report
    }
    throw;
  }
  size_ += block.size();
}

JournalReader::JournalReader(const std::filesystem::path& path, OnDamage on_damage)
    : file_(path, O_RDONLY), on_damage_(on_damage), file_size_(file_.size()), end_(file_size_) {
  std::array<char, file_mark.size()> start{};
  const std::size_t got = file_.read_at(0, std::as_writable_bytes(std::span(start)));
  if (std::string_view(start.data(), got) != file_mark)
    throw FileError(fmt::format("{}: it is not a suture journal of version 1", path.string()));
  offset_ = file_mark.size();
}

bool JournalReader::read_block(std::uint64_t at, std::string& payload) {
  struct {
    std::uint64_t mark, length;
  } head{};
  if (end_ - at < head_size + tail_size) return false;
  file_.read_at(at, std::as_writable_bytes(std::span(&head, 1)));
  if (head.mark != block_mark || head.length > end_ - at - head_size - tail_size) return false;
  payload.resize(head.length + tail_size);
  const std::size_t got = file_.read_at(at + head_size, std::as_writable_bytes(std::span(payload.data(), payload.size())));
  if (got != payload.size()) return false;
  std::uint64_t hash = 0;
  std::memcpy(&hash, payload.data() + head.length, sizeof hash);
  payload.resize(head.length);
  if (hash != block_hash(payload, at)) return false;
  offset_ = at + head_size + head.length + tail_size;
  return true;
}

/// Moves `at` to the next place that looks like the start of a block.
bool JournalReader::find_mark(std::uint64_t& at) const {
  std::string window(1 << 16, '\0');
  const std::string_view mark(reinterpret_cast<const char*>(&block_mark), sizeof block_mark);
  while (at < end_) {
    const std::size_t got = file_.read_at(at, std::as_writable_bytes(std::span(window.data(), window.size())));
    const std::size_t found = std::string_view(window.data(), got).find(mark);
    if (found != std::string_view::npos) {
      at += found;
      return true;
    }
    if (got < window.size()) return false;
    at += got - (mark.size() - 1);
  }
  return false;
}

bool JournalReader::next(std::string& payload) {
  if (offset_ >= end_) return false;
  const std::uint64_t start = offset_;
  if (read_block(start, payload)) return true;
  if (on_damage_ == OnDamage::skip)
    for (std::uint64_t at = start + 1; find_mark(at); ++at)
      if (read_block(at, payload)) {
        damaged_ += at - start;
        return true;
      }
  damaged_ += end_ - start;
  offset_ = start;
  end_ = start;
  return false;
}

bool is_journal(const std::filesystem::path& path) {
  try {
    JournalReader reader(path);
    return true;
  } catch (const FileError&) {
    return false;
  }
}

}  // namespace suture
