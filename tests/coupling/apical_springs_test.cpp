#include "coupling/mechanics/apical_springs.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "coupling/face_marks.h"
#include "coupling/simulation.h"
#include "tests/coupling/sprung_model.h"

namespace morula {
namespace {

Tissue ring_of_cells(const Model& model, ShapeLibrary& shapes) {
  std::vector<Vec3d> center;
  for (int k = 0; k < 5; ++k) center.push_back(Vec3d{std::cos(1.2566 * k), std::sin(1.2566 * k), 0.05 * k} * 11.0);
  Tissue tissue = test::make_tissue(model, shapes, center, std::vector(5, BodyKind::kShell));
  mark_new_shells(model, tissue);
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  for (Vec3d& x : tissue.shells.position) x += 0.1 * Vec3d{normal(engine), normal(engine), normal(engine)};
  return tissue;
}

/// Springs at positions, as a step has them.
struct At {
  ApicalSprings springs;
  std::vector<Vec3d> force;
  double energy = 0.0;

  At(const Model& model, const Tissue& tissue, const std::vector<Vec3d>& x) : springs(model), force(x.size()) {
    springs.set_weights(tissue.shells, Comm());
    springs.find_spheres(x, Comm());
    OrderFreeSum sum;
    springs.add_forces(x, force, sum);
    energy = sum.value();
  }

  /// K p with a step of 1 s.
  std::vector<Vec3d> times(const std::vector<Vec3d>& x, const std::vector<Vec3d>& p) {
    const Comm comm;
    springs.assemble_at(x, {}, 1.0, comm);
    std::vector<Float4> in, out(p.size());
    for (const Vec3d& v : p) in.push_back({static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0.0f});
    springs.add_product(in, out);
    std::vector<Vec3d> product;
    for (const Float4& v : out) product.push_back({v.x, v.y, v.z});
    return product;
  }
};

std::vector<Vec3d> random_vectors(std::size_t count, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  std::vector<Vec3d> out(count);
  for (Vec3d& v : out) v = {normal(engine), normal(engine), normal(engine)};
  return out;
}

double dot_of(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i], b[i]);
  return sum;
}

double largest(const std::vector<Vec3d>& a) {
  double out = 0.0;
  for (const Vec3d& v : a) out = std::max(out, norm(v));
  return out;
}

TEST(ApicalSprings, ForceIsMinusTheGradientAndTheNetForceIsZero) {
  const Model model = test::sprung_model();
  ShapeLibrary shapes;
  const Tissue tissue = ring_of_cells(model, shapes);
  const std::vector<Vec3d>& x = tissue.shells.position;
  const At here(model, tissue, x);
  Vec3d sum{};
  double size = 0.0;
  for (const Vec3d& f : here.force) sum += f, size += norm(f);
  EXPECT_GT(size, 1.0);
  EXPECT_LT(norm(sum), 1e-12 * size);
  for (unsigned k = 0; k < 20; ++k) {
    const std::vector<Vec3d> d = random_vectors(x.size(), k);
    std::vector<Vec3d> low = x, high = x;
    double size_of = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) low[i] -= d[i] * 1e-5, high[i] += d[i] * 1e-5, size_of += std::abs(dot(here.force[i], d[i]));
    // The areas stay those of the tissue: they are those of a step's start.
    EXPECT_NEAR((At(model, tissue, high).energy - At(model, tissue, low).energy) / 2e-5, -dot_of(here.force, d), 1e-6 * size_of);
  }
}

/// Where all nodes lie on the mean sphere nothing is left out: K is the second derivative.
TEST(ApicalSprings, StiffnessIsTheSecondDerivativeOnTheSphere) {
  Model model = test::sprung_model();
  model.marks[0].angle = std::numbers::pi;  // all faces
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{3, 4, 5}}, {BodyKind::kShell});
  mark_new_shells(model, tissue);
  const std::vector<Vec3d>& x = tissue.shells.position;
  At here(model, tissue, x);
  ASSERT_LT(largest(here.force), 1e-9);
  for (unsigned k = 0; k < 5; ++k) {
    const std::vector<Vec3d> p = random_vectors(x.size(), k);
    std::vector<Vec3d> low = x, high = x;
    for (std::size_t i = 0; i < x.size(); ++i) low[i] -= p[i] * 1e-5, high[i] += p[i] * 1e-5;
    const std::vector<Vec3d> product = here.times(x, p), up = At(model, tissue, high).force, down = At(model, tissue, low).force;
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_LT(norm(product[i] - (down[i] - up[i]) * (1.0 / 2e-5)), 1e-4 * largest(product)) << i;
  }
}

