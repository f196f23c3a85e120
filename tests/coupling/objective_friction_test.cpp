/// Friction of contacts that does not feel a common rotation (dcm.md §1, T9.4).
#include "core/contact/objective_friction.h"
#include "core/contact/contact_layer.h"
#include "coupling/mechanics/scene.h"

#include <gtest/gtest.h>

#include "core/mesh/primitives.h"
#include "core/random/philox.h"
#include "tests/coupling/friction_sums.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

/// Two plates, 2 µm thick, whose faces of length × width meet over a gap. The range ends before the points of their sides.
struct Plates {
  double length = 4.0, width = 4.0, edge = 0.8, gap = 0.1, range = 0.2;
  Vec3d aside{0.1, 0.05, 0.0};  ///< how far the upper one is shifted
  int points_per_face = 3;
};
class Blocks {
 public:
  explicit Blocks(bool objective, const Plates& plates = {})
      : layer_({.range = plates.range,
                .skin = 1.0,
                .body_skin = 2.0,
                .points_per_face = plates.points_per_face,
                .objective_friction = objective},
               {}, materials(plates.range), 1) {
    const TriangleMesh mesh = *make_box({plates.length, plates.width, 2.0}, plates.edge);
    topology_ = Topology::build(static_cast<std::uint32_t>(mesh.position.size()), mesh.faces).value();
    for (int k = 0; k < 2; ++k) {
      ContactBody& body = bodies_.emplace_back();
      body.id = CellId::founder(static_cast<std::uint64_t>(k + 1));
      body.place = static_cast<std::uint32_t>(k);
      body.shape = BodyShape::kSurface;
      body.point_count = topology_->node_count();
      body.first_point = static_cast<std::uint32_t>(position.size());
      for (const Vec3d& x : mesh.position) position.push_back(x + (plates.aside + Vec3d{0.0, 0.0, 2.0 + plates.gap}) * k);
    }
    layer_.rebuild(scene(), {.box = {{-50, -50, -50}, {50, 50, 50}}});
    ContactGradient gradient;
    gradient.force.resize(position.size());
    gradient.node_normal.resize(position.size());
    gradient.face_energy.resize(2 * topology_->face_count());
    gradient.told_area.resize(2 * topology_->face_count());
    layer_.evaluate(scene(), SurfacePairKind::kSurfaces, gradient);
    const std::span<const Vec3d> nodes = position;
    for (std::size_t k = 0; k < 2; ++k)
      told_area_ +=
          0.5 * gradient.contact_area(topology_->faces(), nodes.subspan(k * topology_->node_count()), k * topology_->face_count());
    layer_.begin_step(scene());
    for (const SurfacePair& pair : layer_.pairs())
      for (std::size_t d = 0; d < 2; ++d)
        for (const ContactElement& element : pair.present(d)) area_ += static_cast<double>(element.area());
  }

  /// dᵀΓ d for a way d(x) of all points; Γ d in `drag`.
  template <class Way>
  double dissipation(Way&& way) {
    std::vector<Vec3d> start = position;
    for (Vec3d& x : position) x += way(x);
    drag.assign(position.size(), {});
    OrderFreeSum sum;
    layer_.add_step_friction(scene(), start, true, drag, sum);
    position = start;
    return Comm().sum(sum);
  }
  ContactScene scene() {
    const std::uint32_t nodes = topology_->node_count(), faces = topology_->face_count(), first_node[3] = {0, nodes, 2 * nodes};
    topologies_[0] = topologies_[1] = topology_.get();
    first_face_[1] = faces, first_face_[2] = 2 * faces;
    compute_surface_geometry({topologies_, first_node, first_face_}, position, geometry_);
    return {bodies_, position, topologies_, first_face_, &geometry_};
  }
  ContactLayer& layer() { return layer_; }
  /// Area over which friction acts, as its elements keep it.
  [[nodiscard]] double area() const { return area_; }
  /// Mean of both surfaces' area in contact, as it is told.
  [[nodiscard]] double told_area() const { return told_area_; }
  /// Σ of `drag` over the nodes of a block.
  [[nodiscard]] Vec3d drag_of(std::size_t block) const {
    Vec3d sum{};
    for (std::size_t i = 0; i < topology_->node_count(); ++i) sum += drag[block * topology_->node_count() + i];
    return sum;
  }

  std::vector<Vec3d> position, drag;

 private:
  static std::vector<ContactMaterial> materials(double range) {
    ContactMaterial material;
    material.law.range = range;
    material.friction = {20.0, 50.0};
    return {material};
  }

  std::shared_ptr<const Topology> topology_;
  const Topology* topologies_[2] = {};
  std::uint32_t first_face_[3] = {};
  std::vector<ContactBody> bodies_;
  SurfaceGeometry geometry_;
  ContactLayer layer_;
  double area_ = 0.0, told_area_ = 0.0;
};

