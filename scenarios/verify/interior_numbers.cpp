// Nucleus and cytoskeleton: T12.1–T12.4 of dcm.md §12.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "core/mesh/mesh_check.h"
#include "core/mesh/primitives.h"
#include "coupling/simulation.h"
#include "dcm/interior.h"
#include "dcm/laws/nucleus_repulsion.h"
#include "dcm/nuclear_shell.h"
#include "scenarios/verify/lone_shell.h"
#include "scenarios/verify/reference_numbers.h"

namespace morula::scenarios {
namespace {

constexpr double kVolume = ball_volume(kRadius);
constexpr const char* kClosedForm = "closed form";

/// Force per displacement of a nucleus on links from all nodes of 162, 0.01 nN/um each.
double hold_of_links() {
  ShapeLibrary shapes;
  const auto shape = shapes.icosphere(162).value();
  dcm::InteriorParameters p;
  p.nucleus_fraction = 0.0723;
  p.nucleus_links = {dcm::LinkParameters::kAll, 0.01, 0.0, false};
  const dcm::InteriorLinks links = dcm::choose_links(*shape, p);
  const Vec3d nucleus{1e-5, 0, 0};
  dcm::InteriorView cell;
  cell.parameters = &p;
  cell.links = &links;
  cell.topology = shape->topology.get();
  cell.node = shape->position;
  cell.nucleus = &nucleus;
  cell.rest_volume = 1.0;
  std::vector<Vec3d> force(162);
  Vec3d pull;
  dcm::add_interior_forces(cell, force, &pull);
  return -pull.x / nucleus.x;
}

/// A nucleus of 162 nodes and 2.5 um radius in a cell of 6 um with as many, links from all nodes.
struct NucleusAtRest {
  ShapeLibrary shapes;
  std::shared_ptr<const ReferenceShape> shape = shapes.icosphere(162).value();
  dcm::InteriorParameters parameters;
  std::vector<dcm::InteriorLink> links;
  std::vector<Vec3d> cell, nucleus;

  NucleusAtRest() {
    parameters.nucleus_fraction = 2.5 * 2.5 * 2.5 / (kRadius * kRadius * kRadius);
    parameters.nucleus_links = {dcm::LinkParameters::kAll, 0.01, 0.0, false};
    links = dcm::choose_nuclear_links(*shape, *shape, parameters);
    for (const Vec3d& x : shape->position) {
      cell.push_back(x * std::cbrt(kVolume));
      nucleus.push_back(x * std::cbrt(kVolume * parameters.nucleus_fraction));
    }
  }
  [[nodiscard]] dcm::NucleusView view() const {
    return {&parameters, links, shape->topology.get(), shape->topology.get(), cell, nucleus, kVolume};
  }
};

/// Force per displacement of the nucleus as a whole.
double hold_of_links_to_a_shell() {
  NucleusAtRest rest;
  constexpr double shift = 1e-5;
  for (Vec3d& x : rest.nucleus) x.x += shift;
  std::vector<Vec3d> on_cell(162), on_nucleus(162);
  (void)dcm::add_nuclear_link_forces(rest.view(), {on_cell, on_nucleus});
  double sum = 0.0;
  for (const Vec3d& f : on_nucleus) sum += f.x;
  return -sum / shift;
}

/// Force per velocity of the nucleus as a whole, without its links.
double drag_of_a_shell() {
  NucleusAtRest rest;
  rest.links.clear();
  dcm::NuclearFriction friction;
  const std::vector<double> areas(162, 1.0);  // what counts is how they compare
  dcm::find_nuclear_friction(rest.view(), areas, areas, friction);
  std::vector<Vec3d> still(162), way(162, Vec3d{1, 0, 0}), on_cell(162), on_nucleus(162);
  (void)dcm::add_nuclear_friction(rest.view(), friction, {still, way}, {on_cell, on_nucleus});
  double sum = 0.0;
  for (const Vec3d& f : on_nucleus) sum += f.x;
  return sum;
}

/// A rough cell of 162 nodes with a rigid nucleus of 2.5 µm that overlaps its cortex, on links, and links across.
Balance balance_with_rigid_nucleus() {
  const dcm::Shells shells = rough(sphere(162, Size::kVolume));
  dcm::InteriorParameters p;
  p.nucleus_fraction = ball_volume(2.5) / kVolume;
  p.nucleus_links = p.cortex_links = {dcm::LinkParameters::kAll, 0.01, 0.0, false};
  const dcm::InteriorLinks links = dcm::choose_links(*shells.shape[0], p);
  const Vec3d nucleus{3.0, -2.0, 1.0};  // 3.74 µm from the centre
  const dcm::InteriorView cell{&p, &links, &shells.topology(0), shells.position, &nucleus, kVolume, 40.0};
  std::vector<Vec3d> force(162), position = shells.position;
  Vec3d on_nucleus;
  if (dcm::add_interior_forces(cell, force, &on_nucleus).push == 0.0) return {NAN, NAN};
  force.push_back(on_nucleus);
  position.push_back(nucleus);
  return balance_of(position, force);
}

/// A cell and a nucleus that is a shell, rough and apart, on links and in the cytosol's drag.
Balance balance_with_nuclear_shell() {
  NucleusAtRest rest;
  rest.cell = plus(rest.cell, random_directions(162, 20), 0.12);
  rest.nucleus = plus(rest.nucleus, random_directions(162, 21), 0.05);
  for (Vec3d& x : rest.nucleus) x.x += 1.0;
  std::vector<Vec3d> on_cell(162), on_nucleus(162);
  (void)dcm::add_nuclear_link_forces(rest.view(), {on_cell, on_nucleus});
  dcm::NuclearFriction friction;
  const std::vector<double> areas(162, 1.0);
  dcm::find_nuclear_friction(rest.view(), areas, areas, friction);
  auto way = random_directions(162, 22), nucleus_way = random_directions(162, 23);
  (void)dcm::add_nuclear_friction(rest.view(), friction, {way, nucleus_way}, {on_cell, on_nucleus});
  std::vector<Vec3d> position = rest.cell;
  position.insert(position.end(), rest.nucleus.begin(), rest.nucleus.end());
  on_cell.insert(on_cell.end(), on_nucleus.begin(), on_nucleus.end());
  return balance_of(position, on_cell);
}

/// Force of a rigid nucleus of 2.5 µm, 100 kPa/µm, on the upper of two flat cortices at ±half [nN].
double push_on_flat_cortex(double half) {
  const TriangleMesh mesh = make_box({6.0, 6.0, 2.0 * half}, 0.1).value();
  const auto topology = Topology::build(static_cast<std::uint32_t>(mesh.position.size()), mesh.faces).value();
  dcm::InteriorParameters p;
  p.nucleus_fraction = ball_volume(2.5) / kVolume;
  const dcm::InteriorLinks none;
  const Vec3d nucleus{};
  const dcm::InteriorView cell{&p, &none, topology.get(), mesh.position, &nucleus, kVolume, 100.0};
  std::vector<Vec3d> force(mesh.position.size());
  Vec3d on_nucleus;
  (void)dcm::add_interior_forces(cell, force, &on_nucleus);
  double up = 0.0;
  for (std::size_t i = 0; i < force.size(); ++i) up += mesh.position[i].z > 0.0 ? force[i].z : 0.0;
  return up;
}

/// A flattened cell of 162 nodes with a nucleus of 4.2 µm between two plates that come from 8.6 to 8.1 µm and then stand still.
class SqueezedNucleus {
 public:
  /// Sum of the forces on the plates at rest, over the larger.
  [[nodiscard]] double unrest() { return measured().unrest; }
  /// Sum of the forces on cortex, nucleus and plates, over the same.
  [[nodiscard]] double imbalance() { return measured().imbalance; }
  /// Solid angle of the cortex about the centre of the nucleus over 4π, where it differs most from 1 in the run.
  [[nodiscard]] double winding() { return measured().winding; }

