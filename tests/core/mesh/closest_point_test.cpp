#include "core/mesh/closest_point.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "core/mesh/icosphere.h"
#include "core/mesh/pseudonormal.h"

namespace morula {
namespace {

using Corners = std::array<Vec3d, 3>;

class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed) {}
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  Vec3d point(double half) { return {number(-half, half), number(-half, half), number(-half, half)}; }
  Corners triangle() { return {point(1), point(1), point(1)}; }

 private:
  std::mt19937_64 engine_;
};

ClosestPoint closest(const Vec3d& p, const Corners& t) { return closest_point_on_triangle(p, t[0], t[1], t[2]); }

Vec3d weighted(const Corners& t, const double (&mu)[3]) { return t[0] * mu[0] + t[1] * mu[1] + t[2] * mu[2]; }

/// The properties that hold for every triangle, degenerate or not.
void expect_sound(const ClosestPoint& c, const Vec3d& p, const Corners& t, double tolerance) {
  double sum = 0.0;
  for (const double mu : c.barycentric) {
    EXPECT_GE(mu, 0.0);
    sum += mu;
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_LE(norm(weighted(t, c.barycentric) - c.point), tolerance);
  EXPECT_EQ(c.distance2, norm2(p - c.point));
  const int zeros = (c.barycentric[0] == 0.0) + (c.barycentric[1] == 0.0) + (c.barycentric[2] == 0.0);
  const int feature = static_cast<int>(c.feature);
  if (feature == 0) {
    EXPECT_EQ(zeros, 0);
  } else if (feature <= 3) {
    EXPECT_EQ(zeros, 1);
    EXPECT_EQ(c.barycentric[feature - 1], 0.0);
  } else {
    EXPECT_EQ(zeros, 2);
    EXPECT_EQ(c.barycentric[feature - 4], 1.0);
    EXPECT_EQ(c.point, t[static_cast<std::size_t>(feature - 4)]);
  }
}

/// No sample of the triangle is nearer: what makes the point the nearest one.
void expect_no_sample_nearer(const ClosestPoint& c, const Vec3d& p, const Corners& t, double tolerance) {
  constexpr int kSteps = 24;
  const double distance = std::sqrt(c.distance2);
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; i + j <= kSteps; ++j) {
      const double mu[3] = {double(i) / kSteps, double(j) / kSteps, double(kSteps - i - j) / kSteps};
      ASSERT_GE(norm(p - weighted(t, mu)), distance - tolerance);
    }
}

TEST(ClosestPoint, IsNoFartherThanAnySampleOfTheTriangle) {
  Draw draw(1);
  std::array<int, 7> met{};
  for (int n = 0; n < 3000; ++n) {
    const Corners t = draw.triangle();
    const Vec3d p = draw.point(2);
    const ClosestPoint c = closest(p, t);
    expect_sound(c, p, t, 1e-13);
    expect_no_sample_nearer(c, p, t, 1e-13);
    ++met[static_cast<std::size_t>(c.feature)];
  }
  for (const int times : met) EXPECT_GT(times, 50);  // every region has been tried
}

TEST(ClosestPoint, LeavesAnOffsetThatNoDirectionInTheTriangleShortens) {
  // Optimality: (p − x)·(y − x) <= 0 for each corner y, and with that for every point y of the triangle.
  Draw draw(2);
  for (int n = 0; n < 100000; ++n) {
    const Corners t = draw.triangle();
    const Vec3d p = draw.point(3);
    const ClosestPoint c = closest(p, t);
    for (const Vec3d& corner : t) ASSERT_LE(dot(p - c.point, corner - c.point), 1e-11);
  }
}

