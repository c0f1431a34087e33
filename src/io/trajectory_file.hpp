// Builds the HDF5 form of a trajectory, item by item. Holds one item and a few thousand rows of observables in memory.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/hdf5_file.hpp"
#include "io/trajectory_items.hpp"

namespace suture {

class TrajectoryFile {
 public:
  explicit TrajectoryFile(Hdf5File file);

  /// Adds the items of one block of a journal. Throws FileError when they make no sense here or cannot be written.
  void add(std::string_view block);
  /// Writes the commit mark; after it nothing may be added.
  void mark(bool complete);
  /// The finished file. Before, mark() it.
  Hdf5File release() &&;
  bool has_header() const;
  int frames() const { return frame_count_; }
  double last_time() const { return last_time_; }

 private:
  struct Column {
    Series series;  ///< rows not yet written
    std::uint64_t hash = 0;
    bool started = false;
  };
  struct EventColumns {
    std::vector<double> time;
    std::vector<std::string> kind;
    std::vector<int> cell, vertex;
    std::uint64_t hash = 0;
  };
  void add(const HeaderItem& header);
  void add(const StageItem& item);
  void add(const TissueItem& item);
  void add(const FrameItem& item);
  void add(const QuantityItem& item);
  void add(const ValueItem& item);
  void add(const StoredEvent& event);
  void add(const SummaryItem& summary);
  void add(const Continuation& continuation);
  void add(const WoundSample&) {}  // its numbers come as observables too
  void flush(Column& column);
  void flush_events();

  Hdf5File file_;
  struct Groups {
    Hdf5Group root, frames, stages, observables, events;
  };
  std::optional<Groups> groups_;  ///< gone before the file is released
  std::int64_t frame_count_ = 0;
  double last_time_ = 0.0;
  TissueItem tissue_;
  bool reproducible_ = true;
  std::map<std::uint32_t, Column> columns_;
  EventColumns pending_events_;
};

/// Opens run.h5, or a journal as the HDF5 file it would become; for a run.h5 that does not exist yet, the journal beside it.
/// A journal of more than `largest_in_memory` bytes becomes a nameless file in $TMPDIR. Checks the schema attributes.
/// Throws FileError.
Hdf5File open_trajectory(const std::filesystem::path& path, std::uintmax_t largest_in_memory = std::uintmax_t{256} << 20);

/// What recover_journal found.
struct Recovered {
  int frames = 0;
  double last_time = 0.0;  ///< of the last frame
  std::vector<WoundSample> samples;
  UnitParameters units;
  std::uint64_t lost_bytes = 0, journal_bytes = 0;
};

/// As convert_journal, but leaves out what is damaged or makes no sense. Throws InputError when the header is lost.
Recovered recover_journal(const std::filesystem::path& journal, const std::filesystem::path& path);

/// Journal to HDF5: what can be read of `journal`, as a file at `path` that is published when it is
/// whole. Throws FileError. Memory does not grow with the length of the journal.
void convert_journal(const std::filesystem::path& journal, const std::filesystem::path& path, bool complete);

}  // namespace suture
