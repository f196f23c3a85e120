// Aggregates of shells: what their shapes say about their forces, in a run and in the mesh files that it began with.
#include <algorithm>
#include <cmath>

#include "core/mesh/surface_file.h"
#include "core/mesh/topology.h"
#include "core/spiral.h"
#include "scenarios/measures/aggregate_shape.h"
#include "scenarios/measures/measures.h"
#include "study/initial/cells_from_meshes.h"

namespace morula::scenarios {
namespace {

constexpr double kInner = 0.95;   // contact part from which a cell is an inner one
constexpr double kOpenGap = 0.2;  // [µm]
constexpr const char* kSource = "physics/scenarios.md S17";

/// The shells of a type, or all.
std::vector<TriangleMesh> surfaces(const Snapshot& snapshot, const Subject& subject) {
  std::vector<TriangleMesh> out;
  for (const Snapshot::Shell& shell : snapshot.shells) {
    if (!is_meant(snapshot.cells[shell.cell], subject)) continue;
    const auto first = snapshot.nodes.begin() + shell.first_node;
    out.push_back({{first, first + shell.node_count}, snapshot.topologies[shell.topology]});
  }
  return out;
}

/// The mesh files that the cells of a type, or of any, begin with.
const InitialCells* mesh_files_of(const Study& study, const Subject& subject) {
  for (const InitialCells& cells : study.initial)
    if (cells.source == InitialCells::Source::kMeshes && (subject.type < 0 || cells.type == subject.type)) return &cells;
  return nullptr;
}

Status needs_mesh_files(const Study& study, const Subject& subject) {
  return mesh_files_of(study, subject) != nullptr
             ? Status{}
             : Status(Error{ErrorKind::kInput, "needs cells from mesh files (`initial` with `meshes`)", ""});
}

Result<std::vector<MeshCell>> cells_of_files(const Study& study, const Subject& subject) {
  const InitialCells* const initial = mesh_files_of(study, subject);
  if (initial == nullptr) return std::vector<MeshCell>{};
  MeshCellsRead read = read_mesh_cells(initial->meshes, initial->type, false);
  if (!read.problems.empty()) return Error{ErrorKind::kFile, read.problems.front().text, read.problems.front().help};
  return std::move(read.cells);
}

std::vector<TriangleMesh> meshes_of(const std::vector<MeshCell>& cells) {
  std::vector<TriangleMesh> out;
  for (const MeshCell& cell : cells) out.push_back(cell.mesh);
  return out;
}

Measure of_aggregate(const char* name, const char* title, const char* doc, const char* formula, Quantity quantity) {
  return {name, title, doc, formula, kSource, quantity, MeasureOf::kCells};
}

/// A value of all cells together at each moment.
Measure at_moments(const char* name, const char* title, const char* doc, const char* formula, Quantity quantity,
                   double (*value)(const std::vector<TriangleMesh>& cells)) {
  Measure out = of_aggregate(name, title, doc, formula, quantity);
  out.take = by_snapshot([value](const Study&, const Snapshot& snapshot, const Subject& subject) -> std::optional<double> {
    const auto cells = surfaces(snapshot, subject);
    return cells.empty() ? std::nullopt : std::optional(value(cells));
  });
  return out;
}

/// Values of the files, told at time 0: of single cells with their ids, or of all.
Measure of_files(const char* name, const char* title, const char* doc, const char* formula, Quantity quantity,
                 Result<std::vector<Sample>> (*value)(FinishedRun& run, const Subject& subject, const std::vector<MeshCell>& cells)) {
  Measure out = of_aggregate(name, title, doc, formula, quantity);
  out.fits = &needs_mesh_files;
  out.take = [value](FinishedRun& run, const Subject& subject, const Moments&) -> Result<std::vector<Sample>> {
    MORULA_TRY_ASSIGN(const auto cells, cells_of_files(run.study(), subject));
    return value(run, subject, cells);
  };
  return out;
}

std::string id_of(std::size_t number) { return CellId::founder(number + 1).text(); }

Result<std::vector<Sample>> closed_cells(FinishedRun&, const Subject&, const std::vector<MeshCell>& cells) {
  std::size_t closed = 0;
  for (const MeshCell& cell : cells)
    closed += Topology::build(static_cast<std::uint32_t>(cell.mesh.position.size()), cell.mesh.faces).ok() && cell.volume > 0.0;
  return std::vector<Sample>{{0.0, static_cast<double>(closed), ""}};
}

/// Against the array `cell_volume` of the file.
Result<std::vector<Sample>> told_volume_errors(FinishedRun& run, const Subject& subject, const std::vector<MeshCell>& cells) {
  const MeshCells& spec = mesh_files_of(run.study(), subject)->meshes;
  std::vector<Sample> out;
  const auto file = read_labelled_mesh(spec.path.front(), spec.scale);
  if (!file.ok()) return out;
  for (const MeshArray& array : file->part_arrays)
    for (std::size_t c = 0; array.name == "cell_volume" && array.components == 1 && c < std::min(cells.size(), array.values.size()); ++c)
      out.push_back({0.0, std::abs(cells[c].volume / (array.values[c] * std::pow(spec.scale, 3)) - 1.0), id_of(c)});
  return out;
}

Result<std::vector<Sample>> start_volume_errors(FinishedRun& run, const Subject&, const std::vector<MeshCell>& cells) {
  MORULA_TRY_ASSIGN(const auto start, run.start());
  std::vector<Sample> out;
  if (start == nullptr) return out;
  for (std::size_t c = 0; c < std::min(cells.size(), start->cells.size()); ++c)
    out.push_back({0.0, std::abs(start->cells[c].volume / cells[c].volume - 1.0), id_of(c)});
  return out;
}

/// p R/2 of every cell with a free surface and a pressure in the file.
Result<std::vector<Sample>> tensions(FinishedRun&, const Subject&, const std::vector<MeshCell>& cells) {
  const AggregateShape shape = measure_aggregate(meshes_of(cells));
  std::vector<Sample> out;
  for (std::size_t c = 0; c < cells.size(); ++c)
    if (shape.sphere[c] && cells[c].pressure) out.push_back({0.0, 0.5 * *cells[c].pressure * shape.sphere[c]->radius, id_of(c)});
  return out;
}

Result<std::vector<Sample>> angle_of_files(FinishedRun&, const Subject&, const std::vector<MeshCell>& cells) {
  const AggregateShape shape = measure_aggregate(meshes_of(cells));
  return shape.angles.empty() ? std::vector<Sample>{} : std::vector<Sample>{{0.0, shape.mean_angle(), ""}};
}

/// How far the outline is from a ball: standard deviation over mean of the distances from the middle at which it is seen, in each of some
/// even directions the farthest node near it.
double roughness(const std::vector<TriangleMesh>& cells) {
  Vec3d middle;
  double count = 0.0, outer = 0.0;
  for (const TriangleMesh& cell : cells)
    for (const Vec3d& p : cell.position) middle += p, count += 1.0;
  middle = middle / count;
  for (const TriangleMesh& cell : cells)
    for (const Vec3d& p : cell.position) outer = std::max(outer, norm(p - middle));
  constexpr int kDirections = 400;
  double sum = 0.0, square = 0.0;
  for (int k = 0; k < kDirections; ++k) {
    const Vec3d direction = spiral_direction(k, kDirections);
    double reach = 0.0;
    for (const TriangleMesh& cell : cells)
      for (const Vec3d& p : cell.position) {
        const Vec3d from = p - middle;
        const double along = dot(from, direction);
        if (along > reach && norm2(from - direction * along) < 0.01 * outer * outer) reach = along;
      }
    sum += reach;
    square += reach * reach;
  }
  const double mean = sum / kDirections;
  return std::sqrt(std::max(0.0, square / kDirections - mean * mean)) / mean;
}

Measure motion_measure() {
  Measure out = of_aggregate("aggregate.motion", "motion of the surfaces along their normals, root mean square",
                             "Motion of the surfaces of all cells along their normals since time 0, root mean square by area, less the "
                             "rigid motion of all.",
                             "rms(n (u - t - w x r))", Quantity::kLength);
  out.take = [](FinishedRun& run, const Subject& subject, const Moments& moments) -> Result<std::vector<Sample>> {
    MORULA_TRY_ASSIGN(const std::vector<double>* const times, run.snapshot_times());
    std::vector<Sample> found;
    MORULA_TRY_ASSIGN(const auto first, run.start());
    if (first == nullptr) return found;
    const auto before = surfaces(*first, subject);
    for (const std::size_t index : moments.among(*times)) {
      MORULA_TRY_ASSIGN(const auto snapshot, run.snapshot(index));
      const auto now = surfaces(*snapshot, subject);
      bool same = !now.empty() && now.size() == before.size();
      for (std::size_t c = 0; same && c < now.size(); ++c) same = now[c].position.size() == before[c].position.size();
      if (same) found.push_back({snapshot->time, rms_normal_motion(before, now), ""});
    }
    return found;
  };
  return out;
}

Measure inner_measure() {
  Measure out = of_aggregate("aggregate.inner", "part of the inner cells that are still inner ones",
                             "Part of the cells with 95 % of their surface in contact in the mesh files that have it in the run.", "",
                             Quantity::kFraction);
  out.fits = &needs_mesh_files;
  out.take = [](FinishedRun& run, const Subject& subject, const Moments& moments) -> Result<std::vector<Sample>> {
    MORULA_TRY_ASSIGN(const auto cells, cells_of_files(run.study(), subject));
    const AggregateShape before = measure_aggregate(meshes_of(cells));
    return by_snapshot([&](const Study&, const Snapshot& snapshot, const Subject& whose) -> std::optional<double> {
      const AggregateShape now = measure_aggregate(surfaces(snapshot, whose));
      double inner = 0.0, still = 0.0;
      for (std::size_t c = 0; c < std::min(now.contact_part.size(), before.contact_part.size()); ++c) {
        if (before.contact_part[c] <= kInner) continue;
        inner += 1.0;
        still += now.contact_part[c] > kInner;
      }
      return inner > 0.0 ? std::optional(still / inner) : std::nullopt;
    })(run, subject, moments);
  };
  return out;
}

}  // namespace

std::vector<Measure> aggregate_measures() {
  return {
      of_files("meshes.closed", "closed cells imported", "Number of cells in the mesh files whose surface is closed and holds a volume.",
               "", Quantity::kNumber, &closed_cells),
      of_files("meshes.told_volume", "volume of any cell against the file's cell_volume, relative",
               "Difference of the volume within a surface of a mesh file from what its array `cell_volume` tells, relative.",
               "|V/V_told - 1|", Quantity::kFraction, &told_volume_errors),
      of_files("meshes.start_volume", "volume of any cell at time 0 against its surface in the file, relative",
               "Difference of the volume of a cell at time 0 from that within its surface in the file, relative.", "|V(0)/V_file - 1|",
               Quantity::kFraction, &start_volume_errors),
      of_files("meshes.tension", "tension over pressure from the curvature of the free surfaces",
               "Tension that the pressure of a cell in the mesh file and the sphere of its free surface stand for.", "p R/2",
               Quantity::kTension, &tensions),
      of_files("meshes.angle", "mean contact angle in the file",
               "Mean angle between contact and free surface of the pairs that meet at the outside, in the mesh files.",
               "(pi - psi)/2, cos(psi) = (Ra^2 + Rb^2 - d^2)/(2 Ra Rb)", Quantity::kAngle, &angle_of_files),
      at_moments("aggregate.angle", "mean contact angle",
                 "Mean angle between contact and free surface of the pairs of cells that meet at the outside: where the spheres of their "
                 "free surfaces cross.",
                 "(pi - psi)/2, cos(psi) = (Ra^2 + Rb^2 - d^2)/(2 Ra Rb)", Quantity::kAngle,
                 [](const std::vector<TriangleMesh>& cells) {
                   const AggregateShape shape = measure_aggregate(cells);
                   return shape.angles.empty() ? std::nan("") : shape.mean_angle();
                 }),
      at_moments("aggregate.contact_part", "share of the surfaces in contact",
                 "Part of the surface of all cells whose nodes are in contact with another cell.", "", Quantity::kFraction,
                 [](const std::vector<TriangleMesh>& cells) { return measure_aggregate(cells).contact_fraction; }),
      at_moments("aggregate.near_part", "share of the surfaces within 0.2 um of another cell",
                 "Part of the surface of all cells whose nodes are within 0.2 um of another cell.", "", Quantity::kFraction,
                 [](const std::vector<TriangleMesh>& cells) { return measure_aggregate(cells, kOpenGap).contact_fraction; }),
      at_moments("aggregate.roughness", "roughness of the outline",
                 "How far the outline of all cells is from a ball: standard deviation over mean of the distances from the middle at which "
                 "it is seen in 400 even directions.",
                 "sd(r)/mean(r)", Quantity::kNumber, &roughness),
      motion_measure(),
      inner_measure(),
  };
}

}  // namespace morula::scenarios