TEST(ClosestPoint, HasKnownValuesInEachRegion) {
  const Corners t = {Vec3d{0, 0, 0}, Vec3d{2, 0, 0}, Vec3d{0, 2, 0}};
  const auto expect = [&](Vec3d p, Vec3d point, TriangleFeature feature) {
    const ClosestPoint c = closest(p, t);
    EXPECT_LT(norm(c.point - point), 1e-15);
    EXPECT_EQ(c.feature, feature);
  };
  expect({0.5, 0.5, 3}, {0.5, 0.5, 0}, TriangleFeature::kFace);
  expect({2, 2, 1}, {1, 1, 0}, TriangleFeature::kEdge0);
  expect({-1, 0.5, 1}, {0, 0.5, 0}, TriangleFeature::kEdge1);
  expect({0.5, -1, 1}, {0.5, 0, 0}, TriangleFeature::kEdge2);
  expect({-1, -1, 1}, {0, 0, 0}, TriangleFeature::kVertex0);
  expect({4, -1, 1}, {2, 0, 0}, TriangleFeature::kVertex1);
  expect({-1, 4, 1}, {0, 2, 0}, TriangleFeature::kVertex2);
}

TEST(ClosestPoint, DoesNotDependOnTheFirstCorner) {
  Draw draw(3);
  for (int n = 0; n < 20000; ++n) {
    const Corners t = draw.triangle();
    const Vec3d p = draw.point(2);
    const ClosestPoint a = closest(p, t), b = closest(p, {t[1], t[2], t[0]}), c = closest(p, {t[2], t[1], t[0]});
    ASSERT_NEAR(std::sqrt(a.distance2), std::sqrt(b.distance2), 1e-13);
    ASSERT_NEAR(std::sqrt(a.distance2), std::sqrt(c.distance2), 1e-13);
    ASSERT_LT(norm(a.point - b.point), 1e-9);
    ASSERT_LT(norm(a.point - c.point), 1e-9);
  }
}

TEST(ClosestPoint, MovesNoFartherThanThePointItBelongsTo) {
  // Projection onto a convex set is a contraction: also across the borders of the regions.
  Draw draw(4);
  for (int n = 0; n < 50000; ++n) {
    const Corners t = draw.triangle();
    const Vec3d p = draw.point(2), q = p + draw.point(n % 2 ? 1e-6 : 0.3);
    ASSERT_LE(norm(closest(p, t).point - closest(q, t).point), norm(p - q) + 1e-10);
  }
}

TEST(ClosestPoint, MovesWithTheTriangle) {
  Draw draw(5);
  for (int n = 0; n < 20000; ++n) {
    const Corners t = draw.triangle();
    const Vec3d p = draw.point(2), shift = draw.point(1000);
    const ClosestPoint here = closest(p, t), there = closest(p + shift, {t[0] + shift, t[1] + shift, t[2] + shift});
    ASSERT_NEAR(std::sqrt(here.distance2), std::sqrt(there.distance2), 1e-11);
    ASSERT_LT(norm(here.point + shift - there.point), 1e-7);
  }
}

TEST(ClosestPoint, IsRightForTrianglesWithoutArea) {
  Draw draw(6);
  for (int n = 0; n < 2000; ++n) {
    const Vec3d a = draw.point(1), b = draw.point(1);
    const double s = draw.number(-0.5, 1.5);
    for (const Corners& t : {Corners{a, b, a + (b - a) * s}, Corners{a, a, b}, Corners{a, b, b}, Corners{a, b, a}, Corners{a, a, a}}) {
      const Vec3d p = draw.point(2);
      const ClosestPoint c = closest(p, t);
      expect_sound(c, p, t, 1e-13);
      expect_no_sample_nearer(c, p, t, 1e-13);
    }
  }
}

TEST(ClosestPoint, IsRightForSliversOfAnyThinness) {
  Draw draw(7);
  for (int n = 0; n < 3000; ++n) {
    const double thin = std::pow(10.0, draw.number(-16, -1));
    const Vec3d a = draw.point(1), b = draw.point(1);
    for (const Corners& t :
         {Corners{a, b, (a + b) * 0.5 + draw.point(thin)}, Corners{a, a + draw.point(thin), b}, Corners{b, a, a + draw.point(thin)}}) {
      for (const Vec3d& p : {draw.point(2), (t[0] + t[1] + t[2]) / 3.0 + draw.point(thin), draw.point(100)}) {
        const ClosestPoint c = closest(p, t);
        expect_sound(c, p, t, 1e-12);
        // A height h is known to 1e-16 only, so that weights over a sliver are known to 1e-16/h; the distance suffers by the lesser of both, at
        // most the root of 1e-16.
        expect_no_sample_nearer(c, p, t, 1e-8);
      }
    }
  }
}

