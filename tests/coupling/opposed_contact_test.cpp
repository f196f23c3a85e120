// Attraction fades between faces that look away from each other (time_stepping.md §9: O), in the whole contact layer; and nothing in it
// jumps.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/contact/contact_layer.h"
#include "core/friction/pair_blocks.h"
#include "core/random/philox.h"
#include "coupling/mechanics/scene.h"
#include "coupling/mechanics/surface_contacts.h"
#include "tests/coupling/energy_gradient.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

using test::clusters_model;
using test::make_tissue;

Model contacts_only(const std::shared_ptr<const SurfaceLaw>& law) {
  Model model = clusters_model(0.3);
  dcm::ShellParameters& p = model.types[0].shell;
  p.shape_stiffness = p.barrier_stiffness = p.spring_stiffness = p.tension = p.hinge_stiffness = p.bulk_modulus = 0.0;
  model.contact.range = 1.5;
  model.pairs[0].law = law;
  model.pairs[0].own.set("modulus", 1.0);
  return model;
}

/// Two shells whose faces are turned at random by tens of degrees: at a border of contact all angles occur.
Tissue crumpled(ShapeLibrary& shapes) {
  Tissue tissue = make_tissue(clusters_model(), shapes, {{0, 0, 0}, {11.8, 0.3, 0.2}}, {BodyKind::kShell, BodyKind::kShell});
  const Random random(5, RandomStream::kInitialPosition);
  std::uint64_t n = 0;
  for (Vec3d& x : tissue.shells.position) x += random.direction(CellId(1), n++) * 1.0;
  return tissue;
}

/// Points of contact by the weight that they have: none, a part, all.
struct Weights {
  int none = 0, part = 0, all = 0;
};
Weights weights_in(const Mechanics& mechanics, const dcm::Shells& shells) {
  Weights out;
  const auto twice_area = [&](std::uint32_t s, std::uint32_t f) {
    const Triangle& t = shells.topology(s).faces()[f];
    const auto x = shells.nodes(s);
    return cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]);
  };
  for (const SurfacePair& pair : mechanics.contacts().pairs())
    for (std::uint32_t d = 0; d < 2; ++d)
      for (const ContactElement& e : pair.present(d)) {
        const std::uint32_t source = d == 0 ? pair.a : pair.b, target = d == 0 ? pair.b : pair.a;
        double mu[3];
        e.weights(mu);
        const Topology& topology = shells.topology(target);
        Vec3d normal;  // of the nodes, by area, at the nearest point
        for (std::size_t j = 0; j < 3; ++j) {
          Vec3d of_node;
          for (const std::uint32_t f : topology.faces_of_node(topology.faces()[e.target()][j])) of_node += twice_area(target, f);
          normal += normalized(of_node) * mu[j];
        }
        const double opposed = -dot(normalized(twice_area(source, e.source_face())), normalized(normal));
        ++(opposed <= -0.3 ? out.none : opposed >= 0.5 ? out.all : out.part);
      }
  return out;
}

class EveryLawOfContact : public testing::TestWithParam<std::shared_ptr<const SurfaceLaw>> {};

TEST_P(EveryLawOfContact, HasAForceThatIsMinusTheGradientWhereFacesTurnAway) {
  const Model model = contacts_only(GetParam());
  ShapeLibrary shapes;
  const Tissue tissue = crumpled(shapes);
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  std::vector<Vec3d> force, unused;
  (void)mechanics.energy_and_forces(tissue, force);
  const Weights weights = weights_in(mechanics, tissue.shells);
  ASSERT_GT(weights.part, 20) << "points whose attraction is partly off";
  ASSERT_GT(weights.all, 20);
  Vec3d sum, torque;
  double size = 0.0;
  for (std::size_t i = 0; i < force.size(); ++i) {
    sum += force[i];
    torque += cross(tissue.shells.position[i], force[i]);
    size += norm(force[i]);
  }
  EXPECT_LT(norm(sum), 1e-12 * size);
  EXPECT_LT(norm(torque), 1e-12 * 12.0 * size);
  test::expect_minus_gradient(tissue, force, 20, 1e-7, [&](const Tissue& moved) {
    Mechanics fresh(model, {}, shapes, Comm(), 1);
    return fresh.energy_and_forces(moved, unused);
  });
}

