#include "cbm/pair_forces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "cbm/division_ramp.h"
#include "cbm/laws/jkr.h"

namespace morula::cbm {
namespace {

constexpr double kPi = std::numbers::pi;

struct Pair {
  std::size_t i, j;
  bool attached;
  double offset;
};

struct Cluster {
  std::vector<Vec3d> position;
  std::vector<double> radius;
  std::vector<std::size_t> type;
  std::vector<Pair> pairs;
};

ContactTable two_types() {
  const std::vector<SphereParameters> types = {{0.45, 0.4}, {1.0, 0.3}};
  const std::vector<SurfacePair> surfaces = {{0.1, 60, 50}, {0.05, 40, 20}, {0.05, 40, 20}, {0.0, 10, 30}};
  return {types, surfaces};
}

Cluster random_cluster(int count, unsigned seed) {
  Cluster cluster;
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> place(-12.0, 12.0), size(5.0, 6.5);
  for (int k = 0; k < count; ++k) {
    cluster.position.push_back({place(generator), place(generator), place(generator)});
    cluster.radius.push_back(size(generator));
    cluster.type.push_back(static_cast<std::size_t>(k % 2));
  }
  for (std::size_t i = 0; i < cluster.position.size(); ++i) {
    for (std::size_t j = i + 1; j < cluster.position.size(); ++j)
      cluster.pairs.push_back({i, j, (i + j) % 3 != 0, (i * j) % 7 == 0 ? 0.4 : 0.0});
  }
  return cluster;
}

/// The pair law of the contact of two JKR or Hertz spheres, or of one and a plane.
PairLaw<double> scalar_law(const PairContact& contact, double reduced) {
  const auto& c = contact.coefficient;
  return make_pair_law({c[0], c[1], c[2], c[3]}, reduced);
}
PairLaw<double> scalar_law(const PairContact& contact, double a, double b) { return scalar_law(contact, reduced_radius(a, b)); }

PairResponse respond(const Cluster& c, const ContactTable& table, const Pair& pair) {
  return evaluate_pair(table.entry(c.type[pair.i], c.type[pair.j]).contact, c.position[pair.j] - c.position[pair.i], c.radius[pair.i],
                       c.radius[pair.j], pair.attached, pair.offset);
}

double energy(const Cluster& cluster, const ContactTable& table) {
  double sum = 0.0;
  for (const Pair& pair : cluster.pairs) sum += respond(cluster, table, pair).energy;
  return sum;
}

TEST(PairForces, HaveTheSameBitsInAFullBlockAsAlone) {
  const auto table = two_types();
  const auto cluster = random_cluster(20, 5);
  PairBlock block;
  int filled = 0;
  std::size_t first = 0, touching = 0;
  for (std::size_t k = 0; k < cluster.pairs.size(); ++k) {
    const Pair& pair = cluster.pairs[k];
    block.set(filled++, cluster.position[pair.j] - cluster.position[pair.i], cluster.radius[pair.i], cluster.radius[pair.j],
              table.entry(cluster.type[pair.i], cluster.type[pair.j]).contact, pair.attached, pair.offset);
    if (filled < PairBlock::kWidth && k + 1 < cluster.pairs.size()) continue;
    evaluate(block, filled);
    for (int lane = 0; lane < filled; ++lane) {
      const auto alone = respond(cluster, table, cluster.pairs[first + static_cast<std::size_t>(lane)]);
      touching += alone.area > 0.0;
      EXPECT_EQ(block.force[lane], alone.force);
      EXPECT_EQ(block.energy[lane], alone.energy);
      EXPECT_EQ(block.area[lane], alone.area);
      EXPECT_EQ(block.stiffness[lane], alone.stiffness);
      EXPECT_EQ(block.normal[2][lane], alone.normal.z);
      EXPECT_EQ(block.attached_next[lane], alone.attached_next);
    }
    first = k + 1;
    filled = 0;
  }
  EXPECT_GE(touching, 10u);
}

TEST(PairForces, OfTwoLawsInOneBlockAreThoseOfEachAlone) {
  const std::vector<SphereParameters> types = {{0.45, 0.4}, {1.0, 0.3, hertz_law()}};
  const std::vector<SurfacePair> surfaces = {{0.1, 60, 50}, {0.05, 40, 20}, {0.05, 40, 20}, {0.2, 10, 30}};
  const ContactTable table(types, surfaces);
  const auto cluster = random_cluster(20, 7);
  PairBlock block;
  for (std::size_t first = 0; first + PairBlock::kWidth <= cluster.pairs.size(); first += PairBlock::kWidth) {
    for (int lane = 0; lane < PairBlock::kWidth; ++lane) {
      const Pair& pair = cluster.pairs[first + static_cast<std::size_t>(lane)];
      block.set(lane, cluster.position[pair.j] - cluster.position[pair.i], cluster.radius[pair.i], cluster.radius[pair.j],
                table.entry(cluster.type[pair.i], cluster.type[pair.j]).contact, pair.attached, pair.offset);
    }
    evaluate(block, PairBlock::kWidth);
    for (int lane = 0; lane < PairBlock::kWidth; ++lane) {
      const auto alone = respond(cluster, table, cluster.pairs[first + static_cast<std::size_t>(lane)]);
      EXPECT_EQ(block.force[lane], alone.force);
      EXPECT_EQ(block.energy[lane], alone.energy);
      EXPECT_EQ(block.distance[lane], alone.distance);
      EXPECT_EQ(block.attached_next[lane], alone.attached_next);
    }
  }
}

TEST(PairForces, AreThoseOfTheScalarLaw) {
  const auto table = two_types();
  const auto cluster = random_cluster(12, 6);
  for (const Pair& pair : cluster.pairs) {
    const auto found = respond(cluster, table, pair);
    const auto law =
        scalar_law(table.entry(cluster.type[pair.i], cluster.type[pair.j]).contact, cluster.radius[pair.i], cluster.radius[pair.j]);
    const double overlap = cluster.radius[pair.i] + cluster.radius[pair.j] - found.distance - pair.offset;
    const auto expected = contact_response(law, overlap, pair.attached);
    EXPECT_EQ(found.force, expected.force);
    EXPECT_EQ(found.stiffness, expected.stiffness);
    EXPECT_EQ(found.area, expected.area);
    EXPECT_EQ(found.energy, expected.energy);
    EXPECT_EQ(found.attached_next, update_attached(overlap, pair.attached, law));
  }
}

TEST(PairForces, AreTheGradientOfTheEnergyWithoutNetForceOrTorque) {
  const auto table = two_types();
  auto cluster = random_cluster(14, 3);
  std::vector<Vec3d> force(cluster.position.size());
  for (const Pair& pair : cluster.pairs) {
    const auto r = respond(cluster, table, pair);
    force[pair.i] -= r.force * r.normal;
    force[pair.j] += r.force * r.normal;
  }
  Vec3d total{}, torque{};
  double largest = 0.0;
  for (std::size_t i = 0; i < cluster.position.size(); ++i) {
    total += force[i];
    torque += cross(cluster.position[i], force[i]);
    largest = std::max(largest, norm(force[i]));
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
      EXPECT_NEAR(force[i][axis], -slope, 1e-7 * largest);
    }
  }
}

TEST(PairForces, StiffnessIsTheHessianWhereTheHessianIsPositive) {
  // Two attached spheres in tension on the rising branch: k n nᵀ along the normal, −F/d across it, which the operator leaves out.
  const auto table = two_types();
  const auto& contact = table.entry(0, 0).contact;
  const Vec3d between{5.5, 6.0, 3.0};
  const auto response = evaluate_pair(contact, between, 5.0, 5.0, true, 0.0);
  ASSERT_LT(response.force, 0.0);
  ASSERT_GT(response.stiffness, 0.0);
  const double h = 1e-4;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3d step{};
    step[axis] = h;
    const auto force = [&](const Vec3d& at) {
      const auto r = evaluate_pair(contact, at, 5.0, 5.0, true, 0.0);
      return r.force * r.normal;  // on j
    };
    const Vec3d column = (force(between + step) - force(between - step)) * (-0.5 / h);
    Vec3d unit{};
    unit[axis] = 1.0;
    const Vec3d along = dot(unit, response.normal) * response.normal;
    const Vec3d expected = response.stiffness * along - response.force / response.distance * (unit - along);
    EXPECT_LT(norm(column - expected), 1e-7);
  }
}