TEST(ClosestPoint, IsFiniteForTinyTriangles) {
  for (const double size : {1e-30, 1e-90, 1e-170, 5e-324}) {
    const ClosestPoint c = closest({1, 2, 3}, {Vec3d{0, 0, 0}, Vec3d{size, 0, 0}, Vec3d{0, size, 0}});
    EXPECT_NEAR(std::sqrt(c.distance2), std::sqrt(14.0), 1e-14);
  }
}

TEST(ClosestPoint, OfACornerIsThatCornerExactly) {
  Draw draw(8);
  for (int n = 0; n < 1000; ++n) {
    const Corners t = draw.triangle();
    for (const Vec3d& corner : t) {
      const ClosestPoint c = closest(corner, t);
      ASSERT_EQ(c.distance2, 0.0);
      ASSERT_EQ(c.point, corner);
    }
  }
}

struct Nearest {
  std::uint32_t face;
  ClosestPoint closest;
};

Nearest nearest_on(const TriangleMesh& mesh, const Vec3d& p) {
  Nearest best{0, {}};
  best.closest.distance2 = 1e300;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& [a, b, c] = mesh.faces[f];
    const ClosestPoint here = closest_point_on_triangle(p, mesh.position[a], mesh.position[b], mesh.position[c]);
    if (here.distance2 < best.closest.distance2) best = {f, here};
  }
  return best;
}

TEST(Pseudonormal, TellsInsideFromOutsideOfASpikyBodyAtEveryFeature) {
  // A star: every other distance from the centre is short, so that edges and nodes are sharp ridges, valleys, peaks and pits. Rays from the centre
  // meet its surface once, which tells the truth independently of normals.
  TriangleMesh star = make_icosphere(1);
  for (std::size_t n = 0; n < star.position.size(); ++n) star.position[n] *= n % 3 == 0 ? 2.0 : 0.6;
  const auto topology = *Topology::build(42, star.faces);
  const auto inside_by_ray = [&](const Vec3d& p) {
    for (const auto& [a, b, c] : star.faces) {
      const Vec3d &x = star.position[a], &y = star.position[b], &z = star.position[c];
      const double u = dot(p, cross(y, z)), v = dot(p, cross(z, x)), w = dot(p, cross(x, y));
      if (u >= 0 && v >= 0 && w >= 0) return dot(p - x, cross(y - x, z - x)) < 0.0;
    }
    ADD_FAILURE() << "the ray misses the star";
    return false;
  };
  Draw draw(9);
  std::array<int, 3> met{};
  for (int n = 0; n < 20000; ++n) {
    const Vec3d p = draw.point(2.2);
    const Nearest near = nearest_on(star, p);
    const double distance = signed_distance(*topology, star.position, p, near.face, near.closest);
    ASSERT_EQ(distance < 0.0, inside_by_ray(p)) << n;
    ASSERT_EQ(std::abs(distance), std::sqrt(near.closest.distance2));
    ++met[near.closest.feature == TriangleFeature::kFace ? 0u : near.closest.feature < TriangleFeature::kVertex0 ? 1u : 2u];
  }
  for (const int times : met) EXPECT_GT(times, 500);
}

TEST(Pseudonormal, WeightsTheNormalsAtANodeByTheirAngles) {
  // Cube corner cut into three squares, one of them by its diagonal through the corner: each square still weighs π/2.
  const std::vector<Vec3d> x = {{1, 1, 1}, {0, 1, 1}, {0, 0, 1}, {1, 0, 1}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}};
  const std::vector<Triangle> faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {3, 5, 4}, {0, 4, 1}, {1, 4, 6},
                                       {2, 1, 6}, {2, 6, 7}, {3, 2, 7}, {3, 7, 5}, {4, 5, 7}, {4, 7, 6}};
  const auto topology = *Topology::build(8, faces);
  const Vec3d n = pseudonormal(*topology, x, 0, TriangleFeature::kVertex0);
  EXPECT_NEAR(n.x, std::acos(0.0), 1e-14);
  EXPECT_NEAR(n.y, std::acos(0.0), 1e-14);
  EXPECT_NEAR(n.z, std::acos(0.0), 1e-14);
}

}  // namespace
}  // namespace morula
