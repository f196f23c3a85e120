// Marked faces and lumens: T15.2 and T15.3 of dcm.md §15.
#include <cmath>
#include <numbers>

#include "coupling/cell_record.h"
#include "coupling/face_marks.h"
#include "coupling/lumens.h"
#include "scenarios/verify/lone_shell.h"
#include "scenarios/verify/reference_numbers.h"

namespace morula::scenarios {
namespace {

/// One cell of 642 nodes on a sphere of radius 6, and a model with a cap of 60 degrees as its first mark.
struct OneCell {
  Model model = lone_cell_model();
  Tissue tissue = lone_cell(model, 642, Size::kNodes);

  OneCell() {
    model.mark_names = {"cap"};
    FaceMark cap;
    cap.angle = std::numbers::pi / 3.0;
    model.marks = {cap};
    mark_new_shells(model, tissue);
  }
  [[nodiscard]] double area() const { return geometry(tissue.shells).area[0]; }
};

double cap_area() {
  const OneCell c;
  return marked_area(c.tissue.shells.topology(0), c.tissue.shells.position, c.tissue.shells.marks_of(0), 0) / c.area();
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
  return norm(sum) / (lumen.pressure * c.area());
}

/// Part of all directions from a cavity in which there is a marked face: twelve cells of 19 µm and 2562 nodes along the corners of an icosahedron, 30 µm
/// away, which leave no gap.
double marked_part_of_a_cavity() {
  Model model = lone_cell_model();
  model.mark_names = {"cavity"};
  Lumen lumen;
  lumen.center = {0.3, -0.2, 0.1};
  lumen.pressure = 0.02;
  model.lumens = {lumen};
  ShapeLibrary shapes;
  const auto shape = shapes.icosphere(2562).value();
  std::vector<CellRecord> cells;
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  for (const double a : {-1.0, 1.0})
    for (const double b : {-golden, golden})
      for (const Vec3d& corner : {Vec3d{0, a, b}, Vec3d{a, b, 0}, Vec3d{b, 0, a}}) {
        CellRecord& cell = cells.emplace_back();
        cell.row.id = CellId::founder(cells.size());
        cell.row.body = BodyKind::kShell;
        cell.shell = spherical_shell(shape, normalized(corner) * 30.0, ball_volume(19.0), ball_volume(19.0));
      }
  Tissue tissue;
  put_together(tissue, std::move(cells));
  mark_new_shells(model, tissue);
  look_into_lumens(model, {}, tissue, Comm());
  return tissue.lumens[0].covered;
}

}  // namespace

void add_active_numbers(std::vector<ReferenceNumber>& out) {
  constexpr const char* kClosedForm = "closed form";
  out.push_back({"dcm 4", "part of a sphere in a cone of 60 degrees, by faces of 642 nodes", 0.25, 0.005, kClosedForm, &cap_area});
  out.push_back(
      {"T15.2", "marked part of a closed cavity between twelve cells of 2562 nodes", 1.0, 1e-3, "dcm.md: 100 %", &marked_part_of_a_cavity});
  out.push_back(
      {"T15.3", "net force of a fluid around a closed surface over pressure times area", 0.0, 1e-12, kClosedForm, &net_force_of_fluid});
}

}  // namespace morula::scenarios
