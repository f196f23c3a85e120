// Flat surfaces that are drawn apart, through the whole contact layer: T7.3 (dcm.md §7).
#include <gtest/gtest.h>

#include "core/mesh/primitives.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

constexpr double kAdhesion = 0.3, kRange = 0.1, kSide = 4.0, kHeight = 2.0;

/// A block with a face of 4 × 4 µm, above an equal block or above a wide plane; the gap is the same everywhere.
struct Flat {
  const char* name;
  std::shared_ptr<const SurfaceLaw> law;
  bool plane;
};
void PrintTo(const Flat& flat, std::ostream* out) { *out << flat.name; }
const Flat kFlats[] = {
    {"TwoBlocksByTheTent", tent_law(), false},
    {"TwoBlocksByMaugisDugdale", maugis_dugdale_law(), false},
    {"TwoBlocksByAFallingTraction", falling_law(), false},
    {"ABlockOnAPlaneByTheTent", tent_law(), true},
    {"ABlockOnAPlaneByMaugisDugdale", maugis_dugdale_law(), true},
    {"ABlockOnAPlaneByAFallingTraction", falling_law(), true},
};

Model flat_model(const Flat& flat) {
  Model model = test::clusters_model(kAdhesion);
  model.contact.range = kRange;
  ContactPair& pair = model.pairs[0];
  pair.law = flat.law;
  pair.own.set("modulus", 1.0);
  if (flat.plane) {
    TriangleMesh plane = make_box({20.0, 20.0, 2.0}, 20.0).value();
    for (Vec3d& x : plane.position) x.z -= 1.0;
    model.obstacles = {ObstacleSpec{"plane", plane.position, plane.faces, false, {}}};
    model.pairs.assign(4, pair);
  }
  return model;
}

/// The upper block (the last body) and what is below it, in a contact layer of their own.
class Plates {
 public:
  Plates(const Flat& flat, const Model& model)
      : layer_(contact_settings(model, 1), contact_obstacles(model).value(), contact_materials(model), contact_material_count(model)) {
    const TriangleMesh mesh = make_box({kSide, kSide, kHeight}, 0.8).value();
    topology_ = Topology::build(static_cast<std::uint32_t>(mesh.position.size()), mesh.faces).value();
    const auto bodies = flat.plane ? 1u : 2u;
    for (std::uint32_t k = 0; k < bodies; ++k) {
      ContactBody& body = bodies_.emplace_back();
      body.id = CellId::founder(k + 1);
      body.place = k;
      body.shape = BodyShape::kSurface;
      body.point_count = topology_->node_count();
      body.first_point = static_cast<std::uint32_t>(position_.size());
      for (const Vec3d& x : mesh.position) position_.push_back(x + Vec3d{0.0, 0.0, k + 1 == bodies ? 0.5 * kHeight : -0.5 * kHeight});
      topologies_.push_back(topology_.get());
      first_node_.push_back(static_cast<std::uint32_t>(position_.size()));
      first_face_.push_back(first_face_.back() + topology_->face_count());
    }
    layer_.set_offsets(std::vector<Vec3d>(model.obstacles.size()));
    layer_.rebuild(scene(), model.space);
  }

  struct Pull {
    double force;   ///< on the upper block, downwards [nN]
    double energy;  ///< [nN·µm]
  };
  Pull at(double gap) {
    for (std::size_t i = position_.size() - topology_->node_count(); i < position_.size(); ++i) position_[i].z += gap - gap_;
    gap_ = gap;
    if (layer_.note_motion(scene())) layer_.rebuild(scene(), {.box = {{-50, -50, -50}, {50, 50, 50}}});
    ContactGradient gradient;
    gradient.set_zero(position_.size(), position_.size(), first_face_.back());
    layer_.evaluate(scene(), SurfacePairKind::kSurfaces, gradient);
    Pull out{0.0, 0.0};
    for (std::size_t i = position_.size() - topology_->node_count(); i < position_.size(); ++i) out.force -= gradient.force[i].z;
    OrderFreeSum energy;
    layer_.add_energy(scene(), energy);
    out.energy = Comm().sum(energy);
    return out;
  }

 private:
  ContactScene scene() {
    compute_surface_geometry({topologies_, first_node_, first_face_}, position_, geometry_);
    return {bodies_, position_, topologies_, first_face_, &geometry_};
  }

  std::shared_ptr<const Topology> topology_;
  std::vector<const Topology*> topologies_;
  std::vector<std::uint32_t> first_node_{0}, first_face_{0};
  std::vector<ContactBody> bodies_;
  std::vector<Vec3d> position_;
  SurfaceGeometry geometry_;
  ContactLayer layer_;
  double gap_ = 0.0;
};

class ParallelPlates : public testing::TestWithParam<Flat> {};

/// The traction is straight between 0, c/10, c/2, 9c/10 and c (contact_setup.cpp): the midpoint rule on a hundred parts of c is exact.
TEST_P(ParallelPlates, AreDrawnApartByTheWorkOfAdhesion) {  // T7.3: ∫ F dg/A = W ± 1e-6
  const Model model = flat_model(GetParam());
  Plates plates(GetParam(), model);
  constexpr int kParts = 100;
  constexpr double kArea = kSide * kSide;
  double work = 0.0;
  for (int i = 0; i < kParts; ++i) work += plates.at((i + 0.5) * kRange / kParts).force * kRange / kParts;
  EXPECT_NEAR(work / kArea, kAdhesion, 1e-6);
  EXPECT_NEAR(plates.at(1e-9).energy / kArea, -kAdhesion, 1e-6);
  EXPECT_EQ(plates.at(kRange + 1e-9).force, 0.0);
  EXPECT_EQ(plates.at(kRange + 1e-9).energy, 0.0);
  EXPECT_LT(plates.at(-0.01).force, 0.0) << "pressed into each other they push";
}

INSTANTIATE_TEST_SUITE_P(Every, ParallelPlates, testing::ValuesIn(kFlats),
                         [](const testing::TestParamInfo<Flat>& given) { return std::string(given.param.name); });

}  // namespace
}  // namespace morula
