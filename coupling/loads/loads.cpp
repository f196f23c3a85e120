#include "coupling/loads/loads.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace morula {
namespace {

constexpr double kTie = 1e-9;  // of a shape that encloses the volume 1

}  // namespace

bool lies_within(const CellLoad& load, const Vec3d& point) {
  const Vec3d axis = load.high_end - load.low_end, from = point - load.low_end;
  const double along = dot(from, axis) / norm2(axis);
  return along >= 0.0 && along <= 1.0 && norm2(from - axis * along) <= load.radius * load.radius;
}

std::vector<std::uint32_t> end_nodes(const ReferenceShape& shape, const Vec3d& axis, double part) {
  const std::size_t all = shape.position.size();
  std::vector<double> along(all);
  for (std::size_t i = 0; i < all; ++i) along[i] = dot(shape.position[i], axis);
  std::vector<double> sorted = along;
  const auto wanted = static_cast<std::size_t>(std::llround(part * static_cast<double>(all)));
  const std::size_t count = std::clamp<std::size_t>(wanted, 1, all);
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count - 1), sorted.end(), std::greater<>());
  std::vector<std::uint32_t> out;
  for (std::size_t i = 0; i < all; ++i)
    if (along[i] >= sorted[count - 1] - kTie) out.push_back(static_cast<std::uint32_t>(i));
  return out;
}

void add_shell_load(const CellLoad& load, const ReferenceShape& shape, std::span<const Vec3d> position, const MarkSets& marks,
                    double strength, std::span<Vec3d> force) {
  if (load.what->push != nullptr) load.what->push(load, {shape, position, marks, strength}, force);
}

Vec3d body_force(const Model& model, std::uint16_t type, double time) {
  Vec3d out{};
  for (const CellLoad& load : model.loads)
    if (load.what->push_cell != nullptr && load.type == type) out += load.what->push_cell(load, load.course.at(time));
  return out;
}

bool follows_surface(const CellLoad& load) { return load.what->follows != nullptr && load.what->follows(load); }

void add_surface_loads(const Model& model, const Tissue& tissue, double time, LoadsThat which, std::span<Vec3d> external) {
  for (const CellLoad& load : model.loads) {
    const double strength = load.course.at(time);
    if (strength == 0.0 || load.what->push == nullptr || (which == LoadsThat::kDoNotFollow && follows_surface(load))) continue;
    for (const auto [row, is_shell, shell] : bodies_of(tissue.cells)) {
      if (is_shell && tissue.cells.rows[row].type == load.type) {
        const std::uint32_t first = tissue.shells.first_node[shell], count = tissue.shells.first_node[shell + 1] - first;
        add_shell_load(load, *tissue.shells.shape[shell], tissue.shells.nodes(shell), tissue.shells.marks_of(shell), strength,
                       external.subspan(first, count));
      }
    }
  }
}

double longest_step_of_forces(const Model& model, double time, double until) {
  constexpr double kChange = 0.025;
  double out = kNever;
  for (const CellLoad& load : model.loads) {
    if (load.what->push_cell == nullptr) continue;
    const double now = load.course.at(time), then = load.course.at(until);
    if (now != then) out = std::min(out, kChange * std::max(std::abs(now), std::abs(then)) / std::abs(then - now) * (until - time));
  }
  return out;
}

double next_corner(const Model& model, double time) {
  double next = model.box_volume.next_point(time);
  for (const fields::FieldSpec& field : model.fields) next = std::min(next, field.course.next_point(time));
  for (const CellLoad& load : model.loads) {
    next = std::min(next, load.course.next_point(time));
    for (const auto& [name, course] : load.values.courses()) next = std::min(next, course.next_point(time));
    next = std::min(next, load.way.next_point(time));
  }
  for (const ObstacleSpec& obstacle : model.obstacles) next = std::min(next, obstacle.distance.next_point(time));
  for (const Lumen& lumen : model.lumens) {
    next = std::min(next, lumen.course.next_point(time));
    if (lumen.from > time) next = std::min(next, lumen.from);
  }
  for (const CellType& type : model.types) {
    next = std::min(next, type.osmosis.course.next_point(time));
    for (const TensionRegion& region : type.regional_tension.regions) next = std::min(next, region.course.next_point(time));
  }
  return next;
}

}  // namespace morula
