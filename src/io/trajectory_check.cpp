#include "suture/io/trajectory_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>

#include "io/tissue_state_io.hpp"
#include "io/checkpoint_file.hpp"
#include "io/journal.hpp"
#include "io/trajectory_file.hpp"
#include "io/trajectory_hashes.hpp"
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

FileReport check_trajectory(const std::filesystem::path& path) {
  try {
    open_trajectory(path);
  } catch (const FileError& error) {
    return unreadable(error.what());
  }
  FileReport out;
  Trajectory trajectory;
  try {
    trajectory = read_trajectory(path);
    for (const std::string& problem : hash_problems(open_trajectory(path).root(), trajectory)) report(out, problem);
  } catch (const std::runtime_error& error) {
    report(out, error.what());
    return out;
  }
  out.content = fmt::format("trajectory: {} cells, {} frames, {} stages, {} observables, {} events",
                            trajectory.tissue.cell_count(), trajectory.frames.size(), trajectory.stages.size(),
                            trajectory.observables.size(), trajectory.events.size());
  if (!trajectory.complete && !is_journal(path))
    report(out, "the run did not finish: the file ends at the last commit before it stopped");
  for (const Continuation& continuation : trajectory.continuations)
    out.content += fmt::format("; resumed at t = {:.6g} ({})", continuation.time,
                               continuation.reproducible ? "bit-identical" : "equal to the tolerances");
  for (const auto& [stage, state] : trajectory.stages) check_state(out, "stage " + stage_name(stage), state);
  for (std::size_t i = 0; i < trajectory.frames.size(); ++i) {
    const std::string where = fmt::format("frame {}", i);
    check_state(out, where, trajectory.state(static_cast<int>(i)));
    if (i > 0 && !(trajectory.frames[i].time > trajectory.frames[i - 1].time))
      report(out, where + ": time does not increase");
    for (const CellField& field : trajectory.frames[i].extras.cell_fields)
      if (!all_finite(field.values)) report(out, fmt::format("{}: {} is not finite", where, field.quantity.name));
  }
  for (const Series& series : trajectory.observables)
    check_series(out, "observable " + series.quantity.name, series.time, series.value);
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
