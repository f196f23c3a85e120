#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random/philox.h"
#include "study/initial/make_tissue.h"
#include "study/initial/packing.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

Space open_space(double half = 500.0) { return {.box = {{-half, -half, -half}, {half, half, half}}, .boundary = {}}; }

/// Largest touch·(r_i + r_j) − distance by brute force.
double worst_overlap(const std::vector<Vec3d>& center, const std::vector<double>& radius, double touch, const Space& space) {
  double worst = -1e300;
  for (std::size_t i = 0; i < center.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      worst = std::max(worst, touch * (radius[i] + radius[j]) - norm(space.nearest_image(center[i] - center[j])));
  return worst;
}

/// Radii between 5 and 7 that repeat no pattern.
std::vector<double> mixed_radii(std::size_t count) {
  std::vector<double> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(6.0 + std::sin(static_cast<double>(i * i)));
  return out;
}

InitialCells ball(std::uint64_t count, double radius) {
  InitialCells block;
  block.count = count;
  block.radius = radius;
  block.center = {10, -20, 30};
  return block;
}

TEST(Packing, CellsOfManySizesTouchWithoutOverlap) {
  const auto radius = mixed_radii(400);
  const Packing packing = pack_cells(ball(400, 60.0), radius, 1.0, open_space(), 1, 7);
  ASSERT_EQ(packing.center.size(), 400u);
  EXPECT_LT(worst_overlap(packing.center, radius, 1.0, open_space()), 0.01);
  EXPECT_GT(worst_overlap(packing.center, radius, 1.0, open_space()), -0.01);  // they do touch
  EXPECT_EQ(packing.reach_beyond, 0.0);
  Vec3d mean{};
  for (const Vec3d& p : packing.center) mean += p * (1.0 / 400.0);
  EXPECT_LT(norm(mean - Vec3d{10, -20, 30}), 1.0);
}

TEST(Packing, IsDenseNotScattered) {
  // Volume of the cells over that of the ball with their radius of gyration; random close packing of spheres is 0.64.
  for (const auto& radius : {std::vector<double>(400, 6.0), mixed_radii(400)}) {
    const Packing packing = pack_cells(ball(400, 60.0), radius, 1.0, open_space(), 1, 7);
    double square = 0.0, cubes = 0.0;
    for (std::size_t i = 0; i < 400; ++i) {
      square += (norm2(packing.center[i] - Vec3d{10, -20, 30}) + 0.6 * radius[i] * radius[i]) / 400.0;
      cubes += std::pow(radius[i], 3);
    }
    EXPECT_GT(cubes / std::pow(std::sqrt(5.0 / 3.0 * square), 3), 0.55);
  }
}

TEST(Packing, DependsOnTheSeedAlone) {
  const auto radius = mixed_radii(60);
  const auto a = pack_cells(ball(60, 40.0), radius, 0.95, open_space(), 5, 7).center;
  EXPECT_EQ(a, pack_cells(ball(60, 40.0), radius, 0.95, open_space(), 5, 7).center);
  EXPECT_NE(a, pack_cells(ball(60, 40.0), radius, 0.95, open_space(), 5, 8).center);
}

TEST(Packing, FillsABoxBetweenWallsAndAcrossPeriodicFaces) {
  InitialCells block;
  block.count = 250;
  block.fill = FillShape::kBox;
  block.size = {84, 84, 84};
  Space space = open_space(42.0);
  for (auto& axis : space.boundary) axis = {BoundaryKind::kPeriodic, BoundaryKind::kPeriodic};
  space.boundary[2] = {BoundaryKind::kWall, BoundaryKind::kWall};
  const std::vector<double> radius(250, 6.0);
  const Packing packing = pack_cells(block, radius, 0.95, space, 1, 3);
  EXPECT_LT(worst_overlap(packing.center, radius, 0.95, space), 0.05);
  for (const Vec3d& p : packing.center) {
    EXPECT_LE(std::abs(p.z), 36.0 + 1e-9);
    EXPECT_TRUE(space.box.contains(p));
  }
}

TEST(Packing, SaysHowFarCellsReachOutOfAShapeThatIsTooSmall) {
  const std::vector<double> radius(200, 6.0);
  const Packing packing = pack_cells(ball(200, 36.0), radius, 1.0, open_space(), 1, 3);  // the ball of all cells has radius 35.1
  EXPECT_LT(worst_overlap(packing.center, radius, 1.0, open_space()), 0.05);
  EXPECT_GT(packing.reach_beyond, 1.0);
}

/// Radii spread by 10 %, as a type with `spread: 10 %` has them.
std::vector<double> spread_radii(std::size_t count) {
  const Random random(5, RandomStream::kInitialPosition);
  std::vector<double> out;
  for (std::size_t i = 0; i < count; ++i)
    out.push_back(6.0 * (1.0 + 0.1 * std::sqrt(3.0) * (2.0 * random.uniform(CellId::founder(i + 1), 0).first - 1.0)));
  return out;
}

/// Radius of the ball of which cells fill this part [µm].
double radius_filled(const std::vector<double>& radius, double part) {
  double cubes = 0.0;
  for (const double r : radius) cubes += r * r * r;
  return std::cbrt(cubes / part);
}

TEST(Packing, OfManyCellsOverlapsByAFewPercent) {
  const auto radius = spread_radii(8000);
  const Packing packing = pack_cells(ball(8000, radius_filled(radius, 0.5)), radius, 0.95, open_space(), 1, 7);
  ASSERT_EQ(packing.center.size(), 8000u);
  EXPECT_LE(worst_overlap(packing.center, radius, 1.0, open_space()), 0.05 * mean_radius(radius));
  EXPECT_NEAR(worst_overlap(packing.center, radius, 1.0, open_space()), packing.worst_overlap, 1e-12);
  EXPECT_LT(packing.reach_beyond, 0.01) << "the ball has room to spare";
}

TEST(Packing, OfManyCellsIsTheSameOnAnyThreads) {
  const auto radius = spread_radii(6000);
  const InitialCells block = ball(6000, radius_filled(radius, 0.55));
  const auto one = pack_cells(block, radius, 0.95, open_space(), 1, 7, {}, 1),
             three = pack_cells(block, radius, 0.95, open_space(), 1, 7, {}, 3);
  EXPECT_EQ(one.center, three.center);
  EXPECT_EQ(scatter_cells(block, radius, 0.95, open_space(), 1, 7, {}, 1).center,
            scatter_cells(block, radius, 0.95, open_space(), 1, 7, {}, 3).center);
}

/// Neighbours between 1.15 and 1.35 of the mean distance at which cells touch: a close packed lattice has none there.
double neighbours_between_shells(const std::vector<Vec3d>& center, double diameter, const Space& space) {
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < center.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double d = norm(space.nearest_image(center[i] - center[j])) / diameter;
      pairs += d > 1.15 && d < 1.35;
    }
  return 2.0 * static_cast<double>(pairs) / static_cast<double>(center.size());
}

