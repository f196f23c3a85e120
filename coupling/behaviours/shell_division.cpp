#include "coupling/behaviours/shell_division.h"

#include <algorithm>
#include <cmath>

#include "core/contact/sister_bond.h"
#include "core/mesh/renewal/divide_surface.h"
#include "coupling/new_mesh.h"

namespace morula {
namespace {

dcm::ShellRecord make_shell(const NewMesh& mesh, const CellType& type, std::shared_ptr<const ReferenceShape> shape, double part,
                            double target) {
  dcm::ShellRecord out;
  carry_columns(mesh, part, out);
  out.position.assign(mesh.position.begin(), mesh.position.end());
  out.rest_volume = target;
  const bool eases = type.new_surface > 0.0 || type.shell.turnover_rate > 0.0;
  out.rest_length = eases && dcm::has_elastic_surface(type.shell) ? carried_rest_lengths(mesh, dcm::strains_faces(type.shell))
                                                                  : free_rest_lengths(*shape, target);
  out.shape = std::move(shape);
  return out;
}

}  // namespace

Result<std::array<dcm::ShellRecord, 2>> divide_shell(const ShellToDivide& what, const Vec3d& axis, double share,
                                                     const std::array<double, 2>& target) {
  const dcm::ShellRecord& mother = *what.shell;
  DivisionPlan plan;
  plan.normal = axis;
  plan.share = share;
  plan.shape = what.shape.get();
  plan.neighbours = what.neighbours;
  MORULA_TRY_ASSIGN(const Division division, divide_surface({mother.position, mother.shape->topology.get()}, plan));
  std::array<dcm::ShellRecord, 2> out;
  for (std::size_t k = 0; k < 2; ++k) {
    const Daughter& daughter = division.daughter[k];
    const NewMesh mesh{mother, division.asked[k], division.cut.half[k].source_face, *what.shape, daughter.position, daughter.is_cap};
    out[k] = make_shell(mesh, *what.type[k], what.shape, k == 0 ? share : 1.0 - share, target[k]);
  }
  return out;
}

double newness_of_surface(const CellRow& row, const CellType& type, double time) {
  return row.parent.valid() ? newness_of_interface(time - row.birth_time, type.new_surface) : 0.0;
}

void renew_surfaces(std::span<const CellType> types, const Cells& cells, dcm::Shells& shells, double time, double dt) {
  const auto renews = [](const CellType& type) {
    return type.new_surface > 0.0 && !(type.shell.turnover_rate > 0.0) && dcm::has_elastic_surface(type.shell);
  };
  if (shells.size() == 0 || std::ranges::none_of(types, renews)) return;
  for (const BodyOfRow& body : bodies_of(cells)) {
    const CellRow& row = cells.rows[body.row];
    const CellType& type = types[row.type];
    if (!body.is_shell || !renews(type)) continue;
    const double before = newness_of_surface(row, type, time - dt);
    if (!(before > 0.0)) continue;
    const double keep = newness_of_surface(row, type, time) / before;
    const std::vector<double> free = free_rest_lengths(*shells.shape[body.number], shells.rest_volume[body.number]);
    double* rest = shells.rest_length.data() + shells.first_edge[body.number];
    for (std::size_t k = 0; k < free.size(); ++k) rest[k] = free[k] + (rest[k] - free[k]) * keep;
  }
}

}  // namespace morula
