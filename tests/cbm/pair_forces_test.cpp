#include "cbm/pair_forces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "cbm/division_ramp.h"

namespace morula::cbm {
namespace {

constexpr double kPi = std::numbers::pi;

struct Cluster {
  std::vector<Vec3d> position;
  std::vector<double> radius;
  std::vector<std::uint16_t> type;
  std::vector<SpherePair> pairs;
  [[nodiscard]] SphereView view() const { return {position, radius, type}; }
};

ContactTable two_types() {
  const std::vector<SphereParameters> types = {{0.45, 0.4}, {1.0, 0.3}};
  const std::vector<SurfacePair> surfaces = {{0.1, 60, 50}, {0.05, 40, 20}, {0.05, 40, 20}, {0.0, 10, 30}};
  return {types, surfaces};
}

Space open_space() {
  Space space;
  space.box = {{-1e3, -1e3, -1e3}, {1e3, 1e3, 1e3}};
  return space;
}

Cluster random_cluster(int count, unsigned seed) {
  Cluster cluster;
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> place(-12.0, 12.0), size(5.0, 6.5);
  for (int k = 0; k < count; ++k) {
    cluster.position.push_back({place(generator), place(generator), place(generator)});
    cluster.radius.push_back(size(generator));
    cluster.type.push_back(static_cast<std::uint16_t>(k % 2));
  }
  for (std::uint32_t i = 0; i < cluster.position.size(); ++i) {
    for (std::uint32_t j = i + 1; j < cluster.position.size(); ++j)
      cluster.pairs.push_back({i, j, (i + j) % 3 != 0, (i * j) % 7 == 0 ? 0.4 : 0.0});
  }
  return cluster;
}

double energy(const Cluster& cluster, const ContactTable& table) {
  std::vector<PairResponse> out(cluster.pairs.size());
  evaluate_pairs(open_space(), cluster.view(), table, cluster.pairs, out);
  double sum = 0.0;
  for (const auto& response : out) sum += response.energy;
  return sum;
}

TEST(PairForces, AreTheGradientOfTheEnergyWithoutNetForceOrTorque) {
  const auto table = two_types();
  auto cluster = random_cluster(14, 3);
  std::vector<PairResponse> out(cluster.pairs.size());
  evaluate_pairs(open_space(), cluster.view(), table, cluster.pairs, out);
  const auto sums = sum_contacts(cluster.position.size(), cluster.pairs, out);
  Vec3d total{}, torque{};
  double largest = 0.0;
  for (std::size_t i = 0; i < cluster.position.size(); ++i) {
    total += sums.force[i];
    torque += cross(cluster.position[i], sums.force[i]);
    largest = std::max(largest, norm(sums.force[i]));
  }
  ASSERT_GT(largest, 1.0);
  EXPECT_LT(norm(total), 1e-12 * largest);
  EXPECT_LT(norm(torque), 1e-11 * largest);
  const double h = 1e-4;
  for (std::size_t i = 0; i < cluster.position.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const double here = cluster.position[i][axis];
      const auto at = [&](double shift) {
        cluster.position[i][axis] = here + shift;
        const double value = energy(cluster, table);
        cluster.position[i][axis] = here;
        return value;
      };
      const double slope = (8.0 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12.0 * h);
      EXPECT_NEAR(sums.force[i][axis], -slope, 1e-7 * largest);
    }
  }
}

TEST(PairForces, StiffnessIsTheHessianWhereTheHessianIsPositive) {
  // Two attached spheres in tension on the rising branch: both parts of the Hessian are positive, so that nothing is dropped.
  const auto table = two_types();
  const auto& entry = table.entry(0, 0);
  const Vec3d between{5.5, 6.0, 3.0};
  const auto response = evaluate_pair(entry, between, 5.0, 5.0, true, 0.0);
  ASSERT_LT(response.force, 0.0);
  ASSERT_GT(response.stiffness, 0.0);
  const double h = 1e-4;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3d step{};
    step[axis] = h;
    const auto force = [&](const Vec3d& at) {
      const auto r = evaluate_pair(entry, at, 5.0, 5.0, true, 0.0);
      return r.force * r.normal;  // on j
    };
    const Vec3d column = (force(between + step) - force(between - step)) * (-0.5 / h);
    Vec3d unit{};
    unit[axis] = 1.0;
    const Vec3d along = dot(unit, response.normal) * response.normal;
    const Vec3d expected = response.stiffness * along + response.transverse_stiffness * (unit - along);
    EXPECT_LT(norm(column - expected), 1e-7);
  }
}

