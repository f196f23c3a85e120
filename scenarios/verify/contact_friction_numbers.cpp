// Friction: T9.1–T9.5 of dcm.md §9.
#include <algorithm>
#include <cmath>

#include "core/mesh/primitives.h"
#include "coupling/mechanics/node_friction.h"
#include "coupling/simulation.h"
#include "scenarios/verify/lone_shell.h"
#include "scenarios/verify/reference_numbers.h"
#include "scenarios/verify/two_bodies.h"

namespace morula::scenarios {
namespace {

constexpr const char* kClosedForm = "closed form";
/// Weights of the objective form are kept in single precision, 6e-8 each.
constexpr double kSingle = 1e-6;
/// Areas of contact points are kept to 1 in 4096 (core/friction/contact_element.h).
constexpr double kPacked = 1.0 / 4096.0;
constexpr double kGap = 0.03, kRange = 0.1;  // friction acts whole up to half the range

ContactMaterial rubbing() {
  ContactMaterial out;
  out.law.range = kRange;
  out.friction = {50.0, 50.0};
  return out;
}

/// Two plates of 2.5 × 4 µm.
TwoBodies plates(bool objective = false, double gap = kGap) {
  return {make_box({2.5, 4.0, 2.0}, 0.5).value(), 2.0, gap, rubbing(), objective};
}

/// Force on the upper plate that slides at 0.01 µm/s [nN].
double force_between(TwoBodies&& two) {
  const auto drag = two.drag(two.slide(true, {0.01, 0, 0})).force;
  return sum_of(std::span(drag).subspan(drag.size() / 2)).x;
}

/// A cell that takes part in a doublet of w = 0.2 in all but its shape: 452.389 µm² of surface, of which 41.49 µm² are a flat end.
struct Doublet {
  static constexpr double kContact = 41.49, kSurface = 452.389;
  double radius = std::sqrt(kContact / std::numbers::pi);
  double height = (kSurface - 2.0 * kContact) / (2.0 * std::numbers::pi * radius);
  TriangleMesh mesh = make_cylinder(radius, height, 0.6).value();

