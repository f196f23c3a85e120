#include "core/friction/pair_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace morula {
namespace {

void set_weights(ContactElement& e, double mu0, double mu1) {
  e.set_weights(static_cast<std::int32_t>(mu0 * ContactElement::kWeightUnits + 0.5),
                static_cast<std::int32_t>(mu1 * ContactElement::kWeightUnits + 0.5));
}

/// Two bodies of 42 nodes (or a sphere, or an obstacle) with random contact points on each other.
struct RandomContacts {
  ShapeLibrary shapes;
  std::shared_ptr<const ReferenceShape> shape = shapes.icosphere(42).value();
  std::vector<ContactElement> elements[2];
  ElementGroup group;
  std::vector<Vec3d> place[2];
  std::mt19937_64 engine{5};

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }

  RandomContacts(bool sphere, bool rigid) {
    const Topology* topology = shape->topology.get();
    group.topology[0] = topology;
    group.topology[1] = sphere ? nullptr : topology;
    group.rigid = rigid;
    for (std::size_t side = 0; side < 2; ++side) {
      for (std::uint32_t i = 0; i < topology->node_count(); ++i) place[side].push_back({uniform(-6, 6), uniform(-6, 6), uniform(-6, 6)});
      group.position[side] = place[side].data();
    }
    group.normal_friction = 40.0f;
    group.tangential_friction = 15.0f;
    for (int d = 0; d < (sphere || rigid ? 1 : 2); ++d) {
      for (std::uint32_t face = 0; face < topology->face_count(); ++face)
        for (std::uint32_t q = 0; q < 3; ++q) {
          if (uniform(0, 1) < 0.6) continue;
          ContactElement e(face, q, sphere ? 0 : static_cast<std::uint32_t>(uniform(0, topology->face_count() - 0.01)));
          const double mu0 = uniform(0, 1) < 0.2 ? 0.0 : uniform(0, 1);
          set_weights(e, mu0, uniform(0, 1) < 0.1 ? 0.0 : uniform(0, 1.0 - mu0));
          const Vec3d n = normalized(Vec3d{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)});
          e.set_normal(n);
          e.set_area(static_cast<float>(uniform(0, 0.5)));
          e.set_stiffness(static_cast<float>(uniform(0, 2.0)));
          elements[d].push_back(e);
        }
      group.elements[d] = elements[d];
    }
  }
};

constexpr float kStep = 30.0f;

/// Σ over the points of a u + (b + Δt k)(n·u) n and, at an edge or a node of a surface, Δt k u across the gap (not along the edge), point by point in double.
void apply_points(const RandomContacts& c, const std::vector<Vec3d> (&v)[2], std::vector<Vec3d> (&q)[2]) {
  const FaceQuadrature& quadrature = FaceQuadrature::with_points(3);
  for (std::size_t d = 0; d < 2; ++d)
    for (const ContactElement& e : c.group.elements[d]) {
      const Triangle& s = c.group.topology[d]->faces()[e.source_face()];
      const Topology* other = c.group.topology[1 - d];
      double mu[3] = {1, 0, 0};
      Triangle t{0, 0, 0};
      if (other != nullptr) {
        e.weights(mu);
        t = other->faces()[e.target()];
      }
      Vec3d u;
      for (std::size_t k = 0; k < 3; ++k) {
        u += v[d][s[k]] * quadrature.weight[e.point()][k];
        if (!c.group.rigid) u -= v[1 - d][t[k]] * mu[k];
      }
      const Vec3d n = e.normal<double>();
      const double stiffness = double(kStep) * e.stiffness();
      Vec3d f = u * (e.area() * 15.0) + n * ((e.area() * 25.0 + stiffness) * dot(n, u));
      if (other != nullptr) {
        const int zeros = (mu[0] == 0.0) + (mu[1] == 0.0) + (mu[2] == 0.0);
        const std::size_t k = mu[0] == 0.0 ? 0 : mu[1] == 0.0 ? 1 : 2;
        const Vec3d across = normalized(cross(n, c.place[1 - d][t[(k + 2) % 3]] - c.place[1 - d][t[(k + 1) % 3]]));
        if (zeros == 2) f += (u - n * dot(n, u)) * stiffness;
        if (zeros == 1) f += across * (dot(across, u) * stiffness);
      }
      for (std::size_t k = 0; k < 3; ++k) {
        q[d][s[k]] += f * quadrature.weight[e.point()][k];
        if (!c.group.rigid) q[1 - d][t[k]] -= f * mu[k];
      }
    }
}

struct Applied {
  std::vector<Float4> q[2];
  std::size_t blocks;
};

