// S17: sixteen cells whose tensions are known, from the shapes alone and as a test of what holds them (physics/scenarios.md).
#include "scenarios/library/embryo.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/mesh/surface_file.h"
#include "core/mesh/topology.h"
#include "scenarios/library/embryo_shape.h"
#include "scenarios/measures/single_cell.h"
#include "scenarios/measures/verdicts.h"
#include "study/initial/cells_from_meshes.h"

namespace morula::scenarios {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// What is known of the aggregate embryo_5 (simulated with SimuCell3D: Runser, Vetter & Iber 2024, doi:10.1038/s43588-024-00620-9; see the study's
// README): measured on its meshes, but for the pressures, which its file holds.
constexpr double kContactFraction = 0.619, kMeanPressure = 0.1177 /* kPa */, kMeanAngle = 58.9 /* degrees */;
constexpr double kInner = 0.95;   // contact part from which a cell is an inner one
constexpr double kOpenGap = 0.2;  // [µm]
constexpr double kBalance = 0.5;  // W/(2T) of the file: each side of a contact has half the tension of a free surface

std::vector<TriangleMesh> surfaces(const Snapshot& snapshot) {
  std::vector<TriangleMesh> out;
  for (const Snapshot::Shell& shell : snapshot.shells) {
    const auto first = snapshot.nodes.begin() + shell.first_node;
    out.push_back({{first, first + shell.node_count}, snapshot.topologies[shell.topology]});
  }
  return out;
}

/// A run of the study: what its file says and how its shapes went on.
struct Aggregate {
  const MeshCells* spec = nullptr;
  const CellType* type = nullptr;
  double ratio = 0.0;  ///< W/(2T)
  MeshCellsRead file;
  AggregateShape file_shape;
  std::vector<Snapshot> moments;

