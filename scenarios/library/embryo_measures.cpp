#include "scenarios/library/embryo_measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace morula::scenarios {
namespace {

Vec3d mean_of(std::span<const Vec3d> points) {
  Vec3d sum{};
  for (const Vec3d& p : points) sum += p;
  return sum * (1.0 / static_cast<double>(points.size()));
}

double determinant(const std::array<std::array<double, 4>, 4>& m) {
  double det = 0.0;
  for (std::size_t c = 0; c < 4; ++c) {
    std::array<std::array<double, 3>, 3> s{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0, k = 0; j < 4; ++j)
        if (j != c) s[i][k++] = m[i + 1][j];
    const double minor = s[0][0] * (s[1][1] * s[2][2] - s[1][2] * s[2][1]) - s[0][1] * (s[1][0] * s[2][2] - s[1][2] * s[2][0]) +
                         s[0][2] * (s[1][0] * s[2][1] - s[1][1] * s[2][0]);
    det += (c % 2 ? -1.0 : 1.0) * m[0][c] * minor;
  }
  return det;
}

/// A piece of a cell's surface.
struct Patch {
  Vec3d place, normal;
  double area = 0.0;
};

constexpr int kPatchesOfSphere = 400;

/// A snapshot's cells as rays meet them.
class Bodies {
 public:
  explicit Bodies(const Snapshot& snapshot) : s_(snapshot), shell_(snapshot.cells.size(), -1), reach_(snapshot.cells.size()) {
    for (std::size_t k = 0; k < s_.shells.size(); ++k) shell_[s_.shells[k].cell] = static_cast<int>(k);
    for (std::size_t i = 0; i < s_.cells.size(); ++i) {
      reach_[i] = s_.cells[i].radius;
      if (const auto* shell = shell_of(i))
        for (std::uint32_t n = 0; n < shell->node_count; ++n)
          reach_[i] = std::max(reach_[i], norm(s_.nodes[shell->first_node + n] - s_.cells[i].centroid));
    }
  }

  [[nodiscard]] std::vector<Patch> patches(std::size_t cell) const {
    std::vector<Patch> out;
    if (const auto* shell = shell_of(cell)) {
      for (const Triangle& t : s_.topologies[shell->topology]) {
        const auto [a, b, c] = corners(*shell, t);
        const Vec3d n = cross(b - a, c - a);
        if (norm2(n) > 0.0) out.push_back({(a + b + c) * (1.0 / 3.0), normalized(n), 0.5 * norm(n)});
      }
      return out;
    }
    for (int k = 0; k < kPatchesOfSphere; ++k) {  // a spiral of equal areas
      const double z = 1.0 - (2.0 * k + 1.0) / kPatchesOfSphere, r = std::sqrt(1.0 - z * z),
                   turn = k * std::numbers::pi * (3.0 - std::sqrt(5.0));
      const Vec3d n{r * std::cos(turn), r * std::sin(turn), z};
      out.push_back({s_.cells[cell].centroid + n * s_.cells[cell].radius, n, 1.0});
    }
    return out;
  }

  /// Whether the ray meets any cell but `own`.
  [[nodiscard]] bool meets_another(const Vec3d& from, const Vec3d& along, std::size_t own) const {
    for (std::size_t i = 0; i < s_.cells.size(); ++i)
      if (i != own && meets_ball(from, along, s_.cells[i].centroid, reach_[i]) &&
          (shell_of(i) == nullptr || meets_shell(from, along, *shell_of(i))))
        return true;
    return false;
  }

 private:
  [[nodiscard]] const Snapshot::Shell* shell_of(std::size_t cell) const {
    return shell_[cell] < 0 ? nullptr : &s_.shells[static_cast<std::size_t>(shell_[cell])];
  }
  [[nodiscard]] std::array<Vec3d, 3> corners(const Snapshot::Shell& shell, const Triangle& t) const {
    return {s_.nodes[shell.first_node + t[0]], s_.nodes[shell.first_node + t[1]], s_.nodes[shell.first_node + t[2]]};
  }
  static bool meets_ball(const Vec3d& from, const Vec3d& along, const Vec3d& center, double radius) {
    const Vec3d to = center - from;
    const double ahead = dot(to, along), square = norm2(to);
    if (square <= radius * radius) return true;
    return ahead > 0.0 && square - ahead * ahead <= radius * radius;
  }
  /// Möller & Trumbore 1997, doi:10.1080/10867651.1997.10487468.
  [[nodiscard]] bool meets_shell(const Vec3d& from, const Vec3d& along, const Snapshot::Shell& shell) const {
    for (const Triangle& t : s_.topologies[shell.topology]) {
      const auto [a, b, c] = corners(shell, t);
      const Vec3d e = b - a, f = c - a, p = cross(along, f);
      const double det = dot(e, p);
      if (det == 0.0) continue;
      const Vec3d d = from - a, q = cross(d, e);
      const double u = dot(d, p) / det, v = dot(along, q) / det;
      if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && dot(f, q) / det > 0.0) return true;
    }
    return false;
  }