TEST(ObjectiveFriction, DoesNotFeelAPairThatTurnsAsAWhole) {
  const auto turn = [](const Vec3d& x) { return cross(Vec3d{0.003, -0.002, 0.001}, x); };
  Blocks plain(false), objective(true);
  const double parasitic = plain.dissipation(turn);
  // γ_t g² per area and square of the part of the rotation along the surface
  EXPECT_NEAR(parasitic, 50.0 * 0.01 * 13e-6 * plain.area(), 0.1 * parasitic);
  EXPECT_LT(objective.dissipation(turn), 1e-7 * parasitic);
}

/// dcm.md T9.1: plates of S = 10 µm² that slide with 0.01 µm/s drag each other with γ_t S v = 50 · 10 · 0.01 = 5 nN, once and not from each
/// side (10 nN); those that part with it, with γ_n S v = 2 nN. With 80 faces a plate and 4 points a face each point stands for 10/(2 · 320)
/// = 1/64 µm², which a friction element keeps without rounding (its area has 11 bits), so that 1e-10 can be asked for.
TEST(ContactFriction, OfPlatesIsTheFrictionPerAreaTimesTheAreaTimesTheSpeed) {
  const Plates ten{.length = 4.0, .width = 2.5, .edge = 0.5, .gap = 0.03125, .range = 0.1, .aside = {}, .points_per_face = 4};
  for (const bool objective : {false, true}) {
    Blocks blocks(objective, ten);
    const auto upper_moves = [&](const Vec3d& v) { return blocks.dissipation([&](const Vec3d& x) { return x.z > 1.01 ? v : Vec3d{}; }); };
    const double sliding = upper_moves({0.01, 0.0, 0.0});
    EXPECT_LT(norm(blocks.drag_of(1) - Vec3d{5.0, 0.0, 0.0}), 5e-10);
    EXPECT_LT(norm(blocks.drag_of(0) + Vec3d{5.0, 0.0, 0.0}), 5e-10);
    EXPECT_NEAR(sliding, 5.0 * 0.01, 5e-12);
    const double parting = upper_moves({0.0, 0.0, 0.01});
    EXPECT_LT(norm(blocks.drag_of(1) - Vec3d{0.0, 0.0, 2.0}), 2e-10);
    EXPECT_LT(norm(blocks.drag_of(0) + Vec3d{0.0, 0.0, 2.0}), 2e-10);
    EXPECT_NEAR(parting, 2.0 * 0.01, 2e-12);
  }
}

/// The area that friction acts on is that on which the plates overlap: shifts by whole edges leave every point either right
/// above the other plate or out of range. Friction has it to 1 in 2048, as its elements are kept.
TEST(ContactFriction, ActsOverTheAreaOnWhichPlatesOverlap) {
  struct Shift {
    Vec3d aside;
    double area;
  };
  for (const Shift& shift : {Shift{{}, 4.0 * 4.0}, Shift{{0.8, 0.0, 0.0}, 3.2 * 4.0}, Shift{{1.6, 2.4, 0.0}, 2.4 * 1.6}}) {
    for (const int points : {3, 4}) {
      Blocks blocks(false, {.gap = 0.05, .range = 0.125, .aside = shift.aside, .points_per_face = points});
      EXPECT_NEAR(blocks.area(), shift.area, shift.area / 2048.0);
      // half the range counts, smoothed from c/4 to 3c/4: at g = 0.4 c there are 0.35/0.5 left
      EXPECT_NEAR(blocks.told_area(), 0.7 * shift.area, 1e-7 * shift.area);  // faces have theirs in single precision
      (void)blocks.dissipation([](const Vec3d& x) { return x.z > 1.02 ? Vec3d{0.0, 0.01, 0.0} : Vec3d{}; });
      const double expected = 50.0 * shift.area * 0.01;
      EXPECT_NEAR(blocks.drag_of(1).y, expected, expected / 2048.0);
    }
  }
}

/// Away from T9.1's plates: translations feel no difference between the two forms, here with a rim whose points are partly in range.
TEST(ObjectiveFriction, IsThePlainOneForSurfacesThatSlideOrPart) {
  for (const Vec3d& v : {Vec3d{0.01, 0, 0}, Vec3d{0, 0, 0.01}}) {
    const auto slide = [&](const Vec3d& x) { return x.z > 1.05 ? v : Vec3d{}; };
    Blocks plain(false), objective(true);
    const double expected = (v.z > 0.0 ? 20.0 : 50.0) * 1e-4 * plain.area();
    EXPECT_NEAR(objective.dissipation(slide), expected, 0.02 * expected);
    EXPECT_NEAR(objective.dissipation(slide), plain.dissipation(slide), 1e-5 * expected);
  }
}