TEST(PairForces, ArePerfectlyAntisymmetricInThePair) {
  const auto table = two_types();
  const Vec3d between{3.1, -7.7, 5.2};
  const auto one = evaluate_pair(table.entry(0, 1), between, 5.3, 6.1, true, 0.0);
  const auto other = evaluate_pair(table.entry(1, 0), -between, 6.1, 5.3, true, 0.0);
  EXPECT_EQ(one.force, other.force);
  EXPECT_EQ(one.area, other.area);
  EXPECT_EQ(one.energy, other.energy);
  EXPECT_EQ(one.normal, -other.normal);
}

TEST(PairForces, FrictionScalarsBuildTheFrictionBlock) {
  const auto table = two_types();
  const auto r = evaluate_pair(table.entry(0, 0), {9.0, 0.0, 0.0}, 5.0, 5.0, true, 0.0);
  EXPECT_NEAR(r.area, kPi * 3.026791 * 3.026791, 1e-4);  // a at δ = 1 of the reference pair
  EXPECT_DOUBLE_EQ(r.isotropic_friction, 50.0 * r.area);
  EXPECT_NEAR(r.isotropic_friction + r.axial_friction, 60.0 * r.area, 1e-10);
}

TEST(PairForces, AWallPushesLikeARigidPlaneWithoutFriction) {
  // R = 5, E* = 0.535714286 (plane of the physics page), δ = 1: (4/3) E* √5.
  const auto r = evaluate_wall({0.45, 0.4}, 5.0, {0, 0, -1}, 4.0);
  EXPECT_NEAR(r.force, 4.0 / 3.0 * 0.535714286 * std::sqrt(5.0), 1e-8);
  EXPECT_NEAR(r.area, 5.0 * kPi, 1e-12);
  EXPECT_EQ(r.isotropic_friction, 0.0);
  EXPECT_EQ(evaluate_wall({0.45, 0.4}, 5.0, {0, 0, -1}, 5.1).force, 0.0);
  EXPECT_GT(evaluate_wall({0.45, 0.4}, 5.0, {0, 0, -1}, -1.0).force, r.force);
}

TEST(PairForces, CoincidentCentresGetADefiniteDirection) {
  const auto table = two_types();
  const auto r = evaluate_pair(table.entry(0, 0), {0, 0, 0}, 5.0, 5.0, true, 0.0);
  EXPECT_EQ(r.normal, (Vec3d{1, 0, 0}));
  EXPECT_TRUE(std::isfinite(r.force));
  EXPECT_GT(r.force, 0.0);
}

TEST(PairForces, SeeTheNearestImageInAPeriodicDomain) {
  Space space;
  space.box = {{0, 0, 0}, {40, 40, 40}};
  space.boundary[0] = {BoundaryKind::kPeriodic, BoundaryKind::kPeriodic};
  Cluster cluster{{{1, 5, 5}, {32, 5, 5}}, {5, 5}, {0, 0}, {{0, 1, true, 0.0}}};
  std::vector<PairResponse> out(1);
  evaluate_pairs(space, cluster.view(), two_types(), cluster.pairs, out);
  EXPECT_DOUBLE_EQ(out[0].distance, 9.0);
  EXPECT_DOUBLE_EQ(out[0].normal.x, -1.0);
}

TEST(PairForces, FlagsChangeOnlyWhereAPairTouchesOrBreaks) {
  const auto table = two_types();
  // Attached and inside the branch; attached and beyond it; free and touching; free with a gap; overlapping without adhesion (type 1–1).
  Cluster cluster;
  const double distances[] = {11.0, 11.2, 9.9, 10.1, 9.0};
  const bool flags[] = {true, true, false, false, false};
  for (std::uint32_t k = 0; k < 5; ++k) {
    const auto type = static_cast<std::uint16_t>(k == 4);
    cluster.position.push_back({0, 100.0 * k, 0});
    cluster.position.push_back({distances[k], 100.0 * k, 0});
    for (int both = 0; both < 2; ++both) {
      cluster.radius.push_back(5.0);
      cluster.type.push_back(type);
    }
    cluster.pairs.push_back({2 * k, 2 * k + 1, flags[k], 0.0});
  }
  EXPECT_EQ(update_attached(open_space(), cluster.view(), table, cluster.pairs), 2u);
  const bool expected[] = {true, false, true, false, false};
  for (int k = 0; k < 5; ++k) EXPECT_EQ(cluster.pairs[k].attached, expected[k]) << k;
}

TEST(PairForces, ReachCoversTheLongestAdhesiveGap) {
  // X of the stickiest, softest pair for R = 5: 1.509423463 (reference pair).
  EXPECT_NEAR(two_types().reach(5.0), 10.0 + 0.75 * 1.509423463, 1e-8);
}

TEST(PairForces, VirialPressureOfAnFccCrystalIsTheLatticeSum) {
  // Twelve neighbours at distance d with force F: p = 2√2 F/d² for the lattice cell d³/√2.
  const double d = 10.0, force = 0.7;
  EXPECT_NEAR(virial_pressure(12 * d * force, d * d * d / std::sqrt(2.0)), 2.0 * std::sqrt(2.0) * force / (d * d), 1e-15);
}

