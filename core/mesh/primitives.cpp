#include "core/mesh/primitives.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

#include "core/mesh/icosphere.h"
#include "core/mesh/node_order.h"

namespace morula {
namespace {

using std::numbers::pi;

constexpr double kMostFaces = 1e7;

struct Length {
  const char* name;
  double value;
};

Status check_lengths(const char* body, std::initializer_list<Length> lengths) {
  for (const Length& length : lengths) {
    if (length.value > 0.0 && std::isfinite(length.value)) continue;
    std::ostringstream message;
    message << "the " << length.name << " of a " << body << " is " << length.value;
    return Error{ErrorKind::kInput, message.str(), "it must be positive and finite"};
  }
  return {};
}

/// `area` of surface in triangles of side `edge`.
Status check_face_count(const char* body, double area, double edge) {
  if (2.0 * area / (edge * edge) <= kMostFaces) return {};
  return Error{ErrorKind::kInput, std::string("a ") + body + " with this edge length has more than ten million faces",
               "choose a longer edge"};
}

/// Number of parts no longer than `edge`; a little over a whole number is rounding, not another part.
std::uint32_t parts(double length, double edge) { return static_cast<std::uint32_t>(std::max(1.0, std::ceil(length / edge - 1e-9))); }

/// A circle of nodes around z, or a pole (radius 0, one node).
struct Ring {
  double radius, z;
  std::uint32_t count;
  std::uint32_t first = 0;
};

/// Triangles between two rings, the second one after the first along the profile; walks around both by angle.
void stitch(const Ring& a, const Ring& b, std::vector<Triangle>& faces) {
  const std::uint64_t na = a.count == 1 ? 0 : a.count, nb = b.count == 1 ? 0 : b.count;
  std::uint64_t i = 0, j = 0;
  const auto at = [](const Ring& ring, std::uint64_t n) { return ring.first + static_cast<std::uint32_t>(n % ring.count); };
  while (i < na || j < nb) {
    const bool along_a = i < na && (j >= nb || (i + 1) * nb <= (j + 1) * na);
    if (along_a) {
      faces.push_back({at(a, i), at(a, i + 1), at(b, j)});
      ++i;
    } else {
      faces.push_back({at(a, i), at(b, j + 1), at(b, j)});
      ++j;
    }
  }
}

/// The profile runs from the bottom pole (−z) to the top pole.
TriangleMesh surface_of_revolution(std::vector<Ring> rings) {
  TriangleMesh mesh;
  for (Ring& ring : rings) {
    ring.first = static_cast<std::uint32_t>(mesh.position.size());
    if (ring.count == 1) mesh.position.push_back({0.0, 0.0, ring.z});
    if (ring.count == 1) continue;
    for (std::uint32_t n = 0; n < ring.count; ++n) {
      const double angle = 2.0 * pi * n / ring.count;
      mesh.position.push_back({ring.radius * std::cos(angle), ring.radius * std::sin(angle), ring.z});
    }
  }
  for (std::size_t r = 1; r < rings.size(); ++r) stitch(rings[r - 1], rings[r], mesh.faces);
  return with_near_neighbour_order(mesh);
}

std::uint32_t around(double radius, double edge) { return std::max(6u, parts(2.0 * pi * radius, edge)); }

}  // namespace

Result<TriangleMesh> make_plane(double size_x, double size_y, double edge) {
  MORULA_TRY(check_lengths("plane", {{"size along x", size_x}, {"size along y", size_y}, {"edge", edge}}));
  MORULA_TRY(check_face_count("plane", size_x * size_y + (size_x + size_y) * edge, edge));
  const std::uint32_t nx = parts(size_x, edge), ny = parts(size_y, edge);
  TriangleMesh mesh;
  for (std::uint32_t y = 0; y <= ny; ++y)
    for (std::uint32_t x = 0; x <= nx; ++x)
      mesh.position.push_back({size_x * (double(x) / nx - 0.5), size_y * (double(y) / ny - 0.5), 0.0});
  for (std::uint32_t y = 0; y < ny; ++y)
    for (std::uint32_t x = 0; x < nx; ++x) {
      const std::uint32_t a = y * (nx + 1) + x, b = a + 1, c = b + nx + 1, d = a + nx + 1;
      mesh.faces.push_back({a, b, c});
      mesh.faces.push_back({a, c, d});
    }
  return with_near_neighbour_order(mesh);
}

Result<TriangleMesh> make_sphere(double radius, int level) {
  MORULA_TRY(check_lengths("sphere", {{"radius", radius}}));
  if (level < 0 || level > 9)
    return Error{ErrorKind::kInput, "an icosphere of level " + std::to_string(level) + " cannot be made", "choose a level from 0 to 9"};
  TriangleMesh mesh = make_icosphere(level);
  for (Vec3d& x : mesh.position) x *= radius;
  return mesh;
}

Result<TriangleMesh> make_box(const Vec3d& size, double edge) {
  MORULA_TRY(check_lengths("box", {{"size along x", size.x}, {"size along y", size.y}, {"size along z", size.z}, {"edge", edge}}));
  const double area = 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x) + 4.0 * (size.x + size.y + size.z) * edge;
  MORULA_TRY(check_face_count("box", area, edge));
  const std::array<std::uint32_t, 3> n = {parts(size.x, edge), parts(size.y, edge), parts(size.z, edge)};
  TriangleMesh mesh;
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> node_at;  // lattice points on the surface
  const auto node = [&](const std::array<std::uint32_t, 3>& at) {
    const auto [place, is_new] = node_at.try_emplace(at, static_cast<std::uint32_t>(mesh.position.size()));
    if (is_new)
      mesh.position.push_back(
          {size.x * (double(at[0]) / n[0] - 0.5), size.y * (double(at[1]) / n[1] - 0.5), size.z * (double(at[2]) / n[2] - 0.5)});
    return place->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;  // u × v = axis
    for (const bool high : {false, true})
      for (std::uint32_t iv = 0; iv < n[v]; ++iv)
        for (std::uint32_t iu = 0; iu < n[u]; ++iu) {
          const auto corner = [&](std::uint32_t du, std::uint32_t dv) {
            std::array<std::uint32_t, 3> at{};
            at[axis] = high ? n[axis] : 0;
            at[u] = iu + du;
            at[v] = iv + dv;
            return node(at);
          };
          const std::uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          if (high)
            mesh.faces.insert(mesh.faces.end(), {Triangle{a, b, c}, Triangle{a, c, d}});
          else
            mesh.faces.insert(mesh.faces.end(), {Triangle{a, c, b}, Triangle{a, d, c}});
        }
  }
  return with_near_neighbour_order(mesh);
}

