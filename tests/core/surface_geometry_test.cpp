#include <gtest/gtest.h>

#include "core/mesh/surface_geometry.h"

#include <cstring>
#include <numbers>
#include <random>

namespace morula {
namespace {

/// Ten rough icospheres of two meshes, and a position between them that belongs to no surface.
struct Surfaces {
  std::vector<std::shared_ptr<const ReferenceShape>> shape;
  std::vector<const Topology*> topology;
  std::vector<std::uint32_t> first_node, first_face{0};
  std::vector<Vec3d> position{Vec3d{1, 2, 3}};

  Surfaces() {
    ShapeLibrary library;
    std::mt19937_64 engine(3);
    std::normal_distribution<double> normal;
    for (int s = 0; s < 10; ++s) {
      shape.push_back(library.icosphere(s == 4 ? 42 : 162).value());
      topology.push_back(shape.back()->topology.get());
      first_node.push_back(static_cast<std::uint32_t>(position.size()));
      first_face.push_back(first_face.back() + topology.back()->face_count());
      for (const Vec3d& x : shape.back()->position) {
        position.push_back(Vec3d{14.0 * s, 0.0, 5.0} + 9.0 * x + 0.1 * Vec3d{normal(engine), normal(engine), normal(engine)});
      }
    }
  }
  [[nodiscard]] SurfaceList list() const { return {topology, first_node, first_face}; }
};

TEST(SurfaceGeometry, MatchesItsDefinitionsFaceByFace) {
  const Surfaces s;
  SurfaceGeometry g;
  compute_surface_geometry(s.list(), s.position, g);
  for (std::size_t k = 0; k < s.topology.size(); ++k) {
    const std::span<const Vec3d> x(s.position.data() + s.first_node[k], s.topology[k]->node_count());
    std::vector<Vec3d> vector_area(x.size());
    std::vector<double> node_area(x.size());
    double area = 0.0;
    for (std::uint32_t f = 0; f < s.topology[k]->face_count(); ++f) {
      const Triangle& t = s.topology[k]->faces()[f];
      const Vec3d n = 0.5 * cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]);
      EXPECT_NEAR(g.face_area[s.first_face[k] + f], norm(n), 1e-12);
      EXPECT_NEAR(norm(g.face_normal[s.first_face[k] + f] - normalized(n)), 0.0, 1e-12);
      area += norm(n);
      for (const std::uint32_t v : t) vector_area[v] += n, node_area[v] += norm(n) / 3.0;
    }
    for (std::size_t v = 0; v < x.size(); ++v) {
      EXPECT_NEAR(g.node_normal_length[s.first_node[k] + v], norm(vector_area[v]), 1e-12);
      EXPECT_NEAR(norm(g.node_normal[s.first_node[k] + v] - normalized(vector_area[v])), 0.0, 1e-12);
      EXPECT_NEAR(g.node_area[s.first_node[k] + v], node_area[v], 1e-12);
    }
    EXPECT_NEAR(g.area[k], area, 1e-10);
    EXPECT_NEAR(g.volume[k], enclosed_volume(s.topology[k]->faces(), x, x[0]), 1e-9);
  }
  EXPECT_EQ(g.node_area[0], 0.0) << "a position that belongs to no surface";
  EXPECT_EQ(g.node_normal[0], Vec3d{});
}

/// E = Σ_T (α_T A_T + β_T·n_T) + Σ_v γ_v·n_v with fixed random α, β, γ.
struct LinearEnergy {
  std::vector<double> face_area;
  std::vector<Vec3d> face_normal, node_normal;

  explicit LinearEnergy(const Surfaces& s)
      : face_area(s.first_face.back()), face_normal(s.first_face.back()), node_normal(s.position.size()) {
    std::mt19937_64 engine(5);
    std::normal_distribution<double> normal;
    for (double& a : face_area) a = normal(engine);
    for (Vec3d& b : face_normal) b = {normal(engine), normal(engine), normal(engine)};
    for (Vec3d& c : node_normal) c = {normal(engine), normal(engine), normal(engine)};
  }
  double operator()(const Surfaces& s, std::span<const Vec3d> x) const {
    SurfaceGeometry g;
    compute_surface_geometry(s.list(), x, g);
    double energy = 0.0;
    for (std::size_t f = 0; f < face_area.size(); ++f) energy += face_area[f] * g.face_area[f] + dot(face_normal[f], g.face_normal[f]);
    for (std::size_t v = 0; v < node_normal.size(); ++v) energy += dot(node_normal[v], g.node_normal[v]);
    return energy;
  }
};

