#include "scenarios/measures/aggregate_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/mesh/remesh.h"
#include "core/mesh/triangle_tree.h"

namespace morula::scenarios {
namespace {

constexpr double kFree = 2.5;            // [µm]
constexpr double kMeetEdges = 0.4;       // of the mean edge, beyond twice kFree
constexpr std::size_t kFewestFree = 20;  // nodes, for a sphere
constexpr double kFewestPart = 0.05;     // of the nodes

/// Solution of a linear system by elimination with pivots; nothing when it is singular. The last column is the right side.
template <std::size_t N>
std::optional<std::array<double, N>> solved(std::array<std::array<double, N + 1>, N> m) {
  double largest = 0.0;
  for (const auto& row : m)
    for (std::size_t c = 0; c < N; ++c) largest = std::max(largest, std::abs(row[c]));
  for (std::size_t k = 0; k < N; ++k) {
    std::size_t pivot = k;
    for (std::size_t r = k + 1; r < N; ++r)
      if (std::abs(m[r][k]) > std::abs(m[pivot][k])) pivot = r;
    if (!(std::abs(m[pivot][k]) > 1e-13 * largest)) return std::nullopt;
    std::swap(m[k], m[pivot]);
    for (std::size_t r = 0; r < N; ++r) {
      if (r == k) continue;
      const double factor = m[r][k] / m[k][k];
      for (std::size_t c = k; c <= N; ++c) m[r][c] -= factor * m[k][c];
    }
  }
  std::array<double, N> out;
  for (std::size_t k = 0; k < N; ++k) out[k] = m[k][N] / m[k][k];
  return out;
}

/// By node: the sum of the area vectors of its faces, over three.
std::vector<Vec3d> node_area_vectors(const TriangleMesh& mesh) {
  std::vector<Vec3d> out(mesh.position.size());
  for (const Triangle& t : mesh.faces) {
    const Vec3d third = cross(mesh.position[t[1]] - mesh.position[t[0]], mesh.position[t[2]] - mesh.position[t[0]]) / 6.0;
    for (const std::uint32_t node : t) out[node] += third;
  }
  return out;
}

std::vector<double> node_areas(const TriangleMesh& mesh) {
  std::vector<double> out(mesh.position.size(), 0.0);
  for (const Triangle& t : mesh.faces) {
    const double third = norm(cross(mesh.position[t[1]] - mesh.position[t[0]], mesh.position[t[2]] - mesh.position[t[0]])) / 6.0;
    for (const std::uint32_t node : t) out[node] += third;
  }
  return out;
}

std::optional<FreeSphere> fit_sphere(std::span<const Vec3d> nodes) {
  Vec3d middle;
  for (const Vec3d& p : nodes) middle += p;
  middle = middle / static_cast<double>(nodes.size());
  std::array<std::array<double, 5>, 4> m{};
  for (const Vec3d& node : nodes) {
    const Vec3d x = node - middle;
    const std::array<double, 4> row{2.0 * x.x, 2.0 * x.y, 2.0 * x.z, 1.0};
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) m[i][j] += row[i] * row[j];
      m[i][4] += row[i] * norm2(x);
    }
  }
  const auto found = solved<4>(m);
  if (!found) return std::nullopt;
  const Vec3d center{(*found)[0], (*found)[1], (*found)[2]};
  const double square = (*found)[3] + norm2(center);
  if (!(square > 0.0)) return std::nullopt;
  FreeSphere out{center + middle, std::sqrt(square), 0.0, nodes.size()};
  for (const Vec3d& p : nodes) out.rms += std::pow(norm(p - out.center) - out.radius, 2);
  out.rms = std::sqrt(out.rms / static_cast<double>(nodes.size()));
  return out;
}

/// By cell and node: distance from the nearest other cell, at most kFree.
std::vector<std::vector<double>> distances(std::span<const TriangleMesh> cells) {
  std::vector<std::unique_ptr<TriangleTree>> trees;
  for (const TriangleMesh& cell : cells) trees.push_back(std::make_unique<TriangleTree>(cell.position, cell.faces));
  std::vector<std::vector<double>> out;
  for (std::size_t a = 0; a < cells.size(); ++a) {
    auto& mine = out.emplace_back(cells[a].position.size(), kFree);
    for (std::size_t b = 0; b < cells.size(); ++b) {
      if (a == b) continue;
      const Box reach = trees[b]->bounds().inflated(kFree);
      for (std::size_t i = 0; i < mine.size(); ++i) {
        if (!reach.contains(cells[a].position[i])) continue;
        if (const auto nearest = trees[b]->nearest(cells[a].position[i], mine[i]))
          mine[i] = std::min(mine[i], std::sqrt(nearest->closest.distance2));
      }
    }
  }
  return out;
}