Applied apply_condensed(const RandomContacts& c, const std::vector<Vec3d> (&v)[2], bool write0 = true, bool write1 = true) {
  PairCondenser condenser(FaceQuadrature::with_points(3), kStep);
  NodePairArena blocks;
  condenser.add_pair_blocks(c.group, blocks);
  std::vector<Float4> p[2];
  Applied out;
  out.blocks = blocks.blocks.size();
  for (std::size_t side = 0; side < 2; ++side) {
    for (const Vec3d& x : v[side]) p[side].push_back({float(x.x), float(x.y), float(x.z), 0.0f});
    out.q[side].resize(v[side].size());
  }
  std::size_t next = 0;
  for (std::size_t r = 0; r < blocks.rows.size(); ++r) {
    if (r > 0) {
      EXPECT_LT(blocks.rows[r - 1].i, blocks.rows[r].i);
    }
    for (std::size_t k = 1; k < blocks.rows[r].count; ++k) EXPECT_LT(blocks.blocks[next + k - 1].j, blocks.blocks[next + k].j);
    next += blocks.rows[r].count;
  }
  EXPECT_EQ(next, blocks.blocks.size());
  apply_pair_blocks({blocks.rows, blocks.blocks}, p[0].data(), write0 ? out.q[0].data() : nullptr, c.group.rigid ? nullptr : p[1].data(),
                    write1 && !c.group.rigid ? out.q[1].data() : nullptr);
  for (int side = 0; side < (c.group.rigid ? 1 : 2); ++side) {
    if (c.group.topology[side] == nullptr) continue;
    std::vector<EdgeBlock> edges(c.group.topology[side]->edge_count());
    condenser.add_edge_blocks(c.group, side, edges);
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const Edge& edge = c.group.topology[side]->edges()[k];
      const float* m = edges[k].m;
      const SymMat3<float> matrix{m[0], m[1], m[2], m[3], m[4], m[5]};
      auto& q = out.q[side];
      const Float4 &a = p[side][edge.i], &b = p[side][edge.j];
      const Vec3f f = matrix * Vec3f{a.x - b.x, a.y - b.y, a.z - b.z};
      if (side == 0 ? write0 : write1) {
        store(q[edge.i], load(q[edge.i]) + Float4v{f.x, f.y, f.z, 0.0f});
        store(q[edge.j], load(q[edge.j]) - Float4v{f.x, f.y, f.z, 0.0f});
      }
    }
  }
  return out;
}

class EveryKindOfTarget : public testing::TestWithParam<int> {};

TEST_P(EveryKindOfTarget, BlocksActAsTheContactPointsDo) {
  RandomContacts c(GetParam() == 1, GetParam() == 2);
  std::vector<Vec3d> v[2], expected[2];
  for (std::size_t side = 0; side < 2; ++side) {
    const std::size_t count = side == 1 && GetParam() == 1 ? 1 : 42;
    for (std::size_t i = 0; i < count; ++i) v[side].push_back({c.uniform(-1, 1), c.uniform(-1, 1), c.uniform(-1, 1)});
    expected[side].resize(count);
  }
  apply_points(c, v, expected);
  const Applied got = apply_condensed(c, v);
  EXPECT_GT(got.blocks, 30u);
  double largest = 0.0;
  for (const auto& side : expected)
    for (const Vec3d& f : side) largest = std::max(largest, norm(f));
  EXPECT_GT(largest, 10.0);
  for (std::size_t side = 0; side < 2; ++side)
    for (std::size_t i = 0; i < expected[side].size(); ++i) {
      const Float4& q = got.q[side][i];
      // a row of 20 blocks, each rounded by half a unit, a 33000th of the row's largest
      EXPECT_NEAR(norm(Vec3d{q.x, q.y, q.z} - expected[side][i]), 0.0, 2e-4 * largest) << side << ' ' << i;
      EXPECT_EQ(q.w, 0.0f);
    }
}

INSTANTIATE_TEST_SUITE_P(SurfaceSphereObstacle, EveryKindOfTarget, testing::Values(0, 1, 2));

TEST(PairBlocks, FeelNothingOfACommonTranslation) {
  const RandomContacts c(false, false);
  std::vector<Vec3d> v[2];
  for (auto& side : v) side.assign(42, Vec3d{0.3, -0.7, 0.1});
  const Applied got = apply_condensed(c, v);
  for (const auto& side : got.q)
    for (const Float4& q : side) EXPECT_EQ((std::array<float, 3>{q.x, q.y, q.z}), (std::array<float, 3>{0, 0, 0}));
}

