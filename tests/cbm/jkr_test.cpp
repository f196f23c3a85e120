#include "cbm/laws/jkr.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace morula::cbm {
namespace {

constexpr double kPi = std::numbers::pi;

/// R = 5/5 µm, E = 0.45 kPa, ν = 0.4, W = 0.1 nN/µm: the reference pair of the physics page.
PairLaw<double> reference_pair() { return make_pair_law(ContactMaterial::elastic(0.45, 0.4, 0.45, 0.4, 0.1), 5.0, 5.0); }

void expect_relative(double value, double expected, double tolerance) { EXPECT_NEAR(value, expected, tolerance * std::abs(expected)); }

struct MasterPoint {
  double x, overlap, force;
};
// Johnson, Kendall & Roberts 1971 in dimensionless form: δ̃ = x² − √(2x), F̃ = (4/3)x³ − √8 x^(3/2); digits as tabulated.
const std::vector<MasterPoint> kMasterCurve = {{0.6, -0.735445, -1.026534}, {0.8, -0.624911, -1.341191}, {1.040042, -0.360562, -1.5},
                                               {1.259921, 0.0, -4.0 / 3.0}, {1.5, 0.517949, -0.696152},  {1.650964, 0.908560, 0.0},
                                               {2.0, 2.0, 8.0 / 3.0},       {3.0, 6.550510, 21.303062}};

TEST(Jkr, FollowsTheMasterCurve) {
  const auto law = reference_pair();
  for (const auto& point : kMasterCurve) {
    const auto contact = jkr_contact(law, point.overlap * law.length);
    EXPECT_NEAR(contact.contact_radius / law.radius, point.x, 4e-6) << point.x;  // 6 digits of δ̃ near the fold give 4e-6 in x
    EXPECT_NEAR(contact.force / law.force, point.force, 6e-6) << point.x;
  }
}

TEST(Jkr, FoldsBackAtFiveSixthsOfTheUnitForce) {
  const auto law = reference_pair();
  const auto contact = jkr_contact(law, kBreakOverlap * law.length);
  EXPECT_NEAR(contact.contact_radius / law.radius, 0.5, 1e-7);  // the slope dx/dδ is infinite: √ of the rounding of δ
  EXPECT_NEAR(contact.force / law.force, -5.0 / 6.0, 1e-7);
}

TEST(Jkr, SolvesTheBranchToRoundingFromTheFoldToAnyOverlap) {
  for (int k = 0; k <= 4000; ++k) {
    const double e = std::pow(10.0, -6.0 + 11.0 * k / 4000.0);
    const double m = e * e * (e * (e + 4.0) + 6.0);
    const double y = jkr_branch(0.25 * (m - 3.0));
    // δ̃ itself is rounded to 1e-16; m and hence e² inherit 4e-16 near the fold.
    EXPECT_NEAR(y - 1.0, e, 1e-14 * (1.0 + e) + 4e-16 / e) << e;
  }
}

struct TablePoint {
  double ratio, contact_radius, force, area;
};
const std::vector<TablePoint> kReferenceTable = {
    {-0.70, 1.335319, -0.925905, 5.60170},      {-0.60, 1.611251, -1.080520, 8.15598}, {-0.50, 1.804718, -1.149521, 10.23219},
    {-0.360562, 2.020349, -1.178097, 12.82340}, {0.0, 2.447478, -1.047198, 18.81861},  {0.25, 2.686963, -0.842478, 22.68157},
    {0.30, 2.731304, -0.792823, 23.43635},      {0.50, 2.899407, -0.568744, 26.40998}, {0.75, 3.092499, -0.237027, 30.04477},
    {1.0, 3.270836, 0.145391, 33.60991},        {1.5, 3.594379, 1.042742, 40.58801},   {2.0, 3.885130, 2.094395, 47.41994},
    {3.0, 4.399027, 4.590885, 60.79433}};

TEST(Jkr, GivesTheReferencePair) {
  const auto law = reference_pair();
  EXPECT_DOUBLE_EQ(law.reduced_radius, 2.5);
  expect_relative(law.modulus, 0.267857143, 2e-9);
  expect_relative(law.length, 1.509423463, 1e-9);
  expect_relative(law.radius, 1.942564969, 1e-9);
  expect_relative(law.force, 0.785398, 1e-6);
  expect_relative(pull_off_force(law), 1.178097, 1e-6);
  for (const auto& point : kReferenceTable) {
    const auto contact = contact_response(law, point.ratio * law.length, true);
    expect_relative(contact.contact_radius, point.contact_radius, 1e-6);
    expect_relative(contact.force, point.force, 1.5e-6);  // the table has six digits: half a unit of the last is 1e-6 of the smaller ones
    expect_relative(contact.area, point.area, 1e-6);
    EXPECT_DOUBLE_EQ(contact.area, kPi * contact.contact_radius * contact.contact_radius);
  }
  const auto at_break = contact_response(law, kBreakOverlap * law.length, true);
  expect_relative(at_break.contact_radius, 0.971282, 1e-6);
  expect_relative(at_break.force, -0.654498, 1e-6);
  expect_relative(at_break.area, 2.96375, 2e-6);
}

TEST(Jkr, GivesTheReferencePairAtPlainDistances) {
  const auto law = reference_pair();
  const double overlaps[] = {-1.0, -0.5, 0.5, 1.0, 1.5, 2.0, 3.0};
  const double forces[] = {-1.0006565, -1.1770292, -0.7604426, -0.3592068, 0.1352687, 0.7099407, 2.0664184};
  const double radii[] = {1.456185, 2.060703, 2.758513, 3.026791, 3.266535, 3.485453, 3.878192};
  for (int k = 0; k < 7; ++k) {
    const auto contact = contact_response(law, overlaps[k], true);
    expect_relative(contact.force, forces[k], 1e-6);
    expect_relative(contact.contact_radius, radii[k], 1e-6);
  }
}

TEST(Jkr, CarriesNoLoadAtItsZeroLoadOverlap) {
  const auto law = reference_pair();
  const auto contact = contact_response(law, zero_load_overlap(law), true);
  EXPECT_NEAR(contact.force, 0.0, 1e-14);
  expect_relative(zero_load_overlap(law), 1.371402, 1e-6);
  expect_relative(contact.contact_radius, 3.207104, 1e-6);
  expect_relative(contact.contact_radius, kZeroLoadRadius * law.radius, 1e-14);
  expect_relative(contact.area, 32.31290, 1e-6);
}

TEST(Jkr, HasTheReferenceSlopes) {
  const auto law = reference_pair();
  expect_relative(jkr_slope(law, zero_load_overlap(law)), 1.0308549, 1e-7);
  expect_relative(jkr_slope(law, 0.0), 0.4370497, 2e-7);
  expect_relative(jkr_slope(law, 2.0), 1.2231022, 1e-7);
  for (const double overlap : {0.0, 0.5, 2.0}) {
    expect_relative(contact_response(law, overlap, true).stiffness, jkr_slope(law, overlap), 1e-14);
  }
}

TEST(Jkr, HasNoNegativeStiffnessBetweenFoldAndLargestTension) {
  const auto law = reference_pair();
  for (const double ratio : {-0.75, -0.7, -0.5, -0.37}) {
    EXPECT_EQ(contact_response(law, ratio * law.length, true).stiffness, 0.0) << ratio;
    EXPECT_LT(jkr_slope(law, ratio * law.length), 0.0) << ratio;
  }
}

TEST(Jkr, GivesTheUnequalPair) {
  const auto law = make_pair_law(ContactMaterial::elastic(0.45, 0.4, 1.0, 0.3, 0.05), 5.0, 6.5);
  expect_relative(law.reduced_radius, 2.826086957, 1e-9);
  expect_relative(law.modulus, 0.360144058, 2e-9);
  expect_relative(law.length, 0.813125516, 1e-9);
  expect_relative(pull_off_force(law), 0.665881052, 1e-9);
  expect_relative(kZeroLoadRadius * law.radius, 2.502701533, 1e-9);
  expect_relative(zero_load_overlap(law), 0.738773560, 1e-9);
  const double overlaps[] = {-0.3, 0.0, 0.5, 1.0};
  const double forces[] = {-0.6658300, -0.5918943, -0.2390705, 0.3036193};
  for (int k = 0; k < 4; ++k) expect_relative(contact_response(law, overlaps[k], true).force, forces[k], 3e-7);
}

TEST(Jkr, GivesTheSphereOnARigidPlane) {
  const auto law = make_pair_law(ContactMaterial::against_rigid(0.45, 0.4, 0.1), 5.0);
  expect_relative(law.modulus, 0.535714286, 2e-9);
  expect_relative(law.length, 1.198030, 1e-6);
  expect_relative(pull_off_force(law), 2.356194, 1e-6);
  expect_relative(kZeroLoadRadius * law.radius, 4.040698, 1e-6);
  expect_relative(zero_load_overlap(law), 1.088483, 1e-6);
  const double overlaps[] = {-0.5, 0.0, 0.5, 1.0};
  const double forces[] = {-2.3475334, -2.0943951, -1.3321893, -0.2256881};
  for (int k = 0; k < 4; ++k) expect_relative(contact_response(law, overlaps[k], true).force, forces[k], 3e-7);
}

TEST(Jkr, LosesTheKnownEnergyPerCycleAndNeedsTheKnownWorkToSeparate) {
  const auto law = reference_pair();
  const double unit = law.force * law.length;
  const double at_break = contact_response(law, kBreakOverlap * law.length, true).energy;
  const double at_touch = contact_response(law, 0.0, true).energy;
  const double unloaded = contact_response(law, zero_load_overlap(law), true).energy;
  EXPECT_NEAR(at_break / unit, 0.0, 1e-14);
  EXPECT_NEAR((at_break - at_touch) / unit, 1.0524406, 5e-8);
  EXPECT_NEAR((at_break - unloaded) / unit, 1.7354085, 5e-8);
  // 1.0524406 πWR* X with πWR* = 0.785398163 nN and X = 1.509423463 µm.
  EXPECT_NEAR(at_break - at_touch, 1.2476667, 1e-7);
}

TEST(Jkr, EnergyAgreesWithTheClosedFormInTheContactRadius) {
  const auto law = reference_pair();
  for (const double ratio : {-0.6, 0.0, 0.4, 2.0, 5.0}) {
    const auto contact = contact_response(law, ratio * law.length, true);
    const double x = contact.contact_radius / law.radius;
    const double expected = 8.0 / 15.0 * std::pow(x, 5) - 4.0 * std::sqrt(2.0) / 3.0 * std::pow(x, 3.5) + x * x - 0.1;
    EXPECT_NEAR(contact.energy / (law.force * law.length), expected, 1e-12);
  }
}

TEST(Jkr, TouchesAtZeroOverlapAndBreaksAtTheFold) {
  const auto law = reference_pair();
  const double fold = kBreakOverlap * law.length;
  EXPECT_FALSE(update_attached(-1e-12, false, law));
  EXPECT_TRUE(update_attached(0.0, false, law));
  EXPECT_TRUE(update_attached(fold * 0.999999, true, law));
  EXPECT_TRUE(update_attached(fold, true, law));
  EXPECT_FALSE(update_attached(fold * 1.000001, true, law));
  EXPECT_FALSE(update_attached(fold * 0.5, false, law)) << "a broken pair attaches again only when it touches";
  EXPECT_DOUBLE_EQ(adhesive_reach(law), 0.75 * law.length);
}

TEST(Jkr, FeelsNothingBeyondTheFold) {
  const auto law = reference_pair();
  const auto contact = contact_response(law, kBreakOverlap * law.length * 1.0001, true);
  EXPECT_EQ(contact.force, 0.0);
  EXPECT_EQ(contact.area, 0.0);
  EXPECT_EQ(contact.stiffness, 0.0);
  EXPECT_EQ(contact.energy, 0.0);
}

TEST(Jkr, UnattachedPairThatOverlapsFeelsHertz) {
  const auto law = reference_pair();
  const auto free = contact_response(law, 0.5, false);
  EXPECT_EQ(free.force, hertz_contact(law, 0.5).force);
  EXPECT_GT(free.force, 0.0);
  EXPECT_EQ(contact_response(law, -0.1, false).force, 0.0);
  EXPECT_EQ(contact_response(law, -0.1, false).area, 0.0);
}

TEST(Jkr, IsHertzWithoutAdhesion) {
  const auto law = make_pair_law(ContactMaterial::elastic(0.45, 0.4, 0.45, 0.4, 0.0), 5.0, 5.0);
  const double overlaps[] = {0.5, 1.0, 2.0};
  const double forces[] = {0.1996489, 0.5646924, 1.5971914};  // physics page, plain Hertz on the reference pair
  for (int k = 0; k < 3; ++k) expect_relative(contact_response(law, overlaps[k], true).force, forces[k], 3e-7);
  EXPECT_FALSE(update_attached(1.0, true, law));
  EXPECT_EQ(zero_load_overlap(law), 0.0);
}

TEST(Jkr, ApproachesHertzAsAdhesionVanishes) {
  // Leading correction of F̃ at large y: 2√6/… ~ √(W); W = 1e-10 is six orders below the elastic scale, hence 1e-4.
  const auto law = make_pair_law(ContactMaterial::elastic(0.45, 0.4, 0.45, 0.4, 1e-10), 5.0, 5.0);
  expect_relative(contact_response(law, 1.0, true).force, 0.5646924, 1e-4);
}

TEST(Jkr, GivesTheSameBitsInLanes) {
  constexpr int W = 8;
  using L = Lane<double, W>;
  const auto law = reference_pair();
  PairLaw<L> lanes{L(law.modulus), L(law.reduced_radius), L(law.length), L(law.inverse_length), L(law.radius), L(law.force)};
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> overlap(-1.3, 4.0);
  for (int round = 0; round < 100; ++round) {
    double values[W];
    for (double& value : values) value = overlap(generator);
    const auto adhesive = jkr_contact(lanes, L::load(values));
    const auto plain = hertz_contact(lanes, L::load(values));
    for (int k = 0; k < W; ++k) {
      const auto single = jkr_contact(law, values[k]);
      EXPECT_EQ(adhesive.force[k], single.force);
      EXPECT_EQ(adhesive.stiffness[k], single.stiffness);
      EXPECT_EQ(adhesive.area[k], single.area);
      EXPECT_EQ(adhesive.energy[k], single.energy);
      EXPECT_EQ(plain.force[k], hertz_contact(law, values[k]).force);
    }
  }
}

/// δ(t) of two free, attached cells from δ = 0: dδ/dt = −2F/(Γ + 2γ πa²), by the classical Runge–Kutta method.
double relaxed_overlap(double time, double cell_friction, double step) {
  const auto law = reference_pair();
  const double medium = 31.41593;
  const auto rate = [&](double overlap) {
    const auto contact = contact_response(law, overlap, true);
    return -2.0 * contact.force / (medium + 2.0 * cell_friction * contact.area);
  };
  double overlap = 0.0;
  const auto steps = static_cast<int>(std::lround(time / step));
  for (int n = 0; n < steps; ++n) {
    const double k1 = rate(overlap);
    const double k2 = rate(overlap + 0.5 * step * k1);
    const double k3 = rate(overlap + 0.5 * step * k2);
    const double k4 = rate(overlap + step * k3);
    overlap += step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return overlap;
}

TEST(Jkr, PairRelaxesAlongTheReferenceCurve) {
  const double times[] = {1, 10, 30, 100, 300, 1000, 3000, 10000};
  const double with_friction[] = {0.001094, 0.010889, 0.032328, 0.103989, 0.283647, 0.713712, 1.197213, 1.369359};
  const double without[] = {0.065720, 0.562946, 1.129612, 1.368858};
  for (int k = 0; k < 8; ++k) EXPECT_NEAR(relaxed_overlap(times[k], 50.0, 0.5), with_friction[k], 1e-6) << times[k];
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(relaxed_overlap(times[k], 0.0, 0.1), without[k], 1e-6) << times[k];
}

TEST(CubeRoot, IsTheCubeRoot) {
  for (int k = -300; k <= 300; ++k) {
    const double a = std::pow(10.0, 0.1 * k) * (1.0 + 0.001 * k);
    EXPECT_NEAR(cube_root(a) / std::cbrt(a), 1.0, 7e-16) << a;
  }
  EXPECT_DOUBLE_EQ(cube_root(27.0), 3.0);
}

}  // namespace
}  // namespace morula::cbm