  /// Velocity of either as a rigid body under ±1 nN: Γ_11 v1 + Γ_12 v2 = 1 with v2 = −v1.
  [[nodiscard]] double velocity() const {
    dcm::ShellParameters p = nothing();
    p.medium_friction = kMedium;
    const LoneFriction medium(shell_of(mesh), p);
    TwoBodies two(mesh, height, kGap, rubbing());
    const auto drag = two.drag(two.slide(false, {1, 0, 0})).force;
    const std::size_t nodes = mesh.position.size();
    const double own = sum_of(std::span(drag).first(nodes)).x, other = sum_of(std::span(drag).subspan(nodes)).x;
    return 1.0 / (medium.dissipation(all_alike(nodes, {1, 0, 0})) + own - other);
  }
};

/// Drag of a whole cell with all its laws: ΣF over the velocity of its centre by area, in one implicit step under 1 nN [nN·s/µm].
double drag_of_a_cell() {
  Model model = lone_cell_model();
  solve_tightly(model);
  CellLoad load;
  load.force = {1.0, 0, 0};
  model.loads = {load};
  model.step.initial_step = model.step.max_step = 2.0;
  auto simulation = Simulation::create(model, lone_cell(model, 642, Size::kNodes), Comm(), 1).value();
  const dcm::Shells before = simulation->tissue().shells;
  if (!simulation->step(1e9).ok()) return NAN;
  const SurfaceGeometry at = geometry(before);
  double way = 0.0;
  for (std::size_t i = 0; i < before.position.size(); ++i)
    way += (simulation->tissue().shells.position[i].x - before.position[i].x) * at.node_area[i] / at.area[0];
  return simulation->tissue().clock.time / way;
}

/// Drag of a rigid cell over its area when a normal motion rubs with 0.3 and a tangential one with 0.06.
double directed_drag() {
  Model model = lone_cell_model();
  model.types[0].medium_normal_extra = 0.24;
  const Tissue tissue = lone_cell(model, 642, Size::kNodes);
  const SurfaceGeometry at = geometry(tissue.shells);
  const Vec3d v = normalized(Vec3d{1, 2, 3});
  double drag = 0.06 * at.area[0];
  for (const auto& block : NodeFriction(model).at(tissue, at)) drag += dot(v, block * v);
  return drag / at.area[0];
}

Balance balance_of_dampers() {
  dcm::ShellParameters p = nothing();
  p.edge_damping = 0.1;
  const LoneFriction dampers(rough(sphere(162, Size::kNodes)), p);
  return balance_of(dampers.shells().position, dampers.times(random_directions(162, 2)));
}
Balance balance_of_contact() {
  // Aside, for meshes that mirror each other would balance whatever each point does; by less than the distance of points from the rim (1/12 µm), for
  // the objective form has no torque where faces are opposed, but some where a point is nearest to an edge.
  TwoBodies two(make_box({2.5, 4.0, 2.0}, 0.5).value(), 2.0, kGap, rubbing(), true, {0.07, 0.05, 0.0});
  return balance_of(two.position(), two.drag(scaled(random_directions(two.position().size(), 2), 0.01)).force);
}

double part_that_turns_taken_off() {
  double held[2];
  for (const bool objective : {false, true}) {
    TwoBodies two = plates(objective);
    held[objective] = two.drag(turning(two.position(), {3e-3, -2e-3, 1e-3})).dissipation;
  }
  return 1.0 - held[1] / held[0];
}

/// −ΔE/Δt over vᵀΓv in one explicit step of a stretched cell of 162 nodes, less 1: the error of the step, of first order.
double excess_of_dissipation(double dt) {
  Model model = lone_cell_model();
  model.step.integrator = Integrator::kExplicitEuler;
  LoneCell cell(model, 162);
  for (Vec3d& x : cell.tissue.shells.position) x = {1.2 * x.x, x.y, x.z / 1.2};
  const dcm::Shells start = cell.tissue.shells;
  const double before = cell.energy();
  if (!cell.step(dt)) return NAN;
  const LoneFriction friction(start, model.types[0].shell);
  const double dissipated = friction.dissipation(plus(cell.tissue.shells.position, start.position, -1.0)) / dt;
  return (before - cell.energy()) / dissipated - 1.0;
}

void add_balances(std::vector<ReferenceNumber>& out) {
  constexpr const char* kBound = "dcm.md: 1e-12";
  constexpr const char* kSingleBound = "dcm.md: 1e-12; weights in single precision";
  out.push_back(
      {"T9.4", "net force of the dampers over the sum of their forces", 0.0, 1e-12, kBound, [] { return balance_of_dampers().force; }});
  out.push_back(
      {"T9.4", "net torque of the dampers over the sum of their levers", 0.0, 1e-12, kBound, [] { return balance_of_dampers().torque; }});
  out.push_back({"T9.4", "net force of the friction of a contact over the sum of its forces", 0.0, 1e-12, kBound,
                 [] { return balance_of_contact().force; }});
  out.push_back({"T9.4", "net torque of its objective form over the sum of the levers", 0.0, kSingle, kSingleBound,
                 [] { return balance_of_contact().torque; }});
  out.push_back({"T9.4", "part of the friction of a contact of parallel faces that turns as a whole which the objective form takes off",
                 1.0, 1e-6, "closed form: exact for opposed parallel faces", [] { return part_that_turns_taken_off(); }});
}

}  // namespace

void add_contact_friction_numbers(std::vector<ReferenceNumber>& out) {
  out.push_back({"T9.1", "force between plates of 10 um^2 that slide at 0.01 um/s, friction 50 nN s/um^3 [nN]", 5.0, 5.0 * kPacked,
                 "closed form gamma S v; areas of points are kept to 1 in 4096", [] { return force_between(plates()); }});
  out.push_back({"T9.1", "the same between plates of 9 um^2, whose points have areas that are kept exactly (3/32 um^2) [nN]", 4.5, 4.5e-10,
                 "closed form; dcm.md: 1e-10", [] {
                   return force_between({make_box({3.0, 3.0, 2.0}, 0.75).value(), 2.0, kGap, rubbing()});
                 }});
  // Told is what is nearer than half the range. Points count whole up to a quarter of it and not at all from three quarters: at these gaps the area is that
  // of the overlap, and none, but for the rounding of 1e-16 of each of some hundred points.
  out.push_back({"T9.1", "told area in contact of these plates of 10 um^2 at a gap of 0.2 of the range [um^2]", 10.0, 1e-12,
                 "closed form: the faces overlap whole", [] { return plates(false, 0.2 * kRange).area(); }});
  out.push_back({"T9.1", "the same at a gap of 0.8 of the range [um^2]", 0.0, 1e-12, "closed form: no point is nearer than half the range",
                 [] { return plates(false, 0.8 * kRange).area(); }});
  out.push_back({"T9.2", "drag of a cell with all its laws under 1 nN, 642 nodes [nN s/um]", 45.023, 5.1e-4,
                 "area of the mesh computed independently", [] { return drag_of_a_cell(); }});
  out.push_back({"T9.2", "drag per area of a rigid cell, friction 0.3 across and 0.06 along its surface [nN s/um^3]", 0.14, 1e-10,
                 kClosedForm, [] { return directed_drag(); }});
  out.push_back({"T9.3", "velocity of a cell of a rigid doublet (w = 0.2) sheared by 1 nN [um/s]", 2.384e-4, 0.01 * 2.384e-4,
                 "closed form F/(Gamma + 2 Gamma_c); the ends of 38 edges have 0.5 % less area; dcm.md: 3 %",
                 [] { return Doublet().velocity(); }});
  add_balances(out);
  out.push_back({"T9.5", "energy that a stretched cell loses in explicit steps over its dissipation, extrapolated from 0.005 and 0.01 s",
                 1.0, 1e-3, "closed form: -dE/dt = v Gamma v",
                 [] { return 1.0 + 2.0 * excess_of_dissipation(0.005) - excess_of_dissipation(0.01); }});
  out.push_back({"T9.5", "what is more of it at 0.01 s over that at 0.005 s", 2.0, 0.1, "closed form: first order",
                 [] { return excess_of_dissipation(0.01) / excess_of_dissipation(0.005); }});
}

}  // namespace morula::scenarios
