// A run on disk: one HDF5 file with every stage's final state, frames, observables, events and full provenance.
// docs/reference/output-format.md describes the layout. Everything is stored in model units.
//
// While a run goes on, everything is appended to a journal beside it (run.journal): checksummed blocks, each of which
// survives a kill once it is written. close() turns the journal into the HDF5 file, which appears as a whole: temporary
// file, fsync, rename, fsync of the directory. Memory does not grow with the number of frames.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "suture/geometry/point.hpp"
#include "suture/io/provenance.hpp"
#include "suture/io/summary.hpp"
#include "suture/model/state.hpp"

namespace suture {

/// What a stored number means.
struct Quantity {
  std::string name;  ///< of the dataset, e.g. "shape_parameter"
  std::string unit;  ///< model unit: "1", "length", "area", "energy", "time", ...
  std::string description;
};

/// One number per cell at the time of a frame.
struct CellField {
  Quantity quantity;
  std::vector<double> values;
};

/// What a frame holds besides the state.
struct FrameExtras {
  std::vector<CellField> cell_fields;
  std::vector<Point> wound_outline;  ///< counter-clockwise; may be empty
};

/// A discrete event of the hybrid system: "yield", "capture", "slip", "exchange", "closure", ... (at most 31 letters).
struct StoredEvent {
  double time = 0.0;
  std::string kind;
  std::optional<int> cell;
  std::optional<int> vertex;  ///< cell vertex, counted through the tissue
  friend bool operator==(const StoredEvent&, const StoredEvent&) = default;
};

/// A checkpoint from which a run went on after it had been stopped or killed.
struct Continuation {
  double time = 0.0;          ///< simulation time of the checkpoint
  bool reproducible = false;  ///< the result has the bits of a run that was never interrupted; else agrees to tolerance
  std::string started;        ///< ISO 8601, UTC
};

struct WoundSample;

/// The journal that belongs to a trajectory: "run.h5" has "run.journal".
std::filesystem::path journal_path(const std::filesystem::path& trajectory);

class TrajectoryWriter {
 public:
  /// Nothing appears on disk before the first commit(). An older journal is then replaced.
  TrajectoryWriter(std::filesystem::path path, const Provenance& provenance);
  /// Goes on with the journal of `path`, whose first `length` bytes are kept (length() of the earlier writer).
  /// Throws FileError when they are not all there and whole, InputError when another process writes the journal.
  static TrajectoryWriter resume(std::filesystem::path path, std::uint64_t length);
  TrajectoryWriter(TrajectoryWriter&&) noexcept;
  ~TrajectoryWriter();

  /// The state at the end of a stage, complete enough to start from. An earlier state of this stage is replaced, and
  /// those of later stages go.
  void write_stage(Stage stage, const TissueState& state);
  /// Appends a frame. The first frame fixes the tissue and the reference rest lengths; the purse string may change
  /// from frame to frame. Throws FileError when time does not increase or the tissue differs.
  void write_frame(const TissueState& state, const FrameExtras& extras = {});
  /// Appends one value to the series /observables/<quantity.name>.
  void record(const Quantity& quantity, double time, double value);
  void record(const StoredEvent& event);
  /// A row of wound.csv, so that the table can be made from the journal.
  void record(const WoundSample& sample);
  void record(const Continuation& continuation);
  /// Counters and results of the run, into /solver and /summary. A later call replaces an earlier one.
  void write_summary(const RunSummary& summary);

  /// Appends everything so far to the journal as one block: a kill of the program cannot take it back. Throws FileError;
  /// nothing is lost then, and a later commit writes it.
  void commit();
  /// Flushes the journal to the disk: not even a power failure can take it back.
  void sync();
  /// Bytes committed to the journal.
  std::uint64_t length() const;
  /// Commits and makes the HDF5 file of everything so far, marked as complete or not. The journal stays.
  void publish(bool complete);
  /// Commits, publishes the complete file and removes the journal. Nothing may be written afterwards.
  void close();
  /// Removes the journal, which publish() has made superfluous. Nothing may be written afterwards.
  void discard_journal();

 private:
  TrajectoryWriter();
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

struct TrajectoryFrame {
  double time = 0.0;
  PurseString purse_string;
  std::vector<double> values;  ///< y
  FrameExtras extras;
};

struct Series {
  Quantity quantity;
  std::vector<double> time, value;
};

struct Trajectory {
  Provenance provenance;
  std::string code_version, code_commit;
  bool complete = false;  ///< closed by the writer; false: the run goes on or was killed
  Tissue tissue;          ///< of the frames
  SharedValues reference_rest_length;
  std::vector<TrajectoryFrame> frames;
  std::map<Stage, TissueState> stages;
  std::vector<Series> observables;
  std::vector<StoredEvent> events;
  std::vector<Continuation> continuations;  ///< empty: the run was not interrupted
  std::string summary;  ///< JSON text of the run's summary; empty if none was written

  TissueState state(int frame) const;
  /// nullptr when there is no such series.
  const Series* observable(std::string_view name) const;
};

/// Reads a whole trajectory, from run.h5 or from run.journal; when run.h5 does not exist, from the journal beside it.
/// Throws InputError when the file cannot be opened, is not a suture trajectory, was written with a newer layout, or
/// contradicts itself.
Trajectory read_trajectory(const std::filesystem::path& path);

/// One frame after the other, of files that are larger than memory. A journal of more than 256 MiB is turned into a scratch
/// file in $TMPDIR (else /tmp), which is gone when the reader is. Throws InputError as read_trajectory.
class FrameReader {
 public:
  explicit FrameReader(const std::filesystem::path& path);
  FrameReader(FrameReader&&) noexcept;
  ~FrameReader();
  int count() const;
  TissueState state(int frame) const;
  double time(int frame) const;
  FrameExtras extras(int frame) const;
  /// Everything else in the file; its `frames` are empty.
  const Trajectory& all_but_frames() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The rows of wound.csv in a journal, up to its first `length` bytes. Throws InputError.
std::vector<WoundSample> read_wound_samples(const std::filesystem::path& journal,
                                            std::uint64_t length = std::numeric_limits<std::uint64_t>::max());

/// The last stage a file holds, without its frames (run.start_from). Throws InputError as read_trajectory.
std::pair<Stage, TissueState> read_last_stage(const std::filesystem::path& path);

}  // namespace suture
