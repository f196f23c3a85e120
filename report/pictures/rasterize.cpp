#include "report/pictures/rasterize.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "report/pictures/cut_faces.h"
#include "report/pictures/projection.h"

namespace morula::scenarios {
namespace {

struct DrawnNode {
  Vec3d at;      // x, y in pixels (y down), z in µm
  Vec3d normal;  // in the view frame
};

struct DrawnTriangle {
  Triangle corner;  // among the drawn nodes
  std::int32_t surface;
  std::uint32_t face;
};

// The surfaces of shells as the camera sees them.
struct DrawnSurfaces {
  std::vector<DrawnNode> nodes;
  std::vector<DrawnTriangle> triangles;
};

// What is drawn into the rows [first, last); every band is drawn by one thread.
struct Band {
  int first, last;
};

void draw_sphere(const Disc& disc, const ClipDepth& clip, const Band& band, double pixels_per_um, PixelBuffer& pixels) {
  const double radius_px = disc.radius * pixels_per_um;
  const int y0 = std::max(band.first, static_cast<int>(std::ceil(disc.y - radius_px - 0.5)));
  const int y1 = std::min(band.last - 1, static_cast<int>(std::floor(disc.y + radius_px - 0.5)));
  const double nearest = disc.depth + disc.radius;
  for (int y = y0; y <= y1; ++y) {
    const double dy = (disc.y - (y + 0.5)) / pixels_per_um;  // up [µm]
    const double half2 = disc.radius * disc.radius - dy * dy;
    if (half2 <= 0.0) continue;
    const double half_px = std::sqrt(half2) * pixels_per_um;
    const int x0 = std::max(0, static_cast<int>(std::ceil(disc.x - half_px - 0.5)));
    const int x1 = std::min(pixels.width - 1, static_cast<int>(std::floor(disc.x + half_px - 0.5)));
    for (int x = x0; x <= x1; ++x) {
      const std::size_t i = pixels.index(x, y);
      if (nearest <= pixels.depth[i]) continue;
      const double dx = ((x + 0.5) - disc.x) / pixels_per_um;
      const double height = std::sqrt(std::max(0.0, half2 - dx * dx));
      const double depth = disc.depth + height;
      if (depth > pixels.depth[i] && depth <= clip.at(x, y))
        pixels.put(i, static_cast<float>(depth), disc.surface, Vec3d{dx, dy, height} / disc.radius);
    }
  }
}

// From where to where the line at this height goes through the triangle; within rounding.
std::pair<double, double> span_of_row(const std::array<Vec3d, 3>& corner, double y) {
  double left = 1e300, right = -1e300;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d &a = corner[k], &b = corner[(k + 1) % 3];
    if ((a.y < y && b.y < y) || (a.y > y && b.y > y)) continue;
    const double x = a.y == b.y ? a.x : a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
    left = std::min(left, x), right = std::max(right, x);
    if (a.y == b.y) left = std::min(left, b.x), right = std::max(right, b.x);
  }
  return {left, right};
}

void draw_triangle(const DrawnTriangle& t, std::span<const DrawnNode> nodes, const ClipDepth& clip, const Band& band, PixelBuffer& pixels) {
  const DrawnNode &first = nodes[t.corner[0]], &second = nodes[t.corner[1]], &third = nodes[t.corner[2]];
  const std::array<Vec3d, 3> corner{first.at, second.at, third.at};
  const auto& [a, b, c] = corner;
  const double twice_area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (!(std::abs(twice_area) > 1e-12)) return;  // a line, or not a number
  const auto [low_x, high_x] = std::minmax({a.x, b.x, c.x});
  const auto [low_y, high_y] = std::minmax({a.y, b.y, c.y});
  const int y0 = std::max(band.first, static_cast<int>(std::ceil(low_y - 0.5)));
  const int y1 = std::min(band.last - 1, static_cast<int>(std::floor(high_y - 0.5)));
  const int x0 = std::max(0, static_cast<int>(std::ceil(low_x - 0.5)));
  const int x1 = std::min(pixels.width - 1, static_cast<int>(std::floor(high_x - 0.5)));
  const double inverse = 1.0 / twice_area;
  for (int y = y0; y <= y1; ++y) {
    const auto [left, right] = span_of_row(corner, y + 0.5);
    if (left > right) continue;
    const int from = std::max(x0, static_cast<int>(std::floor(left - 0.5))), to = std::min(x1, static_cast<int>(std::ceil(right - 0.5)));
    for (int x = from; x <= to; ++x) {
      const double px = x + 0.5, py = y + 0.5;
      const double v = ((px - a.x) * (c.y - a.y) - (py - a.y) * (c.x - a.x)) * inverse;
      const double w = ((b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x)) * inverse;
      const double u = 1.0 - v - w;
      if (u < 0.0 || v < 0.0 || w < 0.0) continue;
      const double depth = u * a.z + v * b.z + w * c.z;
      const std::size_t i = pixels.index(x, y);
      if (!(depth > pixels.depth[i]) || depth > clip.at(x, y)) continue;
      Vec3d normal = first.normal * u + second.normal * v + third.normal * w;
      normal.z = std::max(normal.z, 0.0);  // an interpolated normal may point away just before the silhouette
      const double length = norm(normal);
      pixels.put(i, static_cast<float>(depth), t.surface, length > 0.0 ? normal / length : Vec3d{0.0, 0.0, 1.0}, t.face);
    }
  }
}

// Node normals: sum of the normals of the faces around, weighted by their areas.
std::vector<Vec3d> node_normals(const Snapshot& snapshot, const Snapshot::Shell& shell) {
  std::vector<Vec3d> normals(shell.node_count);
  const Vec3d* x = snapshot.nodes.data() + shell.first_node;
  for (const Triangle& face : snapshot.topologies[shell.topology]) {
    const Vec3d n = cross(x[face[1]] - x[face[0]], x[face[2]] - x[face[0]]);
    for (const auto corner : face) normals[corner] += n;
  }
  for (Vec3d& n : normals) {
    const double length = norm(n);
    if (length > 0.0) n = n / length;
  }
  return normals;
}

/// `first_face`: among the faces of all shells. Faces that are seen from behind are left out, for a front face always hides them, and those
/// that the cut takes off.
void add_shell(const Snapshot& snapshot, const Snapshot::Shell& shell, std::size_t first_face, const Projection& projection,
               const std::optional<CutPlane>& cut, DrawnSurfaces& out) {
  const auto normals = node_normals(snapshot, shell);
  const auto first_node = static_cast<std::uint32_t>(out.nodes.size());
  std::vector<char> is_cut_off(shell.node_count, 0);
  for (std::size_t i = 0; i < shell.node_count; ++i) {
    const Vec3d& x = snapshot.nodes[shell.first_node + i];
    out.nodes.push_back({projection.pixel(x), projection.direction(normals[i])});
    is_cut_off[i] = cut && dot(x - cut->point, cut->normal) > 0.0;
  }
  const std::vector<Triangle>& faces = snapshot.topologies[shell.topology];
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const Triangle f = {faces[k][0] + first_node, faces[k][1] + first_node, faces[k][2] + first_node};
    const auto &a = out.nodes[f[0]].at, &b = out.nodes[f[1]].at, &c = out.nodes[f[2]].at;
    if ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) >= 0.0) continue;  // y points down: the sign is reversed
    if (is_cut_off[faces[k][0]] && is_cut_off[faces[k][1]] && is_cut_off[faces[k][2]]) continue;
    out.triangles.push_back({f, static_cast<std::int32_t>(2 * shell.cell), static_cast<std::uint32_t>(first_face + k)});
  }
}

