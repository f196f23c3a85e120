// Axes and shares of division, which both bodies have alike.
#include "coupling/behaviours/division_axis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "coupling/cells.h"
#include "coupling/model.h"

namespace morula {
namespace {

std::shared_ptr<const DivisionAxis> axis_named(const std::string& name) {
  for (const auto& axis : builtin_division_axes())
    if (axis->info.name == name) return axis;
  return nullptr;
}

CellState cell(std::uint64_t number) {
  CellState row;
  row.id = CellId::founder(number);
  row.polarity = {0.6, 0.0, 0.8};
  return row;
}

/// An icosphere of radius 6 stretched along z, turned by nothing.
struct Ellipsoid {
  explicit Ellipsoid(double stretch) {
    ShapeLibrary shapes;
    shape = shapes.icosphere(162).value();
    for (const Vec3d& x : shape->position) position.push_back({6.0 * x.x, 6.0 * x.y, 6.0 * stretch * x.z});
  }
  [[nodiscard]] SurfaceView view() const { return {position, shape->topology.get()}; }
  std::shared_ptr<const ReferenceShape> shape;
  std::vector<Vec3d> position;
};

TEST(DivisionAxis, EveryRuleGivesWhatItsNameSays) {
  const Ellipsoid egg(1.3), ball(1.0);
  CellType type;
  type.axis_own.set_vector("direction", {0.0, 0.6, 0.8});
  double up = 0.0, mean = 0.0, across = 0.0;
  const int n = 400;
  for (int k = 1; k <= n; ++k) {
    const CellState row = cell(static_cast<std::uint64_t>(k));
    const auto of = [&](const char* name, const SurfaceView& surface) {
      type.axis = axis_named(name);
      return division_axis({row, type, surface}, 3, 0);
    };
    const Vec3d along = of("long", egg.view());
    EXPECT_NEAR(std::abs(along.z), 1.0, 1e-9);
    up += along.z > 0.0;
    EXPECT_NEAR(norm(of("fixed", {}) - Vec3d{0, 0.6, 0.8}), 0.0, 1e-15);
    const Vec3d in_layer = of("across_direction", {});
    EXPECT_NEAR(dot(in_layer, Vec3d{0, 0.6, 0.8}), 0.0, 1e-14);
    EXPECT_NEAR(norm(in_layer), 1.0, 1e-14);
    across += in_layer.x * in_layer.x;
    EXPECT_NEAR(norm(of("polarity", {}) - row.polarity), 0.0, 1e-15);
    EXPECT_NEAR(dot(of("across_polarity", {}), row.polarity), 0.0, 1e-14);
    EXPECT_NEAR(norm(of("across_polarity", {})), 1.0, 1e-14);
    EXPECT_EQ(of("long", ball.view()), of("random", {})) << "a ball has no longest axis";
    EXPECT_EQ(of("long", {}), of("random", {})) << "nor has a sphere that touches nobody";
    mean += of("random", {}).z;
  }
  EXPECT_NEAR(up / n, 0.5, 4.0 * 0.5 / std::sqrt(n)) << "either end comes first";
  EXPECT_NEAR(mean / n, 0.0, 4.0 / std::sqrt(3.0 * n));
  EXPECT_NEAR(across / n, 0.5, 4.0 * std::sqrt(1.0 / 8.0 / n)) << "every direction of the layer alike: the variance of cos² is 1/8";
}

TEST(DivisionAxis, StraysAsVonMisesAndFisherSay) {
  CellType type;
  type.axis = axis_named("fixed");
  type.axis_own.set_vector("direction", {0, 0, 1});
  const int n = 20000;
  for (const double spread : {0.1, 0.4, 1.2}) {
    type.axis_spread = spread;
    double cosine = 0.0, x = 0.0;
    for (int k = 1; k <= n; ++k) {
      const Vec3d u = division_axis({cell(static_cast<std::uint64_t>(k)), type}, 5, 0);
      EXPECT_NEAR(norm(u), 1.0, 1e-12);
      cosine += u.z;
      x += u.x;
    }
    const double kappa = 1.0 / (spread * spread);
    const double mean = 1.0 / std::tanh(kappa) - 1.0 / kappa;  // Mardia & Jupp 2000, eq. 9.3.9
    const double square = 1.0 - 2.0 * mean / kappa;
    EXPECT_NEAR(cosine / n, mean, 4.0 * std::sqrt((square - mean * mean) / n));
    EXPECT_NEAR(x / n, 0.0, 4.0 * std::sqrt(0.5 * (1.0 - square) / n));
  }
}

TEST(DivisionAxis, LaterAttemptsAreOtherPlanesAndTheSameWheneverAsked) {
  CellType type;
  type.axis = axis_named("fixed");
  type.axis_own.set_vector("direction", {1, 0, 0});
  const CellState row = cell(7);
  EXPECT_EQ(division_axis({row, type}, 1, 0), (Vec3d{1, 0, 0}));
  for (std::uint64_t attempt = 1; attempt < 4; ++attempt) {
    const Vec3d tilted = division_axis({row, type}, 1, attempt);
    EXPECT_EQ(tilted, division_axis({row, type}, 1, attempt));
    EXPECT_LT(tilted.x, 1.0 - 1e-6);
    EXPECT_GT(tilted.x, -0.5);
  }
  CellState later = row;
  later.draws = 4;
  EXPECT_FALSE(division_axis({later, type}, 1, 1) == division_axis({row, type}, 1, 1)) << "what was tried is not tried again";
}

TEST(DivisionShare, IsDrawnAndKeptWithinATenthAndNineTenths) {
  CellType type;
  EXPECT_EQ(division_share({cell(1), type}, 1), 0.5);
  type.division_share = {0.3, 0.1};
  double sum = 0.0, squares = 0.0;
  const int n = 5000;
  for (int k = 1; k <= n; ++k) {
    const double share = division_share({cell(static_cast<std::uint64_t>(k)), type}, 1);
    sum += share;
    squares += share * share;
  }
  EXPECT_NEAR(sum / n, 0.3, 4.0 * 0.03 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n - sum * sum / n / n), 0.03, 0.002);  // cut at 3: 0.987 of the spread
  type.division_share = {0.12, 0.3};
  for (int k = 1; k <= 500; ++k) EXPECT_GE(division_share({cell(static_cast<std::uint64_t>(k)), type}, 1), 0.1);
}

}  // namespace
}  // namespace morula