TEST(PairBlocks, StayPositiveThoughRounded) {  // without friction C is of rank one: rounding alone would make it indefinite
  RandomContacts c(false, false);
  for (auto& elements : c.elements)
    for (ContactElement& e : elements) e.set_area(0.0f);
  PairCondenser condenser(FaceQuadrature::with_points(3), kStep);
  NodePairArena blocks;
  condenser.add_pair_blocks(c.group, blocks);
  ASSERT_GT(blocks.blocks.size(), 30u);
  std::size_t row = 0, last = blocks.rows[0].count;
  for (std::size_t k = 0; k < blocks.blocks.size(); ++k) {
    if (k == last) last += blocks.rows[++row].count;
    const SymMat3<float> m = blocks.blocks[k].matrix(1.0f);  // in units of the row: exact
    const double xx = m.xx, yy = m.yy, zz = m.zz, xy = m.xy, xz = m.xz, yz = m.yz;
    EXPECT_GE(xx * yy - xy * xy, 0.0);
    EXPECT_GE(xx * zz - xz * xz, 0.0);
    EXPECT_GE(xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz), 0.0);
  }
}

TEST(PairBlocks, WriteOneSideWithTheSameBits) {
  RandomContacts c(false, false);
  std::vector<Vec3d> v[2];
  for (auto& side : v)
    for (int i = 0; i < 42; ++i) side.push_back({c.uniform(-1, 1), c.uniform(-1, 1), c.uniform(-1, 1)});
  const Applied both = apply_condensed(c, v), first = apply_condensed(c, v, true, false), second = apply_condensed(c, v, false, true);
  for (std::size_t i = 0; i < 42; ++i) {
    EXPECT_EQ(both.q[0][i].x, first.q[0][i].x);
    EXPECT_EQ(first.q[1][i].x, 0.0f);
    EXPECT_EQ(both.q[1][i].y, second.q[1][i].y);
  }
}

TEST(ContactElement, KeepsWeightsThatSumToOne) {
  ContactElement e(0, 0, 0);
  for (double mu0 = 0.0; mu0 <= 1.0; mu0 += 0.0137)
    for (double mu1 = 0.0; mu0 + mu1 <= 1.0; mu1 += 0.0171) {
      set_weights(e, mu0, mu1);
      double mu[3];
      e.weights(mu);
      EXPECT_NEAR(mu[0], mu0, 3.1e-5);
      EXPECT_NEAR(mu[1], mu1, 6.2e-5);
      EXPECT_GE(mu[2], 0.0);
      EXPECT_NEAR(mu[0] + mu[1] + mu[2], 1.0, 1e-15);
    }
  set_weights(e, 0.0, 1.0);
  double mu[3];
  e.weights(mu);
  EXPECT_EQ(mu[0], 0.0);
  EXPECT_EQ(mu[2], 0.0);
}

TEST(ContactElement, KeepsWhatItIsGivenToItsRounding) {
  ContactElement e(65535, 3, 130000);
  e.set_weights(16383, 0);
  e.set_normal(normalized(Vec3d{0.3, -2.0, 0.7}));
  EXPECT_EQ(e.source_face(), 65535u);
  EXPECT_EQ(e.point(), 3u);
  EXPECT_EQ(e.target(), 130000u);
  for (const Vec3d& direction :
       {Vec3d{0.3, -2.0, 0.7}, Vec3d{1, 1, 1}, Vec3d{0, 0, -1}, Vec3d{-1, 1, 0}, Vec3d{0, -1, -1}, Vec3d{5, 1e-9, -4}}) {
    e.set_normal(normalized(direction));
    EXPECT_NEAR(norm(e.normal<double>() - normalized(direction)), 0.0, 5e-5);
    EXPECT_NEAR(norm(e.normal<double>()), 1.0, 1e-15);
  }
  for (const float area : {1e-12f, 3.3e-7f, 0.0123f, 0.9999999f, 1.0f, 7.7f, 1e5f}) {
    e.set_area(area);
    EXPECT_NEAR(e.area(), area, area * 4.9e-4f);
    e.set_stiffness(area);
    EXPECT_NEAR(e.stiffness(), area, area * 4e-3f);
  }
  for (const float none : {0.0f, 1e-20f}) {
    e.set_area(none);
    EXPECT_EQ(e.area(), 0.0f);
  }
  e.set_area(1e9f);  // held at the largest
  EXPECT_GT(e.area(), 1e6f);
  EXPECT_EQ(e.target(), 130000u);  // and nothing runs over
}

}  // namespace
}  // namespace morula
