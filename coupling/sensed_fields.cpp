#include "coupling/sensed_fields.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/ball.h"
#include "fields/field_solver.h"

namespace morula {
namespace {

double radius_of(const CellRow& row) { return ball_radius(row.target_volume); }

/// What is seen at a point, where faces of the domain have a concentration: between such a face and the middle of the voxel at it a field goes straight from
/// the face's concentration to that of the voxel, which is what sample() gives there; beyond the face it stays.
double beside_faces(double seen, const Vec3d& at, const fields::Grid& grid, const fields::FieldSpec& now, const Space& space) {
  const Vec3d half = grid.spacing() * 0.5;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t side = 0; side < 2 && !space.periodic(static_cast<int>(axis)); ++side) {
      const fields::FaceCondition& face = now.boundary[axis][side];
      const double depth = side == 0 ? at[axis] - grid.box.low[axis] : grid.box.high[axis] - at[axis];
      if (face.kind != fields::FaceCondition::Kind::kValue || depth >= half[axis]) continue;
      seen = face.value + (seen - face.value) * std::max(0.0, depth / half[axis]);
    }
  return seen;
}

}  // namespace

bool any_senses_a_field(std::span<const CellType> types) {
  return std::ranges::any_of(types, [](const CellType& type) { return type.migration.sensed_field() >= 0; });
}

Result<std::vector<SensedField>> sense_field(const Model& model, const Tissue& tissue, std::size_t field, std::span<const std::size_t> rows,
                                             std::span<const Vec3d> center, const Comm& comm) {
  std::vector<SensedField> out(rows.size());
  std::vector<fields::CellSource> points(rows.size());
  std::vector<double> ahead(rows.size()), behind(rows.size());
  const fields::FieldSpec now = fields::in_interval(model.fields[field], tissue.clock.time, 0.0);
  const auto sample = [&](std::size_t axis, double sign, std::vector<double>& seen) -> Status {
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const CellRow& row = tissue.cells.rows[rows[k]];
      points[k] = {row.id, row.type, center[k]};
      points[k].center[axis] += sign * radius_of(row);
    }
    MORULA_TRY(fields::sample(tissue.fields[field], model.space, points, comm, seen));
    for (std::size_t k = 0; k < rows.size(); ++k)
      seen[k] = beside_faces(seen[k], points[k].center, tissue.fields[field].grid, now, model.space);
    return {};
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    MORULA_TRY(sample(axis, 1.0, ahead));
    MORULA_TRY(sample(axis, -1.0, behind));
    for (std::size_t k = 0; k < rows.size(); ++k) {
      out[k].gradient[axis] = (ahead[k] - behind[k]) / (2.0 * radius_of(tissue.cells.rows[rows[k]]));
      out[k].concentration += (ahead[k] + behind[k]) / 6.0;
    }
  }
  return out;
}

Result<std::vector<SensedField>> sense_fields(const Model& model, const Tissue& tissue, std::span<const Vec3d> center, const Comm& comm) {
  std::set<int> sensed;
  for (const CellType& type : model.types) sensed.insert(type.migration.sensed_field());
  sensed.erase(-1);
  std::vector<SensedField> out(tissue.cells.size());
  for (const int field : sensed) {
    std::vector<std::size_t> rows;
    std::vector<Vec3d> places;
    for (std::size_t i = 0; i < tissue.cells.size(); ++i)
      if (model.types[tissue.cells.rows[i].type].migration.sensed_field() == field) {
        rows.push_back(i);
        places.push_back(center[i]);
      }
    MORULA_TRY_ASSIGN(const auto found, sense_field(model, tissue, static_cast<std::size_t>(field), rows, places, comm));
    for (std::size_t k = 0; k < rows.size(); ++k) out[rows[k]] = found[k];
  }
  return out;
}

}  // namespace morula
