#include "scenarios/measures/shape_measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/ball.h"

namespace morula::scenarios {
namespace {

std::vector<double> node_areas(const ShellView& shell) {
  std::vector<double> out(shell.nodes.size(), 0.0);
  for (const Triangle& t : shell.faces) {
    const double part = norm(cross(shell.nodes[t[1]] - shell.nodes[t[0]], shell.nodes[t[2]] - shell.nodes[t[0]])) / 6.0;
    for (const std::uint32_t node : t) out[node] += part;
  }
  return out;
}

/// Solution of a system of four equations by elimination with pivots; nothing when it is singular.
std::optional<std::array<double, 4>> solve4(std::array<std::array<double, 5>, 4> m) {
  double largest = 0.0;
  for (const auto& row : m)
    for (int c = 0; c < 4; ++c) largest = std::max(largest, std::abs(row[static_cast<std::size_t>(c)]));
  for (std::size_t k = 0; k < 4; ++k) {
    std::size_t pivot = k;
    for (std::size_t r = k + 1; r < 4; ++r)
      if (std::abs(m[r][k]) > std::abs(m[pivot][k])) pivot = r;
    if (!(std::abs(m[pivot][k]) > 1e-12 * largest)) return std::nullopt;
    std::swap(m[k], m[pivot]);
    for (std::size_t r = 0; r < 4; ++r) {
      if (r == k) continue;
      const double factor = m[r][k] / m[k][k];
      for (std::size_t c = k; c < 5; ++c) m[r][c] -= factor * m[k][c];
    }
  }
  return std::array<double, 4>{m[0][4] / m[0][0], m[1][4] / m[1][1], m[2][4] / m[2][2], m[3][4] / m[3][3]};
}

/// Four unknowns by linear least squares: the normal equations of Σ (row · unknowns − value)².
struct LeastSquares4 {
  std::array<std::array<double, 5>, 4> equations{};

  void add(const std::array<double, 4>& row, double value) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) equations[i][j] += row[i] * row[j];
      equations[i][4] += row[i] * value;
    }
  }
  [[nodiscard]] std::optional<std::array<double, 4>> solved() const { return solve4(equations); }
};

}  // namespace

std::vector<ShellView> shells_of(const Snapshot& snapshot, std::size_t type) {
  std::vector<ShellView> out;
  for (const Snapshot::Shell& shell : snapshot.shells) {
    const Snapshot::Cell& cell = snapshot.cells[shell.cell];
    if (cell.type != type) continue;
    out.push_back({std::span(snapshot.nodes).subspan(shell.first_node, shell.node_count), snapshot.topologies[shell.topology], &cell});
  }
  return out;
}

double extent(std::span<const Vec3d> nodes, const Vec3d& axis) {
  double low = 1e300, high = -1e300;
  for (const Vec3d& x : nodes) {
    low = std::min(low, dot(x, axis));
    high = std::max(high, dot(x, axis));
  }
  return high - low;
}

double node_to_volume_radius(std::size_t nodes) {
  ShapeLibrary shapes;
  const auto shape = shapes.icosphere(static_cast<std::uint32_t>(nodes));
  if (!shape.ok()) return 1.0;
  double mean = 0.0;
  for (const Vec3d& x : (*shape)->position) mean += norm(x);
  return ball_radius(1.0) * static_cast<double>(nodes) / mean;
}

SecondMode fit_second_mode(const ShellView& unloaded, const ShellView& loaded, const Vec3d& axis) {
  const std::vector<double> area = node_areas(unloaded);
  const Vec3d c0 = unloaded.cell->centroid, c1 = loaded.cell->centroid;
  double radius = 0.0, whole = 0.0, p = 0.0, pp = 0.0, u = 0.0, pu = 0.0;
  const auto mode = [&](std::size_t i) {
    const Vec3d from = unloaded.nodes[i] - c0;
    const double cosine = dot(from, axis) / norm(from);
    return 1.5 * cosine * cosine - 0.5;
  };
  const auto moved = [&](std::size_t i) { return norm(loaded.nodes[i] - c1) - norm(unloaded.nodes[i] - c0); };
  for (std::size_t i = 0; i < area.size(); ++i) {
    const double w = area[i], p2 = mode(i), here = moved(i);
    whole += w;
    radius += w * norm(unloaded.nodes[i] - c0);
    p += w * p2;
    pp += w * p2 * p2;
    u += w * here;
    pu += w * p2 * here;
  }
  radius /= whole;
  const double u2 = (pu - p * u / whole) / (pp - p * p / whole), u0 = (u - p * u2) / whole;
  double rest = 0.0;
  for (std::size_t i = 0; i < area.size(); ++i) {
    const double left = moved(i) - u0 - u2 * mode(i);
    rest += area[i] * left * left;
  }
  return {(u0 + u2) / radius, (u0 - 0.5 * u2) / radius, std::sqrt(rest / whole) / radius};
}

std::optional<CapFit> fit_cap(const ShellView& shell, const Vec3d& point, const Vec3d& normal) {
  double top = 0.0;
  for (const Vec3d& x : shell.nodes) top = std::max(top, dot(x - point, normal));
  LeastSquares4 fit;
  for (const Vec3d& node : shell.nodes) {
    const Vec3d x = node - point;  // near the origin: no cancellation
    if (dot(x, normal) >= 0.5 * top) fit.add({2.0 * x.x, 2.0 * x.y, 2.0 * x.z, 1.0}, norm2(x));
  }
  const auto found = fit.solved();
  if (!found) return std::nullopt;
  const Vec3d center{(*found)[0], (*found)[1], (*found)[2]};
  const double square = (*found)[3] + norm2(center);
  if (!(square > 0.0)) return std::nullopt;
  CapFit out;
  out.radius = std::sqrt(square) * node_to_volume_radius(shell.nodes.size());
  const double cosine = std::clamp(dot(center, normal) / out.radius, -1.0, 1.0);
  out.angle = std::acos(cosine);
  out.contact_radius = out.radius * std::sin(out.angle);
  out.height = out.radius * (1.0 + cosine);
  return out;
}

std::optional<double> curvature_along(const ShellView& shell, const Vec3d& axis, double radius) {
  const Vec3d across = normalized(cross(axis, std::abs(axis.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0})), third = cross(axis, across);
  LeastSquares4 fit;
  int nodes = 0;
  for (const Vec3d& x : shell.nodes) {
    const Vec3d from = x - shell.cell->centroid;
    const double along = dot(from, axis), u = dot(from, across), v = dot(from, third), square = u * u + v * v;
    if (along < 0.0 || square > radius * radius) continue;
    fit.add({1.0, u, v, -0.5 * square}, along);
    ++nodes;
  }
  const auto found = fit.solved();
  return nodes >= 6 && found ? std::optional((*found)[3]) : std::nullopt;
}

double flat_radius(const ShellView& shell, const Vec3d& point, const Vec3d& normal, double distance) {
  std::vector<Vec3d> near;
  Vec3d mean{};
  for (const Vec3d& x : shell.nodes) {
    const double height = dot(x - point, normal);
    if (height > distance) continue;
    near.push_back(x - normal * height);
    mean += near.back();
  }
  if (near.empty()) return 0.0;
  mean *= 1.0 / static_cast<double>(near.size());
  double most = 0.0;
  for (const Vec3d& x : near) most = std::max(most, norm(x - mean));
  return most;
}

}  // namespace morula::scenarios
