#include "scenarios/verify/lone_shell.h"

#include <cmath>

#include "core/random/philox.h"
#include "coupling/cell_record.h"
#include "coupling/mechanics/contact_setup.h"
#include "dcm/blocks.h"
#include "dcm/derived_parameters.h"
#include "dcm/growth.h"

namespace morula::scenarios {
namespace {

void add_shell(dcm::Shells& out, std::shared_ptr<const ReferenceShape> shape, double size) {
  out.position = scaled(shape->position, size);
  for (const double length : shape->edge_length) out.rest_length.push_back(size * length);
  out.velocity.resize(out.position.size());
  out.first_node.push_back(static_cast<std::uint32_t>(out.position.size()));
  out.first_edge.push_back(static_cast<std::uint32_t>(out.rest_length.size()));
  out.reference_volume.push_back(size * size * size);
  out.rest_volume.push_back(size * size * size);
  out.type.push_back(0);
  out.shape.push_back(std::move(shape));
}

double size_of_mesh(const ReferenceShape& shape, Size size) {
  return size == Size::kNodes ? kRadius / norm(shape.position[0]) : std::cbrt(ball_volume(kRadius));
}

}  // namespace

dcm::Shells sphere(std::uint32_t nodes, Size size) {
  ShapeLibrary shapes;
  const auto shape = shapes.icosphere(nodes).value();
  dcm::Shells out;
  add_shell(out, shape, size_of_mesh(*shape, size));
  return out;
}

dcm::Shells shell_of(const TriangleMesh& mesh) {
  auto topology = Topology::build(static_cast<std::uint32_t>(mesh.position.size()), mesh.faces).value();
  const double size = std::cbrt(enclosed_volume(mesh.faces, mesh.position, {}));
  dcm::Shells out;
  add_shell(out, make_reference_shape(std::move(topology), mesh.position), size);
  return out;
}

dcm::Shells rough(dcm::Shells shells) {
  shells.position = plus(shells.position, random_directions(shells.position.size(), 1), 0.02 * kRadius);
  return shells;
}

dcm::ShellParameters nothing() {
  dcm::ShellParameters p;
  p.spring_stiffness = p.edge_damping = p.hinge_stiffness = p.tension = p.bulk_modulus = p.shape_stiffness = p.barrier_stiffness =
      p.medium_friction = 0.0;
  return p;
}

dcm::ShellMechanics mechanics(const dcm::Shells& shells, const dcm::ShellParameters& parameters, std::span<const Vec3d> position) {
  dcm::ShellMechanics out;
  const std::vector<dcm::ShellParameters> types{parameters};
  dcm::internal_forces(dcm::make_shell_blocks(shells), shells, types, position, out);
  return out;
}

SurfaceGeometry geometry(const dcm::Shells& shells, std::span<const Vec3d> position) {
  const std::vector<const Topology*> topology{shells.shape[0]->topology.get()};
  SurfaceGeometry out;
  compute_surface_geometry({topology, shells.first_node, dcm::make_shell_blocks(shells).first_face}, position, out);
  return out;
}

std::vector<Vec3d> volume_gradient(dcm::Shells shells) {
  shells.reference_volume[0] = geometry(shells).volume[0] * std::numbers::e;  // −K_V ln(V/V0) = 1 for K_V = 1
  dcm::ShellParameters p = nothing();
  p.bulk_modulus = 1.0;
  return mechanics(shells, p).force;
}

LoneFriction::LoneFriction(dcm::Shells shells, const dcm::ShellParameters& parameters)
    : shells_(std::move(shells)), blocks_(dcm::make_shell_blocks(shells_)) {
  const std::vector<dcm::ShellParameters> types{parameters};
  dcm::compute_shell_friction(blocks_, shells_, types, shells_.position, geometry(shells_).node_area, friction_);
}

std::vector<Vec3d> LoneFriction::times(std::span<const Vec3d> velocity) const {
  std::vector<Vec3d> out(velocity.size());
  double quadratic = 0.0;
  dcm::friction_times_displacement(blocks_, shells_, friction_, velocity, out, {&quadratic, 1});
  return out;
}

double LoneFriction::dissipation(std::span<const Vec3d> velocity) const {
  std::vector<Vec3d> out(velocity.size());
  double quadratic = 0.0;
  dcm::friction_times_displacement(blocks_, shells_, friction_, velocity, out, {&quadratic, 1});
  return quadratic;
}

double dot_of(std::span<const Vec3d> a, std::span<const Vec3d> b) {
  double out = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) out += dot(a[i], b[i]);
  return out;
}

double norm_of(std::span<const Vec3d> a) { return std::sqrt(dot_of(a, a)); }

