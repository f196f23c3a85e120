#include <algorithm>
#include <cmath>

#include "core/mesh/closest_point.h"
#include "core/mesh/mesh_check.h"
#include "core/mesh/remesh.h"
#include "core/mesh/surface_bytes.h"
#include "core/mesh/surface_overlap.h"
#include "core/mesh/topology.h"
#include "core/space/space.h"
#include "dcm/interior.h"
#include "study/build.h"
#include "study/build_meshes.h"
#include "study/initial/cells_from_meshes.h"
#include "study/input_file.h"
#include "study/read_section.h"

namespace morula::scenarios {
namespace {

class MeshesBuilder {
 public:
  MeshesBuilder(BuildContext& context, draft::Initial& draft, const Place& place, InitialCells& cells)
      : c_(context), d_(draft.meshes), entry_(draft), place_(place), cells_(cells), spec_(cells.meshes) {}

  void build() {
    cells_.source = InitialCells::Source::kMeshes;
    cells_.body_given = true;
    cells_.body = BodyKind::kShell;
    cells_.orientation = Orientation::kAligned;  // as in the file
    const std::size_t before = c_.diagnostics.error_count();
    refuse_contradictions();
    take_settings();
    take_files();
    take_types();
    if (c_.diagnostics.error_count() > before || !d_.scale.known()) return;
    read();
  }

 private:
  void error(int code, const Place& place, std::string text, std::string help) {
    c_.diagnostics.error(code, place, std::move(text), std::move(help));
  }
  void refuse_contradictions();
  void take_settings();
  void take_files();
  void take_types();
  void read();
  void note_remeshing(std::span<const TriangleMesh> meshes, std::size_t nodes, double shortest, double longest, double changed);
  void check_edge(const Given<double>& range, double shortest, double longest);
  void check_nucleus(const MeshCell& cell, const TriangleMesh& surface, const Place& at);

