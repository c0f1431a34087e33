// XDMF 3 with its numbers in HDF5, one dataset per frame: hyperslabs into common arrays come out wrong or empty in one or
// the other of ParaView's readers.
#include <fcntl.h>
#include <fmt/format.h>

#include "export/mesh.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5_file.hpp"
#include "io/posix_file.hpp"

namespace suture {
namespace {

constexpr const char* data_file = "data.h5";
constexpr int polygon_code = 3;  // XDMF's number of a polygon in a topology of mixed type

// The numbers of one frame of one series, written into `group`, and the XML that refers to them.
class GridText {
 public:
  GridText(const Hdf5Group& group, std::string path) : group_(group), path_(std::move(path)) {}

  std::string grid(const Mesh& mesh, double time) const {
    std::string text = fmt::format("<Grid Name=\"{}\" GridType=\"Uniform\">\n<Time Value=\"{}\"/>\n", path_, time);
    text += topology(mesh) + geometry(mesh);
    for (const MeshArray& array : mesh.point_data) text += attribute(array, "Node");
    for (const MeshArray& array : mesh.element_data) text += attribute(array, "Cell");
    return text + "</Grid>\n";
  }

 private:
  std::string reference(const std::string& name, const std::string& dimensions, const char* number) const {
    return fmt::format("<DataItem Format=\"HDF\" NumberType=\"{}\" Precision=\"{}\" Dimensions=\"{}\">{}:/{}/{}</DataItem>\n",
                       number, number == std::string("Int") ? 4 : 8, dimensions, data_file, path_, name);
  }

  std::string topology(const Mesh& mesh) const {
    const std::size_t elements = mesh.end.size();
    std::vector<int> numbers;
    if (mesh.kind == Mesh::Kind::lines) {
      numbers = mesh.connectivity;
    } else {
      for (std::size_t e = 0; e < elements; ++e) {
        const int first = e > 0 ? mesh.end[e - 1] : 0;
        numbers.insert(numbers.end(), {polygon_code, mesh.end[e] - first});
        numbers.insert(numbers.end(), mesh.connectivity.begin() + first, mesh.connectivity.begin() + mesh.end[e]);
      }
    }
    group_.write("topology", numbers, {"1", "elements, as XDMF counts them"});
    if (mesh.kind == Mesh::Kind::lines)
      return fmt::format("<Topology TopologyType=\"Polyline\" NodesPerElement=\"2\" NumberOfElements=\"{0}\">\n{1}</Topology>\n",
                         elements, reference("topology", std::to_string(numbers.size()), "Int"));
    return fmt::format("<Topology TopologyType=\"Mixed\" NumberOfElements=\"{}\">\n{}</Topology>\n", elements,
                       reference("topology", std::to_string(numbers.size()), "Int"));
  }

  std::string geometry(const Mesh& mesh) const {
    std::vector<double> x, y;
    for (const Point& point : mesh.points) x.push_back(point.x), y.push_back(point.y);
    const std::vector<double> z(x.size(), 0.0);
    const std::span<const double> columns[] = {x, y, z};
    group_.write_table("points", columns, {"length", "x, y, 0"});
    return fmt::format("<Geometry GeometryType=\"XYZ\">\n{}</Geometry>\n",
                       reference("points", fmt::format("{} 3", x.size()), "Float"));
  }

  std::string attribute(const MeshArray& array, const char* centre) const {
    // Names may repeat between vertices and elements.
    const std::string name = fmt::format("{}_{}", centre, array.name);
    std::string dimensions = std::to_string(array.values.size());
    if (array.components == 1) {
      group_.write(name, array.values, {"1", array.name});
    } else {
      std::vector<std::vector<double>> parts(array.components);
      for (std::size_t i = 0; i < array.values.size(); ++i) parts[i % parts.size()].push_back(array.values[i]);
      const std::vector<std::span<const double>> columns(parts.begin(), parts.end());
      group_.write_table(name, columns, {"1", array.name});
      dimensions = fmt::format("{} {}", array.values.size() / array.components, array.components);
    }
    return fmt::format("<Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">\n{}</Attribute>\n", array.name,
                       array.components == 1 ? "Scalar" : "Vector", centre, reference(name, dimensions, "Float"));
  }

  const Hdf5Group& group_;
  std::string path_;
};

std::string xdmf_text(const char* series, const std::string& grids) {
  return fmt::format("<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n"
                     "<Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n{}</Grid>\n</Domain>\n</Xdmf>\n",
                     series, grids);
}

// Readers refuse a grid of nothing: a frame without purse string or wound gets one element that has no extent.
Mesh with_something(Mesh mesh, const Mesh& like, Point where) {
  if (!mesh.points.empty()) return mesh;
  const int corners = mesh.kind == Mesh::Kind::lines ? 2 : 3;
  for (int k = 0; k < corners; ++k) mesh.points.push_back(where), mesh.connectivity.push_back(k);
  mesh.end = {corners};
  for (const MeshArray& array : like.element_data)
    mesh.element_data.push_back({array.name, array.components, std::vector<double>(array.components, 0.0)});
  return mesh;
}

/// The numbers of all series, frame after frame, and the XML of each series' grids.
std::vector<std::string> write_numbers(const Replay& replay, const ExportRequest& request, const std::vector<bool>& present,
                                       const Hdf5Group& root) {
  const std::size_t series = present.size();
  std::vector<std::string> grids(series);
  std::vector<Mesh> last(series);  // with points; tells which fields a series has
  for (const int index : request.frames) {
    const std::string frame = fmt::format("{:06}", index);
    const Hdf5Group group = root.create_group(frame);
    const std::vector<Mesh> meshes = make_meshes(replay.frame(index), replay.scales(), request.units);
    for (std::size_t s = 0; s < series; ++s) {
      if (!present[s]) continue;
      const Hdf5Group place = group.create_group(series_names[s]);
      if (!meshes[s].points.empty()) last[s] = meshes[s];
      const Mesh mesh = with_something(meshes[s], last[s], meshes[0].points.front());
      grids[s] += GridText(place, fmt::format("{}/{}", frame, series_names[s]))
                      .grid(mesh, export_time(replay, index, request.units));
    }
  }
  return grids;
}

/// write_numbers() into a file that appears when it is whole. Throws FileError.
std::vector<std::string> write_data(const Replay& replay, const ExportRequest& request, const std::vector<bool>& present,
                                    const std::filesystem::path& path) {
  std::vector<std::string> grids;
  write_file_atomically(path, [&](const std::filesystem::path& temporary) {
    Hdf5File file = Hdf5File::create(temporary);
    grids = write_numbers(replay, request, present, file.root());
    file.finish();
    PosixFile(temporary, O_RDWR).sync();
  });
  return grids;
}

}  // namespace

std::vector<std::filesystem::path> export_xdmf(const Replay& replay, const ExportRequest& request,
                                               const std::filesystem::path& directory) {
  const std::vector<bool> present = series_present(replay, request.frames);
  make_directory(directory);
  const std::vector<std::string> grids = write_data(replay, request, present, directory / data_file);
  std::vector<std::filesystem::path> written;
  for (std::size_t s = 0; s < present.size(); ++s) {
    if (!present[s]) continue;
    written.push_back(directory / fmt::format("{}.xdmf", series_names[s]));
    write_file_atomically(written.back(), xdmf_text(series_names[s], grids[s]));
  }
  return written;
}

}  // namespace suture