Vec3d sum_of(std::span<const Vec3d> a) {
  Vec3d out{};
  for (const Vec3d& v : a) out += v;
  return out;
}

double size_of(std::span<const Vec3d> a) {
  double out = 0.0;
  for (const Vec3d& v : a) out += norm(v);
  return out;
}

Vec3d torque_of(std::span<const Vec3d> position, std::span<const Vec3d> force) {
  Vec3d out{};
  for (std::size_t i = 0; i < force.size(); ++i) out += cross(position[i], force[i]);
  return out;
}

Balance balance_of(std::span<const Vec3d> position, std::span<const Vec3d> force) {
  double lever = 0.0;
  for (std::size_t i = 0; i < force.size(); ++i) lever += norm(position[i]) * norm(force[i]);
  return {norm(sum_of(force)) / size_of(force), norm(torque_of(position, force)) / lever};
}

std::vector<Vec3d> scaled(std::span<const Vec3d> a, double factor) {
  std::vector<Vec3d> out(a.begin(), a.end());
  for (Vec3d& v : out) v *= factor;
  return out;
}

std::vector<Vec3d> plus(std::span<const Vec3d> a, std::span<const Vec3d> b, double factor) {
  std::vector<Vec3d> out(a.begin(), a.end());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] += b[i] * factor;
  return out;
}

std::vector<Vec3d> all_alike(std::size_t count, const Vec3d& v) { return std::vector<Vec3d>(count, v); }

std::vector<Vec3d> turning(std::span<const Vec3d> position, const Vec3d& rate) {
  std::vector<Vec3d> out;
  for (const Vec3d& x : position) out.push_back(cross(rate, x));
  return out;
}

std::vector<Vec3d> random_directions(std::size_t count, std::uint64_t number) {
  const Random random(1, RandomStream::kOrientation);
  std::vector<Vec3d> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(random.direction(CellId::founder(number), i));
  return out;
}

Model lone_cell_model() {
  Model model;
  model.space.box = {{-200, -200, -200}, {200, 200, 200}};
  CellType type;
  type.name = "cell";
  type.medium_friction = type.shell.medium_friction = kMedium;
  type.shell.spring_stiffness = dcm::spring_stiffness(kYoung, kThickness);
  type.shell.hinge_stiffness = dcm::hinge_stiffness(kYoung, kThickness, kPoisson);
  type.shell.tension = kTension;
  type.shell.bulk_modulus = kBulk;
  model.types = {type};
  model.pairs = {ContactPair{}};
  return model;
}

void solve_tightly(Model& model) {
  model.step.first_tolerance = model.step.later_tolerance = 1e-6;
  model.step.newton_stop = 1e-12;
  model.step.max_newton = 30;
}

Tissue lone_cell(const Model& model, std::uint32_t nodes, Size size) {
  ShapeLibrary shapes;
  const auto shape = shapes.icosphere(nodes).value();
  const double length = size_of_mesh(*shape, size), volume = length * length * length;
  CellRecord cell;
  cell.row.id = CellId::founder(1);
  cell.row.body = cell.row.own_body = BodyKind::kShell;
  cell.row.target_volume = cell.row.birth_volume = volume;
  cell.row.division_volume = 2.0 * volume;
  const dcm::ShellParameters& p = model.types[0].shell;
  const double reference = p.bulk_modulus > 0.0 ? dcm::pressure_free_reference(volume, p.tension, p.bulk_modulus) : volume;
  cell.shell = spherical_shell(shape, {}, volume, reference);
  place_nucleus(*cell.shell, model.types[0], shapes);
  std::vector<CellRecord> cells;
  cells.push_back(std::move(cell));
  Tissue out;
  out.clock.next_step = model.step.initial_step;
  put_together(out, std::move(cells));
  return out;
}

LoneCell::LoneCell(Model model, std::uint32_t nodes, Size size)
    : model_(std::move(model)),
      tissue(lone_cell(model_, nodes, size)),
      mechanics_(model_, contact_obstacles(model_).value(), shapes_, Comm(), 1) {
  tissue.obstacle_offset.resize(model_.obstacles.size());
}

bool LoneCell::step(double dt, std::span<const Vec3d> external) {
  const std::vector<Vec3d> none(Mechanics::external_size(tissue));
  mechanics_.bodies_changed();
  if (!mechanics_.step(tissue, dt, external.empty() ? std::span<const Vec3d>(none) : external).ok()) return false;
  tissue.clock.time += dt;
  ++tissue.clock.steps;
  return true;
}

double LoneCell::energy() {
  std::vector<Vec3d> force;
  mechanics_.bodies_changed();
  return mechanics_.energy_and_forces(tissue, force);
}

}  // namespace morula::scenarios