  BuildContext& c_;
  draft::Meshes& d_;
  draft::Initial& entry_;
  Place place_;
  InitialCells& cells_;
  MeshCells& spec_;
};

void MeshesBuilder::refuse_contradictions() {
  if (entry_.body.known() && entry_.body.value != "shell")
    error(111, entry_.body.place, "cells from meshes are shells", "leave `as` away; a region can make them spheres later");
  if (entry_.start_volume.given)
    error(111, entry_.start_volume.place, "'start_volume' has no meaning with `meshes`: a cell has the volume of its surface",
          "leave it away");
  for (const Given<std::string>* key : {&entry_.shape, &entry_.orientation})
    if (key->given) error(111, key->place, "cells from meshes have a shape and an orientation of their own", "leave the key away");
  for (std::string* text : {&entry_.start_volume.text, &entry_.inflate.text, &entry_.shape.text, &entry_.orientation.text}) text->clear();
  if (d_.nodes.value > 0 && d_.edge.given)
    error(111, d_.edge.place, "'edge' and 'nodes' both say how fine the cells are", "leave one of them away");
  if (!has_remesher() && (d_.nodes.value > 0 || d_.edge.given))
    error(691, d_.edge.given ? d_.edge.place : d_.nodes.place,
          "this program cannot remesh cells: it was built without CGAL's mesh processing, which is under the GPL",
          "leave the key away (the nodes of the file are kept), or build with MORULA_WITH_GPL=ON");
  if (d_.cell_is.given && d_.id_array.given)
    error(111, d_.cell_is.place, "'cell_is' and 'id_array' both say what one cell is", "leave one of them away");
  if (d_.pressure_array.given != d_.pressure_unit.given)
    error(d_.pressure_unit.given ? 111 : 201, d_.pressure_unit.given ? d_.pressure_unit.place : d_.pressure_array.place,
          "'pressure_array' and 'pressure_unit' belong together", "for example `pressure_array: cell_pressure, pressure_unit: 1 Pa`");
  if (d_.type_array.given && !d_.types.given)
    error(103, d_.type_array.place, "'type_array' needs `types`", "name the cell types 0, 1, 2, ... of the array");
}

void MeshesBuilder::take_settings() {
  using CellIs = MeshCells::CellIs;
  spec_.scale = d_.scale.value;
  const std::string& word = d_.cell_is.value;
  spec_.cell_is = d_.id_array.given     ? CellIs::kArray
                  : word == "part"      ? CellIs::kPart
                  : word == "component" ? CellIs::kComponent
                  : word == "file"      ? CellIs::kFile
                                        : CellIs::kAuto;
  if (d_.id_array.given) d_.cell_is.text.clear();
  spec_.id_array = d_.id_array.value;
  spec_.type_array = d_.type_array.value;
  spec_.pressure_array = d_.pressure_array.value;
  spec_.pressure_unit = d_.pressure_unit.value;
  spec_.nodes = static_cast<std::uint32_t>(d_.nodes.value);
  spec_.edge = d_.edge.value;
  spec_.repair = d_.repair.value;
  spec_.overlap = d_.overlap.value;
  spec_.has_center = d_.center.known();
  spec_.center = d_.center.value;
}

/// The files, as they are there; the resolved study names their copies.
void MeshesBuilder::take_files() {
  if (d_.file.given == d_.files.given || (d_.files.given && d_.files.value.empty()))
    return error(111, d_.file.given ? d_.file.place : place_, "`meshes` needs either `file` or `files`", "for example `file: embryo.vtk`");
  std::vector<Given<std::string>> files;
  if (d_.file.given) files.push_back(d_.file);
  for (const std::string& name : d_.files.value) files.push_back({name, name, d_.files.place, true});
  std::string copies;
  for (Given<std::string>& file : files) {
    const std::string shown = file.value;
    const std::string path = add_input_file(c_, file);
    copies += (copies.empty() ? "" : ", ") + yaml_scalar(file.text);
    check_input_file(path, shown, kMaxSurfaceBytes, file.place, c_.diagnostics);
    spec_.path.push_back(path);
    spec_.shown.push_back(shown);
  }
  if (d_.file.given) {
    d_.file.text = files.front().text;
    d_.files.text.clear();
  } else {
    d_.files.text = "[" + copies + "]";
  }
}

void MeshesBuilder::take_types() {
  if (!d_.types.given) {
    d_.types.text.clear();
    if (!entry_.type.given)
      error(103, place_, "key 'type' is missing in an entry of `initial`", "name one of the cell types, or a list: `meshes.types`");
    return;
  }
  if (entry_.type.given)
    error(111, entry_.type.place, "'type' and 'meshes.types' both say the type of the cells", "leave one of them away");
  for (const std::string& name : d_.types.value)
    if (const int type = find_type(c_, name, d_.types.place); type >= 0) spec_.types.push_back(static_cast<std::uint16_t>(type));
}

void MeshesBuilder::read() {
  const Place& at = d_.file.given ? d_.file.place : d_.files.place;
  MeshCellsRead read = read_mesh_cells(spec_, cells_.type, true);
  for (std::string& note : read.notes) c_.study.notes.push_back(std::move(note));
  for (MeshCellProblem& problem : read.problems) error(problem.code, at, std::move(problem.text), std::move(problem.help));
  if (!read.problems.empty()) return;
  cells_.count = read.cells.size();
  double shortest = 1e300, longest = 0.0, changed = 0.0;
  std::size_t nodes = 0;
  std::vector<TriangleMesh> meshes;
  for (const MeshCell& cell : read.cells) {
    const auto surface = cell_surface(cell, spec_);
    if (!surface.ok()) {
      error(548, d_.edge.given ? d_.edge.place : d_.nodes.place, surface.error().message, surface.error().help);
      return;
    }
    shortest = std::min(shortest, surface->mean_edge);
    longest = std::max(longest, surface->mean_edge);
    changed = std::max(changed, std::abs(surface->volume_error));
    nodes += surface->mesh.position.size();
    Box box;
    for (const Vec3d& p : surface->mesh.position) box.include(p);
    const Box& domain = c_.study.model.space.box;
    if (c_.draft.domain.size.known() && !(domain.contains(box.low) && domain.contains(box.high)))
      error(505, at, cell.name + " reaches out of the domain: from " + text_of_place(box.low) + " to " + text_of_place(box.high),
            "the domain reaches from " + text_of_place(domain.low) + " to " + text_of_place(domain.high) +
                "; `meshes.center` can move the cells");
    check_nucleus(cell, surface->mesh, at);
    meshes.push_back(std::move(surface->mesh));
  }
  if (spec_.remeshes()) note_remeshing(meshes, nodes, shortest, longest, changed);
  check_edge(c_.draft.contact.range, shortest, longest);
  for (const auto& pair : c_.draft.contact.pairs) {
    const auto& names = pair.content.between.value;
    const auto is_here = [&](const std::string& name) {
      return std::any_of(read.cells.begin(), read.cells.end(),
                         [&](const MeshCell& cell) { return c_.draft.cell_types[cell.type].name == name; });
    };
    if (pair.content.range.given && std::any_of(names.begin(), names.end(), is_here)) check_edge(pair.content.range, shortest, longest);
  }
}

void MeshesBuilder::note_remeshing(std::span<const TriangleMesh> meshes, std::size_t nodes, double shortest, double longest,
                                   double changed) {
  double deepest = 0.0;
  for (const SurfaceOverlap& overlap : find_overlaps(meshes)) deepest = std::max(deepest, overlap.depth);
  c_.study.notes.push_back(std::to_string(meshes.size()) + " cells remeshed to " + std::to_string(nodes) + " nodes in all, mean edges of " +
                           short_number(std::round(shortest * 100) / 100) + " to " + short_number(std::round(longest * 100) / 100) +
                           " um; the new triangles changed volumes by up to " + short_number(std::round(changed * 1e4) / 100) +
                           " %, which was given back; deepest overlap then: " + short_number(std::round(deepest * 1000) / 1000) + " um");
}

/// As for the shells of a type (E503), with the edges that these cells have.
void MeshesBuilder::check_edge(const Given<double>& range, double shortest, double longest) {
  if (!range.known()) return;
  const bool too_long = range.value > 0.56 * shortest, too_short = range.value < 0.25 * longest;
  if (!too_long && !too_short) return;
  const double edge = too_long ? shortest : longest;
  const Place at = range.given ? range.place : d_.edge.given ? d_.edge.place : d_.nodes.given ? d_.nodes.place : place_;
  const std::string what = "the contact range (" + range.text + ") is " + (too_long ? "more than half" : "less than a quarter") +
                           " of the mean edge (" + short_number(std::round(edge * 100) / 100) + " um) of a cell from a mesh";
  const std::string help = "a contact range between " + short_number(std::ceil(longest * 25) / 100) + " um and " +
                           short_number(std::floor(shortest * 50) / 100) + " um fits these cells; or remesh them";
  if (too_long)
    error(503, at, what, help);
  else
    c_.diagnostics.warning(503, at, what, help);
}

/// A nucleus begins at the centroid, where its links are at rest: the ball must lie inside the surface there.
void MeshesBuilder::check_nucleus(const MeshCell& cell, const TriangleMesh& surface, const Place& at) {
  const auto& types = c_.draft.cell_types;
  const auto is_this = [&](const auto& type) { return type.name == entry_.type.value; };
  if (!d_.types.given && std::none_of(types.begin(), types.end(), is_this)) return;  // told already
  const dcm::InteriorParameters& interior = c_.study.model.types[cell.type].interior;
  if (!interior.has_nucleus()) return;
  const Vec3d center = volume_centroid(surface.faces, surface.position);
  double room = std::lround(winding_number(surface.position, surface.faces, center)) == 1 ? 1e300 : 0.0;
  for (const Triangle& t : surface.faces) {
    const Vec3d foot = closest_point_on_triangle(center, surface.position[t[0]], surface.position[t[1]], surface.position[t[2]]).point;
    room = std::min(room, norm(foot - center));
  }
  const double radius = dcm::nucleus_radius(interior, cell.volume);
  if (room >= radius) return;
  error(593, at,
        cell.name + " has no room for its nucleus of radius " + short_number(std::round(radius * 100) / 100) + " um at its centroid " +
            text_of_place(center) + ", which is " +
            (room > 0.0 ? short_number(std::floor(room * 100) / 100) + " um from its surface" : "outside"),
        "a smaller `volume_fraction` of the nucleus, or `nucleus: {kind: none}` for a type of such cells");
}

}  // namespace

void build_meshes(BuildContext& context, draft::Initial& draft, const Place& place, InitialCells& cells) {
  MeshesBuilder(context, draft, place, cells).build();
}

bool only_from_meshes(const Study& study, std::size_t type) {
  if (study.model.swaps.any()) return false;
  bool from_meshes = false;
  for (const InitialCells& cells : study.initial) {
    const bool own = cells.source == InitialCells::Source::kMeshes, here = cells.may_have(type);
    if (here && !own) return false;
    from_meshes = from_meshes || here;
  }
  return from_meshes;
}

}  // namespace morula::scenarios