 private:
  struct Measured {
    double unrest = NAN, imbalance = NAN, winding = NAN;
  };
  static constexpr double kGap = 8.6, kSpeed = 0.02, kMoves = 25.0, kEnd = 600.0;

  static Model model() {
    Model out = lone_cell_model();
    solve_tightly(out);
    out.contact.repulsion = 100.0;
    out.types[0].interior.nucleus_fraction = ball_volume(4.2) / kVolume;
    TriangleMesh lower = make_box({40, 40, 4}, 10.0).value(), upper = lower;
    for (Vec3d& x : lower.position) x.z -= 2.0 + 0.5 * kGap;
    for (Vec3d& x : upper.position) x.z += 2.0 + 0.5 * kGap;
    ObstacleSpec below, above;
    below.name = "lower", below.position = lower.position, below.faces = lower.faces;
    above.name = "upper", above.position = upper.position, above.faces = upper.faces;
    above.direction = {0, 0, -1};
    above.distance = {{0.0, kMoves}, {0.0, kSpeed * kMoves}};
    out.obstacles = {below, above};
    out.pairs.assign(9, ContactPair{0.0, 0.1, 0.1});
    out.step.max_step = 60.0;
    return out;
  }
  /// Of the forces on the nodes, and of that on the nucleus by the law alone.
  static Vec3d sum_of_all(Simulation& simulation) {
    const Tissue& tissue = simulation.tissue();
    std::vector<Vec3d> force, of_law(tissue.shells.node_count());
    (void)simulation.mechanics().energy_and_forces(tissue, force);
    const dcm::InteriorParameters& p = simulation.model().types[0].interior;
    const dcm::InteriorLinks none;
    const ContactNumerics& contact = simulation.model().contact;
    Vec3d on_nucleus;
    (void)dcm::add_interior_forces({&p, &none, &tissue.shells.topology(0), tissue.shells.position, tissue.shells.nucleus_of(0),
                                    tissue.shells.rest_volume[0], contact.repulsion, contact.points_per_face},
                                   of_law, &on_nucleus);
    return sum_of(force) + on_nucleus;
  }
  const Measured& measured() {
    if (measured_) return *measured_;
    measured_.emplace();
    Tissue tissue = lone_cell(model(), 162);
    for (Vec3d& x : tissue.shells.position) x = {x.x / std::sqrt(0.7), x.y / std::sqrt(0.7), 0.7 * x.z};
    auto simulation = Simulation::create(model(), std::move(tissue), Comm(), 1).value();
    double winding = 1.0;
    while (simulation->tissue().clock.time < kEnd) {
      if (!simulation->step(simulation->tissue().clock.time < kMoves ? kMoves : kEnd).ok()) return *measured_;
      const dcm::Shells& shells = simulation->tissue().shells;
      const double now = winding_number(shells.position, shells.topology(0).faces(), *shells.nucleus_of(0));
      if (std::abs(now - 1.0) > std::abs(winding - 1.0)) winding = now;
    }
    if (simulation->mechanics().interior_of(0).push == 0.0) return *measured_;  // not squeezed
    const auto plate = simulation->mechanics().obstacle_forces(simulation->tissue());
    const double one = std::max(norm(plate[0]), norm(plate[1]));
    *measured_ = {norm(plate[0] + plate[1]) / one, norm(sum_of_all(*simulation) + plate[0] + plate[1]) / one, winding};
    return *measured_;
  }
  std::optional<Measured> measured_;
};

void add_balances(std::vector<ReferenceNumber>& out) {
  constexpr const char* kBound = "dcm.md: 1e-12";
  out.push_back({"T12.2", "net force of a cell and its rigid nucleus over the sum of the forces", 0.0, 1e-12, kBound,
                 [] { return balance_with_rigid_nucleus().force; }});
  out.push_back(
      {"T12.2", "their net torque over the sum of the levers", 0.0, 1e-12, kBound, [] { return balance_with_rigid_nucleus().torque; }});
  out.push_back({"T12.2", "net force of a cell and a nucleus that is a shell, with drag", 0.0, 1e-12, kBound,
                 [] { return balance_with_nuclear_shell().force; }});
  out.push_back({"T12.2", "their net torque over the sum of the levers, with drag", 0.0, 1e-12, kBound,
                 [] { return balance_with_nuclear_shell().torque; }});
}

void add_squeezing(std::vector<ReferenceNumber>& out) {
  constexpr double half = 2.4, exact = std::numbers::pi * 100.0 * half * 0.1 * 0.1;
  out.push_back({"T12.3", "push of a nucleus of 2.5 um on flat cortices 5.002 um apart [nN]", 0.0, 1e-12, "closed form: nothing touches",
                 [] { return push_on_flat_cortex(2.501); }});
  out.push_back({"T12.3", "the same 4.8 um apart, k_r 100 kPa/um [nN]", exact, 0.01 * exact,
                 "closed form pi k_r d (R_n - d)^2 at half the distance d; 1 % for faces of 0.1 um",
                 [] { return push_on_flat_cortex(half); }});
  const auto squeezed = std::make_shared<SqueezedNucleus>();
  out.push_back({"T12.3", "sum of the forces on a cell, its nucleus of 8.4 um and two plates 8.1 um apart, over that on a plate", 0.0, 1e-8,
                 "dcm.md: 1e-8", [squeezed] { return squeezed->imbalance(); }});
  // a step ends when the energy could fall by 1e-12 of its 200 fJ: forces of √(2 · 1 nN/µm · 2e-10 fJ) = 2e-5 nN at some nodes, and 22 nN on a plate
  out.push_back({"T12.3", "sum of the forces on these plates at rest, over that on one", 0.0, 1e-5,
                 "at rest; steps end at 1e-12 of the energy, whose root is 1e-6 of the force", [squeezed] { return squeezed->unrest(); }});
  out.push_back({"T12.4", "winding number of the cortex about that nucleus, furthest from 1 in the run", 1.0, 1e-9, kClosedForm,
                 [squeezed] { return squeezed->winding(); }});
}

}  // namespace

void add_interior_numbers(std::vector<ReferenceNumber>& out) {
  out.push_back({"T12", "drag of a nucleus of 2.5 um in 1 Pa s [nN s/um]", 0.04712, 5e-6, "Stokes",
                 [] { return dcm::CytoplasmDrag{1e-3}.coefficient(2.5); }});
  out.push_back({"T12.1", "stiffness that 162 links of 0.01 nN/um give a nucleus: N k/3 [nN/um]", 0.540, 1e-5, kClosedForm,
                 [] { return hold_of_links(); }});
  out.push_back({"T12", "drag of a nucleus of 2.5 um that is a shell, in 1 Pa s [nN s/um]", 0.04712, 5e-6, "Stokes",
                 [] { return drag_of_a_shell(); }});
  out.push_back({"T12.1", "stiffness that 162 links of 0.01 nN/um give a nucleus that is a shell: N k/3 [nN/um]", 0.540, 1e-5, kClosedForm,
                 [] { return hold_of_links_to_a_shell(); }});
  add_balances(out);
  add_squeezing(out);
}

}  // namespace morula::scenarios
