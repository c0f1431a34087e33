// An append-only file of checksummed blocks: what a running simulation writes, because it survives a kill at any moment.
//
//     8 bytes "SUTUREJ" and zero, u32 version, u32 zero
//     per block: u64 mark, u64 length, the payload, u64 hash of payload, length and place
//
// The hash comes last and is the commit mark: a block counts when it is complete and its hash is right, so a kill or a
// full disk costs at most the block being written. The place in the hash keeps remains of another file from counting.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "io/posix_file.hpp"

namespace suture {

class Journal {
 public:
  /// A new, empty journal; an old one is replaced. Throws FileError, and InputError when another process writes it.
  static Journal create(const std::filesystem::path& path);
  /// An existing journal, cut to `length` bytes, to be continued. Throws as create.
  static Journal reopen(const std::filesystem::path& path, std::uint64_t length);

  /// Throws FileError; then the journal is as before (or, if even that fails, ends in a block that does not count).
  void append(std::string_view payload);
  /// Until everything appended is on the disk: also a power failure cannot take it back. Throws FileError.
  void sync() { file_.sync(); }
  std::uint64_t size() const { return size_; }

 private:
  explicit Journal(PosixFile file);
  PosixFile file_;
  std::uint64_t size_ = 0;
};

enum class OnDamage {
  stop,  ///< the journal ends before the first damaged block
  skip,  ///< damaged stretches are left out
};

/// Reads block after block; holds one in memory. The file may be growing: its size at the start is what counts.
class JournalReader {
 public:
  /// Throws FileError when the file cannot be opened or is no journal.
  explicit JournalReader(const std::filesystem::path& path, OnDamage on_damage = OnDamage::stop);

  /// False at the end of what can be read.
  bool next(std::string& payload);
  /// End of the last block that was read.
  std::uint64_t offset() const { return offset_; }
  /// Bytes that belong to no good block, so far.
  std::uint64_t damaged() const { return damaged_; }
  std::uint64_t file_size() const { return file_size_; }

 private:
  bool read_block(std::uint64_t at, std::string& payload);
  bool find_mark(std::uint64_t& at) const;
  PosixFile file_;
  OnDamage on_damage_;
  std::uint64_t file_size_, end_, offset_ = 0, damaged_ = 0;  // end_: of what is worth reading
};

/// Whether the file starts like a journal.
bool is_journal(const std::filesystem::path& path);

}  // namespace suture
