// Numbers of contacts that are known whatever the cell: a rigid ball that leaves a plane, and pipettes.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/mesh/primitives.h"
#include "coupling/cell_record.h"
#include "coupling/face_marks.h"
#include "coupling/mechanics/contact_setup.h"
#include "coupling/mechanics/mechanics.h"
#include "scenarios/library/theory.h"
#include "scenarios/verify/reference_numbers.h"

namespace morula::scenarios {
namespace {

constexpr double kRadius = 6.0, kAdhesion = 0.1, kRange = 0.5;

/// A ball of 642 nodes above a plane, moved as one rigid body. `capped`: its lower cap has the adhesion, all else three times as much.
class RigidBall {
 public:
  explicit RigidBall(bool capped = false)
      : model_(model(capped)), mechanics_(model_, contact_obstacles(model_).value(), shapes_, Comm(), 1) {
    CellRecord cell;
    const double volume = 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius;
    cell.row.id = CellId::founder(1);
    cell.row.body = BodyKind::kShell;
    cell.row.target_volume = cell.row.birth_volume = volume;
    cell.shell = spherical_shell(shapes_.icosphere(642).value(), {0, 0, 2.0 * kRadius}, volume, volume);
    std::vector<CellRecord> cells;
    cells.push_back(std::move(cell));
    put_together(tissue_, std::move(cells));
    tissue_.obstacle_offset.resize(1);
    mark_new_shells(model_, tissue_);
  }

  /// Pull of the plane on the ball when the sphere that the mesh stands for (of its volume) is `gap` above the plane [nN].
  double pull(double gap) {
    double center = 0.0;
    for (const Vec3d& x : tissue_.shells.position) center += x.z / static_cast<double>(tissue_.shells.position.size());
    for (Vec3d& x : tissue_.shells.position) x.z += gap + kRadius - center;
    mechanics_.bodies_changed();
    return mechanics_.obstacle_forces(tissue_)[0].z;
  }

 private:
  static Model model(bool capped) {
    Model out;
    out.space.box = {{-50, -50, -50}, {50, 50, 50}};
    CellType type;
    type.name = "ball";
    out.types = {type};
    const TriangleMesh box = make_box({60, 60, 6}, 6.0).value();
    ObstacleSpec plane;
    plane.name = "plane";
    plane.position = box.position;
    for (Vec3d& x : plane.position) x.z -= 3.0;
    plane.faces = box.faces;
    out.obstacles = {std::move(plane)};
    out.pairs.assign(4, ContactPair{kAdhesion, 0.0, 0.0});
    out.contact.range = kRange;
    if (!capped) return out;
    FaceMark low;
    low.axis = {0, 0, -1};
    low.angle = 1.0;
    out.mark_names = {"low"};
    out.marks = {low};
    for (ContactPair& pair : out.pairs) pair.adhesion = 3.0 * kAdhesion;
    out.pairs[1].regions = {{1, 0, kAdhesion}};
    out.pairs[2].regions = {{0, 1, kAdhesion}};
    return out;
  }