  [[nodiscard]] bool tells_pressure() const { return !spec->pressure_array.empty(); }
  [[nodiscard]] bool balanced() const { return std::abs(ratio - kBalance) < 0.05; }
};

Result<Aggregate> read_aggregate(const Study& study, const std::filesystem::path& run) {
  Aggregate out;
  for (const InitialCells& cells : study.initial)
    if (cells.source == InitialCells::Source::kMeshes && !out.spec) {
      out.spec = &cells.meshes;
      out.type = &study.model.types[cells.type];
      out.ratio = study.model.pair(cells.type, cells.type).adhesion / (2.0 * out.type->shell.tension);
      out.file = read_mesh_cells(cells.meshes, cells.type, false);
    }
  if (!out.file.problems.empty()) return Error{ErrorKind::kFile, out.file.problems.front().text, out.file.problems.front().help};
  std::vector<TriangleMesh> meshes;
  for (const MeshCell& cell : out.file.cells) meshes.push_back(cell.mesh);
  out.file_shape = measure_aggregate(meshes);
  MORULA_TRY_ASSIGN(out.moments, all_snapshots(run));
  return out;
}

/// The volumes that the file itself tells of its cells [µm³]; empty when it tells none.
std::vector<double> told_volumes(const MeshCells& spec) {
  const auto file = read_labelled_mesh(spec.path.front(), spec.scale);
  if (!file.ok()) return {};
  for (const MeshArray& array : file->part_arrays)
    if (array.name == "cell_volume" && array.components == 1) {
      std::vector<double> out = array.values;
      for (double& v : out) v *= std::pow(spec.scale, 3);
      return out;
    }
  return {};
}

/// S17.1
void judge_import(const Aggregate& all, std::vector<Verdict>& out) {
  std::size_t closed = 0;
  for (const MeshCell& cell : all.file.cells)
    closed += Topology::build(static_cast<std::uint32_t>(cell.mesh.position.size()), cell.mesh.faces).ok() && cell.volume > 0.0;
  out.push_back(equal("S17.1", "closed cells imported", closed, 16));
  Largest worst_told, worst_start;
  const std::vector<double> told = told_volumes(*all.spec);
  for (std::size_t c = 0; c < all.file.cells.size(); ++c) {
    if (c < told.size()) worst_told.add(std::abs(all.file.cells[c].volume / told[c] - 1.0));
    if (c < all.moments.front().cells.size())
      worst_start.add(std::abs(all.moments.front().cells[c].volume / all.file.cells[c].volume - 1.0));
  }
  if (!told.empty())
    out.push_back(at_most("S17.1", "volume of any cell against the file's cell_volume, relative", worst_told.value(), 0.002));
  out.push_back(at_most("S17.1", "volume of any cell at time 0 against its surface in the file, relative", worst_start.value(), 0.002));
}

/// Tension that the curvature of each free surface and the file's pressure stand for: p R/2 [nN/µm].
std::vector<std::pair<std::size_t, double>> tensions(const Aggregate& all) {
  std::vector<std::pair<std::size_t, double>> out;
  for (std::size_t c = 0; c < all.file.cells.size(); ++c)
    if (all.file_shape.sphere[c] && all.file.cells[c].pressure)
      out.emplace_back(c, 0.5 * *all.file.cells[c].pressure * all.file_shape.sphere[c]->radius);
  return out;
}

/// S17.2
void judge_inference(const Aggregate& all, double factor, std::vector<Verdict>& out) {
  double sum = 0.0;
  const auto by_cell = tensions(all);
  for (const auto& [cell, tension] : by_cell) sum += tension;
  const double mean = by_cell.empty() ? 0.0 : sum / static_cast<double>(by_cell.size());
  out.push_back(at_most("S17.2", "tension over pressure from the curvature of the free surfaces, relative",
                        std::abs(mean / all.type->shell.tension - 1.0), factor * 0.03));
  out.push_back(at_most("S17.2", "mean contact angle against 58.9 degrees", std::abs(all.file_shape.mean_angle() / kDegree - kMeanAngle),
                        factor * 2.0, "deg"));
}

/// S17.3; with nodes of a coarser copy also S17.6.
void judge_hold(const Aggregate& all, double factor, std::vector<Verdict>& out) {
  const auto before = surfaces(all.moments.front()), after = surfaces(all.moments.back());
  const AggregateShape start = measure_aggregate(before), end = measure_aggregate(after);
  out.push_back(at_most("S17.3", "motion of the surfaces along their normals, root mean square", rms_normal_motion(before, after),
                        factor * 0.3, "um"));
  out.push_back(
      at_most("S17.3", "share of the surfaces in contact against 0.619", std::abs(end.contact_fraction - kContactFraction), factor * 0.03));
  double pressure = 0.0;
  for (const auto& cell : all.moments.back().cells) pressure += cell.inner_pressure / static_cast<double>(all.moments.back().cells.size());
  out.push_back(at_most("S17.3", "mean inner pressure against 117.7 Pa", 1000.0 * std::abs(pressure - kMeanPressure), factor * 6.0, "Pa"));
  std::size_t inner = 0, still = 0;
  for (std::size_t c = 0; c < after.size(); ++c) {
    if (all.file_shape.contact_part[c] <= kInner) continue;
    ++inner;
    still += end.contact_part[c] > kInner;
  }
  out.push_back(
      at_least("S17.3", "part of the inner cells that are still inner ones", static_cast<double>(still) / static_cast<double>(inner), 1.0));
  if (all.spec->nodes > 0)
    out.push_back(at_most("S17.6",
                          ("share of the surfaces in contact against 0.619, " + std::to_string(all.spec->nodes) + " nodes a cell").c_str(),
                          std::abs(end.contact_fraction - kContactFraction), all.spec->nodes < 642 ? 0.06 : 0.03));
}

/// How far the outline is from a sphere: standard deviation over mean of the distances of free nodes from the middle of the aggregate.
double roughness(const std::vector<TriangleMesh>& cells) {
  Vec3d middle;
  double count = 0.0;
  for (const TriangleMesh& cell : cells)
    for (const Vec3d& p : cell.position) middle += p, count += 1.0;
  middle = middle / count;
  const double outer = [&] {
    double far = 0.0;
    for (const TriangleMesh& cell : cells)
      for (const Vec3d& p : cell.position) far = std::max(far, norm(p - middle));
    return far;
  }();
  // In each of some even directions, the farthest node near it: the outline as it would be seen.
  constexpr int kDirections = 400;
  double sum = 0.0, square = 0.0;
  for (int k = 0; k < kDirections; ++k) {
    const double z = 1.0 - (2.0 * k + 1.0) / kDirections, turn = k * std::numbers::pi * (3.0 - std::sqrt(5.0)), r = std::sqrt(1.0 - z * z);
    const Vec3d direction{r * std::cos(turn), r * std::sin(turn), z};
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

/// S17.4
void judge_opening(const Aggregate& all, std::vector<Verdict>& out) {
  const auto before = surfaces(all.moments.front()), after = surfaces(all.moments.back());
  const AggregateShape end = measure_aggregate(after);
  const double expected = std::acos(1.0 - all.ratio) / kDegree;  // Young's law
  out.push_back(at_most("S17.4", "mean contact angle against Young's law", std::abs(end.mean_angle() / kDegree - expected), 5.0, "deg"));
  // Where cells open at a small angle, surfaces stay within 0.6 µm of each other over a rim of 0.6 µm around each contact, which is a fifth of its area.
  out.push_back(
      at_most("S17.4", "share of the surfaces within 0.2 um of another cell", measure_aggregate(after, kOpenGap).contact_fraction, 0.4));
  const double rough_before = roughness(before), rough_after = roughness(after);
  out.push_back(at_least("S17.4", "growth of the outline's roughness", rough_after - rough_before, 0.0));
}

/// S17.5
void judge_closing(const Aggregate& all, std::vector<Verdict>& out) {
  const AggregateShape end = measure_aggregate(surfaces(all.moments.back()));
  out.push_back(
      at_most("S17.5", "share of the surfaces in contact against 0.619", std::abs(end.contact_fraction - kContactFraction), 0.05));
}

}  // namespace

Status embryo_needs(const Study& study) {
  for (const InitialCells& cells : study.initial)
    if (cells.source == InitialCells::Source::kMeshes) return {};
  return Error{ErrorKind::kInput, "cells from mesh files (`initial` with `meshes`)", ""};
}

Result<std::vector<Verdict>> judge_embryo(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const Aggregate all, read_aggregate(study, run));
  std::vector<Verdict> out;
  const double factor = all.spec->nodes > 0 && all.spec->nodes < 642 ? 2.0 : 1.0;
  judge_import(all, out);
  if (all.tells_pressure()) judge_inference(all, factor, out);
  if (!all.balanced())
    judge_opening(all, out);
  else if (all.tells_pressure())
    judge_hold(all, factor, out);
  else
    judge_closing(all, out);
  return out;
}

Result<std::vector<NamedPlot>> plot_embryo(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const Aggregate all, read_aggregate(study, run));
  std::vector<NamedPlot> out;
  const auto line = [](std::string name, double x0, double x1, double y) {
    return Curve{std::move(name), {x0, x1}, {y, y}, CurveStyle::kLine};
  };
  const auto cells = static_cast<double>(all.file.cells.size());
  if (all.tells_pressure()) {
    CurvePlot tension;
    tension.title = "Embryo: tension from curvature and pressure of the file";
    tension.x = {"cell", "", false, 0.0, cells};
    tension.y = {"p R/2", "mN/m", false, 0.0, {}};
    Curve points{"cells with a free surface", {}, {}, CurveStyle::kPoints};
    for (const auto& [cell, value] : tensions(all)) {
      points.x.push_back(static_cast<double>(cell));
      points.y.push_back(value);
    }
    tension.curves = {line("tension of the study", 0.0, cells, all.type->shell.tension), std::move(points)};
    out.push_back({"embryo_tension", std::move(tension)});
  }
  CurvePlot angles, fraction, pressure;
  angles.title = "Embryo: contact angles of the pairs that meet at the outside";
  angles.x = {"pair, by angle", "", false, 0.0, {}};
  angles.y = {"angle", "deg", false, 0.0, 90.0};
  const auto sorted_angles = [](const AggregateShape& shape, std::string name) {
    Curve curve{std::move(name), {}, {}, CurveStyle::kPoints};
    for (const JunctionAngle& one : shape.angles) curve.y.push_back(one.angle / kDegree);
    std::sort(curve.y.begin(), curve.y.end());
    for (std::size_t i = 0; i < curve.y.size(); ++i) curve.x.push_back(static_cast<double>(i));
    return curve;
  };
  const AggregateShape end = measure_aggregate(surfaces(all.moments.back()));
  const double pairs = static_cast<double>(std::max<std::size_t>({all.file_shape.angles.size(), end.angles.size(), 1}));
  angles.curves = {line("Young's law", 0.0, pairs, std::acos(1.0 - all.ratio) / kDegree)};
  for (auto& [shape, name] : {std::pair(&all.file_shape, "in the file"), std::pair(&end, "at the end")})
    if (Curve curve = sorted_angles(*shape, name); !curve.x.empty()) angles.curves.push_back(std::move(curve));
  fraction.title = "Embryo: share of the surfaces in contact";
  pressure.title = "Embryo: mean inner pressure";
  fraction.x = pressure.x = {"time", "s", false, {}, {}};
  fraction.y = {"contact", "", false, 0.0, 1.0};
  pressure.y = {"inner pressure", "Pa", false, 0.0, {}};
  Curve f{"cells", {}, {}, CurveStyle::kLine}, p{"cells", {}, {}, CurveStyle::kLine};
  for (const Snapshot& moment : all.moments) {
    double mean = 0.0;
    for (const auto& cell : moment.cells) mean += 1000.0 * cell.inner_pressure / static_cast<double>(moment.cells.size());
    f.x.push_back(moment.time);
    p.x.push_back(moment.time);
    f.y.push_back(measure_aggregate(surfaces(moment)).contact_fraction);
    p.y.push_back(mean);
  }
  const double last = std::max(all.moments.back().time, 1.0);
  fraction.curves = {line("embryo_5", 0.0, last, kContactFraction), std::move(f)};
  pressure.curves = {line("embryo_5", 0.0, last, 1000.0 * kMeanPressure), std::move(p)};
  out.push_back({"embryo_angles", std::move(angles)});
  out.push_back({"embryo_contact", std::move(fraction)});
  out.push_back({"embryo_pressure", std::move(pressure)});
  return out;
}

}  // namespace morula::scenarios
