#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/space/space.h"
#include "core/spiral.h"
#include "scenarios/measures/outer_surface.h"

namespace morula::scenarios {
namespace {

constexpr int kPatchesOfSphere = 400;
constexpr double kSpacing = 0.2;   // of the grid, in units of the probe's radius
constexpr double kTouch = 0.02;    // the probe may dip that far into a cell, in units of its radius: facets of shells, contacts
constexpr double kDeepest = 0.75;  // a probe whose centre is nearer than this part of a shell's inner radius to its centroid is inside it

/// A piece of a cell's surface.
struct Patch {
  Vec3d place, normal;
  double area = 0.0;
};

/// A snapshot's cells as a probe meets them.
class Bodies {
 public:
  explicit Bodies(const Snapshot& snapshot) : s_(snapshot), bodies_(snapshot.cells.size()) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i].reach = s_.cells[i].radius;
    for (const auto& shell : s_.shells) {
      Body& body = bodies_[shell.cell];
      const Vec3d& center = s_.cells[shell.cell].centroid;
      body.shell = &shell;
      body.reach = 0.0;
      body.core = 1e300;
      for (std::uint32_t n = 0; n < shell.node_count; ++n) body.points.push_back(s_.nodes[shell.first_node + n]);
      for (const Triangle& t : s_.topologies[shell.topology]) {
        const auto [a, b, c] = corners(shell, t);
        body.points.push_back((a + b + c) * (1.0 / 3.0));
      }
      for (const Vec3d& p : body.points) {
        body.reach = std::max(body.reach, norm(p - center));
        body.core = std::min(body.core, kDeepest * norm(p - center));
      }
    }
  }

  [[nodiscard]] std::vector<Patch> patches(std::size_t cell) const {
    std::vector<Patch> out;
    if (const auto* shell = bodies_[cell].shell) {
      for (const Triangle& t : s_.topologies[shell->topology]) {
        const auto [a, b, c] = corners(*shell, t);
        const Vec3d n = cross(b - a, c - a);
        if (norm2(n) > 0.0) out.push_back({(a + b + c) * (1.0 / 3.0), normalized(n), 0.5 * norm(n)});
      }
      return out;
    }
    for (int k = 0; k < kPatchesOfSphere; ++k) {  // a spiral of equal areas
      const Vec3d n = spiral_direction(k, kPatchesOfSphere);
      out.push_back({s_.cells[cell].centroid + n * s_.cells[cell].radius, n, 1.0});
    }
    return out;
  }

  /// Whether a ball at this place meets a cell.
  [[nodiscard]] bool meet(const Vec3d& center, double radius) const {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Body& body = bodies_[i];
      const double square = norm2(center - s_.cells[i].centroid), touch = body.reach + radius;
      if (square >= touch * touch) continue;
      if (body.shell == nullptr || square < body.core * body.core) return true;
      for (const Vec3d& p : body.points)
        if (norm2(center - p) < radius * radius) return true;
    }
    return false;
  }

  [[nodiscard]] Box box() const {
    Box box;
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      for (const double sign : {-1.0, 1.0}) box.include(s_.cells[i].centroid + Vec3d{1, 1, 1} * (sign * bodies_[i].reach));
    return box;
  }

 private:
  struct Body {
    const Snapshot::Shell* shell = nullptr;
    std::vector<Vec3d> points;  ///< of a shell's surface
    double reach = 0.0;         ///< of the farthest point from the centroid
    double core = 0.0;
  };
  [[nodiscard]] std::array<Vec3d, 3> corners(const Snapshot::Shell& shell, const Triangle& t) const {
    return {s_.nodes[shell.first_node + t[0]], s_.nodes[shell.first_node + t[1]], s_.nodes[shell.first_node + t[2]]};
  }

  const Snapshot& s_;
  std::vector<Body> bodies_;
};