TEST(SurfaceForces, AreMinusTheGradientThroughAreasAndNormals) {
  const Surfaces s;
  const LinearEnergy energy(s);
  SurfaceGeometry g;
  compute_surface_geometry(s.list(), s.position, g);
  std::vector<Vec3d> force(s.position.size(), Vec3d{1.0, 0.0, 0.0});  // it is added to what is there
  add_surface_forces(s.list(), s.position, g, {energy.face_area, energy.face_normal, energy.node_normal}, force);
  EXPECT_EQ(force[0], (Vec3d{1.0, 0.0, 0.0}));
  std::mt19937_64 engine(11);
  std::normal_distribution<double> normal;
  double size = 0.0;
  for (Vec3d& f : force) f -= Vec3d{1.0, 0.0, 0.0}, size += norm2(f);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<Vec3d> d(s.position.size());
    double length = 0.0, expected = 0.0;
    for (Vec3d& v : d) v = {normal(engine), normal(engine), normal(engine)}, length += norm2(v);
    for (Vec3d& v : d) v *= 1.0 / std::sqrt(length);
    for (std::size_t i = 0; i < d.size(); ++i) expected -= dot(force[i], d[i]);
    const auto at = [&](double h) {
      auto x = s.position;
      for (std::size_t i = 0; i < x.size(); ++i) x[i] += h * d[i];
      return energy(s, x);
    };
    const double h = 2e-4;
    EXPECT_NEAR((at(h) - at(-h)) / (2 * h), expected, 1e-7 * std::sqrt(size));
  }
}

TEST(SurfaceForces, AndGeometryHaveTheSameBitsForEveryLaneWidth) {
  const Surfaces s;
  const LinearEnergy energy(s);
  std::vector<SurfaceGeometry> g(3);
  std::vector<std::vector<Vec3d>> force(3, std::vector<Vec3d>(s.position.size()));
  for (int k = 0; k < 3; ++k) {
    const auto blocks = group_by_topology(s.topology, k == 0 ? 1 : k == 1 ? 4 : 8);
    compute_surface_geometry(s.list(), blocks, s.position, g[k]);
    add_surface_forces(s.list(), blocks, s.position, g[k], {energy.face_area, energy.face_normal, energy.node_normal}, force[k]);
  }
  for (int k = 1; k < 3; ++k) {
    EXPECT_EQ(g[0].face_area, g[k].face_area);
    EXPECT_EQ(g[0].face_normal, g[k].face_normal);
    EXPECT_EQ(g[0].node_normal, g[k].node_normal);
    EXPECT_EQ(g[0].node_area, g[k].node_area);
    EXPECT_EQ(g[0].volume, g[k].volume);
    EXPECT_EQ(force[0], force[k]);
  }
}

TEST(LaneBlocks, HoldEverySurfaceOnceWithSurfacesOfItsTopology) {
  const Surfaces s;
  const auto blocks = group_by_topology(s.topology);
  std::vector<int> seen(s.topology.size());
  for (const LaneBlock& block : blocks) {
    ASSERT_LE(block.count, block.lanes);
    for (int lane = 0; lane < block.count; ++lane) {
      EXPECT_EQ(s.topology[block.member[lane]], block.topology);
      ++seen[block.member[lane]];
    }
    for (int lane = block.count; lane < LaneBlock::kMaxLanes; ++lane) EXPECT_EQ(block.member[lane], block.member[block.count - 1]);
  }
  EXPECT_EQ(seen, std::vector<int>(s.topology.size(), 1));
  ASSERT_EQ(blocks.size(), 3u);
  EXPECT_EQ(blocks[0].lanes, 8);  // 9 surfaces of 162 nodes: 8 and 1
  EXPECT_EQ(blocks[1].lanes, 1);
  EXPECT_EQ(blocks[2].lanes, 1);
}

}  // namespace
}  // namespace morula
