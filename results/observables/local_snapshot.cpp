#include "results/observables/local_snapshot.h"

#include <algorithm>
#include <cmath>

#include "core/ball.h"

namespace morula::scenarios {

namespace {

/// Obstacles where they are, and the cavities that exist.
void add_surroundings(const Model& model, const Tissue& tissue, Snapshot& out) {
  for (std::size_t i = 0; i < model.obstacles.size(); ++i) {
    Snapshot::Obstacle& obstacle = out.obstacles.emplace_back();
    obstacle.name = model.obstacles[i].name;
    if (i < tissue.obstacle_offset.size()) obstacle.offset = tissue.obstacle_offset[i];
  }
  for (const Snapshot::Obstacle& wall : domain_walls(model.space)) out.obstacles.emplace_back().name = wall.name;
  for (std::size_t i = 0; i < model.lumens.size() && i < tissue.lumens.size(); ++i) {
    const LumenState& lumen = tissue.lumens[i];
    if (tissue.clock.time >= model.lumens[i].from && lumen.volume > 0.0)
      out.lumens.push_back({model.lumens[i].name, model.lumens[i].center, lumen.volume, lumen.pressure});
  }
}

/// Directions of the cells, where any type has one.
void add_polarity(const Model& model, const Cells& cells, Snapshot& out) {
  if (std::ranges::none_of(model.types, [](const CellType& type) { return type.polarity.set; })) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Snapshot::Variable& told = out.variables.emplace_back(Snapshot::Variable{std::string("polarity/") + "xyz"[axis], "1", {}});
    for (std::size_t i = 0; i < cells.size(); ++i) told.values.push_back(cells.optional.polarity[i][axis]);
  }
}

}  // namespace

std::vector<Snapshot::Obstacle> domain_walls(const Space& space) {
  std::vector<Snapshot::Obstacle> walls;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t side = 0; side < 2; ++side) {
      if (space.boundary[axis][side] != BoundaryKind::kWall) continue;
      Snapshot::Obstacle& wall = walls.emplace_back();
      // Names of the study have no spaces: this one is never an obstacle's.
      wall.name = std::string("wall ") + "xyz"[axis] + (side == 0 ? " low" : " high");
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      for (int corner = 0; corner < 4; ++corner) {
        Vec3d p = side == 0 ? space.box.low : space.box.high;
        p[u] = corner == 1 || corner == 2 ? space.box.high[u] : space.box.low[u];
        p[v] = corner >= 2 ? space.box.high[v] : space.box.low[v];
        wall.position.push_back(p);
      }
      // Counter-clockwise as seen from the cells: along +axis from the low face.
      wall.faces = side == 0 ? std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}} : std::vector<Triangle>{{0, 2, 1}, {0, 3, 2}};
    }
  return walls;
}

std::vector<Snapshot::Obstacle> obstacles_at_start(const Model& model) {
  std::vector<Snapshot::Obstacle> out;
  for (const ObstacleSpec& spec : model.obstacles) out.push_back({spec.name, {}, spec.position, spec.faces});
  for (Snapshot::Obstacle& wall : domain_walls(model.space)) out.push_back(std::move(wall));
  return out;
}

Snapshot local_snapshot(Simulation& simulation) {
  const BodyValues& values = simulation.values();
  const AsBalls balls = simulation.mechanics().as_balls(simulation.tissue());
  const Tissue& tissue = simulation.tissue();
  const Model& model = simulation.model();
  const std::vector<Vec3d> center = simulation.centers();
  Snapshot out;
  out.time = tissue.clock.time;
  out.box = model.space.box;
  for (const CellType& type : model.types) out.type_names.push_back(type.name);
  for (const auto& spec : model.fields) out.fields.emplace_back().name = spec.name;
  out.mark_names = model.mark_names;
  add_surroundings(model, tissue, out);
  for (const VariableColumn& variable : tissue.cells.variables) {
    Snapshot::Variable& told = out.variables.emplace_back(Snapshot::Variable{variable.what.name, variable.what.unit, {}});
    for (std::size_t i = 0; i < tissue.cells.size(); ++i) told.values.push_back(variable.values[i]);
  }
  Snapshot::Variable& outside = out.variables.emplace_back(Snapshot::Variable{"outside_law", "1", {}});
  for (const BodyOfRow& owned : bodies_of(tissue.cells)) outside.values.push_back(balls.outside_law[owned.place(tissue.shells.size())]);
  add_polarity(model, tissue.cells, out);
  std::vector<const Topology*> known;
  for (const BodyOfRow& owned : bodies_of(tissue.cells)) {
    const std::size_t i = owned.row, body = owned.place(tissue.shells.size()), shell = owned.number;
    const CellRow& row = tissue.cells.rows[i];
    const bool is_shell = owned.is_shell;
    Snapshot::Cell& cell = out.cells.emplace_back();
    cell.id = row.id;
    cell.parent = row.parent;
    cell.type = row.type;
    cell.body = row.body;
    cell.phase = row.phase;
    cell.centroid = center[i];
    cell.volume = values.volume[body];
    cell.area = values.area[body];
    cell.pressure = values.pressure[body];
    cell.inner_pressure = values.inner_pressure[body];
    const SymMat3<double>& stress = values.stress[body];
    cell.stress_xx = stress.xx, cell.stress_xy = stress.xy, cell.stress_xz = stress.xz;
    cell.stress_yy = stress.yy, cell.stress_yz = stress.yz, cell.stress_zz = stress.zz;
    cell.contact_area = values.contact_area[body];
    cell.age = out.time - row.birth_time;
    cell.radius = is_shell ? ball_radius(cell.volume) : tissue.spheres.radius[owned.number];
    if (!is_shell) continue;
    const auto add_surface = [&](const dcm::Shells& from, std::size_t s, std::vector<Snapshot::Shell>& shells, std::vector<Vec3d>& all) {
      const Topology* topology = &from.topology(s);
      const auto found = std::find(known.begin(), known.end(), topology);
      const auto number = static_cast<std::uint32_t>(found - known.begin());
      if (found == known.end()) {
        known.push_back(topology);
        out.topologies.emplace_back(topology->faces().begin(), topology->faces().end());
      }
      const auto nodes = from.nodes(s);
      shells.push_back(
          {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(all.size()), static_cast<std::uint32_t>(nodes.size()), number});
      all.insert(all.end(), nodes.begin(), nodes.end());
    };
    add_surface(tissue.shells, shell, out.shells, out.nodes);
    if (const std::size_t n = tissue.nuclei.of_shell(shell); n < tissue.nuclei.size())
      add_surface(tissue.nuclei.shells, n, out.nuclear_shells, out.nuclear_nodes);
    if (const Vec3d* nucleus = tissue.shells.nucleus_of(shell))
      out.nuclei.push_back(
          {static_cast<std::uint32_t>(i), *nucleus, dcm::nucleus_radius(model.types[row.type].interior, tissue.shells.rest_volume[shell])});
    if (!model.mark_names.empty()) {
      const auto& marks = tissue.shells.faces_of(shell).mark;
      out.face_marks.insert(out.face_marks.end(), marks.begin(), marks.end());
      if (marks.empty()) out.face_marks.resize(out.face_marks.size() + tissue.shells.topology(shell).face_count() * out.mark_width(), 0);
    }
  }
  return out;
}

}  // namespace morula::scenarios
