#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/mesh/topology.h"
#include "core/random/philox.h"
#include "scenarios/library/library.h"
#include "scenarios/measures/outer_surface.h"
#include "scenarios/measures/point_statistics.h"
#include "study/initial/make_tissue.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

std::vector<Vec3d> cloud(std::size_t count) {
  const Random random(7, RandomStream::kInitialPosition);
  std::vector<Vec3d> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(random.direction(CellId::founder(i + 1), 0) * (10.0 + static_cast<double>(i)));
  return out;
}

TEST(RigidMotion, OfTheSameShapeLeavesNoDistance) {
  const auto a = cloud(30);
  std::vector<Vec3d> b;
  const double c = std::cos(1.1), s = std::sin(1.1);
  for (const Vec3d& p : a) b.push_back(Vec3d{c * p.x - s * p.z, p.y, s * p.x + c * p.z} + Vec3d{100, -7, 3});
  EXPECT_NEAR(rms_after_rigid_motion(a, b), 0.0, 1e-5);
}

TEST(RigidMotion, LeavesTheStretchOfAPair) {
  const std::vector<Vec3d> a{{1, 0, 0}, {-1, 0, 0}}, b{{0, 3, 0}, {0, 8, 0}};
  EXPECT_NEAR(rms_after_rigid_motion(a, b), 1.5, 1e-6);
}

TEST(RigidMotion, DoesNotMirror) {
  const auto a = cloud(30);
  auto b = a;
  for (Vec3d& p : b) p.x = -p.x;
  EXPECT_GT(rms_after_rigid_motion(a, b), 3.0);
}

TEST(RigidMotion, FindsSmallIndependentDisplacements) {
  const auto a = cloud(400);
  auto b = a;
  const Random random(9, RandomStream::kInitialPosition);
  for (std::size_t i = 0; i < b.size(); ++i) b[i] += random.direction(CellId::founder(i + 1), 5) * 0.5;
  EXPECT_NEAR(rms_after_rigid_motion(a, b), 0.5, 0.01);  // six degrees of freedom of 1200 go into the motion
}

TEST(MannWhitney, HasTheKnownPOfSeparatedLists) {
  const std::vector<double> lower{1, 2, 3, 4, 5}, upper{6, 7, 8, 9, 10};
  // U = 25, mean 12.5, variance 5 · 5 · 11/12, continuity ½: z = 12/√22.9167 = 2.5067; P(Z > z) = 0.006093
  EXPECT_NEAR(mann_whitney_p(lower, upper), 0.006093, 2e-6);
  EXPECT_NEAR(mann_whitney_p(upper, lower), 1.0, 0.01);
}

TEST(MannWhitney, OfEqualListsSaysNothing) {
  const std::vector<double> values{1, 1, 2, 2, 3};
  EXPECT_GT(mann_whitney_p(values, values), 0.4);
  EXPECT_EQ(mann_whitney_p({}, values), 1.0);
  EXPECT_EQ(mann_whitney_p(std::vector<double>(4, 1.0), std::vector<double>(5, 1.0)), 1.0);
}

Snapshot::Cell ball(std::uint64_t number, const Vec3d& center, double radius) {
  Snapshot::Cell cell;
  cell.id = CellId::founder(number);
  cell.centroid = center;
  cell.radius = radius;
  return cell;
}

void make_shell(Snapshot& snapshot, std::uint32_t cell, double radius) {
  ShapeLibrary shapes;
  const auto shape = shapes.icosphere(162).value();
  const auto first = static_cast<std::uint32_t>(snapshot.nodes.size());
  for (const Vec3d& p : shape->position) snapshot.nodes.push_back(snapshot.cells[cell].centroid + p * radius);
  snapshot.shells.push_back({cell, first, 162, static_cast<std::uint32_t>(snapshot.topologies.size())});
  snapshot.topologies.emplace_back(shape->topology->faces().begin(), shape->topology->faces().end());
  snapshot.cells[cell].body = BodyKind::kShell;
}

TEST(OuterSurface, OfOneCellIsAll) {
  Snapshot s;
  s.cells.push_back(ball(1, {3, 4, 5}, 6.0));
  EXPECT_DOUBLE_EQ(outer_surface_fractions(s, 6.0, {})[0], 1.0);
  make_shell(s, 0, 9.0);
  EXPECT_DOUBLE_EQ(outer_surface_fractions(s, 6.0, {})[0], 1.0);
}

TEST(OuterSurface, OfACellInsideAShellIsNone) {
  Snapshot s;
  s.cells.push_back(ball(1, {0, 0, 0}, 10.0));
  make_shell(s, 0, 20.0);
  s.cells.push_back(ball(2, {3, 0, 0}, 2.0));
  const auto free = outer_surface_fractions(s, 4.0, {});
  EXPECT_DOUBLE_EQ(free[0], 1.0);
  EXPECT_DOUBLE_EQ(free[1], 0.0);
}

