#include "core/mesh/renewal/transfer_marks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace morula {
namespace {

constexpr double kSampleSpacing = 0.35;  // of the mean edge of the new mesh: some 16 samples a face

double area_of(const SurfaceView& surface, std::uint32_t face) {
  const auto& [a, b, c] = surface.topology->faces()[face];
  return 0.5 * norm(cross(surface.position[b] - surface.position[a], surface.position[c] - surface.position[a]));
}

}  // namespace

std::vector<char> transfer_marks(const AskedSurface& surface, std::span<const char> marked, const SurfaceView& mesh) {
  const std::uint32_t faces = mesh.topology->face_count();
  std::vector<char> out(faces, 0);
  double wanted = 0.0, total = 0.0;
  for (std::uint32_t f = 0; f < marked.size(); ++f)
    if (marked[f]) wanted += area_of(surface.view(), f);
  if (!(wanted > 0.0)) return out;
  std::vector<double> area(faces), covered(faces, 0.0);
  for (std::uint32_t f = 0; f < faces; ++f) total += area[f] = area_of(mesh, f);
  const double spacing = kSampleSpacing * std::sqrt(4.0 * total / (std::sqrt(3.0) * faces));
  std::uint32_t near = 0;
  for (const SurfaceSample& sample : sample_surface(mesh, spacing, false)) {
    // Not by walking: inside a sharp rim both sides have a nearest point of their own.
    near = surface.nearest(sample.point, near).face;
    if (marked[near]) covered[sample.face] += sample.area / area[sample.face];
  }
  std::vector<std::uint32_t> order(faces);
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) { return covered[a] > covered[b]; });
  double taken = 0.0;
  for (const std::uint32_t f : order) {
    if (!(covered[f] > 0.0) || std::abs(taken + area[f] - wanted) > std::abs(taken - wanted)) break;
    taken += area[f];
    out[f] = 1;
  }
  return out;
}

}  // namespace morula
