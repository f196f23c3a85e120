#include "coupling/lumens.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/mesh/mesh_check.h"
#include "coupling/cell_variables.h"
#include "coupling/face_marks.h"
#include "coupling/neighbourhoods.h"
#include "coupling/sight.h"

namespace morula {
namespace {

/// Part of all directions from the centre of a cavity in which its walls may have come or gone before its faces are found anew.
constexpr double kWallsMoved = 0.05;

bool carries(const dcm::FaceState& face, std::size_t f, int mark) { return !face.mark.empty() && (face.mark[f] >> mark & 1); }

/// Solid angle of a triangle about the origin, positive where it shows the origin its outside (Van Oosterom & Strackee 1983,
/// doi:10.1109/TBME.1983.325207).
double solid_angle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double la = norm(a), lb = norm(b), lc = norm(c);
  return 2.0 * std::atan2(-dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

/// Function(corners, area vector) for the rank's faces of a lumen.
template <class F>
void for_faces(const Tissue& tissue, int mark, F&& function) {
  const dcm::Shells& shells = tissue.shells;
  for (std::size_t s = 0; s < shells.size(); ++s) {
    const dcm::FaceState& face = shells.faces_of(s);
    if (face.mark.empty()) continue;
    const std::uint32_t first = shells.first_node[s];
    const auto triangles = shells.topology(s).faces();
    for (std::size_t f = 0; f < triangles.size(); ++f) {
      if (!carries(face, f, mark)) continue;
      const Triangle t{first + triangles[f][0], first + triangles[f][1], first + triangles[f][2]};
      const auto& x = shells.position;
      function(t, cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]) * 0.5);
    }
  }
}

/// Whether a cell lies over the place from where a cavity is looked at.
bool lies_over(const Vec3d& eye, const BodyOfRow& body, const Tissue& tissue) {
  if (!body.is_shell) return norm(tissue.spheres.position[body.number] - eye) < tissue.spheres.radius[body.number];
  if (!box_of(tissue, body).contains(eye)) return false;
  return winding_number(tissue.shells.nodes(body.number), tissue.shells.topology(body.number).faces(), eye) > 0.5;
}

/// The three variables of the cells that say what the fluid of a lumen touches of spheres.
template <class Columns>
auto sides_of_spheres(const Model& model, std::size_t lumen, Columns& variables) {
  return std::span(variables).subspan(cavity_variables(model, lumen), 3);
}

/// Marks the faces, and notes what else is a wall.
void mark_by_sight(const Model& model, std::size_t number_of_lumen, std::span<const RigidSurface> obstacles, Tissue& tissue,
                   const Comm& comm) {
  const Lumen& lumen = model.lumens[number_of_lumen];
  LumenState& state = tissue.lumens[number_of_lumen];
  SightMap map(lumen.center, lumen.reach);
  dcm::Shells& shells = tissue.shells;
  std::uint32_t number = 0;
  std::vector<std::uint32_t> first_face{0};
  bool covered_eye = false;
  for (const BodyOfRow& body : bodies_of(tissue.cells)) {
    const bool over = lies_over(lumen.center, body, tissue);
    covered_eye = covered_eye || over;
    if (!body.is_shell) {
      map.add_ball(tissue.spheres.position[body.number], over ? 0.0 : tissue.spheres.radius[body.number]);
      continue;
    }
    const auto x = std::as_const(shells).nodes(body.number);
    for (const Triangle& t : shells.topology(body.number).faces()) {
      const Vec3d normal = cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]);
      const bool outside = dot(normal, x[t[0]] - lumen.center) < 0.0;
      if (!over) map.add_triangle(x[t[0]], x[t[1]], x[t[2]], outside ? number : SightMap::kNothing);
      ++number;
    }
    first_face.push_back(number);
  }
  state.hidden = comm.any(covered_eye) ? 1.0 : 0.0;
  for (std::size_t o = 0; comm.is_root() && o < obstacles.size(); ++o) {
    const auto at = [&](std::uint32_t node) { return obstacles[o].position[node] + tissue.obstacle_offset[o]; };
    for (const Triangle& t : obstacles[o].topology->faces()) map.add_wall(at(t[0]), at(t[1]), at(t[2]));
  }
  map.join(comm);
  for (std::size_t s = 0; s < shells.size(); ++s)
    for (std::size_t face = 0; face < shells.marks_of(s).size(); ++face)
      set_mark(shells.faces_of(s).mark, shells.marks_of(s).width(), face, lumen.mark, false);
  for (const std::uint32_t face : map.seen()) {
    const auto s = static_cast<std::size_t>(std::upper_bound(first_face.begin(), first_face.end(), face) - first_face.begin()) - 1;
    set_mark(shells.faces_of(s).mark, shells.marks_of(s).width(), face - first_face[s], lumen.mark, true);
  }
  state.covered = map.covered();
  const SightMap::InTheWay others = map.in_the_way(comm);
  state.before_others = others.volume;
  state.other_directions = others.directions;
  state.wall_x = others.normal.x, state.wall_y = others.normal.y, state.wall_z = others.normal.z;
  tissue.cells.declare(cell_variables(model));
  const auto side = sides_of_spheres(model, number_of_lumen, tissue.cells.variables);
  for (const BodyOfRow& body : bodies_of(tissue.cells))
    for (std::size_t axis = 0; axis < 3; ++axis)
      side[axis].values.set(body.row, body.is_shell ? 0.0 : others.balls[body.number][axis], tissue.cells.rows.capacity());
}

/// What the faces of a lumen are, over all ranks.
struct Walls {
  double volume = 0.0;      ///< −⅓ Σ A n·(x − center) [µm³]
  double area = 0.0;        ///< [µm²]
  double directions = 0.0;  ///< winding number about the centre: part of the sphere of directions
};