/// A node that sticks out to right in front of a contact point of another shell: it attracts that point from aside as much as from ahead. The matrix of a
/// step counts on the stiffness that the forces show; by the direction of the gap alone there would be none (decision 0065).
TEST(StiffnessOfContacts, IsThatOfForcesWhereANodeSticksOut) {
  Model model = contacts_only(surface_laws().front());
  model.pairs[0].normal_friction = model.pairs[0].tangential_friction = 0.0;
  ShapeLibrary shapes;
  Tissue start = make_tissue(clusters_model(), shapes, {{0, 0, 0}, {13.6, 0.0, 0.0}}, {BodyKind::kShell, BodyKind::kShell}, 42);
  const std::uint32_t with_tip = start.shells.nodes(0)[0].x > 6.5 ? 0 : 1, other = 1 - with_tip;
  const auto foremost = [&](std::span<const Vec3d> places, double way) {
    return std::size_t(
        std::max_element(places.begin(), places.end(), [&](const Vec3d& a, const Vec3d& b) { return way * a.x < way * b.x; }) -
        places.begin());
  };
  const auto nodes = start.shells.nodes(other);
  const auto faces = start.shells.topology(other).faces();
  const FaceQuadrature& quadrature = FaceQuadrature::with_points(3);
  std::vector<Vec3d> points, normals;
  for (const Triangle& t : faces)
    for (int q = 0; q < 3; ++q) {
      points.push_back(nodes[t[0]] * quadrature.weight[q][0] + nodes[t[1]] * quadrature.weight[q][1] +
                       nodes[t[2]] * quadrature.weight[q][2]);
      normals.push_back(normalized(cross(nodes[t[1]] - nodes[t[0]], nodes[t[2]] - nodes[t[0]])));
    }
  const std::size_t point = foremost(points, 1.0);
  const std::size_t first = start.shells.first_node[with_tip], count = start.shells.nodes(with_tip).size();
  start.shells.position[first + foremost(start.shells.nodes(with_tip), -1.0)] = points[point] + normals[point] * 0.3;
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  const Vec3d aside = normalized(cross(normals[point], Vec3d{0.0, 0.3, 1.0}));
  std::vector<Vec3d> force;
  const auto pushed = [&](double way) {  // along the way, the shell with the tip
    Tissue moved = start;
    for (std::size_t i = first; i < first + count; ++i) moved.shells.position[i] += aside * way;
    mechanics.bodies_changed();
    (void)mechanics.energy_and_forces(moved, force);
    double sum = 0.0;
    for (std::size_t i = first; i < first + count; ++i) sum += dot(force[i], aside);
    return sum;
  };
  constexpr double kWay = 1e-4;
  const double found = (pushed(-kWay) - pushed(kWay)) / (2.0 * kWay);
  (void)pushed(0.0);
  double counted = 0.0, along_gaps = 0.0;  // by PairCondenser: the blocks couple the two shells, and act on their common way
  for (const ElementGroup& group : mechanics.contacts().element_groups(contact_scene(mechanics.scene(), SurfaceGeometry()))) {
    PairCondenser condenser(quadrature, 1.0f);
    NodePairArena blocks;
    condenser.add_pair_blocks(group, blocks);
    const std::vector<Float4> still(42), moves(42, {float(aside.x), float(aside.y), float(aside.z), 0.0f});
    std::vector<Float4> q(42);
    apply_pair_blocks({blocks.rows, blocks.blocks}, moves.data(), q.data(), still.data(), nullptr);
    for (const Float4& f : q) counted += dot(Vec3d{f.x, f.y, f.z}, aside);
    for (const auto& elements : group.elements)
      for (const ContactElement& e : elements)
        along_gaps += e.stiffness() * dot(e.normal<double>(), aside) * dot(e.normal<double>(), aside);
  }
  EXPECT_GT(found, 0.05);
  EXPECT_LT(along_gaps, 0.2 * found);
  EXPECT_GT(counted, 0.95 * found);
  EXPECT_LT(counted, 2.0 * found);
}

/// One shell goes past another, or past a sphere, while it comes nearer, from out of range to a gap of a tenth of it: nearest faces, edges
/// and nodes change all the way. dcm.md §16.9: no jump of the energy above 1e-9; the work of the force along the way is the change of the
/// energy.
TEST_P(EveryLawOfContact, HasAnEnergyWithoutJumpsAlongAnyApproach) {
  for (const BodyKind other : {BodyKind::kShell, BodyKind::kSphere}) {
    const Model model = contacts_only(GetParam());
    ShapeLibrary shapes;
    const Tissue start = make_tissue(clusters_model(), shapes, {{0, 0, 0}, {13.8, 0.3, 0.2}}, {BodyKind::kShell, other}, 42);
    const std::size_t last_node = start.shells.position.size(), first_node = last_node - 42;  // of the shell that moves
    const Vec3d center = other == BodyKind::kShell ? start.shells.position[0] : start.spheres.position[0];
    const double to_left = start.shells.position[first_node].x > center.x ? -1.0 : 1.0;
    const auto way = [&](std::size_t i) {  // nearer, aside, and turning
      return Vec3d{1.9 * to_left, 0.9, -0.4} + cross(Vec3d{0.02, -0.03, 0.05}, start.shells.position[i]);
    };
    Mechanics mechanics(model, {}, shapes, Comm(), 1);
    struct State {
      double s, energy, slope;
    };
    const auto at = [&](double s) {
      Tissue moved = start;
      for (std::size_t i = first_node; i < last_node; ++i) moved.shells.position[i] += way(i) * s;
      std::vector<Vec3d> force;
      mechanics.bodies_changed();
      State out{s, mechanics.energy_and_forces(moved, force), 0.0};
      for (std::size_t i = first_node; i < last_node; ++i) out.slope -= dot(force[i], way(i));
      return out;
    };
    // What the trapezium of the slopes leaves over an interval: a jump in it stays however short the interval is made.
    const auto left = [](const State& a, const State& b) {
      return std::abs(b.energy - a.energy - 0.5 * (a.slope + b.slope) * (b.s - a.s));
    };
    constexpr int kParts = 1000;
    EXPECT_EQ(at(0.0).energy, 0.0);
    EXPECT_LT(at(1.0).energy, -0.5);
    State last = at(0.0);
    double largest = 0.0;
    for (int i = 1; i <= kParts; ++i) {
      State a = last, b = last = at(static_cast<double>(i) / kParts);
      for (int cut = 0; cut < 14 && left(a, b) > 1e-9; ++cut) {
        const State middle = at(0.5 * (a.s + b.s));
        (left(a, middle) > left(middle, b) ? b : a) = middle;
      }
      largest = std::max(largest, left(a, b));
    }
    EXPECT_LT(largest, 1e-9);
  }
}

std::string name_of(const testing::TestParamInfo<std::shared_ptr<const SurfaceLaw>>& given) { return given.param->info.name; }

INSTANTIATE_TEST_SUITE_P(Every, EveryLawOfContact, testing::ValuesIn(surface_laws()), name_of);

}  // namespace
}  // namespace morula
