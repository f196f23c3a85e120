// Contacts: T7.2 and T7.3 of dcm.md §7. T7.1 and S3 are theory that studies are held against; its own numbers are held by theory_test.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/ball.h"
#include "core/mesh/primitives.h"
#include "coupling/cell_record.h"
#include "coupling/face_marks.h"
#include "coupling/mechanics/contact_setup.h"
#include "coupling/mechanics/mechanics.h"
#include "scenarios/verify/lone_shell.h"
#include "scenarios/verify/reference_numbers.h"
#include "scenarios/verify/two_bodies.h"

namespace morula::scenarios {
namespace {

constexpr double kAdhesion = 0.1, kRange = 0.5;

/// A ball of 642 nodes above a plane, moved as one rigid body. `capped`: its lower cap has the adhesion, all else three times as much.
class RigidBall {
 public:
  explicit RigidBall(bool capped = false)
      : model_(model(capped)), mechanics_(model_, contact_obstacles(model_).value(), shapes_, Comm(), 1) {
    CellRecord cell;
    const double volume = ball_volume(kRadius);
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
    place(gap);
    return mechanics_.obstacle_forces(tissue_)[0].z;
  }
  /// Area in contact that is told of it there [µm²].
  double contact_area(double gap) {
    place(gap);
    return mechanics_.values(tissue_).contact_area[0];
  }

 private:
  void place(double gap) {
    double center = 0.0;
    for (const Vec3d& x : tissue_.shells.position) center += x.z / static_cast<double>(tissue_.shells.position.size());
    for (Vec3d& x : tissue_.shells.position) x.z += gap + kRadius - center;
    mechanics_.bodies_changed();
  }
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
    out.pairs[1].regions = {{0, -1, kAdhesion}};
    out.pairs[2].regions = {{-1, 0, kAdhesion}};
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

/// ∫ F dg/A of two plates of 4 × 4 µm pulled apart from touching to out of range, by a trapezoid rule whose nodes are where the traction bends.
double work_between_plates(double flat_from, double flat_to) {
  ContactMaterial material;
  material.law.adhesion = kAdhesion;
  material.law.range = 0.1;
  material.law.coefficient = {flat_from, flat_to, 0.0};
  const TriangleMesh mesh = make_box({4.0, 4.0, 2.0}, 0.8).value();
  constexpr int kSteps = 20;
  const double step = material.law.range / kSteps;
  double work = 0.0;
  for (int i = 0; i <= kSteps; ++i) work -= TwoBodies(mesh, 2.0, i * step, material).force().z * step * (i == 0 || i == kSteps ? 0.5 : 1.0);
  return work / 16.0;
}

/// Told area of the ball, mean of twenty heights from touching to a fifth of the range, where points have come as near as they count whole: the points of
/// a face come into reach together, and heights average over that.
double told_area_of_ball() {
  RigidBall ball;
  constexpr int kHeights = 20;
  double sum = 0.0;
  for (int i = 0; i < kHeights; ++i) sum += ball.contact_area(0.2 * kRange * (i + 0.5) / kHeights);
  return sum / kHeights;
}

void add_pull_off(std::vector<ReferenceNumber>& out) {
  out.push_back({"T7.2", "pull-off force of a rigid ball of 642 nodes from a plane, 2 pi R W, R 6 um, W 0.1 nN/um [nN]", 3.7699,
                 0.01 * 3.7699, "closed form (Derjaguin), any range below 2 R; 0.3 % for nodes outside the sphere, 0.4 % from mesh to mesh",
                 [] { return largest_pull(false); }});
  out.push_back({"T7.2", "the same where only the ball's lower cap has that W, and all else three times as much [nN]", 3.7699,
                 0.01 * 3.7699, "closed form; the plane meets the cap alone", [] { return largest_pull(true); }});
  struct Law {
    const char* name;
    double from, to;
  };
  for (const Law& law : {Law{"tent", 0.5, 0.5}, Law{"Maugis-Dugdale", 0.1, 0.9}, Law{"falling", 0.1, 0.1}})
    out.push_back({"T7.3", std::string("work of pulling parallel plates apart per area, ") + law.name + " traction [nN/um]", kAdhesion,
                   1e-6 * kAdhesion, "closed form: W; dcm.md: 1e-6", [law] { return work_between_plates(law.from, law.to); }});
}

}  // namespace

void add_contact_numbers(std::vector<ReferenceNumber>& out) {
  add_pull_off(out);
  // The part of a sphere that is nearer to a plane than h is 2 π R h of its surface: h = c/2 less the height, 0.1 c in the mean.
  out.push_back({"T9.1", "told area of that ball on the plane, mean over heights up to a fifth of the range of 0.5 um [um^2]", 7.539822,
                 0.02 * 7.539822, "closed form 2 pi R (c/2 - gap), Archimedes; faces of 0.7 um^2 for a cap of 1.6 um: 2 %",
                 [] { return told_area_of_ball(); }});
  out.push_back({"S5", "W recovered from the work of lifting that ball off [nN/um]", kAdhesion, 0.02 * kAdhesion,
                 "closed form: work pi R c W from touching to out of the range c", [] { return adhesion_from_work(); }});
}

}  // namespace morula::scenarios