/// Springs between cells resist neither shifts nor turns, and no motion makes them give energy.
TEST(ApicalSprings, StiffnessResistsNoCommonMotion) {
  const Model model = test::sprung_model();
  ShapeLibrary shapes;
  const Tissue tissue = ring_of_cells(model, shapes);
  const std::vector<Vec3d>& x = tissue.shells.position;
  At here(model, tissue, x);
  const double usual = largest(here.times(x, random_vectors(x.size(), 3)));
  EXPECT_GT(usual, 0.01);
  for (const Vec3d& axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}) {
    std::vector<Vec3d> turn;
    for (const Vec3d& at : x) turn.push_back(cross(axis, at));
    EXPECT_LT(largest(here.times(x, std::vector(x.size(), axis))), 1e-6 * usual);
    EXPECT_LT(largest(here.times(x, turn)), 1e-5 * usual);
  }
  for (unsigned k = 0; k < 10; ++k) {
    const std::vector<Vec3d> a = random_vectors(x.size(), 2 * k), b = random_vectors(x.size(), 2 * k + 1);
    const std::vector<Vec3d> of_a = here.times(x, a), of_b = here.times(x, b);
    EXPECT_NEAR(dot_of(a, of_b), dot_of(b, of_a), 1e-5 * dot_of(a, of_a));
    EXPECT_GT(dot_of(a, of_a), 0.0);
  }
}

/// A push moves a cell as far in long steps as in short ones.
TEST(ApicalSprings, DoNotHoldACellInItsPlace) {
  Model model = test::sprung_model();
  model.step.max_step = 2.0;
  const double shorter = test::way_of_a_pushed_cell(model);
  model.step.max_step = 60.0;
  EXPECT_GT(shorter, 1.0);
  EXPECT_NEAR(test::way_of_a_pushed_cell(model), shorter, 0.01 * shorter);
}

TEST(ApicalSprings, MakeTheMarkedFacesASphere) {
  Model model = test::sprung_model();
  model.apical_springs[0].stiffness = 2.0;
  model.step.max_step = 20.0;
  ShapeLibrary shapes;
  const auto spread = [](const Tissue& tissue) {  // deviation of the distances of the marked nodes from their mean
    double sum = 0.0, square = 0.0, count = 0.0;
    Vec3d center{};
    for (int pass = 0; pass < 2; ++pass) {
      sum = square = count = 0.0;
      Vec3d mean{};
      for (std::size_t s = 0; s < tissue.shells.size(); ++s)
        for (std::size_t f = 0; f < tissue.shells.faces_of(s).mark.size(); ++f)
          if (tissue.shells.faces_of(s).mark[f])
            for (const std::uint32_t node : tissue.shells.topology(s).faces()[f]) {
              const Vec3d& x = tissue.shells.nodes(s)[node];
              const double r = norm(x - center);
              mean += x, sum += r, square += r * r, count += 1.0;
            }
      center = mean * (1.0 / count);
    }
    return std::sqrt(std::max(0.0, square / count - sum * sum / (count * count)));
  };
  double after[2];
  for (const bool held : {false, true}) {
    Model with = model;
    if (!held) with.apical_springs.clear();
    auto simulation = Simulation::create(with, ring_of_cells(model, shapes), Comm(), 1).value();
    while (simulation->tissue().clock.time < 100.0) ASSERT_TRUE(simulation->step(100.0).ok());
    after[held] = spread(simulation->tissue());
  }
  EXPECT_LT(after[1], 0.6 * after[0]);
}

}  // namespace
}  // namespace morula
