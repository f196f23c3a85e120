#include "scenarios/study/obstacle_shapes.h"

#include <cmath>
#include <numbers>

namespace morula::scenarios {
namespace {

constexpr std::uint32_t kSides = 64;

/// Two directions that make a right-handed frame with a unit vector: u × v = axis.
struct Frame {
  Vec3d u, v;
};

Frame frame_of(const Vec3d& axis) {
  const Vec3d away = std::fabs(axis.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d u = normalized(cross(away, axis));
  return {u, cross(axis, u)};
}

/// A hexahedron from its centre and three right-handed half edges.
TriangleMesh hexahedron(const Vec3d& center, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  TriangleMesh s;
  for (int i = 0; i < 8; ++i)
    s.position.push_back(center + a * (i & 1 ? 1.0 : -1.0) + b * (i & 2 ? 1.0 : -1.0) + c * (i & 4 ? 1.0 : -1.0));
  constexpr std::uint32_t kQuads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : kQuads) {
    s.faces.push_back({q[0], q[1], q[2]});
    s.faces.push_back({q[0], q[2], q[3]});
  }
  return s;
}

/// A body of revolution: rings of kSides points (centre, radius) from bottom to top, closed by a point at each end.
class Revolution {
 public:
  Revolution(const Vec3d& axis, const Vec3d& bottom) : frame_(frame_of(axis)) { surface_.position.push_back(bottom); }

  void ring(const Vec3d& center, double radius) {
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kSides;
      surface_.position.push_back(center + frame_.u * (radius * std::cos(angle)) + frame_.v * (radius * std::sin(angle)));
    }
    const std::uint32_t first = 1 + rings_ * kSides;
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const std::uint32_t j = (i + 1) % kSides;
      if (rings_ == 0) {
        surface_.faces.push_back({0, first + j, first + i});
      } else {
        const std::uint32_t below = first - kSides;
        surface_.faces.push_back({below + i, below + j, first + j});
        surface_.faces.push_back({below + i, first + j, first + i});
      }
    }
    ++rings_;
  }

  TriangleMesh finish(const Vec3d& top) {
    const auto last = static_cast<std::uint32_t>(surface_.position.size());
    const std::uint32_t first = last - kSides;
    surface_.position.push_back(top);
    for (std::uint32_t i = 0; i < kSides; ++i) surface_.faces.push_back({last, first + i, first + (i + 1) % kSides});
    return std::move(surface_);
  }

 private:
  Frame frame_;
  TriangleMesh surface_;
  std::uint32_t rings_ = 0;
};

/// Radius of the polygon whose area is that of a circle of radius 1.
double polygon_radius() {
  const double angle = 2.0 * std::numbers::pi / kSides;
  return std::sqrt(angle / std::sin(angle));
}

}  // namespace

TriangleMesh box_surface(const Vec3d& center, const Vec3d& size) {
  return hexahedron(center, {0.5 * size.x, 0, 0}, {0, 0.5 * size.y, 0}, {0, 0, 0.5 * size.z});
}

TriangleMesh slab_surface(const Vec3d& center, const Vec3d& normal, double size) {
  const Vec3d n = normalized(normal);
  const Frame f = frame_of(n);
  const double half_thickness = 0.05 * size;
  return hexahedron(center - n * half_thickness, f.u * (0.5 * size), f.v * (0.5 * size), n * half_thickness);
}

TriangleMesh sphere_surface(const Vec3d& center, double radius) {
  ShapeLibrary library;
  const auto shape = library.icosphere(2562);  // 2562 nodes exist, so that this cannot fail
  const double scale = radius * std::cbrt(4.0 / 3.0 * std::numbers::pi);
  TriangleMesh s;
  for (const Vec3d& p : (*shape)->position) s.position.push_back(center + p * scale);
  const auto faces = (*shape)->topology->faces();
  s.faces.assign(faces.begin(), faces.end());
  return s;
}

TriangleMesh cylinder_surface(const Vec3d& from, const Vec3d& to, double radius) {
  Revolution body(normalized(to - from), from);
  const double polygon = radius * polygon_radius();
  body.ring(from, polygon);
  body.ring(to, polygon);
  return body.finish(to);
}

TriangleMesh capsule_surface(const Vec3d& from, const Vec3d& to, double radius) {
  constexpr int kCapRings = 16;
  const Vec3d axis = normalized(to - from);
  const double polygon = polygon_radius();
  Revolution body(axis, from - axis * radius);
  for (int i = 1; i <= kCapRings; ++i) {
    const double angle = 0.5 * std::numbers::pi * i / kCapRings;
    body.ring(from - axis * (radius * std::cos(angle)), radius * polygon * std::sin(angle));
  }
  for (int i = kCapRings; i >= 1; --i) {
    const double angle = 0.5 * std::numbers::pi * i / kCapRings;
    body.ring(to + axis * (radius * std::cos(angle)), radius * polygon * std::sin(angle));
  }
  return body.finish(to + axis * radius);
}

}  // namespace morula::scenarios
