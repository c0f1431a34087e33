#include "suture/io/state_csv.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

#include "suture/errors.hpp"
#include "suture/geometry/polygon.hpp"

namespace suture {

namespace {

constexpr std::array<std::string_view, 5> required_columns{"cell", "vertex", "x", "y", "l0"};

/// Where in which file we are; every complaint starts with it.
struct Place {
  const std::string& path;
  int line = 0;
  template <class... Arguments>
  [[noreturn]] void fail(fmt::format_string<Arguments...> format, Arguments&&... arguments) const {
    throw InputError(fmt::format("{}:{}: {}", path, line, fmt::format(format, std::forward<Arguments>(arguments)...)));
  }
};

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t comma = 0; (comma = line.find(',')) != std::string_view::npos; line.remove_prefix(comma + 1))
    fields.push_back(trimmed(line.substr(0, comma)));
  fields.push_back(trimmed(line));
  return fields;
}

template <class Number>
Number parse(std::string_view text, std::string_view column, const Place& place) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    place.fail("column {}: '{}' is not {} number", column, text, std::is_integral_v<Number> ? "a whole" : "a");
  if constexpr (std::is_floating_point_v<Number>)
    if (!std::isfinite(value)) place.fail("column {}: '{}' is not finite", column, text);
  return value;
}

/// Position of every required column in the header.
std::array<std::size_t, 5> find_columns(const std::vector<std::string_view>& header, const Place& place) {
  std::array<std::size_t, 5> position{};
  for (std::size_t k = 0; k < required_columns.size(); ++k) {
    int found = 0;
    for (std::size_t column = 0; column < header.size(); ++column)
      if (header[column] == required_columns[k]) position[k] = column, ++found;
    if (found == 0) place.fail("column '{}' is missing; needed are cell,vertex,x,y,l0", required_columns[k]);
    if (found > 1) place.fail("column '{}' appears {} times", required_columns[k], found);
  }
  return position;
}

/// The cell that ends above this line is a counter-clockwise polygon.
void check_last_cell(const StateTable& table, const Place& place) {
  const std::size_t cell = table.vertex_counts.size() - 1, count = table.vertex_counts.back();
  if (count < 3) place.fail("cell {} has {} vertices; at least 3 are needed", cell, count);
  const std::span x(table.x), y(table.y);
  const double area = signed_area(x.last(count), y.last(count));
  if (!(area > 0.0)) place.fail("cell {} has area {}; its vertices must run counter-clockwise", cell, area);
}

void add_row(StateTable& table, const std::vector<std::string_view>& fields, const std::array<std::size_t, 5>& column,
             const Place& place) {
  const int cell = parse<int>(fields[column[0]], "cell", place),
            vertex = parse<int>(fields[column[1]], "vertex", place);
  const int cells = static_cast<int>(table.vertex_counts.size());
  const bool next_vertex = cells > 0 && cell == cells - 1 && vertex == table.vertex_counts.back();
  const bool next_cell = cell == cells && vertex == 0;
  if (!next_vertex && !next_cell)
    place.fail(
        "found cell {}, vertex {} where {}cell {}, vertex 0 was expected; number cells and vertices 0, 1, ... in order",
        cell, vertex, cells > 0 ? fmt::format("cell {}, vertex {} or ", cells - 1, table.vertex_counts.back()) : "",
        cells);
  if (next_cell) {
    if (cells > 0) check_last_cell(table, place);
    table.vertex_counts.push_back(0);
  }
  ++table.vertex_counts.back();
  table.x.push_back(parse<double>(fields[column[2]], "x", place));
  table.y.push_back(parse<double>(fields[column[3]], "y", place));
  table.rest_length.push_back(parse<double>(fields[column[4]], "l0", place));
  if (!(table.rest_length.back() > 0.0))
    place.fail("column l0: the rest length {} is not positive", table.rest_length.back());
}

/// Runs write(file) and reports a file that could not be written completely.
template <class Write>
void write_file(const std::string& path, Write&& write) {
  std::ofstream file(path);
  if (file) write(file);
  file.flush();
  if (!file) throw FileError(fmt::format("{}: cannot be written", path));
}

}  // namespace

StateTable read_state_csv(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw InputError(fmt::format("{}: cannot be read", path));
  Place place{path};
  StateTable table;
  std::string line;
  std::array<std::size_t, 5> column{};
  std::size_t width = 0;
  while (std::getline(file, line)) {
    ++place.line;
    if (trimmed(line).empty()) continue;
    const std::vector<std::string_view> fields = split(line);
    if (width == 0) {
      column = find_columns(fields, place);
      width = fields.size();
      continue;
    }
    if (fields.size() != width) place.fail("{} fields where the header has {}", fields.size(), width);
    add_row(table, fields, column, place);
  }
  if (table.vertex_counts.empty()) place.fail("the file holds no cells");
  check_last_cell(table, place);
  return table;
}

TissueState make_state(const StateTable& table, const Config& config) {
  const int cells = static_cast<int>(table.vertex_counts.size());
  Config per_cell = config;
  per_cell.tissue.cells = cells;
  per_cell.cell_types.clear();
  for (const CellType& type : config.cell_types)
    per_cell.cell_types.insert(per_cell.cell_types.end(), type.cells, type);
  if (static_cast<int>(per_cell.cell_types.size()) > cells)
    throw InputError(fmt::format("[[cell_type]] tables ask for {} cells, but the configuration has {}",
                                 per_cell.cell_types.size(), cells));
  per_cell.cell_types.resize(cells);
  for (int cell = 0; cell < cells; ++cell) {
    per_cell.cell_types[cell].cells = 1;
    per_cell.cell_types[cell].vertices = table.vertex_counts[cell];
  }
  TissueState state{.tissue = make_tissue(per_cell)};
  state.values = table.x;
  state.values.insert(state.values.end(), table.y.begin(), table.y.end());
  state.values.insert(state.values.end(), table.rest_length.begin(), table.rest_length.end());
  return state;
}

void write_forces_csv(const std::string& path, const TissueState& state, const std::vector<TermForces>& forces) {
  write_file(path, [&](std::ostream& file) {
    file << "cell,vertex,x,y,l0";
    for (const TermForces& term : forces) fmt::print(file, ",{0}_fx,{0}_fy", term.term);
    file << '\n';
    const StateView view = state.view();
    for (int v = 0; v < state.tissue.vertex_count(); ++v) {
      const int cell = state.tissue.cell_of(v);
      fmt::print(file, "{},{},{:.17g},{:.17g},{:.17g}", cell, v - state.tissue.first_vertex(cell), view.x[v], view.y[v],
                 view.rest_length[v]);
      for (const TermForces& term : forces) fmt::print(file, ",{:.17g},{:.17g}", term.fx[v], term.fy[v]);
      file << '\n';
    }
  });
}

void write_energy_csv(const std::string& path, const std::vector<TermForces>& forces) {
  write_file(path, [&](std::ostream& file) {
    file << "term,energy\n";
    for (const TermForces& term : forces) fmt::print(file, "{},{:.17g}\n", term.term, term.energy);
  });
}

std::string energy_csv_path(const std::string& forces_path) {
  const std::string_view ending = ".csv";
  if (forces_path.ends_with(ending)) return forces_path.substr(0, forces_path.size() - ending.size()) + "_energy.csv";
  return forces_path + "_energy.csv";
}

}  // namespace suture
