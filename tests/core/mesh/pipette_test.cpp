#include "core/mesh/pipette.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/mesh/mesh_check.h"

namespace morula {
namespace {

using std::numbers::pi;

TEST(Pipette, IsClosedAndHasTheVolumeOfItsWallByPappus) {
  for (const auto& [wall, lip] : {std::pair{1.0, 0.5}, {2.0, 0.5}}) {
    const auto made = make_pipette(2.5, wall, lip, 15.0, 0.2);
    ASSERT_TRUE(made.ok()) << made.error().message;
    for (const MeshProblem& problem : check_mesh(made->position, made->faces)) ADD_FAILURE() << problem.message;
    // Profile: the wall less two rounded corners, each lip² (1 − π/4), whose centroids lie symmetric to the middle of the wall.
    const double area = wall * 15.0 - 2.0 * lip * lip * (1.0 - 0.25 * pi), middle = 2.5 + 0.5 * wall;
    EXPECT_NEAR(enclosed_volume(made->faces, made->position, {}) / (2.0 * pi * middle * area), 1.0, 4e-3);
  }
}

TEST(Pipette, IsNarrowestAboveItsLipAndReachesThePlaneOfItsMouth) {
  const TriangleMesh mesh = *make_pipette(3.0, 1.0, 0.5, 12.0, 0.4);
  double narrow = 1e300, wide = 0.0, low = 1e300, high = 0.0;
  for (const Vec3d& x : mesh.position) {
    const double r = std::hypot(x.x, x.y);
    narrow = std::min(narrow, r);
    wide = std::max(wide, r);
    low = std::min(low, x.z);
    high = std::max(high, x.z);
    if (x.z < 0.5 - 1e-9) {
      EXPECT_NEAR(std::hypot(r - 3.5, x.z - 0.5), 0.5, 1e-12);
    }
  }
  EXPECT_NEAR(narrow, 3.0, 1e-12);
  EXPECT_NEAR(wide, 4.0, 1e-12);
  EXPECT_NEAR(low, 0.0, 1e-12);
  EXPECT_NEAR(high, 12.0, 1e-12);
}

TEST(Pipette, RefusesWhatIsNoTube) {
  EXPECT_FALSE(make_pipette(2.5, 1.0, 0.6, 15.0, 0.4).ok());
  EXPECT_FALSE(make_pipette(2.5, 1.0, 0.5, 0.9, 0.4).ok());
  EXPECT_FALSE(make_pipette(-2.5, 1.0, 0.5, 15.0, 0.4).ok());
  EXPECT_FALSE(make_pipette(2.5, 1.0, 0.5, 15.0, 1e-4).ok());
}

}  // namespace
}  // namespace morula