TEST(DenseScatter, FillsSixtyPercentOfABallInDisorder) {
  const auto radius = spread_radii(6000);
  const InitialCells block = ball(6000, radius_filled(radius, 0.60));
  const Packing packing = scatter_cells(block, radius, 0.95, open_space(), 1, 7);
  ASSERT_EQ(packing.center.size(), 6000u);
  EXPECT_FALSE(packing.jammed);
  const double mean = mean_radius(radius);
  EXPECT_LE(worst_overlap(packing.center, radius, 1.0, open_space()), 0.05 * mean);
  for (std::size_t i = 0; i < radius.size(); ++i) EXPECT_LE(norm(packing.center[i] - block.center) + radius[i], block.radius + 0.05 * mean);
  EXPECT_GT(neighbours_between_shells(packing.center, 2.0 * mean, open_space()), 2.0);
  const std::vector<double> equal(6000, 6.0);
  const Packing lattice = pack_cells(ball(6000, radius_filled(equal, 0.60)), equal, 0.95, open_space(), 1, 7);
  EXPECT_LT(neighbours_between_shells(lattice.center, 12.0, open_space()), 0.5);
}

TEST(DenseScatter, FillsAPeriodicBoxAndFewCells) {
  InitialCells block;
  block.count = 300;
  block.fill = FillShape::kBox;
  Space space = open_space(0.5 * std::cbrt(300.0 * 4.0 / 3.0 * std::numbers::pi * 216.0 / 0.60));
  block.size = space.box.size();
  for (auto& axis : space.boundary) axis = {BoundaryKind::kPeriodic, BoundaryKind::kPeriodic};
  const std::vector<double> radius(300, 6.0);
  const Packing packing = scatter_cells(block, radius, 0.95, space, 1, 3);
  ASSERT_EQ(packing.center.size(), 300u);
  EXPECT_LE(worst_overlap(packing.center, radius, 1.0, space), 0.3);
  // Across a face as within: the density near the border is that of the middle.
  std::size_t at_border = 0;
  for (const Vec3d& p : packing.center) {
    EXPECT_TRUE(space.box.contains(p));
    at_border += std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > 0.5 * std::cbrt(0.5) * block.size.x;  // half of the volume
  }
  EXPECT_NEAR(static_cast<double>(at_border) / 300.0, 0.5, 0.1);
}

