#include "report/pictures/cut_faces.h"

#include <algorithm>
#include <cmath>

namespace morula::scenarios {
namespace {

// Where an edge goes through the plane; always computed from its lower node, so that both faces of the edge get the same bits.
Vec3d crossing(std::uint32_t i, std::uint32_t j, const Vec3d* x, const std::vector<double>& height) {
  if (i > j) std::swap(i, j);
  return x[i] + (x[j] - x[i]) * (height[i] / (height[i] - height[j]));
}

}  // namespace

CutFaces::CutFaces(const Snapshot& snapshot, const Projection& projection, const CutPlane& cut)
    : normal_(projection.direction(cut.normal)), pixels_per_um_(projection.camera.pixels_per_um) {
  for (const auto& shell : snapshot.shells)
    add_outline(snapshot, shell, snapshot.nodes, projection, cut, {{}, 1e300, -1e300, static_cast<std::int32_t>(2 * shell.cell + 1)});
  std::size_t number = snapshot.cells.size() + snapshot.nuclei.size();  // as the renderer colours them
  for (const auto& nucleus : snapshot.nuclear_shells)
    add_outline(snapshot, nucleus, snapshot.nuclear_nodes, projection, cut,
                {{}, 1e300, -1e300, static_cast<std::int32_t>(2 * number++ + 1), static_cast<std::int32_t>(2 * nucleus.cell + 1)});
}

void CutFaces::add_outline(const Snapshot& snapshot, const Snapshot::Shell& shell, std::span<const Vec3d> nodes,
                           const Projection& projection, const CutPlane& cut, Outline outline) {
  const Vec3d* x = nodes.data() + shell.first_node;
  std::vector<double> height(shell.node_count);
  for (std::size_t i = 0; i < shell.node_count; ++i) height[i] = dot(x[i] - cut.point, cut.normal);
  for (const Triangle& face : snapshot.topologies[shell.topology]) {
    // A node on the plane counts as above it: then every crossed face has exactly one falling and one rising edge.
    Vec3d fall, rise;
    int crossed = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto i = face[c], j = face[(c + 1) % 3];
      if ((height[i] >= 0.0) == (height[j] >= 0.0)) continue;
      ++crossed;
      (height[i] >= 0.0 ? fall : rise) = projection.pixel(crossing(i, j, x, height));
    }
    if (crossed != 2) continue;
    outline.segments.push_back({fall.x, fall.y, rise.x, rise.y});
    outline.low_y = std::min({outline.low_y, fall.y, rise.y});
    outline.high_y = std::max({outline.high_y, fall.y, rise.y});
  }
  if (!outline.segments.empty()) outlines_.push_back(std::move(outline));
}

void CutFaces::draw(int first, int last, std::span<const Disc> spheres, const ClipDepth& clip, PixelBuffer& pixels) const {
  std::vector<float> power(static_cast<std::size_t>(last - first) * static_cast<std::size_t>(pixels.width), 0.0f);
  for (const Disc& disc : spheres) {
    const double radius_px = disc.radius * pixels_per_um_;
    const int y0 = std::max(first, static_cast<int>(std::ceil(disc.y - radius_px - 0.5)));
    const int y1 = std::min(last - 1, static_cast<int>(std::floor(disc.y + radius_px - 0.5)));
    const int x0 = std::max(0, static_cast<int>(std::ceil(disc.x - radius_px - 0.5)));
    const int x1 = std::min(pixels.width - 1, static_cast<int>(std::floor(disc.x + radius_px - 0.5)));
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const double dx = (x + 0.5 - disc.x) / pixels_per_um_, dy = (y + 0.5 - disc.y) / pixels_per_um_;
        const double dz = clip.at(x, y) - disc.depth;
        const auto value = static_cast<float>(dx * dx + dy * dy + dz * dz - disc.radius * disc.radius);
        float& best = power[pixels.index(x, y - first)];
        if (value >= best) continue;
        best = value;
        pixels.put(pixels.index(x, y), static_cast<float>(clip.at(x, y)), disc.surface + 1, normal_);
      }
    }
  }
  for (const Outline& outline : outlines_)
    if (outline.high_y >= first && outline.low_y <= last) fill(outline, first, last, clip, pixels);
}

void CutFaces::fill(const Outline& outline, int first, int last, const ClipDepth& clip, PixelBuffer& pixels) const {
  struct Hit {
    double x;
    int turn;
  };
  std::vector<Hit> hits;
  const int y0 = std::max(first, static_cast<int>(std::floor(outline.low_y - 0.5)));
  const int y1 = std::min(last - 1, static_cast<int>(std::ceil(outline.high_y)));
  for (int y = y0; y <= y1; ++y) {
    const double py = y + 0.5;
    hits.clear();
    for (const Segment& s : outline.segments) {
      if ((s.y0 <= py) == (s.y1 <= py)) continue;
      hits.push_back({s.x0 + (s.x1 - s.x0) * (py - s.y0) / (s.y1 - s.y0), s.y0 <= py ? 1 : -1});
    }
    std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.x < b.x; });
    int winding = 0;  // non-zero rule: a fold of the outline does not become a hole
    for (std::size_t h = 0; h + 1 < hits.size(); ++h) {
      winding += hits[h].turn;
      if (winding == 0) continue;
      const int x0 = std::max(0, static_cast<int>(std::ceil(hits[h].x - 0.5)));
      const int x1 = std::min(pixels.width - 1, static_cast<int>(std::ceil(hits[h + 1].x - 0.5)) - 1);
      for (int x = x0; x <= x1; ++x) {
        const std::size_t i = pixels.index(x, y);
        if (outline.within != PixelBuffer::kNothing && pixels.surface[i] != outline.within) continue;
        pixels.put(i, static_cast<float>(clip.at(x, y)), outline.surface, normal_);
      }
    }
  }
}

}  // namespace morula::scenarios