TEST(PairForces, ArePerfectlyAntisymmetricInThePair) {
  const auto table = two_types();
  const Vec3d between{3.1, -7.7, 5.2};
  const auto one = evaluate_pair(table.entry(0, 1).contact, between, 5.3, 6.1, true, 0.0);
  const auto other = evaluate_pair(table.entry(1, 0).contact, -between, 6.1, 5.3, true, 0.0);
  EXPECT_EQ(one.force, other.force);
  EXPECT_EQ(one.area, other.area);
  EXPECT_EQ(one.energy, other.energy);
  EXPECT_EQ(one.normal, -other.normal);
}

TEST(PairForces, AreaOfTheReferencePairIsThatOfItsRadius) {
  const auto r = evaluate_pair(two_types().entry(0, 0).contact, {9.0, 0.0, 0.0}, 5.0, 5.0, true, 0.0);
  EXPECT_NEAR(r.area, kPi * 3.026791 * 3.026791, 1e-4);  // a at δ = 1 of the reference pair
}

TEST(ContactTable, KnowsRigidMaterialsAndWhoDoesNotAdhere) {
  // R = 5, E* = 0.535714286 (plane of the physics page), δ = 1: (4/3) E* √5 without adhesion.
  const std::vector<SphereParameters> types = {{0.45, 0.4}, {0.45, 0.4, hertz_law()}};
  const std::vector<SurfacePair> surfaces = {{0.1, 1, 2}, {0.1, 3, 4}, {0.1, 5, 6}, {0.0, 0, 0},  //
                                             {0.1, 3, 4}, {0.1, 1, 2}, {0.1, 5, 6}, {0.0, 0, 0}};
  const ContactTable table(types, surfaces);
  ASSERT_EQ(table.material_count(), 4u);
  const auto wall = contact_response(scalar_law(table.entry(0, 3).contact, 5.0), 1.0, false);
  EXPECT_NEAR(wall.force, 4.0 / 3.0 * 0.535714286 * std::sqrt(5.0), 1e-8);
  EXPECT_NEAR(wall.area, 5.0 * kPi, 1e-12);
  // Sphere on a rigid plane, R = 5, W = 0.1, attached at δ = 0: −2.0943951 nN (physics page).
  EXPECT_NEAR(contact_response(scalar_law(table.entry(0, 2).contact, 5.0), 0.0, true).force, -2.0943951, 1e-6);
  EXPECT_EQ(table.entry(0, 2).tangential_friction, 6.0);
  EXPECT_FALSE(is_adhesive(scalar_law(table.entry(0, 1).contact, 5.0, 5.0)));
  EXPECT_FALSE(is_adhesive(scalar_law(table.entry(1, 2).contact, 5.0)));
  EXPECT_TRUE(is_adhesive(scalar_law(table.entry(0, 0).contact, 5.0, 5.0)));
}

