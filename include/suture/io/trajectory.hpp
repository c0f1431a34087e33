// A run on disk: one HDF5 file with every stage's final state, frames, observables, events and full provenance.
// docs/reference/output-format.md describes the layout. Everything is stored in model units.
//
// The file is built in memory and published as a whole by commit() and close(): temporary file, fsync, rename, fsync of
// the directory. So what carries the final name is a complete, readable HDF5 file at every moment, also after a kill or
// on a full disk; the price is memory for the whole trajectory and one rewrite of the file per commit.
#pragma once

#include <filesystem>
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

class TrajectoryWriter {
 public:
  /// Nothing appears at `path` before the first commit() or close().
  TrajectoryWriter(std::filesystem::path path, const Provenance& provenance);
  ~TrajectoryWriter();

  /// The state at the end of a stage, complete enough to start from. Written once per stage.
  void write_stage(Stage stage, const TissueState& state);
  /// Appends a frame. The first frame fixes the tissue and the reference rest lengths; the purse string may change
  /// from frame to frame. Throws FileError when time does not increase or the tissue differs.
  void write_frame(const TissueState& state, const FrameExtras& extras = {});
  /// Appends one value to the series /observables/<quantity.name>.
  void record(const Quantity& quantity, double time, double value);
  void record(const StoredEvent& event);
  /// Counters and results of the run, into /solver and /summary. A later call replaces an earlier one.
  void write_summary(const RunSummary& summary);

  /// Publishes everything so far, marked as unfinished.
  void commit();
  /// Publishes the finished file. Nothing may be written afterwards. Without close() the file stays at its last commit.
  void close();

 private:
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
  std::vector<double> reference_rest_length;
  std::vector<TrajectoryFrame> frames;
  std::map<Stage, TissueState> stages;
  std::vector<Series> observables;
  std::vector<StoredEvent> events;
  std::string summary;  ///< JSON text of the run's summary; empty if none was written

  TissueState state(int frame) const;
  /// nullptr when there is no such series.
  const Series* observable(std::string_view name) const;
};

/// Reads a whole trajectory. Throws InputError when the file cannot be opened, is not a suture trajectory, was written
/// with a newer layout, or contradicts itself.
Trajectory read_trajectory(const std::filesystem::path& path);

/// The last stage a file holds, without its frames (run.start_from). Throws InputError as read_trajectory.
std::pair<Stage, TissueState> read_last_stage(const std::filesystem::path& path);

}  // namespace suture
