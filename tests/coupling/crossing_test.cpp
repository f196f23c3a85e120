/// A step in which a surface passes through another is refused (time_stepping.md §9.1).
#include "core/contact/crossing.h"

#include <gtest/gtest.h>

#include "core/contact/contact_layer.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

/// Two shells of radius 6 with their centres so far apart along x, in a contact layer of their own.
class TwoShells {
 public:
  explicit TwoShells(double apart) : layer_({.range = 0.5, .skin = 2.0, .body_skin = 4.0}, {}, materials(), 1) {
    const auto shape = shapes_.icosphere(162).value();
    for (int k = 0; k < 2; ++k) {
      ContactBody& body = bodies_.emplace_back();
      body.id = CellId::founder(static_cast<std::uint64_t>(k + 1));
      body.place = static_cast<std::uint32_t>(k);
      body.shape = BodyShape::kSurface;
      topology_[k] = shape->topology.get();
      first_face_[k + 1] = first_face_[k] + topology_[k]->face_count();
      body.point_count = topology_[k]->node_count();
      body.first_point = static_cast<std::uint32_t>(position_.size());
      for (const Vec3d& x : shape->position) position_.push_back(normalized(x) * 6.0 + Vec3d{k * apart, 0, 0});
    }
    layer_.rebuild(scene(), space());
    measure();
    layer_.begin_step(scene());
    start_ = position_;
  }

  /// Move the second shell along x and look at the contacts there.
  bool crosses_when_moved(double by) {
    for (std::size_t i = position_.size() / 2; i < position_.size(); ++i) position_[i].x += by;
    (void)layer_.note_motion(scene());
    measure();
    return layer_.crossed(scene(), start_) != nullptr;
  }
  ContactLayer& layer() { return layer_; }

 private:
  static std::vector<ContactMaterial> materials() {
    ContactMaterial material;
    material.law.adhesion = 0.1;
    material.law.range = 0.5;
    return {material};
  }
  static Space space() {
    Space out;
    out.box = {{-100, -100, -100}, {100, 100, 100}};
    return out;
  }
  ContactScene scene() {
    const std::uint32_t nodes = bodies_[0].point_count, first_node[3] = {0, nodes, 2 * nodes};
    compute_surface_geometry({topology_, first_node, first_face_}, position_, geometry_);
    return {bodies_, position_, topology_, first_face_, &geometry_};
  }
  void measure() {
    ContactGradient gradient;
    gradient.force.resize(position_.size());
    gradient.node_normal.resize(position_.size());
    gradient.face_energy.resize(first_face_[2]);
    gradient.told_area.resize(first_face_[2]);
    layer_.evaluate(scene(), SurfacePairKind::kSurfaces, gradient);
  }

  ShapeLibrary shapes_;
  std::vector<ContactBody> bodies_;
  const Topology* topology_[2] = {};
  std::uint32_t first_face_[3] = {};
  std::vector<Vec3d> position_, start_;
  SurfaceGeometry geometry_;
  ContactLayer layer_;
};

TEST(Crossing, IsASideThatChangesBeyondHalfTheRange) {
  EXPECT_FALSE(TwoShells(12.1).crosses_when_moved(-0.2)) << "from a gap of 0.1 µm to an overlap of 0.1 µm";
  EXPECT_TRUE(TwoShells(12.4).crosses_when_moved(-1.2)) << "from a gap in range to an overlap of 0.8 µm";
  EXPECT_TRUE(TwoShells(13.0).crosses_when_moved(-1.8)) << "from out of range to an overlap";
  EXPECT_FALSE(TwoShells(11.2).crosses_when_moved(-0.2)) << "deep before and after";
  EXPECT_TRUE(TwoShells(11.2).crosses_when_moved(1.2)) << "out of a deep overlap, to a gap in range";
  EXPECT_TRUE(TwoShells(11.2).crosses_when_moved(2.0)) << "likewise, out of range";
  EXPECT_FALSE(TwoShells(12.1).crosses_when_moved(1.0)) << "parting";
}

TEST(Crossing, IsAllowedWhileAStartFromOverlapIsOn) {
  TwoShells shells(13.0);
  shells.layer().set_cap(0.1);
  EXPECT_FALSE(shells.crosses_when_moved(-1.8));
}

TEST(Crossing, OfATrialStepIsRefused) {
  Model model = test::clusters_model(0.0);
  model.contact.range = 0.5;
  model.contact.repulsion = 0.01;  // as good as none
  model.step.max_displacement = 4.0;
  model.pairs = {ContactPair{0.0, 0.0, 0.0}};
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}, {12.45, 0, 0}}, {BodyKind::kShell, BodyKind::kShell});
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  const double towards = tissue.shells.nodes(0)[0].x < tissue.shells.nodes(1)[0].x ? 1.0 : -1.0;
  const std::vector<Vec3d> push{{40.0 * towards, 0, 0}, {-40.0 * towards, 0, 0}};
  const auto report = mechanics.step(tissue, 1.0, mechanics.spread(tissue, push));
  ASSERT_TRUE(report.ok()) << report.error().what;
  EXPECT_GT(report->crossings, 0);
  EXPECT_LT(report->overlap, 0.25);
}

}  // namespace
}  // namespace morula
