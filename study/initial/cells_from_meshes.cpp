#include "study/initial/cells_from_meshes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/ball.h"
#include "core/mesh/mesh_check.h"
#include "core/mesh/mesh_repair.h"
#include "core/mesh/node_order.h"
#include "core/mesh/remesh.h"
#include "core/mesh/split_mesh.h"
#include "core/mesh/surface_file.h"
#include "core/mesh/surface_overlap.h"
#include "core/mesh/topology.h"
#include "core/mesh/weld_nodes.h"
#include "core/space/space.h"
#include "dcm/growth.h"
#include "study/mesh_problem_codes.h"

namespace morula::scenarios {
namespace {

using CellIs = MeshCells::CellIs;

constexpr double kWeld = 1e-6;                                    // of the diagonal: STL rounds to single precision
constexpr double kSmallestRadius = 0.1, kLargestRadius = 1000.0;  // of a cell [µm]: beyond, the scale must be wrong
constexpr std::size_t kMostNodes = 15000;                         // of a cell: lists of contacts count the faces near it in 15 bits
constexpr const char* kMend = "mend the surface, for example in MeshLab or Blender";

std::string text_of(double value, const char* format = "%.6g") {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}
TriangleMesh welded(const TriangleMesh& mesh) {
  Box box;
  for (const Vec3d& p : mesh.position) box.include(p);
  return with_welded_nodes(mesh, kWeld * norm(box.size()));
}

/// Cells of one file; the places of its faces and nodes lead back to the file's arrays.
struct FileCells {
  LabelledMesh file;
  std::vector<SplitSurface> cells;
  bool by_id = false;
  std::vector<double> type_value, pressure_value;  ///< by face; empty where the study names no such array
};

class MeshCellReader {
 public:
  MeshCellReader(const MeshCells& spec, std::uint16_t type, bool judge) : spec_(spec), type_(type), judge_(judge) {}

  MeshCellsRead run() {
    for (std::size_t f = 0; f < spec_.path.size(); ++f) read_file(f);
    if (out_.cells.empty() && out_.problems.empty()) problem(547, "the files hold no cells", "every cell is a closed surface");
    check_type_count();
    if (out_.problems.empty() && spec_.has_center) move_to_center();
    if (out_.problems.empty() && judge_) check_overlaps();
    return std::move(out_);
  }

 private:
  void problem(int code, std::string text, std::string help) { out_.problems.push_back({code, std::move(text), std::move(help)}); }
  void read_file(std::size_t number);
  bool split(const std::string& shown, FileCells& file);
  [[nodiscard]] const MeshArray* find_array(const std::string& shown, const LabelledMesh& file, const std::string& name, bool& of_points);
  [[nodiscard]] std::optional<std::vector<double>> by_face(const std::string& shown, const LabelledMesh& file,
                                                           const std::string& array_name);
  [[nodiscard]] std::optional<double> value_of(const std::string& cell, const SplitSurface& surface, const std::string& array_name,
                                               const std::vector<double>& by_face);
  void add_cell(const std::string& name, const FileCells& file, const SplitSurface& surface);
  bool mend_and_check(MeshCell& cell);
  void check_size(const MeshCell& cell);
  void check_type_count();
  void move_to_center();
  void check_overlaps();