TEST(PairForces, VirialPressureOfHertzSpheresInFcc) {
  // R = 6, E = 0.45, ν = 0.4, W = 0, s = 1 − d/2R = 0.12: p_H = 27.11 Pa (physics page, from p_H = 1.885618 E* s^1.5/(1 − s)²).
  const double radius = 6.0, d = 2 * radius * (1 - 0.12);
  Cluster cluster;
  cluster.position = {{0, 0, 0}};
  const double c = d / std::sqrt(2.0);
  for (const int a : {-1, 1}) {
    for (const int b : {-1, 1}) {
      cluster.position.push_back({a * c, b * c, 0});
      cluster.position.push_back({a * c, 0, b * c});
      cluster.position.push_back({0, a * c, b * c});
    }
  }
  cluster.radius.assign(13, radius);
  cluster.type.assign(13, 0);
  for (std::uint32_t k = 1; k < 13; ++k) cluster.pairs.push_back({0, k, false, 0.0});
  const std::vector<SphereParameters> types = {{0.45, 0.4}};
  const std::vector<SurfacePair> surfaces = {{0.0, 50, 50}};
  std::vector<PairResponse> out(12);
  evaluate_pairs(open_space(), cluster.view(), ContactTable(types, surfaces), cluster.pairs, out);
  const auto sums = sum_contacts(13, cluster.pairs, out);
  EXPECT_EQ(sums.count[0], 12u);
  EXPECT_NEAR(1000.0 * virial_pressure(sums.virial[0], d * d * d / std::sqrt(2.0)), 27.11, 0.005);
  EXPECT_NEAR(sums.area[0], 12 * kPi * 0.5 * radius * (2 * radius - d), 1e-10);  // πR*δ each
}

TEST(DivisionRamp, EqualSistersAreBornInsideTheirMother) {
  const double mother = 6.0, daughter = mother * 0.7937005259840998;
  EXPECT_NEAR(sister_distance(daughter, daughter) / mother, 0.4125989, 5e-8);
  EXPECT_NEAR((2 * daughter - sister_distance(daughter, daughter)) / mother, 1.174802, 5e-7);
}

TEST(DivisionRamp, UnequalSistersStayInsideTheirMother) {
  const double volume = 216.0, fraction = 0.3;
  const double r1 = std::cbrt(fraction * volume), r2 = std::cbrt((1 - fraction) * volume);
  const double d = sister_distance(r1, r2);
  const double first = d * (1 - fraction) + r1, second = d * fraction + r2;
  EXPECT_LE(first, 6.0 + 1e-12);
  EXPECT_LE(second, 6.0 + 1e-12);
  EXPECT_NEAR(std::max(first, second), 6.0, 1e-12);
}

TEST(DivisionRamp, SistersAreBornWithoutLoadAndEndAsAnOrdinaryPair) {
  const auto table = two_types();
  const double mother = 6.0, r = mother / std::cbrt(2.0);
  const auto& entry = table.entry(0, 0);
  const auto law = make_pair_law(entry.material, r, r);
  const double born = sister_distance(r, r), ordinary = 2 * r - zero_load_overlap(law);
  for (const double age : {0.0, 150.0, 300.0, 600.0, 1e6}) {
    const double offset = sister_overlap_offset(law, r, r, r, r, age);
    const double rest = born + (ordinary - born) * std::min(1.0, age / 600.0);  // grows linearly
    EXPECT_NEAR(evaluate_pair(entry, {rest, 0, 0}, r, r, true, offset).force, 0.0, 1e-12) << age;
    EXPECT_GE(offset, 0.0);
  }
  EXPECT_EQ(sister_overlap_offset(law, r, r, r, r, 600.0), 0.0);
}

TEST(DivisionRamp, KnowsSistersByTheirIds) {
  const CellId mother = CellId::founder(17).daughter(1);
  EXPECT_TRUE(are_sisters(mother.daughter(0), mother.daughter(1)));
  EXPECT_TRUE(are_sisters(mother.daughter(1), mother.daughter(0)));
  EXPECT_FALSE(are_sisters(mother.daughter(0), mother.daughter(0)));
  EXPECT_FALSE(are_sisters(mother.daughter(0), CellId::founder(18).daughter(1).daughter(1)));
  EXPECT_FALSE(are_sisters(mother, mother.daughter(1)));
  EXPECT_FALSE(are_sisters(mother.daughter(0).daughter(0), mother.daughter(1).daughter(0))) << "cousins";
  EXPECT_FALSE(are_sisters(CellId::founder(2), CellId::founder(3)));
}

}  // namespace
}  // namespace morula::cbm
