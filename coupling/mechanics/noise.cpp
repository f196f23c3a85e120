#include "coupling/mechanics/noise.h"

namespace morula {

std::vector<double> Noise::normals(CellId cell, std::uint64_t first_factor, std::size_t count) const {
  const Random random(seed, RandomStream::kFluctuationOfNodes);
  std::vector<double> out(count);
  for (std::size_t k = 0; k < count; k += 2) {
    const RandomPair pair = random.normal(cell, 2 * draw(first_factor + k / 2));
    out[k] = pair.first;
    if (k + 1 < count) out[k + 1] = pair.second;
  }
  return out;
}

Vec3d normal_vector(const Random& random, CellId cell, std::uint64_t index) {
  const RandomPair one = random.normal(cell, 2 * index), two = random.normal(cell, 2 * index + 1);
  return {one.first, one.second, two.first};
}

std::uint64_t mixed(std::uint64_t a) {
  a = (a ^ (a >> 30)) * 0xBF58476D1CE4E5B9ull;
  a = (a ^ (a >> 27)) * 0x94D049BB133111EBull;
  return a ^ (a >> 31);
}

std::uint64_t point_draw(std::uint64_t step, CellId partner, std::uint64_t point) {
  return mixed(mixed(mixed(partner.bits()) + step) + point) >> 1;
}

Vec3d along_and_across(const Vec3d& noise, const Vec3d& n, double across, double along) {
  const double part = dot(noise, n);
  return (noise - n * part) * std::sqrt(across) + n * (part * std::sqrt(along));
}

void add_edge_noise(const ShellNoise& s, const Noise& noise) {
  const Random random(noise.seed, RandomStream::kFluctuationOfEdges);
  const double along = s.strength * std::sqrt(s.law.edge_damping), all = s.strength * std::sqrt(s.law.isotropic_damping);
  const auto edges = s.topology.edges();
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const Vec3d numbers = normal_vector(random, s.cell, noise.draw(s.first_draw + 2 * k));
    Vec3d f = normalized(s.x[edges[k].j] - s.x[edges[k].i]) * (along * numbers.x);
    if (all > 0.0) f += normal_vector(random, s.cell, noise.draw(s.first_draw + 2 * k + 1)) * all;
    s.force[edges[k].i] += f;
    s.force[edges[k].j] -= f;
  }
}

void add_bulk_noise(const ShellNoise& s, const Noise& noise, double volume) {
  if (s.law.bulk_viscosity == 0.0) return;
  const Random random(noise.seed, RandomStream::kFluctuationOfNodes);
  const double number = random.normal(s.cell, 2 * noise.draw(s.first_draw + s.x.size())).first;
  const double size = s.strength * std::sqrt(s.law.bulk_viscosity / volume) * number / 6.0;
  for (const Triangle& t : s.topology.faces()) {
    const Vec3d part = cross(s.x[t[1]] - s.x[t[0]], s.x[t[2]] - s.x[t[0]]) * size;
    for (const std::uint32_t node : t) s.force[node] += part;
  }
}

}  // namespace morula