bool come_near(std::span<const Vec3d> a, std::span<const Vec3d> b, double near) {
  for (const Vec3d& p : a)
    for (const Vec3d& q : b)
      if (norm2(p - q) < near * near) return true;
  return false;
}

}  // namespace

double AggregateShape::mean_angle() const {
  double sum = 0.0;
  for (const JunctionAngle& one : angles) sum += one.angle;
  return angles.empty() ? 0.0 : sum / static_cast<double>(angles.size());
}

AggregateShape measure_aggregate(std::span<const TriangleMesh> cells, double contact_gap) {
  AggregateShape out;
  const auto distance = distances(cells);
  std::vector<std::vector<Vec3d>> free(cells.size());
  double whole = 0.0, touching = 0.0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const std::vector<double> area = node_areas(cells[c]);
    double mine = 0.0, in_contact = 0.0;
    for (std::size_t i = 0; i < area.size(); ++i) {
      mine += area[i];
      if (distance[c][i] < contact_gap) in_contact += area[i];
      if (distance[c][i] >= kFree) free[c].push_back(cells[c].position[i]);
    }
    whole += mine;
    touching += in_contact;
    out.contact_part.push_back(in_contact / mine);
    const bool enough =
        free[c].size() >= kFewestFree && static_cast<double>(free[c].size()) >= kFewestPart * static_cast<double>(area.size());
    out.sphere.push_back(enough ? fit_sphere(free[c]) : std::nullopt);
  }
  out.contact_fraction = touching / whole;
  for (std::size_t a = 0; a < cells.size(); ++a)
    for (std::size_t b = a + 1; b < cells.size(); ++b) {
      const double near = 2.0 * kFree + kMeetEdges * 0.5 * (mean_edge_length(cells[a]) + mean_edge_length(cells[b]));
      if (!out.sphere[a] || !out.sphere[b] || !come_near(free[a], free[b], near)) continue;
      const double ra = out.sphere[a]->radius, rb = out.sphere[b]->radius, d = norm(out.sphere[b]->center - out.sphere[a]->center);
      const double cosine = (ra * ra + rb * rb - d * d) / (2.0 * ra * rb);
      if (std::abs(cosine) < 1.0) out.angles.push_back({a, b, 0.5 * (std::numbers::pi - std::acos(cosine))});
    }
  return out;
}

double rms_normal_motion(std::span<const TriangleMesh> before, std::span<const TriangleMesh> after) {
  struct Point {
    Vec3d x, normal, moved;
    double area;
  };
  std::vector<Point> points;
  for (std::size_t c = 0; c < before.size(); ++c) {
    const auto vector = node_area_vectors(before[c]);
    for (std::size_t i = 0; i < vector.size(); ++i)
      if (const double area = norm(vector[i]); area > 0.0)
        points.push_back({before[c].position[i], vector[i] / area, after[c].position[i] - before[c].position[i], area});
  }
  Vec3d middle;
  double whole = 0.0;
  for (const Point& p : points) {
    middle += p.x * p.area;
    whole += p.area;
  }
  middle = middle / whole;
  // n·(u − t − ω × x) with the six numbers of t and ω by least squares.
  std::array<std::array<double, 7>, 6> m{};
  const auto row_of = [&](const Point& p) {
    const Vec3d turn = cross(p.x - middle, p.normal);
    return std::array<double, 6>{p.normal.x, p.normal.y, p.normal.z, turn.x, turn.y, turn.z};
  };
  for (const Point& p : points) {
    const auto row = row_of(p);
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < 6; ++j) m[i][j] += p.area * row[i] * row[j];
      m[i][6] += p.area * row[i] * dot(p.normal, p.moved);
    }
  }
  const auto rigid = solved<6>(m).value_or(std::array<double, 6>{});  // a single sphere can be turned at will
  double sum = 0.0;
  for (const Point& p : points) {
    const auto row = row_of(p);
    double left = dot(p.normal, p.moved);
    for (std::size_t i = 0; i < 6; ++i) left -= row[i] * rigid[i];
    sum += p.area * left * left;
  }
  return std::sqrt(sum / whole);
}

}  // namespace morula::scenarios