TEST(OuterSurface, EndsWhereTheBallTouchesTheNeighbourToo) {
  // Ball r on two touching cells R: its centre is R + r from both, at the angle α with cos α = R/(R + r) to the row.
  Snapshot s;
  for (std::uint64_t k = 0; k < 3; ++k) s.cells.push_back(ball(k + 1, {10.0 * static_cast<double>(k), 0, 0}, 5.0));
  for (const double probe : {5.0, 2.5}) {
    const double cos_alpha = 5.0 / (5.0 + probe);
    const auto free = outer_surface_fractions(s, probe, {});
    EXPECT_NEAR(free[0], 0.5 * (1.0 + cos_alpha), 0.015);
    EXPECT_NEAR(free[1], cos_alpha, 0.015);
    EXPECT_NEAR(free[2], 0.5 * (1.0 + cos_alpha), 0.015);
  }
}

TEST(OuterSurface, AGapNarrowerThanTheBallExposesNoCell) {
  Snapshot s;  // a cell and its twelve neighbours in face-centred cubic packing, all touching
  s.cells.push_back(ball(1, {}, 5.0));
  std::uint64_t number = 2;
  const double d = 10.0 / std::sqrt(2.0);
  for (const double a : {-d, d})
    for (const double b : {-d, d}) {
      s.cells.push_back(ball(number++, {a, b, 0}, 5.0));
      s.cells.push_back(ball(number++, {a, 0, b}, 5.0));
      s.cells.push_back(ball(number++, {0, a, b}, 5.0));
    }
  EXPECT_DOUBLE_EQ(outer_surface_fractions(s, 5.0, {})[0], 0.0);
  // Through the square windows a ball of up to (√2 − 1) R passes and finds the middle.
  EXPECT_GT(outer_surface_fractions(s, 1.0, {})[0], 0.02);
}

TEST(OuterSurface, WallsOfTheCavityDoNotCount) {
  Snapshot s;
  s.cells.push_back(ball(1, {}, 5.0));
  // The ball's centre 10 n is in the cavity when 100 + 900 − 600 cos θ < 625: cos θ > 0.625.
  EXPECT_NEAR(outer_surface_fractions(s, 5.0, {{30, 0, 0}, 25.0})[0], 0.5 * (1.0 + 0.625), 0.01);
}

#ifdef MORULA_EMBRYO_DATA
struct KnownEmbryo {
  int cells, outer;  ///< all, and of the trophectoderm
  int groups;        ///< of rows at the same place
  const char* cavity;
};

class MeasuredEmbryo : public testing::TestWithParam<KnownEmbryo> {};

/// S18.1: cells and lineages as the data's README counts them; each group of coincident cells has its line in the log.
TEST_P(MeasuredEmbryo, IsImportedWhole) {
  const KnownEmbryo& known = GetParam();
  const std::string file = "embryo_" + std::to_string(known.cells) + ".csv";
  std::string text;
  for (const TemplateFile& f : find_template("blastocyst")->files)
    if (f.path == "study.yaml") text = std::string(f.content);
  text = test::changed("embryo_44.csv", file, text);
  text = test::changed("{center: [12 um, -9 um, 18 um], radius: 33.8 um}", known.cavity, text);
  const auto study = test::read(text, {}, MORULA_EMBRYO_DATA);
  ASSERT_TRUE(study.ok()) << study.error().text();
  ASSERT_EQ(study->initial[0].count, static_cast<std::uint64_t>(known.cells));
  int named = 0;
  for (const std::string& note : study->notes) named += note.find("lie at the same place") != std::string::npos;
  EXPECT_EQ(named, known.groups);

  ShapeLibrary shapes;
  const auto tissue = make_tissue(*study, shapes, Comm());
  ASSERT_TRUE(tissue.ok()) << tissue.error().message;
  EXPECT_EQ(tissue->tissue.shells.size(), static_cast<std::size_t>(known.outer));
  EXPECT_EQ(tissue->tissue.spheres.size(), static_cast<std::size_t>(known.cells - known.outer));
  for (std::size_t i = 0; i < tissue->tissue.cells.size(); ++i) {
    const CellState row = tissue->tissue.cells.state(i);
    const double volume = study->initial[0].room[row.id.founder_number() - 1];
    EXPECT_NEAR(row.target_volume, 0.15 * volume, 1e-9 * volume);
    EXPECT_NEAR(row.target_volume + row.inflation_left, volume, 1e-9 * volume);
  }
}

INSTANTIATE_TEST_SUITE_P(Saiz2020, MeasuredEmbryo,
                         testing::Values(KnownEmbryo{44, 29, 0, "{center: [12 um, -9 um, 18 um], radius: 33.8 um}"},
                                         KnownEmbryo{64, 33, 2, "{center: [27 um, -6 um, 9 um], radius: 34.5 um}"},
                                         KnownEmbryo{114, 83, 2, "{center: [18 um, 0 um, 6 um], radius: 37.4 um}"},
                                         KnownEmbryo{178, 96, 10, "{center: [6 um, -12 um, 42 um], radius: 23.4 um}"},
                                         KnownEmbryo{216, 124, 8, "{center: [-18 um, -36 um, 12 um], radius: 20.3 um}"}),
                         [](const auto& one) { return "Cells" + std::to_string(one.param.cells); });
#endif

}  // namespace
}  // namespace morula::scenarios