/// Where the centre of a probe can go that comes from far away.
class Outside {
 public:
  Outside(const Bodies& bodies, double probe, const Cavity& cavity) : spacing_(kSpacing * probe) {
    const Box box = bodies.box().inflated(probe + 2.0 * spacing_);
    low_ = box.low;
    const Vec3d size = box.high - box.low;
    const double lengths[3] = {size.x, size.y, size.z};
    for (std::size_t a = 0; a < 3; ++a) count_[a] = static_cast<std::int64_t>(std::ceil(lengths[a] / spacing_)) + 1;
    state_.assign(static_cast<std::size_t>(count_[0] * count_[1] * count_[2]), kUnseen);
    std::vector<std::array<std::int64_t, 3>> front{{0, 0, 0}};  // a corner of the inflated box is free
    state_[0] = kReached;
    while (!front.empty()) {
      const auto at = front.back();
      front.pop_back();
      for (std::size_t a = 0; a < 3; ++a)
        for (const std::int64_t step : {-1, 1}) {
          auto next = at;
          next[a] += step;
          if (next[a] < 0 || next[a] >= count_[a]) continue;
          std::uint8_t& state = state_[index(next)];
          if (state != kUnseen) continue;
          const Vec3d p = place(next);
          const bool barred = norm2(p - cavity.center) < cavity.radius * cavity.radius || bodies.meet(p, (1.0 - kTouch) * probe);
          state = barred ? kBarred : kReached;
          if (!barred) front.push_back(next);
        }
    }
  }

  /// Whether the probe has come to within two spacings of this place.
  [[nodiscard]] bool comes_near(const Vec3d& p) const {
    const Vec3d d = (p - low_) * (1.0 / spacing_);
    const std::array<std::int64_t, 3> base{static_cast<std::int64_t>(std::floor(d.x)), static_cast<std::int64_t>(std::floor(d.y)),
                                           static_cast<std::int64_t>(std::floor(d.z))};
    for (std::int64_t i = -1; i <= 2; ++i)
      for (std::int64_t j = -1; j <= 2; ++j)
        for (std::int64_t k = -1; k <= 2; ++k) {
          const std::array<std::int64_t, 3> at{base[0] + i, base[1] + j, base[2] + k};
          const bool inside = std::min({at[0], at[1], at[2]}) >= 0 && at[0] < count_[0] && at[1] < count_[1] && at[2] < count_[2];
          if (inside && state_[index(at)] == kReached && norm2(place(at) - p) <= 4.0 * spacing_ * spacing_) return true;
        }
    return false;
  }

 private:
  static constexpr std::uint8_t kUnseen = 0, kReached = 1, kBarred = 2;
  [[nodiscard]] std::size_t index(const std::array<std::int64_t, 3>& at) const {
    return static_cast<std::size_t>((at[2] * count_[1] + at[1]) * count_[0] + at[0]);
  }
  [[nodiscard]] Vec3d place(const std::array<std::int64_t, 3>& at) const {
    return low_ + Vec3d{static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])} * spacing_;
  }

  double spacing_;
  Vec3d low_;
  std::array<std::int64_t, 3> count_{};
  std::vector<std::uint8_t> state_;
};

}  // namespace

std::vector<double> outer_surface_fractions(const Snapshot& snapshot, double probe, const Cavity& cavity) {
  if (snapshot.cells.empty()) return {};
  const Bodies bodies(snapshot);
  const Outside outside(bodies, probe, cavity);
  std::vector<double> out;
  for (std::size_t i = 0; i < snapshot.cells.size(); ++i) {
    double free = 0.0, whole = 0.0;
    for (const Patch& patch : bodies.patches(i)) {
      whole += patch.area;
      const Vec3d center = patch.place + patch.normal * probe;
      if (norm2(center - cavity.center) >= cavity.radius * cavity.radius && !bodies.meet(center, (1.0 - kTouch) * probe) &&
          outside.comes_near(center))
        free += patch.area;
    }
    out.push_back(whole > 0.0 ? free / whole : 0.0);
  }
  return out;
}

}  // namespace morula::scenarios
