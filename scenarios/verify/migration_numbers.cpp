// Migration: T11.1–T11.4 of dcm.md §11.
#include <cmath>
#include <map>

#include "core/mesh/primitives.h"
#include "core/space/curve.h"
#include "coupling/behaviours/migration.h"
#include "coupling/behaviours/polarity.h"
#include "coupling/cell_record.h"
#include "coupling/protrusion.h"
#include "coupling/simulation.h"
#include "scenarios/verify/lone_shell.h"
#include "scenarios/verify/reference_numbers.h"
#include "scenarios/verify/two_bodies.h"

namespace morula::scenarios {
namespace {

constexpr double kDrag = 45.239, kForce = 1.0, kTime = 60.0;  // Γ [nN·s/µm], σ_F [nN], τ [s] of T11.1
constexpr double kProtrusion = 0.2;                           // F_p [nN]

/// 2000 cells that crawl far from each other in a simulation with the drag Γ, for 20 τ in 200 steps.
struct Walk {
  double diffusion = 0.0, speed = 0.0;  ///< D of ⟨x²⟩ = 2D (t − τ (1 − e^(−t/τ))) and v_rms, per component
};
Walk walk_of_cells() {
  constexpr int kCells = 2000, kSteps = 200, kAlong = 20;
  constexpr double kStep = 6.0, kEnd = kSteps * kStep, kApart = 60.0;
  Model model = lone_cell_model();
  model.space.box = {{-1000, -1000, -1000}, {1000, 1000, 1000}};
  model.contact.range = 5.0;  // nobody is near, and steps are long as the range is
  model.step.initial_step = model.step.max_step = kStep;
  model.types[0].migration.speed = std::sqrt(3.0) * kForce / kDrag;
  model.types[0].migration.own.set("persistence", kTime);
  std::vector<CellRecord> cells(kCells);
  for (int i = 0; i < kCells; ++i) {
    CellRecord& cell = cells[static_cast<std::size_t>(i)];
    cell.row.id = CellId::founder(static_cast<std::uint64_t>(i) + 1);
    cell.row.target_volume = cell.row.birth_volume = ball_volume(kRadius);
    cell.sphere = SphereRecord{Vec3d{i % kAlong - 10.0, i / kAlong % kAlong - 10.0, i / (kAlong * kAlong) - 2.0} * kApart, kRadius, {}, {}};
    cell.row.order = curve_place(cell.sphere->position);
    cell.row.migration_velocity = initial_migration_velocity(cell.row.id, model.types[0], model.seed);
  }
  Tissue tissue;
  tissue.clock.next_step = kStep;
  put_together(tissue, std::move(cells));
  std::map<CellId, Vec3d> start;  // by id: rows are put in a new order now and then
  for (std::size_t i = 0; i < tissue.cells.size(); ++i) start[tissue.cells.rows[i].id] = tissue.spheres.position[i];
  auto made = Simulation::create(std::move(model), std::move(tissue), Comm(), 1);
  if (!made.ok()) return {NAN, NAN};
  Simulation& simulation = **made;
  double square = 0.0, speed = 0.0;
  while (simulation.tissue().clock.time < kEnd) {
    if (!simulation.step(kEnd).ok()) return {NAN, NAN};
    for (const Vec3f& v : simulation.tissue().spheres.velocity) speed += static_cast<double>(norm2(v)) / (3.0 * kCells * kSteps);
  }
  const Tissue& end = simulation.tissue();
  for (std::size_t i = 0; i < end.cells.size(); ++i)
    square += norm2(end.spheres.position[i] - start[end.cells.rows[i].id]) / (3.0 * kCells);
  return {square / (2.0 * (kEnd - kTime * (1.0 - std::exp(-kEnd / kTime)))), std::sqrt(speed)};
}

/// Velocity of a cell with all its laws in one implicit step with a protrusion along x: of its centre by area, which uniform friction holds [µm/s].
double speed_of_protruding_cell(bool internal) {
  Model model = lone_cell_model();
  solve_tightly(model);
  LoneCell cell(model, 162, Size::kNodes);
  const dcm::Shells before = cell.tissue.shells;
  Protrusion law;
  law.internal = internal;
  std::vector<Vec3d> force(162);
  const Vec3d x{1, 0, 0};
  if (!add_protrusion(law, before.topology(0), before.position, x, {}, x, kProtrusion, force)) return NAN;
  constexpr double kStep = 2.0;
  if (!cell.step(kStep, force)) return NAN;
  const SurfaceGeometry at = geometry(before);
  double way = 0.0;
  for (std::size_t i = 0; i < 162; ++i) way += (cell.tissue.shells.position[i].x - before.position[i].x) * at.node_area[i] / at.area[0];
  return way / kStep;
}

/// Velocity of a rigid cell of 452.389 µm² that rubs on a substrate with 41.49 µm² and 50 nN·s/µm³, under a protrusion along it [µm/s].
double speed_on_a_substrate() {
  const double radius = std::sqrt(41.49 / std::numbers::pi), height = (452.389 - 2.0 * 41.49) / (2.0 * std::numbers::pi * radius);
  const TriangleMesh mesh = make_cylinder(radius, height, 0.6).value();
  const dcm::Shells shells = shell_of(mesh);
  const std::size_t nodes = mesh.position.size();
  dcm::ShellParameters p = nothing();
  p.medium_friction = kMedium;
  ContactMaterial material;
  material.law.range = 0.1;
  material.friction = {50.0, 50.0};
  TwoBodies on_substrate(mesh, height, 0.03, material);
  const Vec3d x{1, 0, 0};
  std::vector<Vec3d> force(nodes);
  Protrusion law;
  if (!add_protrusion(law, shells.topology(0), mesh.position, x, {}, x, kProtrusion, force)) return NAN;
  return sum_of(force).x /
         (LoneFriction(shells, p).dissipation(all_alike(nodes, x)) + on_substrate.drag(on_substrate.slide(true, x)).dissipation);
}

/// Mean square of one component of the first polarity of 20,000 cells.
double square_of_polarity(double Vec3d::*component) {
  CellType type;
  type.polarity.set = true;
  constexpr int kCells = 20000;
  double out = 0.0;
  for (std::uint64_t k = 1; k <= kCells; ++k) {
    const double p = initial_polarity(CellId::founder(k), type, 1).*component;
    out += p * p / kCells;
  }
  return out;
}

/// Rotation about z by 1 rad, then about x by 0.7 rad.
Vec3d rotated(const Vec3d& v) {
  const Vec3d a{std::cos(1.0) * v.x - std::sin(1.0) * v.y, std::sin(1.0) * v.x + std::cos(1.0) * v.y, v.z};
  return {a.x, std::cos(0.7) * a.y - std::sin(0.7) * a.z, std::sin(0.7) * a.y + std::cos(0.7) * a.z};
}

/// Largest difference at any node between the protrusion of a rotated mesh along a rotated polarity and the rotated protrusion, over F_p, and of the
/// sum from F_p p; of 100 polarities.
double unlikeness_of_rotated_protrusions() {
  const dcm::Shells shells = sphere(162, Size::kVolume);
  std::vector<Vec3d> turned;
  for (const Vec3d& x : shells.position) turned.push_back(rotated(x));
  const Protrusion law;
  double most = 0.0;
  for (const Vec3d& p : random_directions(100, 8)) {
    std::vector<Vec3d> here(162), there(162);
    if (!add_protrusion(law, shells.topology(0), shells.position, p, {}, p, 1.0, here)) return NAN;
    if (!add_protrusion(law, shells.topology(0), turned, rotated(p), {}, rotated(p), 1.0, there)) return NAN;
    for (std::size_t i = 0; i < 162; ++i) most = larger(most, norm(there[i] - rotated(here[i])));
    most = larger(most, norm(sum_of(here) - p));
  }
  return most;
}

}  // namespace

void add_migration_numbers(std::vector<ReferenceNumber>& out) {
  constexpr const char* kOrnstein = "Ornstein-Uhlenbeck; dcm.md: 5 %, of 2000 cells for 20 tau";
  out.push_back({"T11.1", "diffusion per component under a force of 1 nN that lasts 60 s, drag 45.239 nN s/um [um^2/s]", 0.029318,
                 0.05 * 0.029318, kOrnstein, [] { return walk_of_cells().diffusion; }});
  out.push_back({"T11.1", "root mean square of the velocity per component [um/s]", 0.0221, 0.05 * 0.0221, kOrnstein,
                 [] { return walk_of_cells().speed; }});
  const double free_speed = kProtrusion / (kMedium * 0.98118 * 4.0 * std::numbers::pi * kRadius * kRadius);
  out.push_back({"T11.2", "speed of a cell whose protrusion is internal over F_p/(gamma A), 162 nodes", 0.0, 1e-10, "dcm.md: 1e-10",
                 [free_speed] { return speed_of_protruding_cell(true) / free_speed; }});
  out.push_back({"T11.3", "speed of a free cell whose protrusion pulls outside, F_p/(gamma A), F_p 0.2 nN, 162 nodes [um/s]", free_speed,
                 1e-5 * free_speed, "closed form; A of the mesh computed independently, five digits",
                 [] { return speed_of_protruding_cell(false); }});
  const double held_speed = kProtrusion / (kMedium * 452.389 + 50.0 * 41.49);
  out.push_back({"T11.3", "speed of a rigid cell on a substrate, F_p/(gamma A + gamma_s A_c), F_p 0.2 nN, A_c 41.49 um^2 [um/s]",
                 held_speed, 0.01 * held_speed, "closed form; an end of 38 edges has 0.5 % less area",
                 [] { return speed_on_a_substrate(); }});
  constexpr const char* kIsotropy = "closed form 1/3; three standard errors of 20,000 cells";
  const double error = 3.0 * std::sqrt(4.0 / 45.0 / 20000.0);  // ⟨p_x⁴⟩ − ⟨p_x²⟩² = 1/5 − 1/9
  out.push_back(
      {"T11.4", "mean square of the polarity along x", 1.0 / 3.0, error, kIsotropy, [] { return square_of_polarity(&Vec3d::x); }});
  out.push_back(
      {"T11.4", "mean square of the polarity along z", 1.0 / 3.0, error, kIsotropy, [] { return square_of_polarity(&Vec3d::z); }});
  out.push_back({"T11.4", "largest difference of protrusions that a rotation of the mesh makes, over F_p", 0.0, 1e-12, "closed form",
                 [] { return unlikeness_of_rotated_protrusions(); }});
}

}  // namespace morula::scenarios
