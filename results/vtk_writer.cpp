#include "results/vtk_writer.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <type_traits>

#include "core/numbers/number_text.h"
#include "results/file_io.h"
#include "results/hdf5_plan.h"
#include "results/parcels.h"
#include "results/snapshot_columns.h"

namespace morula::scenarios {
namespace fs = std::filesystem;
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

const char* vtk_type(StoredType type) {
  switch (type) {
    case StoredType::kUint8:
    case StoredType::kText:
      return "UInt8";
    case StoredType::kUint16:
      return "UInt16";
    case StoredType::kUint32:
      return "UInt32";
    case StoredType::kUint64:
      return "UInt64";
    case StoredType::kInt32:
      return "Int32";
    case StoredType::kInt64:
      return "Int64";
    case StoredType::kFloat:
      return "Float32";
    case StoredType::kDouble:
      return "Float64";
  }
  return "UInt8";
}

/// One <DataArray>: the length in bytes and then the values, together in base64.
template <class T>
std::string data_array(const std::string& name, const std::vector<T>& values) {
  ByteWriter bytes;
  bytes.put(std::uint64_t{values.size() * sizeof(T)});
  bytes.put_all(std::span(values));
  std::string out = std::string("<DataArray type=\"") + vtk_type(Stored<T>::type) + "\" Name=\"" + escaped(name) + '"';
  if (Stored<T>::width > 1) out += " NumberOfComponents=\"" + std::to_string(Stored<T>::width) + '"';
  return out + " format=\"binary\">" + base64(bytes.bytes()) + "</DataArray>\n";
}

std::string file_head(const char* type) {
  return std::string("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<VTKFile type=\"") + type +
         "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n";
}

/// Time, and what the numbers of kinds mean: one array each, `type liver` = 1. No array of strings: not all readers know them.
std::string field_data(const Snapshot& s) {
  std::string out = "<FieldData>\n";
  const auto add = [&out](const char* type, const std::string& name, const std::string& value) {
    out += std::string("<DataArray type=\"") + type + "\" Name=\"" + escaped(name) + "\" NumberOfTuples=\"1\" format=\"ascii\">" + value +
           "</DataArray>\n";
  };
  add("Float64", "TimeValue", shortest_text(s.time));
  for (std::size_t i = 0; i < s.type_names.size(); ++i) add("Int32", "type " + s.type_names[i], std::to_string(i));
  for (std::size_t i = 0; i < kBodyNames.size(); ++i) add("Int32", std::string("body ") + kBodyNames[i], std::to_string(i));
  for (std::size_t i = 0; i < kPhaseNames.size(); ++i) add("Int32", std::string("phase ") + kPhaseNames[i], std::to_string(i));
  return out + "</FieldData>\n";
}

std::string with_unit(const std::string& name, const std::string& unit) { return unit == "1" ? name : name + " [" + unit + ']'; }

/// All numbers of the cells with these indices, one array each; concentrations by the names of the fields.
std::string cell_arrays(const Snapshot& s, const std::vector<std::uint32_t>& cell_of_item) {
  std::string out;
  for_each_snapshot_column([&](const std::string& name, const std::string& units, const char*, auto member) {
    using Value = std::remove_cvref_t<decltype(s.cells.front().*member)>;
    std::vector<Value> column;
    for (const std::uint32_t c : cell_of_item) column.push_back(s.cells[c].*member);
    const std::string label = name == "id" ? "cell_id" : name;
    out += data_array(with_unit(label, units), column);
  });
  for (const Snapshot::Variable& variable : s.variables) {
    std::vector<double> column;
    for (const std::uint32_t c : cell_of_item) column.push_back(variable.values[c]);
    out += data_array(with_unit(title_of(variable), variable.unit), column);
  }
  return out;
}

struct Mesh {
  std::vector<Vec3d> points;
  std::vector<std::int64_t> connectivity, offsets;
  std::vector<std::uint8_t> types;
};

std::string mesh_file(const Snapshot& s, const Mesh& mesh, const std::string& point_data, const std::string& cell_data) {
  return file_head("UnstructuredGrid") + "<UnstructuredGrid>\n" + field_data(s) + "<Piece NumberOfPoints=\"" +
         std::to_string(mesh.points.size()) + "\" NumberOfCells=\"" + std::to_string(mesh.types.size()) + "\">\n<PointData>\n" +
         point_data + "</PointData>\n<CellData>\n" + cell_data + "</CellData>\n<Points>\n" + data_array("Points", mesh.points) +
         "</Points>\n<Cells>\n" + data_array("connectivity", mesh.connectivity) + data_array("offsets", mesh.offsets) +
         data_array("types", mesh.types) + "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

/// The triangles of these surfaces, and which cell each belongs to.
Mesh triangles(const Snapshot& s, const std::vector<Snapshot::Shell>& shells, const std::vector<Vec3d>& nodes,
               std::vector<std::uint32_t>& cell_of_face) {
  constexpr std::uint8_t kTriangle = 5;  // VTK_TRIANGLE
  Mesh mesh;
  mesh.points = nodes;
  for (const Snapshot::Shell& shell : shells)
    for (const Triangle& face : s.topologies[shell.topology]) {
      for (const std::uint32_t node : face) mesh.connectivity.push_back(std::int64_t{shell.first_node} + node);
      mesh.offsets.push_back(static_cast<std::int64_t>(mesh.connectivity.size()));
      mesh.types.push_back(kTriangle);
      cell_of_face.push_back(shell.cell);
    }
  return mesh;
}

std::string shells_file(const Snapshot& s) {
  std::vector<std::uint32_t> cell_of_face;
  const Mesh mesh = triangles(s, s.shells, s.nodes, cell_of_face);
  std::string marks;
  for (std::size_t bit = 0; bit < s.mark_names.size(); ++bit) {
    std::vector<std::uint8_t> column;
    for (std::size_t face = 0; face < s.marks().size(); ++face) column.push_back(s.marks().has(face, static_cast<int>(bit)));
    marks += data_array("mark " + s.mark_names[bit], column);
  }
  return mesh_file(s, mesh, "", cell_arrays(s, cell_of_face) + marks);
}

std::string spheres_file(const Snapshot& s) {
  constexpr std::uint8_t kVertex = 1;  // VTK_VERTEX
  Mesh mesh;
  std::vector<std::uint32_t> cell_of_point;
  for (std::size_t c = 0; c < s.cells.size(); ++c) {
    if (s.cells[c].body != BodyKind::kSphere) continue;
    mesh.connectivity.push_back(static_cast<std::int64_t>(mesh.points.size()));
    mesh.points.push_back(s.cells[c].centroid);
    mesh.offsets.push_back(static_cast<std::int64_t>(mesh.points.size()));
    mesh.types.push_back(kVertex);
    cell_of_point.push_back(static_cast<std::uint32_t>(c));
  }
  return mesh_file(s, mesh, cell_arrays(s, cell_of_point), "");
}

/// Centres and radii of nuclei: glyphs of spheres.
std::string nuclei_file(const Snapshot& s) {
  constexpr std::uint8_t kVertex = 1;  // VTK_VERTEX
  Mesh mesh;
  std::vector<double> radius;
  std::vector<std::uint64_t> id;
  for (const Snapshot::Nucleus& nucleus : s.nuclei) {
    mesh.connectivity.push_back(static_cast<std::int64_t>(mesh.points.size()));
    mesh.points.push_back(nucleus.center);
    mesh.offsets.push_back(static_cast<std::int64_t>(mesh.points.size()));
    mesh.types.push_back(kVertex);
    radius.push_back(nucleus.radius);
    id.push_back(s.cells[nucleus.cell].id.bits());
  }
  return mesh_file(s, mesh, data_array("cell_id", id) + data_array("radius [um]", radius), "");
}

/// Nuclei that are shells, with the numbers of their cells.
std::string nuclear_shells_file(const Snapshot& s) {
  std::vector<std::uint32_t> cell_of_face;
  const Mesh mesh = triangles(s, s.nuclear_shells, s.nuclear_nodes, cell_of_face);
  return mesh_file(s, mesh, "", cell_arrays(s, cell_of_face));
}

/// The surfaces of obstacles and walls where they are, each face with the number of its obstacle.
std::string obstacles_file(const Snapshot& s) {
  constexpr std::uint8_t kTriangle = 5;  // VTK_TRIANGLE
  Mesh mesh;
  std::vector<std::int32_t> number;
  for (std::size_t i = 0; i < s.obstacles.size(); ++i) {
    const auto first = static_cast<std::int64_t>(mesh.points.size());
    for (const Vec3d& p : s.obstacles[i].position) mesh.points.push_back(p + s.obstacles[i].offset);
    for (const Triangle& face : s.obstacles[i].faces) {
      for (const std::uint32_t node : face) mesh.connectivity.push_back(first + node);
      mesh.offsets.push_back(static_cast<std::int64_t>(mesh.connectivity.size()));
      mesh.types.push_back(kTriangle);
      number.push_back(static_cast<std::int32_t>(i));
    }
  }
  return mesh_file(s, mesh, "", data_array("obstacle", number));
}

std::string grid_file(const Snapshot& s, const Snapshot::Grid& grid) {
  std::string extent, origin, spacing;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const char* gap = axis == 0 ? "" : " ";
    extent += gap + ("0 " + std::to_string(grid.voxels[axis]));
    origin += gap + shortest_text(grid.low[axis]);
    spacing += gap + shortest_text(grid.spacing[axis]);
  }
  return file_head("ImageData") + "<ImageData WholeExtent=\"" + extent + "\" Origin=\"" + origin + "\" Spacing=\"" + spacing + "\">\n" +
         field_data(s) + "<Piece Extent=\"" + extent + "\">\n<PointData>\n</PointData>\n<CellData>\n" +
         data_array(grid.name + " [mM]", grid.concentration) + "</CellData>\n</Piece>\n</ImageData>\n</VTKFile>\n";
}

std::string numbered(const std::string& stem, std::size_t number, const char* suffix) {
  char text[32];
  std::snprintf(text, sizeof text, "_%06zu", number);
  return stem + text + suffix;
}

Status write_collection(const fs::path& folder, const std::string& stem, const char* suffix, const std::vector<std::size_t>& numbers,
                        const std::vector<double>& times) {
  std::string text = file_head("Collection") + "<Collection>\n";
  for (std::size_t i = 0; i < numbers.size(); ++i)
    text += "<DataSet timestep=\"" + shortest_text(times[i]) + "\" group=\"\" part=\"0\" file=\"" +
            escaped(numbered(stem, numbers[i], suffix)) + "\"/>\n";
  return write_file_atomically(folder / (stem + ".pvd"), text + "</Collection>\n</VTKFile>\n");
}

}  // namespace