Result<TriangleMesh> make_cylinder(double radius, double length, double edge) {
  MORULA_TRY(check_lengths("cylinder", {{"radius", radius}, {"length", length}, {"edge", edge}}));
  MORULA_TRY(check_face_count("cylinder", 2.0 * pi * radius * (radius + length) + 6.0 * (radius + length) * edge, edge));
  const std::uint32_t discs = parts(radius, edge), rows = parts(length, edge);
  const double half = 0.5 * length;
  std::vector<Ring> rings = {{0.0, -half, 1}};
  for (std::uint32_t d = 1; d <= discs; ++d) rings.push_back({radius * d / discs, -half, around(radius * d / discs, edge)});
  for (std::uint32_t r = 1; r <= rows; ++r) rings.push_back({radius, r == rows ? half : -half + length * r / rows, around(radius, edge)});
  for (std::uint32_t d = discs; d-- > 1;) rings.push_back({radius * d / discs, half, around(radius * d / discs, edge)});
  rings.push_back({0.0, half, 1});
  return surface_of_revolution(std::move(rings));
}

Result<TriangleMesh> make_capsule(double radius, double length, double edge) {
  MORULA_TRY(check_lengths("capsule", {{"radius", radius}, {"length", length}, {"edge", edge}}));
  if (length < 2.0 * radius)
    return Error{ErrorKind::kInput, "a capsule cannot be shorter than its two hemispheres", "the length must be at least twice the radius"};
  MORULA_TRY(check_face_count("capsule", 2.0 * pi * radius * length + 6.0 * length * edge, edge));
  const double straight = length - 2.0 * radius;
  const std::uint32_t arcs = std::max(2u, parts(0.5 * pi * radius, edge)), rows = straight > 0.0 ? parts(straight, edge) : 0;
  const auto arc = [&](std::uint32_t n, double side) {
    const double angle = 0.5 * pi * n / arcs;  // from the pole
    const double r = n == arcs ? radius : radius * std::sin(angle), z = n == arcs ? 0.0 : radius * std::cos(angle);
    return Ring{r, side * (0.5 * straight + z), around(r, edge)};
  };
  std::vector<Ring> rings = {{0.0, -0.5 * length, 1}};
  for (std::uint32_t n = 1; n <= arcs; ++n) rings.push_back(arc(n, -1.0));
  for (std::uint32_t r = 1; r < rows; ++r) rings.push_back({radius, -0.5 * straight + straight * r / rows, around(radius, edge)});
  for (std::uint32_t n = rows > 0 ? arcs : arcs - 1; n >= 1; --n) rings.push_back(arc(n, 1.0));
  rings.push_back({0.0, 0.5 * length, 1});
  return surface_of_revolution(std::move(rings));
}

}  // namespace morula
