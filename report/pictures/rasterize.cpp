#include "report/pictures/rasterize.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/pictures/cut_faces.h"
#include "report/pictures/projection.h"

namespace morula::scenarios {
namespace {

struct DrawnTriangle {
  std::array<Vec3d, 3> corner;  // x, y in pixels (y down), z in µm
  std::array<Vec3d, 3> normal;  // in the view frame
  std::int32_t surface;
  std::uint32_t face;
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

void draw_triangle(const DrawnTriangle& t, const ClipDepth& clip, const Band& band, PixelBuffer& pixels) {
  const auto& [a, b, c] = t.corner;
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
    for (int x = x0; x <= x1; ++x) {
      const double px = x + 0.5, py = y + 0.5;
      const double v = ((px - a.x) * (c.y - a.y) - (py - a.y) * (c.x - a.x)) * inverse;
      const double w = ((b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x)) * inverse;
      const double u = 1.0 - v - w;
      if (u < 0.0 || v < 0.0 || w < 0.0) continue;
      const double depth = u * a.z + v * b.z + w * c.z;
      const std::size_t i = pixels.index(x, y);
      if (!(depth > pixels.depth[i]) || depth > clip.at(x, y)) continue;
      Vec3d normal = t.normal[0] * u + t.normal[1] * v + t.normal[2] * w;
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

/// `first_face`: among the faces of all shells.
void add_shell(const Snapshot& snapshot, const Snapshot::Shell& shell, std::size_t first_face, const Projection& projection,
               std::vector<DrawnTriangle>& out) {
  const auto normals = node_normals(snapshot, shell);
  std::vector<Vec3d> corner(shell.node_count), normal(shell.node_count);
  for (std::size_t i = 0; i < shell.node_count; ++i) {
    corner[i] = projection.pixel(snapshot.nodes[shell.first_node + i]);
    normal[i] = projection.direction(normals[i]);
  }
  const std::vector<Triangle>& faces = snapshot.topologies[shell.topology];
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const Triangle& f = faces[k];
    const auto &a = corner[f[0]], &b = corner[f[1]], &c = corner[f[2]];
    // Seen from behind (y points down: the sign is reversed). The mesh is closed, so that a front face always hides it.
    if ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) >= 0.0) continue;
    out.push_back({{a, b, c},
                   {normal[f[0]], normal[f[1]], normal[f[2]]},
                   static_cast<std::int32_t>(2 * shell.cell),
                   static_cast<std::uint32_t>(first_face + k)});
  }
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
  std::vector<DrawnTriangle> triangles;
  std::size_t face = 0;
  for (const auto& shell : snapshot.shells) {
    add_shell(snapshot, shell, face, projection, triangles);
    face += snapshot.topologies[shell.topology].size();
  }
  const CutFaces faces = cut ? CutFaces(snapshot, projection, *cut) : CutFaces();
  const std::vector<CutNucleus> nuclei = cut ? nuclei_of(snapshot, projection) : std::vector<CutNucleus>();

  constexpr int kBandRows = 64;
  const int bands = (pixels.height + kBandRows - 1) / kBandRows;
#pragma omp parallel for schedule(dynamic, 1)
  for (int b = 0; b < bands; ++b) {
    const Band band{b * kBandRows, std::min((b + 1) * kBandRows, pixels.height)};
    for (const Disc& disc : discs) draw_sphere(disc, clip, band, camera.pixels_per_um, pixels);
    for (const DrawnTriangle& triangle : triangles) draw_triangle(triangle, clip, band, pixels);
    if (cut) faces.draw(band.first, band.last, discs, clip, pixels);
    for (const CutNucleus& nucleus : nuclei) draw_nucleus(nucleus, clip, band, camera.pixels_per_um, pixels);
  }
}

}  // namespace morula::scenarios