TEST(PairForces, CoincidentCentresGetADefiniteDirection) {
  const auto table = two_types();
  const auto r = evaluate_pair(table.entry(0, 0).contact, {0, 0, 0}, 5.0, 5.0, true, 0.0);
  EXPECT_EQ(r.normal, (Vec3d{0, 0, 1}));
  EXPECT_TRUE(std::isfinite(r.force));
  EXPECT_GT(r.force, 0.0);
}

TEST(PairForces, FlagsChangeOnlyWhereAPairTouchesOrBreaks) {
  const auto table = two_types();
  // Attached and inside the branch; attached and beyond it; free and touching; free with a gap; overlapping without adhesion (type 1–1).
  const double distances[] = {11.0, 11.2, 9.9, 10.1, 9.0};
  const bool flags[] = {true, true, false, false, false};
  const bool expected[] = {true, false, true, false, false};
  for (std::size_t k = 0; k < 5; ++k) {
    const std::size_t type = k == 4;
    EXPECT_EQ(evaluate_pair(table.entry(type, type).contact, {distances[k], 0, 0}, 5.0, 5.0, flags[k], 0.0).attached_next, expected[k])
        << k;
  }
}

TEST(PairForces, VirialPressureOfAnFccCrystalIsTheLatticeSum) {
  // Twelve neighbours at distance d with force F: p = 2√2 F/d² for the lattice cell d³/√2.
  const double d = 10.0, force = 0.7;
  EXPECT_NEAR(virial_pressure(12 * contact_arm(d, 6.0, 6.0) * force, d * d * d / std::sqrt(2.0)), 2.0 * std::sqrt(2.0) * force / (d * d),
              1e-15);
}

