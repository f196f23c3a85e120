#include <cmath>
#include <numbers>

#include "coupling/cell_record.h"
#include "coupling/face_marks.h"
#include "coupling/lumens.h"
#include "coupling/mechanics/face_tensions.h"
#include "coupling/mechanics/node_terms.h"
#include "dcm/blocks.h"
#include "scenarios/verify/reference_numbers.h"

namespace morula::scenarios {
namespace {

constexpr double kRadius = 6.0;

/// One cell of 642 nodes on a sphere of radius 6, and a model with a cap of 60 degrees as its first mark.
struct OneCell {
  Model model;
  Tissue tissue;
  SurfaceGeometry geometry;

  OneCell() {
    model.types.emplace_back();
    model.mark_names = {"cap"};
    FaceMark cap;
    cap.angle = std::numbers::pi / 3.0;
    model.marks = {cap};
    ShapeLibrary shapes;
    std::vector<CellRecord> cells(1);
    cells[0].row.id = CellId::founder(1);
    cells[0].shell = spherical_shell(shapes.icosphere(642).value(), {}, 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius, 1.0);
    for (Vec3d& x : cells[0].shell->position) x = normalized(x) * kRadius;
    put_together(tissue, std::move(cells));
    mark_new_shells(model, tissue);
    const std::vector<const Topology*> topology{&tissue.shells.topology(0)};
    compute_surface_geometry({topology, tissue.shells.first_node, dcm::make_shell_blocks(tissue.shells).first_face}, tissue.shells.position,
                             geometry);
  }
};

double cap_area() {
  const OneCell c;
  return marked_area(c.tissue.shells.topology(0), c.tissue.shells.position, c.tissue.shells.faces_of(0).mark, 0) / c.geometry.area[0];
}

/// −x·F of the extra tension 0.6 on the whole surface, over 2 A: the tension itself (virial).
double tension_by_virial() {
  OneCell c;
  c.model.types[0].shell.tension = 0.5;
  TensionRegion whole;
  whole.tension = 1.1;
  c.model.types[0].regional_tension.regions = {whole};
  FaceTensions tensions(c.model);
  tensions.set(c.tissue, 0.0);
  std::vector<Vec3d> force(c.tissue.shells.node_count());
  OrderFreeSum energy;
  tensions.add_forces(c.tissue.shells, c.tissue.shells.position, force, energy);
  double virial = 0.0;
  for (std::size_t i = 0; i < force.size(); ++i) virial -= dot(force[i], c.tissue.shells.position[i]);
  return 0.5 + virial / (2.0 * c.geometry.area[0]);
}

double directed_drag() {
  OneCell c;
  c.model.types[0].medium_normal_extra = 0.24;
  const auto blocks = NodeTerms(c.model).friction(c.tissue, c.geometry);
  const Vec3d v = normalized(Vec3d{1, 2, 3});
  double drag = 0.06 * c.geometry.area[0];
  for (const auto& block : blocks) drag += dot(v, block * v);
  return drag / c.geometry.area[0];
}

/// |ΣF|/(P A) of a uniform pressure on the whole closed surface.
double net_force_of_fluid() {
  OneCell c;
  Lumen lumen;
  lumen.by_sight = false;
  lumen.pressure = 0.02;
  c.model.lumens = {lumen};
  c.tissue.shells.faces_of(0).mark.assign(c.tissue.shells.topology(0).face_count(), 1);
  c.tissue.lumens.resize(1);
  c.tissue.lumens[0].covered = 1.0;
  std::vector<Vec3d> force(c.tissue.shells.node_count());
  add_lumen_forces(c.model, c.tissue, 0.0, Comm(), force);
  Vec3d sum{};
  for (const Vec3d& f : force) sum += f;
  return norm(sum) / (lumen.pressure * c.geometry.area[0]);
}

}  // namespace

void add_active_numbers(std::vector<ReferenceNumber>& out) {
  constexpr const char* kClosedForm = "closed form";
  out.push_back({"dcm 4", "part of a sphere in a cone of 60 degrees, by faces of 642 nodes", 0.25, 0.005, kClosedForm, &cap_area});
  out.push_back({"T4.2", "tension of a region by the virial of its forces [nN/um]", 1.1, 1e-9, kClosedForm, &tension_by_virial});
  out.push_back({"T9.2", "drag per area of a rigid cell, friction 0.3 across and 0.06 along its surface [nN s/um^3]", 0.14, 1e-10,
                 kClosedForm, &directed_drag});
  out.push_back(
      {"T15.3", "net force of a fluid around a closed surface over pressure times area", 0.0, 1e-12, kClosedForm, &net_force_of_fluid});
  out.push_back(
      {"lumen", "pressure of 19.389 uM of solute at 310 K [kPa]", 0.050, 5e-6, "van 't Hoff 1887", [] { return kGasEnergy * 19.389e-3; }});
}

}  // namespace morula::scenarios