std::string base64(std::span<const std::byte> bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < count; ++k) group |= std::to_integer<std::uint32_t>(bytes[i + k]) << (16 - 8 * k);
    for (std::size_t k = 0; k < 4; ++k) out += k <= count ? kDigits[(group >> (18 - 6 * k)) & 63] : '=';
  }
  return out;
}

Status write_vtk(const Snapshot& snapshot, const fs::path& folder, std::size_t number) {
  MORULA_TRY(make_folder(folder));
  MORULA_TRY(write_file_atomically(folder / numbered("shells", number, ".vtu"), shells_file(snapshot)));
  MORULA_TRY(write_file_atomically(folder / numbered("spheres", number, ".vtu"), spheres_file(snapshot)));
  if (!snapshot.nuclei.empty()) MORULA_TRY(write_file_atomically(folder / numbered("nuclei", number, ".vtu"), nuclei_file(snapshot)));
  if (!snapshot.nuclear_shells.empty())
    MORULA_TRY(write_file_atomically(folder / numbered("nuclear_shells", number, ".vtu"), nuclear_shells_file(snapshot)));
  if (!snapshot.obstacles.empty())
    MORULA_TRY(write_file_atomically(folder / numbered("obstacles", number, ".vtu"), obstacles_file(snapshot)));
  for (const Snapshot::Grid& grid : snapshot.fields)
    MORULA_TRY(write_file_atomically(folder / numbered("field_" + grid.name, number, ".vti"), grid_file(snapshot, grid)));
  return {};
}

Status write_vtk_collections(const fs::path& folder, const std::vector<std::size_t>& numbers, const std::vector<double>& times,
                             const std::vector<std::string>& field_names) {
  MORULA_TRY(write_collection(folder, "shells", ".vtu", numbers, times));
  MORULA_TRY(write_collection(folder, "spheres", ".vtu", numbers, times));
  for (const char* stem : {"nuclei", "nuclear_shells", "obstacles"}) {
    std::vector<std::size_t> written;
    std::vector<double> when;
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (fs::exists(folder / numbered(stem, numbers[i], ".vtu"))) written.push_back(numbers[i]), when.push_back(times[i]);
    if (!written.empty()) MORULA_TRY(write_collection(folder, stem, ".vtu", written, when));
  }
  for (const std::string& name : field_names) MORULA_TRY(write_collection(folder, "field_" + name, ".vti", numbers, times));
  return {};
}

}  // namespace morula::scenarios