TEST(PairForces, PressureOfASphereIsThatOfTheVolumeThatItLeaves) {
  const double ball = 900.0, modulus = 2.5;
  for (const double ratio : {1.2, 1.0, 0.95, 0.9, 0.85, 0.5, 0.37}) {
    const double p = -modulus * std::log(ratio);  // p V = virial/3
    EXPECT_NEAR(sphere_pressure(3.0 * p * ratio * ball, ball, modulus), p, 1e-9) << ratio;
    EXPECT_NEAR(pressed_volume(p, ball, modulus), ratio * ball, 1e-9 * ball) << ratio;
  }
  const double most = 3.0 * modulus * ball / std::numbers::e;  // no volume has more: it stays at V0/e
  EXPECT_NEAR(sphere_pressure(0.999999 * most, ball, modulus), modulus, 5e-3);
  EXPECT_NEAR(sphere_pressure(2.0 * most, ball, modulus), 2.0 * modulus, 1e-12);
  EXPECT_EQ(sphere_pressure(0.0, ball, modulus), 0.0);
  EXPECT_EQ(sphere_pressure(30.0, 10.0, 0.0), 1.0);
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
  const std::vector<SphereParameters> types = {{0.45, 0.4}};
  const std::vector<SurfacePair> surfaces = {{0.0, 50, 50}};
  const ContactTable table(types, surfaces);
  double virial = 0.0, area = 0.0;
  for (std::size_t k = 1; k < 13; ++k) {
    const auto r = evaluate_pair(table.entry(0, 0).contact, cluster.position[k], radius, radius, false, 0.0);
    virial += contact_arm(r.distance, radius, radius) * r.force;
    area += r.area;
  }
  EXPECT_NEAR(1000.0 * virial_pressure(virial, d * d * d / std::sqrt(2.0)), 27.11, 0.005);
  EXPECT_NEAR(area, 12 * kPi * 0.5 * radius * (2 * radius - d), 1e-10);  // πR*δ each
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
  const auto& contact = table.entry(0, 0).contact;
  const auto law = scalar_law(contact, r, r);
  const double born = sister_distance(r, r), ordinary = 2 * r - zero_load_overlap(law);
  for (const double age : {0.0, 450.0, 900.0, 1800.0, 1e6}) {
    const double offset = sister_overlap_offset(zero_load_overlap(law), r, r, r, r, age);
    const double rest = born + (ordinary - born) * std::min(1.0, age / 1800.0);  // grows linearly
    EXPECT_NEAR(evaluate_pair(contact, {rest, 0, 0}, r, r, true, offset).force, 0.0, 1e-12) << age;
    EXPECT_GE(offset, 0.0);
  }
  EXPECT_EQ(sister_overlap_offset(zero_load_overlap(law), r, r, r, r, 1800.0), 0.0);
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