  const Snapshot& s_;
  std::vector<int> shell_;     ///< by cell: its shell, or −1
  std::vector<double> reach_;  ///< by cell: radius of a ball around it
};

}  // namespace

double rms_after_rigid_motion(std::span<const Vec3d> a, std::span<const Vec3d> b) {
  const Vec3d mean_a = mean_of(a), mean_b = mean_of(b);
  std::array<std::array<double, 3>, 3> m{};
  double both = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Vec3d p = a[k] - mean_a, q = b[k] - mean_b;
    both += norm2(p) + norm2(q);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) m[i][j] += p[i] * q[j];
  }
  const double xx = m[0][0], xy = m[0][1], xz = m[0][2], yx = m[1][0], yy = m[1][1], yz = m[1][2], zx = m[2][0], zy = m[2][1], zz = m[2][2];
  const std::array<std::array<double, 4>, 4> horn{{{xx + yy + zz, yz - zy, zx - xz, xy - yx},
                                                   {yz - zy, xx - yy - zz, xy + yx, zx + xz},
                                                   {zx - xz, xy + yx, yy - xx - zz, yz + zy},
                                                   {xy - yx, zx + xz, yz + zy, zz - xx - yy}}};
  double squares = 0.0;
  for (const auto& row : m)
    for (const double x : row) squares += x * x;
  const double det3 = xx * (yy * zz - yz * zy) - xy * (yx * zz - yz * zx) + xz * (yx * zy - yy * zx);
  const double c2 = -2.0 * squares, c1 = -8.0 * det3, c0 = determinant(horn);
  double largest = 0.5 * both;  // a bound from above: Newton's method falls to the largest root
  for (int k = 0; k < 100; ++k) {
    const double l2 = largest * largest, value = (l2 + c2) * l2 + c1 * largest + c0, slope = 4.0 * l2 * largest + 2.0 * c2 * largest + c1;
    if (slope == 0.0) break;
    const double next = largest - value / slope;
    if (!(next < largest)) break;
    largest = next;
  }
  return std::sqrt(std::max(0.0, both - 2.0 * largest) / static_cast<double>(a.size()));
}

double mann_whitney_p(std::span<const double> lower, std::span<const double> upper) {
  const double n = static_cast<double>(lower.size()), m = static_cast<double>(upper.size()), all = n + m;
  if (n == 0.0 || m == 0.0) return 1.0;
  double wins = 0.0;
  for (const double l : lower)
    for (const double u : upper) wins += u > l ? 1.0 : u == l ? 0.5 : 0.0;
  std::vector<double> values(lower.begin(), lower.end());
  values.insert(values.end(), upper.begin(), upper.end());
  std::sort(values.begin(), values.end());
  double ties = 0.0;
  for (std::size_t i = 0, j = 0; i < values.size(); i = j) {
    while (j < values.size() && values[j] == values[i]) ++j;
    const double t = static_cast<double>(j - i);
    ties += t * t * t - t;
  }
  const double variance = n * m / 12.0 * (all + 1.0 - ties / (all * (all - 1.0)));
  if (!(variance > 0.0)) return 1.0;
  return 0.5 * std::erfc((wins - 0.5 * n * m - 0.5) / std::sqrt(2.0 * variance));
}

std::vector<double> free_outer_fractions(const Snapshot& snapshot) {
  const Bodies bodies(snapshot);
  std::vector<Vec3d> centers;
  for (const auto& cell : snapshot.cells) centers.push_back(cell.centroid);
  const Vec3d middle = centers.empty() ? Vec3d{} : mean_of(centers);
  std::vector<double> out;
  for (std::size_t i = 0; i < snapshot.cells.size(); ++i) {
    double free = 0.0, whole = 0.0;
    for (const Patch& patch : bodies.patches(i)) {
      whole += patch.area;
      if (dot(patch.normal, patch.place - middle) > 0.0 && !bodies.meets_another(patch.place, patch.normal, i)) free += patch.area;
    }
    out.push_back(whole > 0.0 ? free / whole : 0.0);
  }
  return out;
}

}  // namespace morula::scenarios