/// The triangles that reach into each band of so many rows, in their order.
std::vector<std::vector<std::uint32_t>> by_band(const DrawnSurfaces& surfaces, int rows, int bands) {
  std::vector<std::vector<std::uint32_t>> out(static_cast<std::size_t>(bands));
  const double last = bands - 1.0;
  for (std::uint32_t k = 0; k < surfaces.triangles.size(); ++k) {
    const Triangle& corner = surfaces.triangles[k].corner;
    const auto [low, high] = std::minmax({surfaces.nodes[corner[0]].at.y, surfaces.nodes[corner[1]].at.y, surfaces.nodes[corner[2]].at.y});
    if (!(high >= 0.0 && low / rows <= bands)) continue;  // beside the picture, or not a number
    const auto end = static_cast<std::size_t>(std::min(last, high / rows));
    for (auto band = static_cast<std::size_t>(std::clamp(low / rows, 0.0, last)); band <= end; ++band) out[band].push_back(k);
  }
  return out;
}

std::vector<Disc> discs_of(const Snapshot& snapshot, const Projection& projection) {
  std::vector<Disc> discs;
  for (std::size_t i = 0; i < snapshot.cells.size(); ++i) {
    const auto& cell = snapshot.cells[i];
    if (cell.body != BodyKind::kSphere || !(cell.radius > 0.0) || !std::isfinite(norm2(cell.centroid))) continue;
    const Vec3d p = projection.pixel(cell.centroid);
    discs.push_back({p.x, p.y, p.z, cell.radius, static_cast<std::int32_t>(2 * i)});
  }
  return discs;
}

