// VTK XML PolyData, one file per frame (VTK file formats: XML, "binary" inline arrays with a 64-bit length header).
#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "export/mesh.hpp"
#include "io/atomic_file.hpp"
#include "suture/io/base64.hpp"

namespace suture {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say LittleEndian");

template <class Number>
std::string array_text(const char* type, const std::string& name, int components, const std::vector<Number>& values) {
  const std::uint64_t length = sizeof(Number) * values.size();
  std::vector<std::byte> bytes(sizeof length + length);
  std::memcpy(bytes.data(), &length, sizeof length);
  if (length > 0) std::memcpy(bytes.data() + sizeof length, values.data(), length);
  return fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">{}</DataArray>\n",
                     type, name, components, base64(bytes));
}

std::string data_text(const char* element, const std::vector<MeshArray>& arrays) {
  std::string text = fmt::format("<{}>\n", element);
  for (const MeshArray& array : arrays) text += array_text("Float64", array.name, array.components, array.values);
  return text + fmt::format("</{}>\n", element);
}

std::string vtp_text(const Mesh& mesh, double time, int cycle) {
  std::vector<double> coordinates;
  for (const Point& point : mesh.points) coordinates.insert(coordinates.end(), {point.x, point.y, 0.0});
  const std::vector<std::int64_t> connectivity(mesh.connectivity.begin(), mesh.connectivity.end());
  const std::vector<std::int64_t> end(mesh.end.begin(), mesh.end.end());
  const bool lines = mesh.kind == Mesh::Kind::lines;
  const char* const element = lines ? "Lines" : "Polys";
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n";
  // ParaView reads the time from TimeValue, VisIt from TIME and CYCLE.
  text += fmt::format(
      "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{0}</DataArray>\n"
      "<DataArray type=\"Float64\" Name=\"TIME\" NumberOfTuples=\"1\" format=\"ascii\">{0}</DataArray>\n"
      "<DataArray type=\"Int32\" Name=\"CYCLE\" NumberOfTuples=\"1\" format=\"ascii\">{1}</DataArray>\n</FieldData>\n",
      time, cycle);
  text += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
                      "NumberOfPolys=\"{}\">\n",
                      mesh.points.size(), lines ? mesh.end.size() : 0, lines ? 0 : mesh.end.size());
  text += data_text("PointData", mesh.point_data) + data_text("CellData", mesh.element_data);
  text += "<Points>\n" + array_text("Float64", "Points", 3, coordinates) + "</Points>\n";
  text += fmt::format("<{}>\n", element) + array_text("Int64", "connectivity", 1, connectivity) +
          array_text("Int64", "offsets", 1, end) + fmt::format("</{}>\n", element);
  return text + "</Piece>\n</PolyData>\n</VTKFile>\n";
}

}  // namespace

std::vector<std::filesystem::path> export_vtp(const Replay& replay, const ExportRequest& request,
                                              const std::filesystem::path& directory) {
  const std::vector<bool> present = series_present(replay, request.frames);
  const std::size_t series = present.size();
  std::vector<std::string> pvd(series), visit(series);
  for (std::size_t s = 0; s < series; ++s)
    if (present[s]) make_directory(directory / series_names[s]);
  for (const int index : request.frames) {
    const std::vector<Mesh> meshes = make_meshes(replay.frame(index), replay.scales(), request.units);
    const double time = export_time(replay, index, request.units);
    for (std::size_t s = 0; s < series; ++s) {
      if (!present[s]) continue;
      const std::string file = fmt::format("{0}/{0}_{1:06}.vtp", series_names[s], index);
      write_file_atomically(directory / file, vtp_text(meshes[s], time, index));
      pvd[s] += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time, file);
      visit[s] += file + "\n";
    }
  }
  std::vector<std::filesystem::path> written;
  for (std::size_t s = 0; s < series; ++s) {
    if (!present[s]) continue;
    written.push_back(directory / fmt::format("{}.pvd", series_names[s]));
    write_file_atomically(written.back(), fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
                                                      "byte_order=\"LittleEndian\">\n<Collection>\n{}</Collection>\n</VTKFile>\n",
                                                      pvd[s]));
    write_file_atomically(directory / fmt::format("{}.visit", series_names[s]), visit[s]);
  }
  return written;
}

}  // namespace suture
