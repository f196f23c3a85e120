#include "coupling/mechanics/apical_dampers.h"

#include <gtest/gtest.h>

#include <random>

#include "coupling/face_marks.h"
#include "coupling/simulation.h"
#include "tests/coupling/sprung_model.h"

namespace morula {
namespace {

class ApicalDampersOfThree : public ::testing::Test {
 protected:
  ApicalDampersOfThree()
      : model_(test::sprung_model()),
        tissue_(test::make_tissue(model_, shapes_, {{11, 0, 1}, {0, 11, 0}, {-9, 0, 6}}, std::vector(3, BodyKind::kShell))),
        dampers_(model_) {
    mark_new_shells(model_, tissue_);
    dampers_.freeze(tissue_.shells, x(), Comm());
    for (const MarkedNode& at : marked_nodes(tissue_.shells, 0).nodes) {
      area_ += at.area;
      center_ += x()[at.node] * at.area;
    }
    center_ *= 1.0 / area_;
  }
  [[nodiscard]] const std::vector<Vec3d>& x() const { return tissue_.shells.position; }

  template <class Way>
  std::vector<Vec3d> way_of(const Way& of) const {
    std::vector<Vec3d> out;
    for (const Vec3d& p : x()) out.push_back(of(p));
    return out;
  }
  struct Push {
    std::vector<Vec3d> of_node;
    double quadratic = 0.0;
  };
  [[nodiscard]] Push push(const std::vector<Vec3d>& way) const {
    Push out{std::vector<Vec3d>(x().size())};
    OrderFreeSum sum;
    dampers_.add_friction_of(way, out.of_node, sum, Comm());
    out.quadratic = sum.value();
    return out;
  }
  static double largest(const std::vector<Vec3d>& all) {
    double out = 0.0;
    for (const Vec3d& v : all) out = std::max(out, norm(v));
    return out;
  }

  Model model_;
  ShapeLibrary shapes_;
  Tissue tissue_;
  ApicalDampers dampers_;
  double area_ = 0.0;
  Vec3d center_{};
};

TEST_F(ApicalDampersOfThree, ResistNeitherMotionsOfTheWholeNorItsExpansion) {
  const Vec3d turn{0.3, -0.2, 0.5};
  EXPECT_LT(largest(push(way_of([](const Vec3d&) { return Vec3d{1, -2, 0.5}; })).of_node), 1e-12);
  EXPECT_LT(largest(push(way_of([&](const Vec3d& p) { return cross(turn, p); })).of_node), 1e-12);
  EXPECT_LT(largest(push(way_of([&](const Vec3d& p) { return normalized(p - center_); })).of_node), 1e-12);
  // one cell goes, the others stay
  const Push one = push(way_of([&](const Vec3d& p) { return p.x > 5.0 ? Vec3d{1, 0, 0} : Vec3d{}; }));
  EXPECT_GT(largest(one.of_node), 1e-2);
}

TEST_F(ApicalDampersOfThree, HaveNoNetForceAndTorqueAndAreTheGradientOfTheirDissipation) {
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  const auto any = [&](const Vec3d&) { return Vec3d{normal(engine), normal(engine), normal(engine)}; };
  const std::vector<Vec3d> one = way_of(any), other = way_of(any);
  const Push of_one = push(one), of_other = push(other);
  Vec3d force, torque;
  double mixed = 0.0, swapped = 0.0, own = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    force += of_one.of_node[i];
    torque += cross(x()[i], of_one.of_node[i]);
    mixed += dot(other[i], of_one.of_node[i]);
    swapped += dot(one[i], of_other.of_node[i]);
    own += dot(one[i], of_one.of_node[i]);
  }
  EXPECT_LT(norm(force), 1e-10 * largest(of_one.of_node));
  EXPECT_LT(norm(torque), 1e-9 * largest(of_one.of_node));
  EXPECT_NEAR(mixed, swapped, 1e-10 * std::abs(own));
  EXPECT_NEAR(own, of_one.quadratic, 1e-10 * own);
  EXPECT_GT(own, 0.0);
  // most of a random motion is no common one: µ Σ A |v|², but for 7 of its degrees of freedom
  double plain = 0.0;
  for (const MarkedNode& at : marked_nodes(tissue_.shells, 0).nodes)
    plain += model_.apical_springs[0].friction * at.area * norm2(one[at.node]);
  EXPECT_LT(own, plain);
  EXPECT_GT(own, 0.8 * plain);
}

TEST_F(ApicalDampersOfThree, ProductsAreTheSameFriction) {
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal;
  const std::vector<Vec3d> way = way_of([&](const Vec3d&) { return Vec3d{normal(engine), normal(engine), normal(engine)}; });
  std::vector<Float4> p, q(way.size());
  for (const Vec3d& v : way) p.push_back({static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0.0f});
  dampers_.assemble_of({}, Comm());
  dampers_.add_product(p, q);
  const Push wanted = push(way);
  for (std::size_t i = 0; i < way.size(); ++i) EXPECT_LT(norm(to_double(q[i]) - wanted.of_node[i]), 1e-5 * largest(wanted.of_node)) << i;
}

/// A cell that carries a force goes as far as without dampers.
TEST(ApicalDampers, DoNotHoldACellInItsPlace) {
  Model model = test::sprung_model();
  model.apical_springs[0].stiffness = 0.0;
  model.apical_springs[0].friction = 0.0;
  const double free = test::way_of_a_pushed_cell(model);
  model.apical_springs[0].friction = 100.0;
  EXPECT_GT(free, 1.0);
  EXPECT_NEAR(test::way_of_a_pushed_cell(model), free, 0.01 * free);
}

TEST(ApicalDampers, SlowWhatSpringsDo) {
  const auto released = [](double stiffness, double friction) {  // energy, in 20 s
    Model model = test::sprung_model();
    model.apical_springs[0].stiffness = stiffness;
    model.apical_springs[0].friction = friction;
    model.step.max_step = 5.0;
    ShapeLibrary shapes;
    Tissue tissue = test::make_tissue(model, shapes, {{11, 0, 0}, {-11, 0, 0}, {0, 11, 0}, {0, -11, 0}, {0, 0, 11}, {0, 0, -11}},
                                      std::vector(6, BodyKind::kShell));  // all around: their growth is that of the sphere
    mark_new_shells(model, tissue);
    auto simulation = Simulation::create(model, std::move(tissue), Comm(), 1).value();
    const double start = simulation->mechanics().energy(simulation->tissue());
    while (simulation->tissue().clock.time < 20.0) EXPECT_TRUE(simulation->step(20.0).ok());
    return start - simulation->mechanics().energy(simulation->tissue());
  };
  const double without = released(0.0, 0.0), free = released(2.0, 0.0) - without;
  EXPECT_GT(free, 100.0);
  EXPECT_LT(released(2.0, 1000.0) - without, 0.15 * free);
}

}  // namespace
}  // namespace morula
