#pragma once
#include <functional>
#include <vector>

#include "core/parallel/comm.h"
#include "fields/field_solver.h"
#include "fields/reactions/decay.h"
#include "fields/reactions/uptake.h"

namespace morula::fields::test {

inline Space cube(double side, BoundaryKind kind = BoundaryKind::kWall) {
  Space space;
  space.box = {{0, 0, 0}, {side, side, side}};
  for (auto& axis : space.boundary) axis = {kind, kind};
  return space;
}

inline FieldSpec spec_of(double diffusion, double voxel, double initial = 0.0) {
  FieldSpec spec;
  spec.name = "oxygen";
  spec.diffusion = diffusion;
  spec.voxel = voxel;
  spec.initial = initial;
  return spec;
}

inline FieldReaction decay_of(double rate) {
  FieldReaction out{decay(), {}};
  out.values.set("decay", rate);
  return out;
}

/// Uptake by Michaelis and Menten of cells of a type.
inline FieldReaction uptake_of(double rate, double half_saturation, std::uint16_t type = 0) {
  FieldReaction out{uptake(), {}, type};
  out.values.set("rate", rate), out.values.set("half_saturation", half_saturation);
  return out;
}

inline void hold_all_faces(FieldSpec& spec, double value) {
  for (auto& axis : spec.boundary)
    for (auto& face : axis) face = {FaceCondition::Kind::kValue, value};
}

/// A field that is all on this rank, with these values at the voxel centres.
inline Field field_of(const FieldSpec& spec, const Space& space, const std::function<double(Vec3d)>& value = {}) {
  const Grid grid = grid_for(spec, space).value();
  const std::vector<int> owner(static_cast<std::size_t>(grid.brick_count()), 0);
  Field field = uniform_field(grid, spec.initial, owner, 0);
  if (!value) return field;
  for (std::size_t b = 0; b < field.owned_bricks.size(); ++b) {
    const auto n = grid.extent(field.owned_bricks[b]);
    const auto p = grid.place(field.owned_bricks[b]);
    std::size_t at = 0;
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i) field.concentration[b][at++] = value(grid.voxel_center({8 * p[0] + i, 8 * p[1] + j, 8 * p[2] + k}));
  }
  return field;
}

/// Value of the voxel with this place in the grid.
inline double value_at(const Field& field, int x, int y, int z) {
  const std::int64_t brick = field.grid.brick_at({x / 8, y / 8, z / 8});
  const auto n = field.grid.extent(brick);
  return field.concentration[static_cast<std::size_t>(brick)][static_cast<std::size_t>((x % 8) + n[0] * ((y % 8) + n[1] * (z % 8)))];
}

inline Comm alone() { return Comm(MPI_COMM_SELF); }

/// Advance a field that is all on this rank; cells' amounts are added to `taken` when it is given.
inline IntervalReport advance(Field& field, const FieldSpec& spec, const Space& space, double interval,
                              const std::vector<CellSource>& cells = {}, std::vector<double>* taken = nullptr) {
  FieldSolver solver;
  std::vector<double> took(cells.size()), seen(cells.size());
  auto report = solver.advance(field, spec, space, cells, interval, alone(), took, seen);
  if (!report.ok()) throw std::runtime_error(report.error().message);
  if (taken != nullptr)
    for (std::size_t i = 0; i < cells.size(); ++i) (*taken)[i] += took[i];
  return *report;
}

}  // namespace morula::fields::test
