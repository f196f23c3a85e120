#pragma once
#include <cmath>
#include <numbers>
#include <vector>

#include "core/space/curve.h"
#include "coupling/cell_record.h"
#include "coupling/mechanics/contact_setup.h"
#include "coupling/mechanics/mechanics.h"
#include "coupling/model.h"
#include "coupling/tissue.h"
#include "dcm/growth.h"

namespace morula::test {

/// One type with the parameters of time_stepping.md §1: R 6, k 0.173, γ 0.5, κ 8.9e-4, K_V 2.5, W 0.1, ξ_cc 50, medium 0.1.
inline Model clusters_model(double adhesion = 0.1) {
  Model model;
  model.space.box = {{-200, -200, -200}, {200, 200, 200}};
  CellType type;
  type.name = "cell";
  type.shell.spring_stiffness = 0.173;
  type.shell.tension = 0.5;
  type.shell.hinge_stiffness = 2.0 / std::sqrt(3.0) * 8.8889e-4;
  type.shell.bulk_modulus = 2.5;
  type.sphere = {0.45, 0.4};
  model.types = {type};
  model.pairs = {ContactPair{adhesion, 50.0, 50.0}};
  model.contact.range = 0.3;
  model.contact.repulsion = 40.0;
  model.contact.points_per_face = 4;
  return model;
}

/// Cells of radius 6 at the given centres; `bodies` says which are shells.
inline Tissue make_tissue(const Model& model, ShapeLibrary& shapes, const std::vector<Vec3d>& centers, const std::vector<BodyKind>& bodies,
                          std::uint32_t nodes = 162, double radius = 6.0) {
  std::vector<CellRecord> cells;
  for (std::size_t i = 0; i < centers.size(); ++i) {
    CellRecord& cell = cells.emplace_back();
    cell.row.id = CellId::founder(i + 1);
    cell.row.order = curve_place(centers[i]);
    const double volume = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
    cell.row.target_volume = cell.row.birth_volume = volume;
    cell.row.division_volume = 2.0 * volume;
    if (bodies[i] == BodyKind::kShell) {
      const auto& p = model.types[0].shell;
      cell.shell = spherical_shell(shapes.icosphere(nodes).value(), centers[i], volume,
                                   dcm::pressure_free_reference(volume, p.tension, p.bulk_modulus));
      place_nucleus(*cell.shell, model.types[0], shapes);
    } else {
      cell.sphere = SphereRecord{centers[i], radius, {}, {}};
    }
  }
  Tissue tissue;
  tissue.clock.next_step = model.step.initial_step;
  put_together(tissue, std::move(cells));
  return tissue;
}

}  // namespace morula::test
