#include "core/friction/friction_system.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/contact/traction_law.h"

namespace morula {
namespace {

/// Spheres with medium friction g and pair friction; vectors are float (time_stepping.md §10.7), so references hold to a few 1e-7.
constexpr double kFloat = 2e-6;

struct Pair {
  std::uint32_t i, j;
  double normal, tangential;
  Vec3d n{1, 0, 0};
};

std::vector<Vec3d> velocities(std::size_t count, double g, const std::vector<Pair>& pairs, const std::vector<Vec3d>& force,
                              int threads = 1) {
  FrictionSystem::Layout layout;
  layout.point_count = count;
  layout.owned.assign(count, 1);  // bodies of one point each
  FrictionSystem system;
  system.set_layout(layout, threads);
  system.set_point_friction(std::vector<float>(count, static_cast<float>(g)));
  SpherePairs list;  // a material of its own for each pair's first sphere, area 1
  std::vector<PairFriction> friction(count * count);
  list.material.resize(count);
  for (std::size_t i = 0; i < count; ++i) list.material[i] = static_cast<std::uint16_t>(i);
  for (const Pair& p : pairs) {
    list.pairs.push_back({p.i, p.j, 0});
    list.elements.push_back({{static_cast<float>(p.n.x), static_cast<float>(p.n.y), static_cast<float>(p.n.z)}, 1.0f, 0.0f});
    friction[p.i * count + p.j] = {static_cast<float>(p.tangential), static_cast<float>(p.normal - p.tangential)};
  }
  list.set_friction(std::move(friction), count);
  list.set_layout(0, static_cast<std::uint32_t>(count), threads);
  system.set_sphere_pairs(&list);
  system.set_elements({}, FaceQuadrature::with_points(3));
  std::vector<Float4> v(count);
  for (std::size_t i = 0; i < count; ++i)
    system.right_hand_side()[i] = {static_cast<float>(force[i].x), static_cast<float>(force[i].y), static_cast<float>(force[i].z), 0.0f};
  const auto report = system.solve(v, 1e-7, 500, Comm());
  EXPECT_TRUE(report.ok());
  std::vector<Vec3d> out;
  for (const Float4& u : v) out.push_back({u.x, u.y, u.z});
  return out;
}

std::vector<Pair> chain(std::uint32_t count, double friction) {
  std::vector<Pair> out;
  for (std::uint32_t i = 0; i + 1 < count; ++i) out.push_back({i, i + 1, friction, friction});
  return out;
}

// Reference velocities: g = 45, G = 600 nN·s/µm, F = 1 nN (cbm.md §1).

TEST(FrictionSystem, TwoCellsPulledApart) {
  const auto v = velocities(2, 45, chain(2, 600), {{1, 0, 0}, {-1, 0, 0}});
  EXPECT_NEAR(v[0].x, 8.0321285e-4, 8.0e-4 * kFloat);
  EXPECT_NEAR(v[1].x, -8.0321285e-4, 8.0e-4 * kFloat);
}

TEST(FrictionSystem, TwoCellsOneOfThemPulled) {
  const auto v = velocities(2, 45, chain(2, 600), {{1, 0, 0}, {0, 0, 0}});
  EXPECT_NEAR(v[0].x, 1.15127175e-2, 1.2e-2 * kFloat);
  EXPECT_NEAR(v[1].x, 1.07095047e-2, 1.1e-2 * kFloat);
}

TEST(FrictionSystem, OpenChainOfThree) {
  const auto v = velocities(3, 45, chain(3, 600), {{1, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  EXPECT_NEAR(v[0].x, 8.27293544e-3, 8.3e-3 * kFloat);
  EXPECT_NEAR(v[1].x, 7.22673893e-3, 7.3e-3 * kFloat);
  EXPECT_NEAR(v[2].x, 6.72254785e-3, 6.8e-3 * kFloat);
}

TEST(FrictionSystem, TriangleOfCells) {
  auto pairs = chain(3, 600);
  pairs.push_back({0, 2, 600, 600});
  const auto v = velocities(3, 45, pairs, {{1, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  EXPECT_NEAR(v[0].x, 7.76874435e-3, 7.8e-3 * kFloat);
  EXPECT_NEAR(v[1].x, 7.22673893e-3, 7.3e-3 * kFloat);
  EXPECT_NEAR(v[2].x, 7.22673893e-3, 7.3e-3 * kFloat);
}

TEST(FrictionSystem, ChainOfTenDecaysAlongItsLength) {
  std::vector<Vec3d> force(10);
  force[0] = {1, 0, 0};
  const auto v = velocities(10, 45, chain(10, 600), force);
  EXPECT_NEAR(v[0].x, 5.36173e-3, 1e-8);
  EXPECT_NEAR(v[1].x, 4.09719e-3, 1e-8);
  EXPECT_NEAR(v[4].x, 1.87780e-3, 1e-8);
  EXPECT_NEAR(v[9].x, 8.0455e-4, 1e-8);
}

TEST(FrictionSystem, ObliquePairWithDifferentNormalAndTangentialFriction) {
  const double s = std::sqrt(0.5);
  const auto v = velocities(2, 45, {{0, 1, 400, 150, {s, s, 0}}}, {{1, 0, 0}, {0, 0, 0}});
  EXPECT_NEAR(v[0].x, 0.01213161, 2e-8);
  EXPECT_NEAR(v[0].y, -0.00042878, 2e-8);
  EXPECT_NEAR(v[1].x, 0.01009062, 2e-8);
  EXPECT_NEAR(v[1].y, 0.00042878, 2e-8);
}

TEST(FrictionSystem, MomentumGoesToTheMediumOnly) {
  std::vector<Vec3d> force(10);
  force[3] = {1, -2, 0.5};
  const auto v = velocities(10, 45, chain(10, 600), force);
  Vec3d sum;
  for (const Vec3d& u : v) sum += u * 45.0;
  EXPECT_NEAR(sum.x, 1.0, 1e-5);
  EXPECT_NEAR(sum.y, -2.0, 1e-5);
  EXPECT_NEAR(sum.z, 0.5, 1e-5);
}

TEST(FrictionSystem, EqualForcesMoveAllAlike) {
  const auto v = velocities(6, 45, chain(6, 600), std::vector<Vec3d>(6, Vec3d{0.3, 0.1, -0.2}));
  for (const Vec3d& u : v) EXPECT_NEAR(u.x, 0.3 / 45.0, 0.3 / 45.0 * kFloat);
}

TEST(FrictionSystem, GivesTheSameBitsOnOneAndThreeThreads) {
  std::vector<Vec3d> force(50);
  for (std::size_t i = 0; i < 50; ++i) force[i] = {std::sin(1.0 + double(i)), std::cos(double(i)), 0.1 * double(i)};
  auto pairs = chain(50, 600);
  for (std::uint32_t i = 0; i + 7 < 50; i += 3) pairs.push_back({i, i + 7, 300, 100, {0, 1, 0}});
  const auto one = velocities(50, 45, pairs, force, 1);
  const auto three = velocities(50, 45, pairs, force, 3);
  for (std::size_t i = 0; i < 50; ++i) EXPECT_EQ(one[i], three[i]);
}

TEST(FrictionSystem, RefusesForcesThatAreNoNumbers) {
  FrictionSystem system;
  FrictionSystem::Layout layout;
  layout.point_count = 1;
  layout.owned = {1};
  system.set_layout(layout, 1);
  const float friction[1] = {1.0f};
  system.set_point_friction(friction);
  system.set_elements({}, FaceQuadrature::with_points(3));
  system.right_hand_side()[0] = {NAN, 0, 0, 0};
  std::vector<Float4> v(1);
  EXPECT_FALSE(system.solve(v, 1e-6, 10, Comm()).ok());
}

/// W, c, k_r, cap, a/c, b/c, κ: tent, Maugis–Dugdale, falling.
const TractionLaw kLaws[] = {{0.3, 0.5, 40.0, 0.0}, {0.3, 0.5, 40.0, 0.0, 0.1, 0.9, 25.0}, {0.3, 0.5, 40.0, 0.0, 0.1, 0.1}};

TEST(TractionLaw, DoesTheWorkOfAdhesionWhenPulledApart) {  // dcm.md T7.3
  for (const TractionLaw& law : kLaws) {
    double work = 0.0;
    const int n = 20000;
    for (int i = 0; i < n; ++i) work += law.attraction((i + 0.5) * law.range / n).slope * law.range / n;
    EXPECT_NEAR(work, 0.3, 1e-9) << law.flat_to;
    EXPECT_EQ(law.attraction(-0.01).energy, -0.3);
    EXPECT_EQ(law.attraction(law.range).energy, 0.0);
  }
  EXPECT_DOUBLE_EQ(kLaws[0].attraction(0.25).slope, 2.0 * 0.3 / 0.5);          // peak 2W/c
  EXPECT_DOUBLE_EQ(kLaws[1].attraction(0.25).slope, 0.3 / (0.9 * 0.5));        // plateau W/(c + b − a)·2
  EXPECT_DOUBLE_EQ(kLaws[2].attraction(0.05).slope, 2.0 * 0.3 / 0.5);          // highest near contact
  EXPECT_GT(kLaws[2].attraction(0.06).slope, kLaws[2].attraction(0.3).slope);  // and falling
}

TEST(TractionLaw, SlopesAreDerivativesOfEnergies) {
  for (TractionLaw law : kLaws)
    for (const double cap : {0.0, 0.05}) {
      law.cap = cap;
      for (double g = -0.3; g < 0.6; g += 0.0137) {
        const double h = 1e-6;
        EXPECT_NEAR((law.attraction(g + h).energy - law.attraction(g - h).energy) / (2 * h), law.attraction(g).slope, 1.2e-5);
        EXPECT_NEAR((law.repulse(g + h).energy - law.repulse(g - h).energy) / (2 * h), law.repulse(g).slope, 5e-5);
        EXPECT_GE(law.attraction(g).curvature, 0.0);
        EXPECT_GE(law.repulse(g).curvature, 0.0);
      }
    }
}

/// dcm.md §16.9: neither the energy nor the traction jumps where one piece of the law meets the next.
TEST(TractionLaw, IsContinuousWhereItsPiecesMeet) {
  for (TractionLaw law : kLaws)
    for (const double cap : {0.0, 0.05}) {
      law.cap = cap;
      for (const double joint : {0.0, law.flat_from * law.range, law.flat_to * law.range, law.range, -0.05, -0.02 * law.range}) {
        constexpr double kNear = 1e-12;
        for (const bool attracts : {true, false}) {
          const auto at = [&](double g) { return attracts ? law.attraction(g) : law.repulse(g); };
          EXPECT_NEAR(at(joint - kNear).energy, at(joint + kNear).energy, 1e-10) << joint;
          EXPECT_NEAR(at(joint - kNear).slope, at(joint + kNear).slope, joint == 0.0 && law.hertz > 0.0 ? 1e-4 : 1e-9)
              << joint;  // √g there
        }
      }
    }
}

/// The same wherever the pieces may meet: over any small way the traction changes by no more than the steepest slope of the law, 41 kPa/µm
/// for these (½ κ/√|g| of Hertz' overlap), and the energy by the traction times the way.
TEST(TractionLaw, NeverJumps) {
  constexpr double h = 1e-4;
  for (TractionLaw law : kLaws)
    for (const double cap : {0.0, 0.05}) {
      law.cap = cap;
      for (double g = -0.3; g < 0.6; g += h) {
        const double steep = std::max(41.0, law.hertz > 0.0 && g < 0.0 ? law.hertz / std::sqrt(std::max(-g - h, h)) : 0.0);
        for (const bool attracts : {true, false}) {
          const auto a = attracts ? law.attraction(g) : law.repulse(g), b = attracts ? law.attraction(g + h) : law.repulse(g + h);
          EXPECT_LE(std::abs(b.slope - a.slope), steep * h) << g;
          EXPECT_LE(std::abs(b.energy - a.energy - 0.5 * h * (a.slope + b.slope)), steep * h * h) << g;
        }
      }
    }
}

TEST(TractionLaw, OfHertzCarriesWhatASphereInAPlaneCarries) {  // 4/3 E* √R δ^{3/2}
  const double modulus = 1.5, radius = 6.0, depth = 0.3;
  TractionLaw law;
  law.hertz = modulus / (std::numbers::pi * std::sqrt(radius));
  double force = 0.0;  // over the disc r² < 2Rδ, whose overlap is δ − r²/2R
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double s = (i + 0.5) / n;  // (r²)/(2Rδ)
    force -= law.repulse(-depth * (1.0 - s)).slope * std::numbers::pi * 2.0 * radius * depth / n;
  }
  EXPECT_NEAR(force, 4.0 / 3.0 * modulus * std::sqrt(radius) * std::pow(depth, 1.5), 1e-5);
}

TEST(TractionLaw, CapLimitsTheTraction) {
  const TractionLaw law{0.0, 0.5, 40.0, 0.1};
  EXPECT_DOUBLE_EQ(law.repulse(-0.05).slope, -2.0);
  EXPECT_DOUBLE_EQ(law.repulse(-3.0).slope, -4.0);
}

/// Two spheres rest where Johnson, Kendall & Roberts have them when each gives half of δ0 = a0²/(3R*), a0³ = 9πWR*²/(2E*): W/2 of its own adhesion and
/// πk_wRδ² of a Winkler foundation balance at δ² = W/k_w. A sphere that does not adhere carries the force of Hertz, 4/3 E' √R δ^{3/2}, where its contact
/// has the radius 0.3 R.
TEST(SphereFoundation, GivesWayAsJohnsonKendallAndRobertsAndAsHertz) {
  const double modulus = 1.5 / 0.84, radius = 5.0, half_radius = 2.5;
  for (const double adhesion : {0.1, 0.3}) {
    const double contact = std::cbrt(9.0 * std::numbers::pi * adhesion * half_radius * half_radius / modulus);  // E* = E'/2
    ASSERT_GT(contact, 0.3 * radius);
    const double given = 0.5 * contact * contact / (3.0 * half_radius);
    EXPECT_NEAR(sphere_foundation(modulus, adhesion, radius) * given * given / adhesion, 1.0, 1e-12) << adhesion;
  }
  const double depth = 0.09 * radius;  // a² = Rδ
  const double hertz = 4.0 / 3.0 * modulus * std::sqrt(radius) * depth * std::sqrt(depth);
  EXPECT_NEAR(std::numbers::pi * sphere_foundation(modulus, 0.0, radius) * radius * depth * depth / hertz, 1.0, 1e-12);
}

TEST(OpposedWeight, IsASmoothStepBetweenItsEnds) {
  EXPECT_EQ(OpposedWeight::of(0.6).value, 1.0);
  EXPECT_EQ(OpposedWeight::of(-0.4).value, 0.0);
  EXPECT_NEAR(OpposedWeight::of(0.1).value, 0.5, 1e-15);
  for (double m = -0.29; m < 0.5; m += 0.03) {
    const double h = 1e-6;
    EXPECT_NEAR((OpposedWeight::of(m + h).value - OpposedWeight::of(m - h).value) / (2 * h), OpposedWeight::of(m).slope, 1e-9);
  }
}

}  // namespace
}  // namespace morula