  ShapeLibrary shapes_;
  Model model_;
  Tissue tissue_;
  Mechanics mechanics_;
};

double largest_pull(bool capped) {
  RigidBall ball(capped);
  double out = 0.0;
  for (int i = -20; i <= 40; ++i) out = std::max(out, ball.pull(0.005 * i));
  return out;
}

/// Work of lifting the ball from touching to out of range, over π R c: W.
double adhesion_from_work() {
  RigidBall ball;
  constexpr int kSteps = 60;
  double work = 0.0;
  for (int i = 0; i <= kSteps; ++i) work += ball.pull(kRange * i / kSteps) * kRange / kSteps * (i == 0 || i == kSteps ? 0.5 : 1.0);
  return work / (std::numbers::pi * kRadius * kRange);
}

/// Two blocks whose flat faces of 4 × 4 µm lie 0.1 µm apart, in a contact layer of their own with friction alone.
class TwoBlocks {
 public:
  explicit TwoBlocks(bool objective)
      : layer_({.range = 0.2, .skin = 1.0, .body_skin = 2.0, .objective_friction = objective}, {}, {material()}, 1) {
    const TriangleMesh mesh = make_box({4.0, 4.0, 2.0}, 0.8).value();
    topology_ = Topology::build(static_cast<std::uint32_t>(mesh.position.size()), mesh.faces).value();
    const std::uint32_t nodes = topology_->node_count(), faces = topology_->face_count();
    for (std::uint32_t k = 0; k < 2; ++k) {
      ContactBody& body = bodies_.emplace_back();
      body.id = CellId::founder(k + 1);
      body.place = k;
      body.shape = BodyShape::kSurface;
      body.point_count = nodes;
      body.first_point = k * nodes;
      for (const Vec3d& x : mesh.position) position_.push_back(x + Vec3d{0.0, 0.0, 2.1 * k});
    }
    const std::uint32_t first_node[3] = {0, nodes, 2 * nodes};
    topologies_[0] = topologies_[1] = topology_.get();
    first_face_[1] = faces, first_face_[2] = 2 * faces;
    compute_surface_geometry({topologies_, first_node, first_face_}, position_, geometry_);
    ContactGradient gradient{std::vector<Vec3d>(2 * nodes), std::vector<Vec3d>(2 * nodes), std::vector<double>(2 * faces), {0.0, 0.0}};
    const ContactScene scene{bodies_, position_, topologies_, first_face_, &geometry_};
    layer_.rebuild(scene, {.box = {{-50, -50, -50}, {50, 50, 50}}});
    layer_.evaluate(scene, SurfacePairKind::kSurfaces, gradient);
    layer_.begin_step(scene);
  }
  /// dᵀΓ d for a common rotation of both blocks.
  double turn() {
    std::vector<Vec3d> turned = position_, drag(position_.size());
    for (Vec3d& x : turned) x += cross(Vec3d{3e-3, -2e-3, 1e-3}, x);
    OrderFreeSum sum;
    layer_.add_step_friction({bodies_, turned, topologies_, first_face_, &geometry_}, position_, true, drag, sum);
    return Comm().sum(sum);
  }

 private:
  static ContactMaterial material() {
    ContactMaterial out;
    out.law.range = 0.2;
    out.normal_friction = out.tangential_friction = 50.0;
    return out;
  }
  std::shared_ptr<const Topology> topology_;
  const Topology* topologies_[2] = {};
  std::uint32_t first_face_[3] = {};
  std::vector<ContactBody> bodies_;
  std::vector<Vec3d> position_;
  SurfaceGeometry geometry_;
  ContactLayer layer_;
};

}  // namespace

void add_contact_numbers(std::vector<ReferenceNumber>& out) {
  out.push_back({"T7.2", "pull-off force of a rigid ball of 642 nodes from a plane, 2 pi R W, R 6 um, W 0.1 nN/um [nN]", 3.7699,
                 0.02 * 3.7699, "closed form (Derjaguin), any range below 2 R; 2 % for the mesh", [] { return largest_pull(false); }});
  out.push_back({"T7.2", "the same where only the ball's lower cap has that W, and all else three times as much [nN]", 3.7699,
                 0.02 * 3.7699, "closed form; the plane meets the cap alone", [] { return largest_pull(true); }});
  out.push_back({"S5", "W recovered from the work of lifting that ball off [nN/um]", kAdhesion, 0.02 * kAdhesion,
                 "closed form: work pi R c W from touching to out of the range c", [] { return adhesion_from_work(); }});
  out.push_back({"T9.4", "part of the friction of a contact of parallel faces that turns as a whole which the objective form takes off",
                 1.0, 1e-6, "closed form: exact for opposed parallel faces",
                 [] { return 1.0 - TwoBlocks(true).turn() / TwoBlocks(false).turn(); }});
  struct Pipette {
    double tension, radius, suction;
  };
  for (const Pipette& p : {Pipette{0.03, 2.5, 13.898}, {0.1, 2.0, 66.486}, {0.1, 2.5, 46.326}, {0.1, 3.0, 32.766}, {0.4, 2.5, 185.302}})
    out.push_back({"S3",
                   "critical suction of a cell of 6 um, tension " + std::to_string(p.tension).substr(0, 4) + " mN/m, pipette " +
                       std::to_string(p.radius).substr(0, 3) + " um [Pa]",
                   p.suction, 1e-3, "computed independently from the closed form",
                   [p] { return 1000.0 * theory::critical_aspiration(p.tension, p.radius, kRadius); }});
}

}  // namespace morula::scenarios