Walls walls_of(const Lumen& lumen, const Tissue& tissue, const Comm& comm) {
  OrderFreeSum sums[3];
  for_faces(tissue, lumen.mark, [&](const Triangle& t, const Vec3d& area) {
    const auto& x = tissue.shells.position;
    const Vec3d a = x[t[0]] - lumen.center, b = x[t[1]] - lumen.center, c = x[t[2]] - lumen.center;
    sums[0].add(-dot(area, a) / 3.0);
    sums[1].add(norm(area));
    sums[2].add(solid_angle(a, b, c));
  });
  double total[3];
  comm.sum(sums, total);
  return {total[0], total[1], total[2] / (4.0 * std::numbers::pi)};
}

/// Whether the faces of a lumen are to be found by now: they were not for a while, or they leave open, or cover twice, where a wall was seen then.
bool is_due(const Lumen& lumen, const Tissue& tissue, const LumenState& state, const Comm& comm) {
  const double time = tissue.clock.time;
  if (time < lumen.from) return false;
  if (time - state.looked_at >= lumen.renewed * (1.0 - 1e-9)) return true;
  return lumen.by_sight && std::abs(walls_of(lumen, tissue, comm).directions + state.other_directions - state.covered) > kWallsMoved;
}

}  // namespace

double lumen_pressure(const Lumen& lumen, const LumenState& state, double time) {
  if (time < lumen.from || state.covered < kBurst) return 0.0;
  const double factor = lumen.course.at(time);
  if (!lumen.keeps_solute) return lumen.pressure * factor;
  return state.volume > 0.0 ? kGasEnergy * state.amount * factor / state.volume : 0.0;
}

void measure_lumens(const Model& model, Tissue& tissue, const Comm& comm) {
  tissue.lumens.resize(model.lumens.size());
  for (std::size_t k = 0; k < model.lumens.size(); ++k) {
    const Lumen& lumen = model.lumens[k];
    if (tissue.clock.time < lumen.from) continue;
    const Walls walls = walls_of(lumen, tissue, comm);
    LumenState& state = tissue.lumens[k];
    if (!lumen.by_sight) state.covered = walls.directions;
    state.area = walls.area;
    const double of_all = walls.directions + state.other_directions;
    state.volume = state.covered >= kBurst && of_all > 0.0 ? std::max(0.0, (walls.volume + state.before_others) / of_all) : 0.0;
    state.pressure = lumen_pressure(lumen, state, tissue.clock.time);
  }
}

void look_into_lumens(const Model& model, std::span<const RigidSurface> obstacles, Tissue& tissue, const Comm& comm) {
  if (model.lumens.empty()) return;
  tissue.lumens.resize(model.lumens.size());
  bool looked = false;
  for (std::size_t k = 0; k < model.lumens.size(); ++k) {
    const Lumen& lumen = model.lumens[k];
    LumenState& state = tissue.lumens[k];
    if (!is_due(lumen, tissue, state, comm)) continue;
    const bool first = state.looked_at < lumen.from;
    state.looked_at = tissue.clock.time;
    looked = true;
    if (lumen.by_sight) mark_by_sight(model, k, obstacles, tissue, comm);
    if (!first) continue;
    measure_lumens(model, tissue, comm);
    if (lumen.keeps_solute) state.amount = lumen.pressure * state.volume / kGasEnergy;
  }
  if (looked) measure_lumens(model, tissue, comm);
}

void add_lumen_forces(const Model& model, const Tissue& tissue, double time, const Comm& comm, std::span<Vec3d> external) {
  for (std::size_t k = 0; k < tissue.lumens.size(); ++k) {
    const Lumen& lumen = model.lumens[k];
    const double pressure = lumen_pressure(lumen, tissue.lumens[k], time);
    if (pressure == 0.0) continue;
    OrderFreeSum sums[4];
    for_faces(tissue, lumen.mark, [&](const Triangle&, const Vec3d& area) {
      sums[0].add(norm(area));
      for (std::size_t axis = 0; axis < 3; ++axis) sums[axis + 1].add(area[axis]);
    });
    double total[4];
    comm.sum(sums, total);
    if (!(total[0] > 0.0)) continue;
    const LumenState& state = tissue.lumens[k];
    const Vec3d mean = (Vec3d{total[1], total[2], total[3]} - Vec3d{state.wall_x, state.wall_y, state.wall_z}) * (1.0 / total[0]);
    for_faces(tissue, lumen.mark, [&](const Triangle& t, const Vec3d& area) {
      const Vec3d push = (mean * norm(area) - area) * (pressure / 3.0);
      for (const std::uint32_t node : t) external[node] += push;
    });
  }
}

std::vector<Vec3d> pushes_on_spheres(const Model& model, const Tissue& tissue, double time) {
  std::vector<Vec3d> out;
  for (std::size_t k = 0; k < tissue.lumens.size(); ++k) {
    const double pressure = lumen_pressure(model.lumens[k], tissue.lumens[k], time);
    if (pressure == 0.0 || !model.lumens[k].by_sight) continue;
    const auto side = sides_of_spheres(model, k, tissue.cells.variables);
    if (std::ranges::all_of(side, [](const VariableColumn& axis) { return axis.values.empty(); })) continue;
    out.resize(tissue.spheres.size());
    for (const BodyOfRow& body : bodies_of(tissue.cells))
      if (!body.is_shell)
        out[body.number] += Vec3d{side[0].values[body.row], side[1].values[body.row], side[2].values[body.row]} * pressure;
  }
  return out;
}

}  // namespace morula
