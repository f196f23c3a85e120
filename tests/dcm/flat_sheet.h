#pragma once
#include <map>

#include "tests/dcm/shell_fixtures.h"

namespace morula::dcm::testing {

/// A flat sheet of equilateral triangles of edge 1 as a closed mesh: two hexagonal layers that share their border. Under a homogeneous
/// deformation every face and every edge of both layers has the same strain as in an endless lattice, and an edge of the border belongs to
/// one face of each layer, so that the energy per area is exactly that of the lattice.
inline Shells flat_sheet(int radius = 4) {
  std::map<std::pair<int, int>, std::uint32_t> layer[2];
  std::vector<Vec3d> position;
  const auto inside = [&](int q, int r) { return std::abs(q) <= radius && std::abs(r) <= radius && std::abs(q + r) <= radius; };
  const auto border = [&](int q, int r) { return std::abs(q) == radius || std::abs(r) == radius || std::abs(q + r) == radius; };
  for (int side = 0; side < 2; ++side) {
    for (int q = -radius; q <= radius; ++q) {
      for (int r = -radius; r <= radius; ++r) {
        if (!inside(q, r)) continue;
        if (side == 1 && border(q, r)) {
          layer[1][{q, r}] = layer[0][{q, r}];
          continue;
        }
        layer[side][{q, r}] = static_cast<std::uint32_t>(position.size());
        position.push_back({q + 0.5 * r, 0.5 * std::sqrt(3.0) * r, 0.0});
      }
    }
  }
  std::vector<Triangle> faces;
  for (int side = 0; side < 2; ++side) {
    const auto add = [&](std::pair<int, int> a, std::pair<int, int> b, std::pair<int, int> c) {
      if (!inside(a.first, a.second) || !inside(b.first, b.second) || !inside(c.first, c.second)) return;
      if (side == 1) std::swap(b, c);
      faces.push_back({layer[side].at(a), layer[side].at(b), layer[side].at(c)});
    };
    for (int q = -radius; q <= radius; ++q) {
      for (int r = -radius; r <= radius; ++r) {
        add({q, r}, {q + 1, r}, {q, r + 1});
        add({q + 1, r}, {q + 1, r + 1}, {q, r + 1});
      }
    }
  }
  const auto topology = Topology::build(static_cast<std::uint32_t>(position.size()), std::move(faces)).value();
  ReferenceShape shape;
  shape.topology = topology;
  shape.position = position;
  shape.edge_length.assign(topology->edge_count(), 1.0);
  shape.face_area.assign(topology->face_count(), 0.25 * std::sqrt(3.0));
  shape.hinge_angle.assign(topology->edge_count(), 0.0);
  Shells shells;
  add_shell(shells, std::make_shared<const ReferenceShape>(std::move(shape)), 1.0);
  return shells;
}

/// The parameters `p` for a flat sheet: its border is folded by π, where the barrier is infinite.
inline ShellParameters on_a_flat_sheet(ShellParameters p) {
  p.barrier_angle = 4.0;
  return p;
}

/// Energy per area at rest after stretching x by λ_x and y by λ_y.
inline double sheet_energy(const Shells& sheet, const ShellParameters& p, double lambda_x, double lambda_y) {
  std::vector<Vec3d> x = sheet.position;
  for (Vec3d& v : x) v.x *= lambda_x, v.y *= lambda_y;
  const double area = 0.25 * std::sqrt(3.0) * sheet.topology(0).face_count();
  return mechanics(sheet, {on_a_flat_sheet(p)}, x).energy[0] / area;
}

struct SheetModuli {
  double young, poisson;
};

/// Young's modulus and Poisson ratio of a uniaxial stretch of ±1 % with free sides (T2.2); the two signs are averaged, so that only odd
/// terms of the stress count.
inline SheetModuli uniaxial_moduli(const Shells& sheet, const ShellParameters& p) {
  const double strain = 0.01;
  const auto free_side = [&](double lambda_x) {  // Newton for the λ_y without stress
    double y = 1.0;
    const double h = 1e-4;
    for (int k = 0; k < 8; ++k) {
      const double low = sheet_energy(sheet, p, lambda_x, y - h), mid = sheet_energy(sheet, p, lambda_x, y),
                   high = sheet_energy(sheet, p, lambda_x, y + h);
      y -= 0.5 * h * (high - low) / (high - 2.0 * mid + low);
    }
    return y;
  };
  const double wide = free_side(1.0 + strain), narrow = free_side(1.0 - strain);
  const double energy = sheet_energy(sheet, p, 1.0 + strain, wide) + sheet_energy(sheet, p, 1.0 - strain, narrow);
  return {energy / (strain * strain), (narrow - wide) / (2.0 * strain)};
}

}  // namespace morula::dcm::testing