  const MeshCells& spec_;
  std::uint16_t type_;
  bool judge_;
  MeshCellsRead out_;
};

void MeshCellReader::read_file(std::size_t number) {
  const std::string& shown = spec_.shown[number];
  FileCells file;
  auto read = read_labelled_mesh(spec_.path[number], spec_.scale);
  if (!read.ok()) return problem(620, read.error().message, read.error().help);
  file.file = std::move(read).value();
  if (!split(shown, file)) return;
  for (const auto& [array, values] :
       {std::pair(&spec_.type_array, &file.type_value), std::pair(&spec_.pressure_array, &file.pressure_value)}) {
    if (array->empty()) continue;
    auto found = by_face(shown, file.file, *array);
    if (!found) return;
    *values = std::move(*found);
  }
  for (std::size_t c = 0; c < file.cells.size(); ++c) {
    std::string name = shown;
    if (file.cells.size() > 1 || file.by_id) name += ", cell " + std::to_string(c);
    if (file.by_id) name += " (" + spec_.id_array + " " + text_of(file.cells[c].label) + ")";
    add_cell(name, file, file.cells[c]);
  }
}

const MeshArray* MeshCellReader::find_array(const std::string& shown, const LabelledMesh& file, const std::string& name, bool& of_points) {
  const auto in = [&](const std::vector<MeshArray>& arrays) {
    const auto found = std::find_if(arrays.begin(), arrays.end(), [&](const MeshArray& a) { return a.name == name; });
    return found == arrays.end() ? nullptr : &*found;
  };
  const MeshArray* array = in(file.part_arrays);
  of_points = array == nullptr;
  if (!array) array = in(file.point_arrays);
  if (!array) {
    std::string known;
    for (const auto* arrays : {&file.part_arrays, &file.point_arrays})
      for (const MeshArray& a : *arrays) known += (known.empty() ? "" : ", ") + std::string("`") + a.name + "`";
    problem(545, "'" + shown + "' has no array '" + name + "'",
            known.empty() ? "it has no arrays at all; STL and OBJ cannot have them" : "it has " + known);
    return nullptr;
  }
  if (array->components != 1) {
    problem(545, "array '" + name + "' of '" + shown + "' has " + std::to_string(array->components) + " components",
            "one number a cell is needed");
    return nullptr;
  }
  return array;
}

/// The number that an array gives to every face: that of its part, or of all its points.
std::optional<std::vector<double>> MeshCellReader::by_face(const std::string& shown, const LabelledMesh& file,
                                                           const std::string& array_name) {
  bool of_points = false;
  const MeshArray* array = find_array(shown, file, array_name, of_points);
  if (!array) return std::nullopt;
  std::vector<double> out;
  for (std::size_t f = 0; f < file.mesh.faces.size(); ++f) {
    const Triangle& nodes = file.mesh.faces[f];
    out.push_back(array->values[of_points ? nodes[0] : file.part[f]]);
    const bool differs = of_points && (array->values[nodes[1]] != out.back() || array->values[nodes[2]] != out.back());
    if (std::isfinite(out.back()) && !differs) continue;
    problem(545,
            "array '" + array_name + "' of '" + shown + "' has " +
                (differs ? "different values at the points of face " + std::to_string(f)
                         : "a value that is not finite, at face " + std::to_string(f)),
            "every face needs one finite number");
    return std::nullopt;
  }
  return out;
}

bool MeshCellReader::split(const std::string& shown, FileCells& file) {
  LabelledMesh& f = file.file;
  const auto closed_parts = std::count(f.is_closed.begin(), f.is_closed.end(), 1);
  CellIs how = spec_.cell_is;
  if (how == CellIs::kAuto) how = closed_parts > 1 ? CellIs::kPart : CellIs::kComponent;
  if (how == CellIs::kPart && closed_parts == 0) {
    problem(547, "the parts of '" + shown + "' are single polygons, which enclose nothing",
            "write `cell_is: component`, or name an `id_array`");
    return false;
  }
  std::vector<double> label;
  switch (how) {
    case CellIs::kArray: {
      auto ids = by_face(shown, f, spec_.id_array);
      if (!ids) return false;
      label = std::move(*ids);
      file.by_id = true;
      break;
    }
    case CellIs::kPart:
      label.assign(f.part.begin(), f.part.end());
      break;
    case CellIs::kFile:
      label.assign(f.mesh.faces.size(), 0.0);
      break;
    case CellIs::kAuto:
    case CellIs::kComponent: {
      // Where faces repeat their nodes, or hang together in less than a tetrahedron, nodes at the same place are one.
      constexpr std::size_t kFewestFaces = 4;
      if (f.has_indices) label = components_of_faces(f.mesh);
      const double most = label.empty() ? 1e300 : *std::max_element(label.begin(), label.end()) + 1.0;
      if (most * kFewestFaces > static_cast<double>(f.mesh.faces.size())) label = components_of_faces(welded(f.mesh));
      break;
    }
  }
  file.cells = split_by_label(f.mesh, label);
  return true;
}

/// The number that all faces of a cell have in common.
std::optional<double> MeshCellReader::value_of(const std::string& cell, const SplitSurface& surface, const std::string& array_name,
                                               const std::vector<double>& by_face) {
  const double value = by_face[surface.face.front()];
  for (const std::uint32_t f : surface.face)
    if (by_face[f] != value) {
      problem(545, "array '" + array_name + "' has the values " + text_of(value) + " and " + text_of(by_face[f]) + " in one cell: " + cell,
              "a cell has one value");
      return std::nullopt;
    }
  return value;
}

void MeshCellReader::add_cell(const std::string& name, const FileCells& file, const SplitSurface& surface) {
  MeshCell cell;
  cell.name = name;
  cell.mesh = file.file.has_indices ? surface.mesh : welded(surface.mesh);
  cell.type = type_;
  if (!spec_.type_array.empty()) {
    const auto value = value_of(name, surface, spec_.type_array, file.type_value);
    if (!value) return;
    const auto count = static_cast<double>(spec_.types.size());
    if (!(*value >= 0.0 && *value < count && *value == std::floor(*value)))
      return problem(549,
                     "array '" + spec_.type_array + "' gives the type number " + text_of(*value) + " to a cell (" + name +
                         "), and `types` has " + std::to_string(spec_.types.size()) + " names",
                     "`types` names the cell types 0, 1, 2, ... of that array");
    cell.type = spec_.types[static_cast<std::size_t>(*value)];
  } else if (!spec_.types.empty() && out_.cells.size() < spec_.types.size()) {
    cell.type = spec_.types[out_.cells.size()];
  }
  if (!spec_.pressure_array.empty()) {
    const auto value = value_of(name, surface, spec_.pressure_array, file.pressure_value);
    if (!value) return;
    cell.pressure = *value * spec_.pressure_unit;
  }
  if (mend_and_check(cell)) check_size(cell);
  out_.cells.push_back(std::move(cell));
}

/// False where the surface is none that encloses a cell.
bool MeshCellReader::mend_and_check(MeshCell& cell) {
  if (spec_.repair) {
    MeshRepair mended = repair_mesh(cell.mesh);
    for (const std::string& repair : mended.repairs) out_.notes.push_back(cell.name + ": " + repair);
    cell.mesh = std::move(mended.mesh);
  }
  MeshExpectation expectation;
  expectation.no_self_intersection = judge_;
  expectation.most_of_a_kind = 3;
  bool sound = true;
  for (const MeshProblem& found : check_mesh(cell.mesh.position, cell.mesh.faces, expectation)) {
    if (found.kind == MeshProblemKind::kSelfIntersection && spec_.remeshes()) {
      out_.notes.push_back(cell.name + ": " + found.message + "; to be smoothed by the remeshing");
      continue;
    }
    const bool mendable = !spec_.repair && (found.kind == MeshProblemKind::kFlippedFaces || found.kind == MeshProblemKind::kInsideOut ||
                                            found.kind == MeshProblemKind::kDegenerateFace ||
                                            found.kind == MeshProblemKind::kDuplicateFace || found.kind == MeshProblemKind::kUnusedNode);
    const bool smooth = found.kind == MeshProblemKind::kSelfIntersection;
    problem(code_of(found.kind), cell.name + ": " + found.message,
            mendable ? "leave `repair: false` away"
            : smooth ? "remesh it (`nodes` or `edge`), or mend the surface"
                     : kMend);
    sound = false;
  }
  if (!sound) return false;
  const std::vector<double> component = components_of_faces(cell.mesh);
  if (const double count = *std::max_element(component.begin(), component.end()) + 1.0; count > 1.0) {
    problem(547, cell.name + " consists of " + text_of(count) + " separate surfaces", "write `cell_is: component`, or leave cavities away");
    return false;
  }
  cell.volume = enclosed_volume(cell.mesh.faces, cell.mesh.position, volume_centroid(cell.mesh.faces, cell.mesh.position));
  return true;
}

void MeshCellReader::check_size(const MeshCell& cell) {
  const double radius = ball_radius(cell.volume);
  if (radius >= kSmallestRadius && radius <= kLargestRadius) return;
  problem(550, cell.name + " has the volume of a ball of radius " + text_of(radius, "%.3g") + " um, which is no cell",
          "check `scale`: the length that 1 in the file stands for");
}

void MeshCellReader::check_type_count() {
  if (!out_.problems.empty() || spec_.types.empty() || !spec_.type_array.empty() || spec_.types.size() == out_.cells.size()) return;
  problem(
      549,
      "`types` names " + std::to_string(spec_.types.size()) + " cell types, and there are " + std::to_string(out_.cells.size()) + " cells",
      "name one type for each cell, or give `type_array`");
}

void MeshCellReader::move_to_center() {
  Vec3d moment;
  double volume = 0.0;
  for (const MeshCell& cell : out_.cells) {
    moment += volume_centroid(cell.mesh.faces, cell.mesh.position) * cell.volume;
    volume += cell.volume;
  }
  const Vec3d shift = spec_.center - moment / volume;
  for (MeshCell& cell : out_.cells)
    for (Vec3d& p : cell.mesh.position) p += shift;
}

void MeshCellReader::check_overlaps() {
  constexpr std::size_t kMostNamed = 10;
  std::vector<TriangleMesh> meshes;
  for (const MeshCell& cell : out_.cells) meshes.push_back(cell.mesh);
  std::size_t too_deep = 0;
  const SurfaceOverlap* deepest = nullptr;
  const std::vector<SurfaceOverlap> overlaps = find_overlaps(meshes);
  const auto named = [&](const SurfaceOverlap& o) {
    return out_.cells[o.a].name + " reaches " + text_of(o.depth, "%.3g") + " um into " + out_.cells[o.b].name + ", at " +
           text_of_place(o.place) + ", through face " + std::to_string(o.face);
  };
  for (const SurfaceOverlap& o : overlaps) {
    if (!deepest || o.depth > deepest->depth) deepest = &o;
    if (o.depth > spec_.overlap && ++too_deep <= kMostNamed)
      problem(546, named(o),
              "at most " + text_of(spec_.overlap) + " um of overlap may be left to the contact law: `overlap`, or move the surfaces");
  }
  if (too_deep > kMostNamed)
    problem(546, std::to_string(too_deep - kMostNamed) + " more overlaps of cells are too deep", "mend the surfaces");
  if (too_deep == 0 && deepest)
    out_.notes.push_back("deepest overlap at the start: " + named(*deepest) + "; the contact law will push it apart");
}

}  // namespace

MeshCellsRead read_mesh_cells(const MeshCells& spec, std::uint16_t type, bool judge) { return MeshCellReader(spec, type, judge).run(); }

namespace {

Error too_many_nodes(const MeshCell& cell, double nodes) {
  return {ErrorKind::kInput,
          cell.name + " would have " + text_of(nodes, "%.3g") + " nodes, and a cell can have " + std::to_string(kMostNodes),
          "remesh the cells, for example `nodes: 642`"};
}

}  // namespace

Result<CellSurface> cell_surface(const MeshCell& cell, const MeshCells& spec) {
  if (!spec.remeshes()) {
    if (cell.mesh.position.size() > kMostNodes) return too_many_nodes(cell, static_cast<double>(cell.mesh.position.size()));
    TriangleMesh mesh = with_near_neighbour_order(cell.mesh);
    const double edge = mean_edge_length(mesh);
    return CellSurface{std::move(mesh), edge, 0.0};
  }
  const double expected = spec.nodes > 0 ? spec.nodes : nodes_of_edge(surface_area(cell.mesh), spec.edge);
  if (expected > 1.2 * static_cast<double>(kMostNodes)) return too_many_nodes(cell, expected);
  auto made = remesh_surface(cell.mesh, {spec.nodes, spec.edge});
  if (!made.ok()) return Error{made.error().kind, cell.name + ": " + made.error().message, made.error().help};
  if (made->mesh.position.size() > kMostNodes) return too_many_nodes(cell, static_cast<double>(made->mesh.position.size()));
  return CellSurface{std::move(made->mesh), made->mean_edge, made->volume_error};
}

Result<ShellRecord> shell_of_surface(const MeshCell& cell, const MeshCells& spec, double reference_volume, ShapeLibrary& shapes) {
  MORULA_TRY_ASSIGN(CellSurface surface, cell_surface(cell, spec));
  const auto nodes = static_cast<std::uint32_t>(surface.mesh.position.size());
  MORULA_TRY_ASSIGN(const auto topology, Topology::build(nodes, std::move(surface.mesh.faces)));
  auto shape = make_reference_shape(topology, surface.mesh.position);
  if (!shape) return Error{ErrorKind::kInput, cell.name + " encloses no volume", kMend};
  shape = shapes.adopt(std::move(shape));
  ShellRecord shell;
  const double scale = std::cbrt(cell.volume);  // the reference shape encloses 1
  for (const double length : shape->edge_length) shell.rest_length.push_back(length * scale);
  shell.position = std::move(surface.mesh.position);
  shell.velocity.assign(nodes, Vec3f{});
  shell.reference_volume = reference_volume;
  shell.rest_volume = cell.volume;
  shell.shape = std::move(shape);
  return shell;
}

std::string text_of_place(const Vec3d& p) {
  const auto text = [](double value) { return text_of(std::abs(value) < 1e-9 ? 0.0 : value, "%.4g"); };
  return "(" + text(p.x) + ", " + text(p.y) + ", " + text(p.z) + ") um";
}

double target_volume_of(double volume, double pressure, double tension, double bulk_modulus) {
  const double wanted = volume * std::exp(pressure / bulk_modulus);
  double target = wanted;  // Newton on ln V0(t), whose slope is that of ln t but for the small part of the tension
  for (int step = 0; step < 60; ++step) {
    const double next = target * wanted / dcm::pressure_free_reference(target, tension, bulk_modulus);
    const bool done = std::abs(next - target) <= 1e-15 * target;
    target = next;
    if (done) break;
  }
  return target;
}

}  // namespace morula::scenarios