TEST(DenseScatter, SaysThatItIsJammed) {
  const std::vector<double> radius(500, 6.0);
  EXPECT_TRUE(scatter_cells(ball(500, radius_filled(radius, 0.80)), radius, 1.0, open_space(), 1, 7).jammed);
}

const std::string kMixed = R"(schema: 1
study: mixed
time: {end: 1 h, output: 30 min}
domain: {size: [400 um, 400 um, 400 um]}
cell_types:
  soft:
    radius: {mean: 6 um, spread: 10 %}
    cycle: {model: volume_threshold, duration: {mean: 18 h, spread: 10 %}}
  hard: {radius: 5 um}
initial:
  - {type: soft, count: 30, fill: sphere, radius: 40 um, as: shell}
  - {type: hard, at: [[80 um, 0 um, 0 um], [95 um, 0 um, 0 um]], start_volume: 50 %, inflate: 30 min}
  - {csv: cells.csv, coincident_shift: 6 um}
)";

class InitialTissues : public ::testing::Test {
 protected:
  Study study() {
    folder_.write(
        "cells.csv",
        "x [um],y [um],z [um],type,radius [um],phase,model\n-80,0,0,soft,7,0.5,sphere\n-80,0,0,hard,4,0,shell\n-100,0,0,soft,6,0,sphere\n");
    auto read = test::read(kMixed, {}, folder_.path());
    EXPECT_TRUE(read.ok()) << read.error().text();
    return std::move(read).value();
  }
  test::Folder folder_;
};

const CellRow* row_of(const Tissue& tissue, std::uint64_t number) {
  for (const CellRow& row : tissue.cells.rows)
    if (row.id == CellId::founder(number)) return &row;
  return nullptr;
}

TEST_F(InitialTissues, NumberFoundersThroughAllEntries) {
  ShapeLibrary shapes;
  const auto made = make_tissue(study(), shapes, Comm());
  ASSERT_TRUE(made.ok()) << made.error().message;
  const Tissue& tissue = made->tissue;
  ASSERT_EQ(tissue.cells.size(), 35u);
  for (std::uint64_t n = 1; n <= 35; ++n) ASSERT_NE(row_of(tissue, n), nullptr) << n;
  EXPECT_EQ(tissue.shells.size(), 31u);
  EXPECT_EQ(tissue.spheres.size(), 4u);
  EXPECT_TRUE(std::is_sorted(tissue.cells.rows.begin(), tissue.cells.rows.end(), before));
}