/// A nucleus in the cut face of its cell.
struct CutNucleus {
  Disc disc;
  std::int32_t cell_face;
};
std::vector<CutNucleus> nuclei_of(const Snapshot& snapshot, const Projection& projection) {
  std::vector<CutNucleus> out;
  for (std::size_t k = 0; k < snapshot.nuclei.size(); ++k) {
    const Vec3d p = projection.pixel(snapshot.nuclei[k].center);
    out.push_back({{p.x, p.y, p.z, snapshot.nuclei[k].radius, static_cast<std::int32_t>(2 * (snapshot.cells.size() + k) + 1)},
                   static_cast<std::int32_t>(2 * snapshot.nuclei[k].cell + 1)});
  }
  return out;
}

void draw_nucleus(const CutNucleus& nucleus, const ClipDepth& clip, const Band& band, double pixels_per_um, PixelBuffer& pixels) {
  const Disc& disc = nucleus.disc;
  const double radius_px = disc.radius * pixels_per_um;
  const int y0 = std::max(band.first, static_cast<int>(std::ceil(disc.y - radius_px - 0.5)));
  const int y1 = std::min(band.last - 1, static_cast<int>(std::floor(disc.y + radius_px - 0.5)));
  const int x0 = std::max(0, static_cast<int>(std::ceil(disc.x - radius_px - 0.5)));
  const int x1 = std::min(pixels.width - 1, static_cast<int>(std::floor(disc.x + radius_px - 0.5)));
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const std::size_t i = pixels.index(x, y);
      const double dx = (x + 0.5 - disc.x) / pixels_per_um, dy = (y + 0.5 - disc.y) / pixels_per_um, dz = clip.at(x, y) - disc.depth;
      if (pixels.surface[i] == nucleus.cell_face && dx * dx + dy * dy + dz * dz < disc.radius * disc.radius)
        pixels.surface[i] = disc.surface;
    }
}

}  // namespace

PixelBuffer::PixelBuffer(int width_, int height_) : width(width_), height(height_) {
  const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  depth.assign(count, -std::numeric_limits<float>::infinity());
  surface.assign(count, kNothing);
  normal_x.assign(count, 0);
  normal_y.assign(count, 0);
  face.assign(count, kNoFace);
}

void rasterize(const Snapshot& snapshot, const Camera& camera, const std::optional<CutPlane>& cut, PixelBuffer& pixels) {
  const Projection projection{camera, 0.5 * pixels.width, 0.5 * pixels.height};
  const ClipDepth clip = cut ? ClipDepth(projection, *cut) : ClipDepth();

  std::vector<Disc> discs = discs_of(snapshot, projection);
  // Nearest first: what is hidden is then rejected before its square root is taken. Ties keep the order of ids.
  std::stable_sort(discs.begin(), discs.end(), [](const Disc& a, const Disc& b) { return a.depth + a.radius > b.depth + b.radius; });
  DrawnSurfaces surfaces;
  std::size_t face = 0;
  for (const auto& shell : snapshot.shells) {
    add_shell(snapshot, shell, face, projection, cut, surfaces);
    face += snapshot.topologies[shell.topology].size();
  }
  const CutFaces faces = cut ? CutFaces(snapshot, projection, *cut) : CutFaces();
  const std::vector<CutNucleus> nuclei = cut ? nuclei_of(snapshot, projection) : std::vector<CutNucleus>();

  constexpr int kBandRows = 64;
  const int bands = (pixels.height + kBandRows - 1) / kBandRows;
  const std::vector<std::vector<std::uint32_t>> triangles_of = by_band(surfaces, kBandRows, bands);
#pragma omp parallel for schedule(dynamic, 1)
  for (int b = 0; b < bands; ++b) {
    const Band band{b * kBandRows, std::min((b + 1) * kBandRows, pixels.height)};
    for (const Disc& disc : discs) draw_sphere(disc, clip, band, camera.pixels_per_um, pixels);
    for (const std::uint32_t k : triangles_of[static_cast<std::size_t>(b)])
      draw_triangle(surfaces.triangles[k], surfaces.nodes, clip, band, pixels);
    if (cut) faces.draw(band.first, band.last, discs, clip, pixels);
    for (const CutNucleus& nucleus : nuclei) draw_nucleus(nucleus, clip, band, camera.pixels_per_um, pixels);
  }
}

}  // namespace morula::scenarios