/// dcm.md T9.4: |Σ (Γ_nn v)_i| ≤ 1e-12 in both forms. The torque is that of the objective form alone; it is zero but for where the nearest
/// point lies on its face, which an element keeps to 1 in 16383 of a side, and for coefficients in single precision.
TEST(ContactFriction, HasNoNetForceAndInItsObjectiveFormNoNetTorque) {
  for (const bool objective : {false, true}) {
    Blocks blocks(objective);
    const Random random(3, RandomStream::kInitialPosition);
    std::uint64_t n = 0;
    EXPECT_GT(blocks.dissipation([&](const Vec3d&) { return random.direction(CellId(1), n++) * 0.01; }), 0.0);
    Vec3d sum, torque;
    double size = 0.0, lever = 0.0;
    for (std::size_t i = 0; i < blocks.drag.size(); ++i) {
      sum += blocks.drag[i], torque += cross(blocks.position[i], blocks.drag[i]);
      size += norm(blocks.drag[i]), lever += norm(blocks.position[i]) * norm(blocks.drag[i]);
    }
    EXPECT_LT(norm(sum), 1e-12 * size);
    if (objective) {
      EXPECT_LT(norm(torque), 1e-5 * lever);
    }
  }
}

TEST(ObjectiveFriction, IsSymmetricAndTheSameInTheMatrix) {
  Blocks blocks(true);
  const Random random(3, RandomStream::kInitialPosition);
  std::vector<Vec3d> way[2];
  std::vector<Vec3d> drag[2];
  for (int k = 0; k < 2; ++k) {
    std::uint64_t n = 1000 * static_cast<std::uint64_t>(k);
    for (std::size_t i = 0; i < blocks.position.size(); ++i) way[k].push_back(random.direction(CellId(1), n++) * 0.01);
    std::size_t i = 0;
    (void)blocks.dissipation([&](const Vec3d&) { return way[k][i++]; });
    drag[k] = blocks.drag;
  }
  double ab = 0.0, ba = 0.0, aa = 0.0;
  for (std::size_t i = 0; i < way[0].size(); ++i) {
    ab += dot(way[0][i], drag[1][i]), ba += dot(way[1][i], drag[0][i]), aa += dot(way[0][i], drag[0][i]);
  }
  EXPECT_NEAR(ab, ba, 1e-6 * aa);
  const ObjectiveFriction& part = *blocks.layer().own_friction();
  std::vector<Float4> p, q(way[0].size());
  for (const Vec3d& v : way[0]) p.push_back({static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0.0f});
  part.add_product(p, q);
  std::vector<SymMat3<float>> diagonal(p.size());
  part.add_diagonal(diagonal);
  double most = 0.0;
  for (const Vec3d& f : drag[0]) most = std::max(most, norm(f));
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_LT(norm(Vec3d{q[i].x, q[i].y, q[i].z} - drag[0][i]), 1e-5 * most) << i;
    std::vector<Float4> one(p.size()), column(p.size());
    one[i] = {0.3f, -0.5f, 0.8f, 0.0f};
    part.add_product(one, column);
    const Vec3f d = diagonal[i] * Vec3f{0.3f, -0.5f, 0.8f};
    EXPECT_LT(std::abs(d.x - column[i].x) + std::abs(d.y - column[i].y) + std::abs(d.z - column[i].z), 1e-4f * (norm(d) + 1e-3f)) << i;
  }
}

/// T9.4 for cells: surfaces in contact are nearly parallel, so that little is left of what the plain form takes from a doublet that turns.
TEST(ObjectiveFriction, LeavesLittleOfWhatHoldsATurningDoubletBack) {
  double held[2];
  for (const bool objective : {false, true}) {
    Model model = test::clusters_model(0.1);
    model.contact.range = 0.5;
    model.contact.objective_friction = objective;
    ShapeLibrary shapes;
    Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}, {12.1, 0, 0}}, {BodyKind::kShell, BodyKind::kShell});
    Mechanics mechanics(model, {}, shapes, Comm(), 1);
    const std::vector<Vec3d> none(Mechanics::external_size(tissue));
    for (int k = 0; k < 30; ++k) {
      const auto report = mechanics.step(tissue, 2.0, none);
      ASSERT_TRUE(report.ok()) << report.error().what;
      EXPECT_EQ(report->halvings, 0);
      tissue.clock.time += 2.0;
    }
    const ContactScene scene{mechanics.scene().bodies(), mechanics.scene().position(), mechanics.scene().topologies(),
                             mechanics.scene().first_face()};
    const auto velocity = [](const Vec3d& x) { return cross(Vec3d{0, 0, 1e-3}, x); };
    if (objective) {
      std::vector<Vec3d> turned = tissue.shells.position, drag(turned.size());
      for (Vec3d& x : turned) x += velocity(x);
      OrderFreeSum sum;
      mechanics.contacts().own_friction()->rub(turned, tissue.shells.position, {}, drag, sum);
      held[1] = Comm().sum(sum);
    } else {
      std::vector<Vec3d> turning;
      for (const Vec3d& x : tissue.shells.position) turning.push_back(velocity(x));
      held[0] = test::contact_dissipation(test::rubbing_points(mechanics.contacts(), scene), 50.0, turning);
    }
  }
  EXPECT_GT(held[0], 0.0);
  EXPECT_LT(held[1], 0.1 * held[0]);
}

}  // namespace
}  // namespace morula