TEST_F(InitialTissues, TakeRadiusPhaseAndBodyFromTheCsv) {
  ShapeLibrary shapes;
  const Tissue tissue = make_tissue(study(), shapes, Comm())->tissue;
  const double ball = 4.0 / 3.0 * std::numbers::pi;
  const CellRow& first = *row_of(tissue, 33);
  EXPECT_NEAR(first.target_volume, ball * 343.0, 1e-9);       // as it is now
  EXPECT_NEAR(first.birth_volume, ball * 343.0 / 1.5, 1e-9);  // halfway through linear growth
  EXPECT_NEAR(first.birth_time, -0.5 * first.cycle_duration, 1e-9);
  EXPECT_EQ(first.body, BodyKind::kSphere);
  const CellRow& second = *row_of(tissue, 34);
  EXPECT_EQ(second.body, BodyKind::kShell);
  EXPECT_NEAR(second.target_volume, ball * 64.0, 1e-9);  // a type that does not cycle
}

TEST_F(InitialTissues, MoveCoincidentCellsApart) {
  ShapeLibrary shapes;
  const Tissue tissue = make_tissue(study(), shapes, Comm())->tissue;
  std::size_t shell = 0;
  for (const CellRow& row : tissue.cells.rows) {
    if (row.body != BodyKind::kShell) continue;
    if (row.id == CellId::founder(34)) {
      EXPECT_NEAR(norm(volume_centroid(tissue.shells.topology(shell).faces(), tissue.shells.nodes(shell)) - Vec3d{-80, 0, 0}), 6.0, 1e-9);
    }
    ++shell;
  }
}

TEST_F(InitialTissues, StartSmallAndOweTheRest) {
  ShapeLibrary shapes;
  const Tissue tissue = make_tissue(study(), shapes, Comm())->tissue;
  const double whole = 4.0 / 3.0 * std::numbers::pi * 125.0;
  const CellRow& row = *row_of(tissue, 31);
  EXPECT_NEAR(row.target_volume, 0.5 * whole, 1e-9);
  const auto number = static_cast<std::size_t>(&row - tissue.cells.rows.data());
  EXPECT_NEAR(tissue.cells.optional.inflation_left[number], 0.5 * whole, 1e-9);
  EXPECT_NEAR(tissue.cells.optional.inflation_rate[number] * 1800.0, 0.5 * whole, 1e-9);
}

TEST_F(InitialTissues, ShellsEncloseTheirVolumeAndAreTurned) {
  ShapeLibrary shapes;
  const Tissue tissue = make_tissue(study(), shapes, Comm())->tissue;
  Vec3d direction[2];
  for (std::size_t i = 0; i < 2; ++i) {
    const auto faces = tissue.shells.topology(i).faces();
    const Vec3d center = volume_centroid(faces, tissue.shells.nodes(i));
    EXPECT_NEAR(enclosed_volume(faces, tissue.shells.nodes(i), center), tissue.shells.rest_volume[i], 1e-9 * tissue.shells.rest_volume[i]);
    direction[i] = normalized(tissue.shells.nodes(i)[0] - center);
  }
  EXPECT_LT(dot(direction[0], direction[1]), 0.999);
}

TEST_F(InitialTissues, RefuseCellsOutsideTheDomain) {
  Study tight = study();
  tight.model.space.box = {{-90, -90, -90}, {90, 90, 90}};
  ShapeLibrary shapes;
  const auto made = make_tissue(tight, shapes, Comm());
  ASSERT_FALSE(made.ok());
  EXPECT_EQ(made.error().kind, ErrorKind::kInput);
  EXPECT_NE(made.error().message.find("outside the domain"), std::string::npos);
}

}  // namespace
}  // namespace morula::scenarios
