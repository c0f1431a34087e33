#include "suture/io/trajectory_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <system_error>

#include "io/tissue_state_io.hpp"
#include "io/checkpoint_file.hpp"
#include "io/journal.hpp"
#include "io/trajectory_file.hpp"
#include "io/trajectory_hashes.hpp"
#include "io/trajectory_parts.hpp"
#include "suture/errors.hpp"
#include "suture/geometry/polygon.hpp"
#include "suture/io/cell_csv.hpp"
#include "suture/io/summary.hpp"
#include "suture/io/trajectory.hpp"
#include "suture/io/wound_csv.hpp"

namespace suture {
namespace {

constexpr std::size_t most_problems = 20;  // a damaged file must not flood the terminal

void report(FileReport& out, std::string problem) {
  out.verdict = FileVerdict::invalid;
  if (out.problems.size() < most_problems) out.problems.push_back(std::move(problem));
}

FileReport unreadable(std::string why) { return {FileVerdict::unreadable, {}, {std::move(why)}}; }

bool all_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

void check_state(FileReport& out, const std::string& where, const TissueState& state) {
  if (!std::isfinite(state.time)) report(out, where + ": the time is not finite");
  if (!all_finite(state.values)) return report(out, where + ": a position or rest length is not finite");
  const StateView view = state.view();
  const auto cell_area = [&](int cell) {
    const std::size_t first = state.tissue.first_vertex(cell), count = state.tissue.vertex_count(cell);
    return signed_area(view.x.subspan(first, count), view.y.subspan(first, count));
  };
  for (int v = 0; v < state.tissue.vertex_count(); ++v)
    if (!(view.rest_length[v] > 0.0))
      report(out, fmt::format("{}: the rest length after {} is {}", where, state.tissue.vertex_name(v),
                              view.rest_length[v]));
  for (int cell = 0; cell < state.tissue.cell_count(); ++cell)
    if (const double area = cell_area(cell); !(area > 0.0))
      report(out, fmt::format("{}: cell {} is not counter-clockwise, its signed area is {}", where, cell, area));
}

void check_series(FileReport& out, const std::string& where, std::span<const double> time,
                  std::span<const double> value) {
  if (!all_finite(time) || !all_finite(value)) report(out, where + ": a value is not finite");
  if (!std::is_sorted(time.begin(), time.end())) report(out, where + ": time decreases");
}

/// One frame is in memory at a time.
void check_frames(FileReport& out, const Hdf5Group& root, const Trajectory& rest) {
  const Hdf5Group frames = root.group("frames");
  const bool hashed = has_hashes(root);
  double previous = -std::numeric_limits<double>::infinity();
  for (int i = 0, count = marked_frames(root); i < count; ++i) {
    TrajectoryFrame frame = read_frame(frames, i, rest.tissue);
    const std::string where = fmt::format("frame {}", i);
    if (hashed)
      for (const std::string& problem : hash_problems(frame_group(frames, i), i, frame)) report(out, problem);
    if (!(frame.time > previous)) report(out, where + ": time does not increase");
    previous = frame.time;
    for (const CellField& field : frame.extras.cell_fields)
      if (!all_finite(field.values)) report(out, fmt::format("{}: {} is not finite", where, field.quantity.name));
    check_state(out, where, state_of(rest, std::move(frame)));
  }
}

std::string content_of(const Trajectory& rest, int frames) {
  std::string text = fmt::format("trajectory: {} cells, {} frames, {} stages, {} observables, {} events", rest.tissue.cell_count(),
                                 frames, rest.stages.size(), rest.observables.size(), rest.events.size());
  for (const Continuation& continuation : rest.continuations)
    text += fmt::format("; resumed at t = {:.6g} ({})", continuation.time,
                        continuation.reproducible ? "bit-identical" : "equal to the tolerances");
  return text;
}

void check_content(FileReport& out, const std::filesystem::path& path, const Hdf5Group& root) {
  const Trajectory rest = read_all_but_frames(root);
  if (has_hashes(root))
    for (const std::string& problem : hash_problems(root, rest)) report(out, problem);
  out.content = content_of(rest, marked_frames(root));
  if (!rest.complete && !is_journal(path))
    report(out, "the run did not finish: the file ends at the last commit before it stopped");
  for (const auto& [stage, state] : rest.stages) check_state(out, "stage " + stage_name(stage), state);
  check_frames(out, root, rest);
  for (const Series& series : rest.observables) check_series(out, "observable " + series.quantity.name, series.time, series.value);
}

FileReport check_trajectory(const std::filesystem::path& path) {
  std::optional<Hdf5File> file;
  try {
    file = open_trajectory(path);
  } catch (const FileError& error) {
    return unreadable(error.what());
  }
  FileReport out;
  try {
    check_content(out, path, file->root());
  } catch (const std::runtime_error& error) {
    report(out, fmt::format("{}: {}", path.string(), error.what()));
  }
  return out;
}

/// Every block, then the trajectory they make.
FileReport check_journal(const std::filesystem::path& path) {
  FileReport out = check_trajectory(path);
  out.content = "journal of an unfinished " + out.content;
  JournalReader reader(path, OnDamage::skip);
  long blocks = 0;
  for (std::string block; reader.next(block);) ++blocks;
  out.content += fmt::format("; {} blocks", blocks);
  if (reader.damaged() > 0)
    report(out, fmt::format("{} of {} bytes are an incomplete or damaged block, which does not count", reader.damaged(),
                            reader.file_size()));
  return out;
}

FileReport check_checkpoint(const std::filesystem::path& path) {
  FileReport out{.content = "checkpoint"};
  try {
    out.content += fmt::format(": {} bytes", read_checkpoint(path).size());
  } catch (const FileError& error) {
    report(out, error.what());
  }
  return out;
}

FileReport check_summary(const std::string& text) {
  FileReport out{.content = "summary"};
  const auto found = nlohmann::json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!found.is_object()) return unreadable("it is not a JSON object");
  const auto expected = nlohmann::json::parse(to_json(RunSummary{}));
  for (const auto& [key, value] : expected.items())
    if (!found.contains(key)) report(out, fmt::format("key '{}' is missing", key));
  const auto allowed = nlohmann::json::parse(to_json(RunSummary{.cell = CellOutcome{}}));
  for (const auto& [key, value] : found.items())
    if (!allowed.contains(key)) report(out, fmt::format("key '{}' is not one of ours", key));
  return out;
}

// An empty field is a value that could not be measured.
bool is_number_or_empty(std::string_view field) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  return field.empty() || (error == std::errc() && end == field.data() + field.size() && std::isfinite(value));
}

