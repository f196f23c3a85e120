#include "report/pictures/surroundings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "core/ball.h"
#include "core/numbers/joined.h"
#include "report/pictures/projection.h"

namespace morula::scenarios {
namespace {

/// Winding number of a surface about a point: 1 inside a closed surface, 0 outside (van Oosterom & Strackee 1983,
/// doi:10.1109/TBME.1983.325207).
double winding(const Snapshot::Obstacle& obstacle, const Vec3d& point) {
  double angle = 0.0;
  for (const Triangle& face : obstacle.faces) {
    const Vec3d a = obstacle.position[face[0]] + obstacle.offset - point, b = obstacle.position[face[1]] + obstacle.offset - point,
                c = obstacle.position[face[2]] + obstacle.offset - point;
    const double la = norm(a), lb = norm(b), lc = norm(c);
    angle += 2.0 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return angle / (4.0 * std::numbers::pi);
}

/// The surface with the nodes on its edges doubled: faces that meet at more than 40 degrees share none, so that each side of a plate is
/// shaded as flat as it is and a tube as round.
Snapshot::Obstacle creased(const Snapshot::Obstacle& smooth) {
  constexpr double kCosine = 0.766;
  std::vector<Vec3d> normal;
  std::vector<std::vector<std::size_t>> around(smooth.position.size());
  for (std::size_t f = 0; f < smooth.faces.size(); ++f) {
    const auto& [a, b, c] = smooth.faces[f];
    const Vec3d n = cross(smooth.position[b] - smooth.position[a], smooth.position[c] - smooth.position[a]);
    normal.push_back(norm(n) > 0.0 ? n / norm(n) : n);
    for (const std::uint32_t node : smooth.faces[f]) around[node].push_back(f);
  }
  Snapshot::Obstacle out = smooth;
  for (std::uint32_t node = 0; node < around.size(); ++node) {
    std::vector<std::size_t> left = around[node];
    for (bool first = true; !left.empty(); first = false) {
      std::vector<std::size_t> side{left.back()};  // all faces that smooth steps lead to
      left.pop_back();
      for (std::size_t i = 0; i < side.size(); ++i)
        for (std::size_t k = left.size(); k-- > 0;)
          if (dot(normal[side[i]], normal[left[k]]) > kCosine) {
            side.push_back(left[k]);
            left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
          }
      if (first) continue;  // the node itself
      const auto copy = static_cast<std::uint32_t>(out.position.size());
      out.position.push_back(smooth.position[node]);
      for (const std::size_t f : side) std::replace(out.faces[f].begin(), out.faces[f].end(), node, copy);
    }
  }
  return out;
}

/// Edges of a surface that bound one face only, along that face.
std::vector<std::pair<std::uint32_t, std::uint32_t>> border_of(const Snapshot::Obstacle& surface) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Triangle& face : surface.faces)
    for (std::size_t k = 0; k < 3; ++k) edges.emplace(face[k], face[(k + 1) % 3]);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> out;
  for (const auto& [a, b] : edges)
    if (!edges.contains({b, a})) out.emplace_back(a, b);
  return out;
}

/// A flat surface that encloses nothing, as a wall of the domain, would fill no pixel where it is seen edge-on: it is as thick as this, away from the side
/// that its faces turn to, which is that of the cells [µm]. Others stay as they are.
Snapshot::Obstacle with_thickness(const Snapshot::Obstacle& wall, const Camera& camera, double thickness) {
  constexpr double kEdgeOn = 0.02;  // cosine to the line of sight
  if (wall.faces.empty()) return wall;
  const auto& [a, b, c] = wall.faces.front();
  const Vec3d normal = normalized(cross(wall.position[b] - wall.position[a], wall.position[c] - wall.position[a]));
  const auto is_in_plane = [&](const Vec3d& p) {
    return std::abs(dot(p - wall.position[a], normal)) <= 1e-6 * (norm(p - wall.position[a]));
  };
  if (std::abs(dot(normal, camera.toward)) > kEdgeOn || !std::ranges::all_of(wall.position, is_in_plane)) return wall;
  const auto border = border_of(wall);
  if (border.empty()) return wall;
  Snapshot::Obstacle out = wall;
  const auto outer = static_cast<std::uint32_t>(wall.position.size());
  for (const Vec3d& p : wall.position) out.position.push_back(p - normal * thickness);
  for (const Triangle& face : wall.faces) out.faces.push_back({face[0] + outer, face[2] + outer, face[1] + outer});
  for (const auto& [from, to] : border) out.faces.push_back({to, from, from + outer}), out.faces.push_back({to, from + outer, to + outer});
  return out;
}

/// Obstacles as if they were shells, for rasterize.
Snapshot as_shells(const Snapshot& snapshot, const std::vector<bool>& hollow, const Camera& camera, double thickness) {
  Snapshot out;
  for (std::size_t i = 0; i < snapshot.obstacles.size(); ++i) {
    const Snapshot::Obstacle obstacle = creased(with_thickness(snapshot.obstacles[i], camera, thickness));
    const auto number = static_cast<std::uint32_t>(i);
    out.cells.emplace_back().body = BodyKind::kShell;
    out.shells.push_back(
        {number, static_cast<std::uint32_t>(out.nodes.size()), static_cast<std::uint32_t>(obstacle.position.size()), number});
    for (const Vec3d& p : obstacle.position) out.nodes.push_back(p + obstacle.offset);
    out.topologies.push_back(obstacle.faces);
    if (hollow[i])
      for (Triangle& face : out.topologies.back()) std::swap(face[1], face[2]);
  }
  return out;
}

/// Floods the part of the plane that no cell covers, from a pixel on; false, and nothing is flooded, when it reaches the border of the
/// picture.
bool flood(const PixelBuffer& cells, std::size_t start, std::vector<std::uint8_t>& fluid) {
  std::vector<std::size_t> open{start}, seen;
  const auto width = static_cast<std::size_t>(cells.width), count = cells.surface.size();
  const auto covered = [&](std::size_t i) { return cells.surface[i] != PixelBuffer::kNothing && cells.surface[i] % 2 == 1; };
  while (!open.empty()) {
    const std::size_t i = open.back();
    open.pop_back();
    if (fluid[i] != 0 || covered(i)) continue;
    const std::size_t x = i % width;
    fluid[i] = 1;
    seen.push_back(i);
    if (x == 0 || x + 1 == width || i < width || i + width >= count) {
      for (const std::size_t s : seen) fluid[s] = 0;
      return false;
    }
    for (const std::size_t next : {i - 1, i + 1, i - width, i + width}) open.push_back(next);
  }
  return true;
}

void fill_disc(const PixelBuffer& cells, const Projection& projection, const ClipDepth& clip, const Vec3d& center, double radius,
               std::vector<std::uint8_t>& fluid) {
  const double s = projection.camera.pixels_per_um;
  const int x0 = std::max(0, static_cast<int>(center.x - radius * s)),
            x1 = std::min(cells.width - 1, static_cast<int>(center.x + radius * s));
  const int y0 = std::max(0, static_cast<int>(center.y - radius * s)),
            y1 = std::min(cells.height - 1, static_cast<int>(center.y + radius * s));
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const double dx = (x + 0.5 - center.x) / s, dy = (y + 0.5 - center.y) / s, dz = clip.at(x, y) - center.z;
      const std::size_t i = cells.index(x, y);
      const bool covered = cells.surface[i] != PixelBuffer::kNothing && cells.surface[i] % 2 == 1;
      if (!covered && dx * dx + dy * dy + dz * dz < radius * radius) fluid[i] = 1;
    }
}

