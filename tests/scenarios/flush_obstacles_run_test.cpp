/// Obstacles that meet flush are one surface to a sphere that crosses their seam: studies, results read back.
#include <gtest/gtest.h>

#include "tests/scenarios/snapshots_of_run.h"

namespace morula::scenarios {
namespace {

/// Where a sphere comes to that 0.1 nN pull along a floor onto which 2 nN press it.
Vec3d end_on(const std::string& floor, const std::string& from, const std::string& pull = "0.1 nN") {
  const auto moments = test::snapshots_of_run(R"(schema: 1
study: seam
time: {end: 80 min, output: 80 min}
domain: {size: [100 um, 100 um, 100 um]}
cell_types: {c: {radius: 6 um, body: sphere, adhesion: {others: 0 J/m^2}, friction: {obstacle: 0 N s/m^3}, cbm: {law: hertz}}}
geometry:
)" + floor + "initial: [{type: c, at: [[" + from +
                                              ", 0 um, 0 um]]}]\nloads: {w: {type: c, body_force: [" + pull +
                                              ", 0 nN, -2 nN]}}\noutput: {report: false}\n");
  return moments.empty() ? Vec3d{} : moments.back().snapshot.cells[0].centroid;
}

std::string box(const std::string& name, const std::string& center, const std::string& size) {
  return "  " + name + ": {box: {center: [" + center + "], size: [" + size + "]}}\n";
}

const std::string kOne = box("one", "0 um, 0 um, -16.5 um", "80 um, 80 um, 20 um");

void expect_near(const Vec3d& a, const Vec3d& b, double within) {
  EXPECT_NEAR(a.x, b.x, within);
  EXPECT_NEAR(a.y, b.y, within);
  EXPECT_NEAR(a.z, b.z, within);
}

TEST(FlushObstacles, BearASphereAsOneDoes) {
  const std::string low = box("low", "-20 um, 0 um, -16.5 um", "40 um, 80 um, 20 um"),
                    high = box("high", "20 um, 0 um, -16.5 um", "40 um, 80 um, 20 um"),
                    over = box("over", "10 um, 0 um, -14.5 um", "60 um, 70 um, 16 um");
  const Vec3d reference = end_on(kOne, "-4 um");
  EXPECT_GT(reference.x, 4.0) << "beyond the seam";
  for (const std::string& floor : {low + high, high + low, low + over}) expect_near(end_on(floor, "-4 um"), reference, 1e-6);
  expect_near(end_on(low + high, "0 um", "0 nN"), end_on(kOne, "0 um", "0 nN"), 1e-9);  // on the seam
}

TEST(FlushObstacles, BearASphereInACornerEachForItself) {
  // 3 nN press it into the corner of a floor and a wall, of one solid or of two that stand flush or into each other: Hertz in both directions.
  const std::string wall = box("wall", "8 um, 0 um, 0 um", "4 um, 80 um, 60 um");
  const Vec3d corner = end_on(kOne + wall, "-1 um", "2 nN"), free = end_on(kOne, "-1 um", "0 nN");
  EXPECT_NEAR(corner.z, free.z, 1e-3);
  EXPECT_NEAR(6.0 - corner.x, free.z + 6.5, 1e-3) << "as deep in the wall as in the floor";
}

/// A step of two boxes: the lower one is covered by the side of the higher one.
TEST(FlushObstacles, AreClimbedNowhere) {
  const std::string low = box("low", "-20 um, 0 um, -16.5 um", "40 um, 80 um, 20 um"),
                    step = box("step", "20 um, 0 um, -12.5 um", "40 um, 80 um, 20 um");
  const Vec3d end = end_on(low + step, "-8 um", "0.5 nN");
  EXPECT_GT(end.x, -6.0);
  EXPECT_LT(end.x, 0.0) << "it stands before the step";
  EXPECT_NEAR(end.z, end_on(kOne, "-8 um", "0 nN").z, 0.2);
}

}  // namespace
}  // namespace morula::scenarios