FileReport check_table(const std::string& text) {
  const UnitScales scales{UnitParameters{}};
  std::istringstream lines(text);
  std::string header;
  std::getline(lines, header);
  const bool wound = header + '\n' == to_csv(std::span<const WoundSample>{}, scales);
  if (!wound && header + '\n' != to_csv(std::span<const CellSample>{}, scales))
    return unreadable("the header line is not that of a wound or cell table");
  FileReport out;
  std::string line;
  const auto columns = std::count(header.begin(), header.end(), ',');
  double previous = -std::numeric_limits<double>::infinity();
  int rows = 0;
  for (; std::getline(lines, line); ++rows) {
    std::istringstream fields(line);
    std::string field;
    bool numbers = std::count(line.begin(), line.end(), ',') == columns;
    while (std::getline(fields, field, ',')) numbers = numbers && is_number_or_empty(field);
    const double time = std::strtod(line.c_str(), nullptr);
    if (!numbers) report(out, fmt::format("line {}: not {} finite numbers", rows + 2, columns + 1));
    if (!(time > previous)) report(out, fmt::format("line {}: time does not increase", rows + 2));
    previous = time;
  }
  out.content = fmt::format("{} table: {} samples", wound ? "wound" : "cell", rows);
  return out;
}

}  // namespace

FileReport check_file(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return unreadable("there is no such file");
  const std::string extension = path.extension().string();
  if (path.filename() == "checkpoint" || path.filename() == "checkpoint.previous") return check_checkpoint(path);
  if (is_journal(path)) return check_journal(path);
  if (extension != ".json" && extension != ".csv") return check_trajectory(path);
  std::ifstream stream(path, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  if (!stream.good() && !stream.eof()) return unreadable("it cannot be read");
  return extension == ".json" ? check_summary(text) : check_table(text);
}

}  // namespace suture