void draw_fluid(const Snapshot& snapshot, const Camera& camera, const CutPlane& cut, const PixelBuffer& cells,
                std::vector<std::uint8_t>& fluid) {
  const Projection projection{camera, 0.5 * cells.width, 0.5 * cells.height};
  for (const Snapshot::Lumen& lumen : snapshot.lumens) {
    const double radius = ball_radius(lumen.volume), height = dot(lumen.center - cut.point, cut.normal);
    if (!(std::abs(height) < radius)) continue;
    const Vec3d start = projection.pixel(lumen.center - cut.normal * height);
    const int x = static_cast<int>(std::floor(start.x)), y = static_cast<int>(std::floor(start.y));
    if (x < 0 || y < 0 || x >= cells.width || y >= cells.height) continue;
    fluid.resize(cells.surface.size(), 0);
    if (!flood(cells, cells.index(x, y), fluid))
      fill_disc(cells, projection, ClipDepth(projection, cut), projection.pixel(lumen.center), radius, fluid);
  }
}

}  // namespace

DrawnSurroundings draw_surroundings(const Snapshot& snapshot, const Camera& camera, const std::optional<CutPlane>& cut,
                                    const PixelBuffer& cells) {
  DrawnSurroundings out;
  bool any = false;
  for (const Snapshot::Obstacle& obstacle : snapshot.obstacles) {
    constexpr std::size_t kAsked = 32;  // cells are on the same side of an obstacle: a few tell
    std::size_t within = 0, asked = 0;
    for (std::size_t c = 0; c < snapshot.cells.size(); c += 1 + snapshot.cells.size() / kAsked, ++asked)
      within += std::abs(winding(obstacle, snapshot.cells[c].centroid)) > 0.5;
    out.hollow.push_back(2 * within > asked);
    any = any || !obstacle.faces.empty();
  }
  if (any) {
    out.obstacles.emplace(cells.width, cells.height);
    constexpr double kWall = 0.012;  // of the width of the picture
    rasterize(as_shells(snapshot, out.hollow, camera, kWall * cells.width / camera.pixels_per_um), camera, cut, *out.obstacles);
  }
  if (cut) draw_fluid(snapshot, camera, *cut, cells, out.fluid);
  return out;
}

std::vector<LegendEntry> surroundings_legend(const Snapshot& snapshot, bool with_cut) {
  std::vector<LegendEntry> entries;
  constexpr std::size_t kNamed = 3;
  std::string names = joined(snapshot.obstacles, &Snapshot::Obstacle::name);  // they share a colour
  if (snapshot.obstacles.size() > kNamed) names = std::to_string(snapshot.obstacles.size()) + " obstacles";
  if (!names.empty()) entries.push_back({names, kObstacleColor});
  if (with_cut)
    for (const Snapshot::Lumen& lumen : snapshot.lumens) entries.push_back({"fluid of " + lumen.name, kFluidColor});
  return entries;
}

}  // namespace morula::scenarios
