#include "export/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "suture/errors.hpp"

namespace suture {
namespace {

class MeshMaker {
 public:
  MeshMaker(const ReplayFrame& frame, const UnitScales& scales, ExportUnits units)
      : frame_(frame), scales_(scales), physical_(units == ExportUnits::physical) {}

  Mesh cells() const {
    const Tissue& tissue = frame_.state.tissue;
    Mesh mesh{.kind = Mesh::Kind::polygons, .points = vertices()};
    mesh.connectivity.resize(tissue.vertex_count());
    std::iota(mesh.connectivity.begin(), mesh.connectivity.end(), 0);
    for (int cell = 0; cell < tissue.cell_count(); ++cell) mesh.end.push_back(tissue.end_vertex(cell));
    mesh.element_data = fields(Place::cell);
    mesh.element_data.push_back(numbered("cell", tissue.cell_count()));
    mesh.point_data = fields(Place::vertex);
    join_force(mesh.point_data);
    mesh.point_data.push_back(numbered("vertex", tissue.vertex_count()));
    return mesh;
  }

  Mesh segments() const {
    const Tissue& tissue = frame_.state.tissue;
    Mesh mesh{.kind = Mesh::Kind::lines, .points = vertices()};
    MeshArray cell{"cell", 1, {}};
    for (int v = 0; v < tissue.vertex_count(); ++v) {
      add_line(mesh, v, tissue.next(v));
      cell.values.push_back(tissue.cell_of(v));
    }
    mesh.element_data = fields(Place::segment);
    mesh.element_data.push_back(cell);
    return mesh;
  }

  // First the springs, then the tethers; points: first the purse string, then the cell vertices it is tethered to.
  Mesh purse_string() const {
    const PurseString& ring = frame_.state.purse_string;
    Mesh mesh{.kind = Mesh::Kind::lines};
    const int count = ring.size(), vertices = frame_.state.tissue.vertex_count();
    for (int j = 0; j < count; ++j) mesh.points.push_back(point(vertices + j)), add_line(mesh, j, (j + 1) % count);
    for (int j = 0; j < count; ++j) mesh.points.push_back(point(ring.vertex[j])), add_line(mesh, j, count + j);
    if (count == 0) return mesh;
    MeshArray kind{"tether", 1, std::vector<double>(count, 0.0)};
    kind.values.resize(2 * count, 1.0);
    mesh.element_data = {kind, spliced("length", "spring_length", "tether_length"),
                         spliced("tension", "spring_tension", "tether_force"),
                         spliced("rest_length", "spring_rest_length", nullptr), spliced("slipped", nullptr, "slipped")};
    return mesh;
  }

  Mesh wound() const {
    Mesh mesh{.kind = Mesh::Kind::polygons};
    for (const Point& corner : frame_.wound_outline) mesh.points.push_back(length_factor() * corner);
    if (mesh.points.empty()) return mesh;
    mesh.connectivity.resize(mesh.points.size());
    std::iota(mesh.connectivity.begin(), mesh.connectivity.end(), 0);
    mesh.end.push_back(static_cast<int>(mesh.points.size()));
    return mesh;
  }

 private:
  double length_factor() const { return physical_ ? scales_.length_um() : 1.0; }

  Point point(int i) const {
    const StateView view = frame_.state.view();
    return length_factor() * Point{view.x[i], view.y[i]};
  }

  std::vector<Point> vertices() const {
    std::vector<Point> points;
    for (int v = 0; v < frame_.state.tissue.vertex_count(); ++v) points.push_back(point(v));
    return points;
  }

  static void add_line(Mesh& mesh, int from, int to) {
    mesh.connectivity.insert(mesh.connectivity.end(), {from, to});
    mesh.end.push_back(static_cast<int>(mesh.connectivity.size()));
  }

  static MeshArray numbered(const char* name, int count) {
    MeshArray array{name, 1, std::vector<double>(count)};
    std::iota(array.values.begin(), array.values.end(), 0.0);
    return array;
  }

  std::string name_with_unit(std::string name, Dimension dimension) const {
    std::string unit(physical_ ? base_unit(dimension) : "");
    std::erase(unit, '^');
    return unit.empty() ? name : name + "_" + unit;
  }

  MeshArray array_of(const Field& field, const std::string& name) const {
    return {name_with_unit(name, field.dimension), 1, physical_ ? in_physical_units(field, scales_) : field.values};
  }

  std::vector<MeshArray> fields(Place place) const {
    std::vector<MeshArray> arrays;
    for (const Field& field : frame_.fields)
      if (field.place == place) arrays.push_back(array_of(field, field.quantity.name));
    return arrays;
  }

  // One field of the springs and one of the tethers as one; nullptr: zeros.
  MeshArray spliced(const char* name, const char* of_springs, const char* of_tethers) const {
    const Field& known = frame_.field(of_springs != nullptr ? of_springs : of_tethers);
    MeshArray result{name_with_unit(name, known.dimension), 1, {}};
    for (const char* part : {of_springs, of_tethers}) {
      const std::vector<double> values =
          part != nullptr ? array_of(frame_.field(part), "").values : std::vector<double>(known.values.size(), 0.0);
      result.values.insert(result.values.end(), values.begin(), values.end());
    }
    return result;
  }

  // force_x and force_y become one vector.
  static void join_force(std::vector<MeshArray>& arrays) {
    MeshArray force{"force" + arrays.at(0).name.substr(std::string("force_x").size()), 3, {}};
    for (std::size_t v = 0; v < arrays[0].values.size(); ++v)
      force.values.insert(force.values.end(), {arrays[0].values[v], arrays[1].values[v], 0.0});
    arrays.erase(arrays.begin());
    arrays[0] = std::move(force);
  }

  const ReplayFrame& frame_;
  const UnitScales& scales_;
  bool physical_;
};

}  // namespace

std::vector<Mesh> make_meshes(const ReplayFrame& frame, const UnitScales& scales, ExportUnits units) {
  const MeshMaker maker(frame, scales, units);
  return {maker.cells(), maker.segments(), maker.purse_string(), maker.wound()};
}

std::vector<bool> series_present(const Replay& replay, const std::vector<int>& frames) {
  bool ring = false, wound = false;
  for (const int index : frames) {
    ring = ring || !replay.state(index).purse_string.empty();
    wound = wound || !replay.wound_outline(index).empty();
  }
  return {true, true, ring, wound};
}

double export_time(const Replay& replay, int frame, ExportUnits units) {
  const double time = replay.times()[frame] - replay.time_origin();
  return units == ExportUnits::physical ? time * replay.scales().time_min() : time;
}

void make_directory(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) throw FileError(fmt::format("{}: {}", directory.string(), error.message()));
}

}  // namespace suture
