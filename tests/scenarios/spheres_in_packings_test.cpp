#include "scenarios/experiments/spheres_in_packings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random/philox.h"
#include "scenarios/calibrate/table_fit.h"

namespace morula::scenarios {
namespace {

constexpr double kYoung = 0.8, kPoisson = 0.4, kAdhesion = 0.02, kRadius = 5.0;

CellMaterial material_of_balls() {
  CellMaterial out;
  out.type = "ball";
  out.radius = kRadius;
  out.adhesion = 0.03;  // that the shells would have
  out.contact = "{range: 0.5 um}";
  return out;
}

/// 54 cells of a body-centred packing, each away from its place by up to half a radius along each axis.
FoundPacking disordered(double volume_ratio, std::uint64_t number) {
  const double cube = std::cbrt(2.0 * volume_ratio * 4.0 / 3.0 * std::numbers::pi) * kRadius;
  FoundPacking out{.volume_ratio = volume_ratio, .edge = 3.0 * cube};
  const Random random(7, RandomStream::kInitialPosition);
  std::uint64_t draw = 0;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 3; ++z)
        for (const double half : {0.0, 0.5}) {
          const RandomPair u = random.uniform(CellId(number), draw++), v = random.uniform(CellId(number), draw++);
          const Vec3d away = Vec3d{u.first - 0.5, u.second - 0.5, v.first - 0.5} * kRadius;
          out.centers.push_back(Vec3d{x + half, y + half, z + half} * cube - Vec3d{1, 1, 1} * (1.4 * cube) + away);
        }
  return out;
}

TrialLaw law_with(const cbm::PackingCurve& curve) {
  TrialLaw out{.sphere = {}, .adhesion = kAdhesion, .pair = calibrate::jkr_model(kYoung, kPoisson, kAdhesion)};
  out.sphere.young = kYoung, out.sphere.poisson = kPoisson, out.sphere.packing = curve;
  return out;
}

double told(const TrialLaw& law, const calibrate::PackingPoint& point) {
  return calibrate::pair_pressure(point.geometry(), point.radius, law.pair) +
         calibrate::curve_pressure(point.geometry(), law.sphere.packing);
}

/// Balls of a known law stand where the shells would: their curve of packing comes back from the pressures alone, though the search begins with the places of
/// a lattice, and each law that it tries puts the balls elsewhere.
TEST(SpheresInPackings, GiveBackTheCurveOfPacking) {
  const CellMaterial material = material_of_balls();
  std::vector<FoundPacking> packings;
  calibrate::Data data;
  for (const double v : {1.02, 0.98, 0.94, 0.9, 0.86, 0.82, 0.78, 0.74, 0.7}) {
    packings.push_back(disordered(v, packings.size()));
    data.packings.push_back({.experiment = 1, .arrangement = calibrate::Arrangement::kRandom, .volume_ratio = v, .radius = kRadius});
  }
  const auto read = SpheresInPackings::read(material, packings, 2);
  ASSERT_TRUE(read.ok()) << read.error().message;
  const SpheresInPackings& places = *read;
  const std::vector<cbm::PackingKnot> knots{{0.08, 0.0}, {0.12, 0.2}, {0.20, 0.4}, {0.32, 0.6}};
  const TrialLaw truth = law_with(cbm::PackingCurve::through(knots).value());
  const Status placed = places.place(truth, false, data);
  ASSERT_TRUE(placed.ok()) << placed.error().message;
  for (calibrate::PackingPoint& point : data.packings) point.pressure = told(truth, point), point.random = {};
  EXPECT_GT(data.packings.back().pressure, 0.5);

  calibrate::FitOptions options{.poisson = kPoisson};
  cbm::PackingCurve found;
  const auto make = [&](const calibrate::Data& now) -> Result<TrialLaw> {
    const auto risen = calibrate::fit_curve(now, truth.pair, options);
    found = risen.empty() ? cbm::PackingCurve() : cbm::PackingCurve::through(risen).value();
    return law_with(found);
  };
  ASSERT_TRUE(fit_in_turns(data, options.weights, make, places).ok());
  ASSERT_TRUE(make(data).ok());
  for (const double packing : {0.12, 0.16, 0.2, 0.24, 0.28})
    EXPECT_NEAR(found.at(packing).pressure / truth.sphere.packing.at(packing).pressure, 1.0, 0.05) << packing;
}

/// What the law tells at the places of its own spheres is what these spheres bear, as a run in the same box has it (`extra` says what attached pairs across a
/// gap do); and points that are held out are left alone until they are asked for.
TEST(SpheresInPackings, AreAtRestWhereTheLawSays) {
  const CellMaterial material = material_of_balls();
  const std::vector<FoundPacking> packings{disordered(0.85, 1), disordered(0.85, 2)};
  calibrate::Data data;
  for (const bool held_out : {false, true})
    data.packings.push_back(
        {.arrangement = calibrate::Arrangement::kRandom, .volume_ratio = 0.85, .radius = kRadius, .held_out = held_out});
  const std::vector<cbm::PackingKnot> knots{{0.08, 0.0}, {0.12, 0.09}, {0.30, 0.5}};
  const TrialLaw law = law_with(cbm::PackingCurve::through(knots).value());
  const auto read = SpheresInPackings::read(material, packings, 2);
  ASSERT_TRUE(read.ok()) << read.error().message;
  const SpheresInPackings& places = *read;
  const Status placed = places.place(law, false, data);
  ASSERT_TRUE(placed.ok()) << placed.error().message;
  EXPECT_GT(data.packings[0].random.neighbours.size(), 0u);
  EXPECT_EQ(data.packings[1].random.neighbours.size(), 0u);
  ASSERT_TRUE(places.place(law, true, data).ok());
  const double first = told(law, data.packings[0]), second = told(law, data.packings[1]);
  EXPECT_NEAR(first / second, 1.0, 0.1);  // two samples of one disorder
  // No overlap is left that the pressure does not speak of: what groups of distances and of cells leave out is little.
  EXPECT_LT(std::abs(data.packings[0].random.extra), 0.02 * first);
  // A packing of the same room bears about what the lattice does.
  const auto lattice = calibrate::lattice_geometry(calibrate::Arrangement::kFaceCentred, 0.85);
  const double ordered = calibrate::pair_pressure(lattice, kRadius, law.pair) + calibrate::curve_pressure(lattice, law.sphere.packing);
  EXPECT_NEAR(first / ordered, 1.0, 0.2);
}

}  // namespace
}  // namespace morula::scenarios
