#include "cbm/pair_forces.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace morula::cbm {

ContactTable::ContactTable(std::span<const SphereParameters> types, std::span<const SurfacePair> surfaces)
    : types_(types.size()), materials_(types.empty() ? 0 : surfaces.size() / types.size()) {
  assert(surfaces.size() == types_ * materials_ && materials_ >= types_);
  entries_.reserve(surfaces.size());
  for (std::size_t a = 0; a < types_; ++a) {
    for (std::size_t b = 0; b < materials_; ++b) {
      const SurfacePair& surface = surfaces[a * materials_ + b];
      ContactMaterial material;
      if (b < types_) {
        // Always from the lower type's side, so that (a, b) and (b, a) are the same numbers to the last bit.
        const SphereParameters& first = types[a < b ? a : b];
        const SphereParameters& second = types[a < b ? b : a];
        const double adhesion = first.adhesive && second.adhesive ? surface.adhesion : 0.0;
        material = ContactMaterial::elastic(first.young, first.poisson, second.young, second.poisson, adhesion);
      } else {
        material = ContactMaterial::against_rigid(types[a].young, types[a].poisson, types[a].adhesive ? surface.adhesion : 0.0);
      }
      entries_.push_back({material, surface.normal_friction, surface.tangential_friction});
    }
  }
}

void evaluate(PairBlock& block, int count) noexcept {
  using L = Lane<double, PairBlock::kWidth>;
  for (int lane = count; lane < PairBlock::kWidth; ++lane)  // idle lanes repeat the first
    block.set(lane, {block.between[0][0], block.between[1][0], block.between[2][0]}, block.radius_a[0], block.radius_b[0],
              *block.material[0], block.attached[0] != 0.0, block.offset[0]);

  const L x = L::load(block.between[0]), y = L::load(block.between[1]), z = L::load(block.between[2]);
  const L distance = sqrt(x * x + y * y + z * z);
  const auto apart = distance > L(kCoincident);
  const L inverse = select(apart, L(1.0) / distance, L(0.0));
  (x * inverse).store(block.normal[0]);
  (y * inverse).store(block.normal[1]);
  select(apart, z * inverse, L(1.0)).store(block.normal[2]);
  distance.store(block.distance);

  const L radius_a = L::load(block.radius_a), radius_b = L::load(block.radius_b);
  const L overlap = radius_a + radius_b - distance - L::load(block.offset);

  // The scales of each pair: make_pair_law() in lanes.
  PairLaw<L> law;
  law.reduced_radius = radius_a * radius_b / (radius_a + radius_b);
  L adhesion, length_factor, radius_factor, root;
  for (int lane = 0; lane < PairBlock::kWidth; ++lane) {
    const ContactMaterial& material = *block.material[lane];
    law.modulus.set(lane, material.modulus);
    adhesion.set(lane, material.adhesion);
    length_factor.set(lane, material.length_factor);
    radius_factor.set(lane, material.radius_factor);
    root.set(lane, cube_root_start(law.reduced_radius[lane]));
  }
  root = cube_root_refined(law.reduced_radius, root);
  const auto adheres = adhesion > L(0.0);
  law.length = length_factor * root;
  law.inverse_length = select(adheres, L(1.0) / law.length, L(0.0));
  law.radius = radius_factor * (root * root);
  law.force = L(std::numbers::pi) * adhesion * law.reduced_radius;

  const auto attached = (L::load(block.attached) > L(0.0)) & adheres;
  const ContactResponse<L> hertz = hertz_contact(law, overlap), jkr = jkr_contact(law, overlap);
  select(attached, jkr.force, hertz.force).store(block.force);
  select(attached, jkr.stiffness, hertz.stiffness).store(block.stiffness);
  select(attached, jkr.area, hertz.area).store(block.area);
  select(attached, jkr.energy, hertz.energy).store(block.energy);
  const auto stays = (overlap >= select(attached, L(kBreakOverlap) * law.length, L(0.0))) & adheres;  // as update_attached()
  for (int lane = 0; lane < PairBlock::kWidth; ++lane) block.attached_next[lane] = stays[lane] != 0;
}

PairResponse evaluate_pair(const ContactMaterial& material, const Vec3d& between, double radius_a, double radius_b, bool attached,
                           double offset) noexcept {
  PairBlock block;
  block.set(0, between, radius_a, radius_b, material, attached, offset);
  evaluate(block, 1);
  return {{block.normal[0][0], block.normal[1][0], block.normal[2][0]},
          block.distance[0],
          block.force[0],
          block.stiffness[0],
          block.area[0],
          block.energy[0],
          block.attached_next[0]};
}

double pressed_volume(double pressure, double free_volume, double bulk_modulus) noexcept {
  return bulk_modulus > 0.0 ? free_volume * std::exp(-std::min(pressure / bulk_modulus, 1.0)) : free_volume;
}

double sphere_pressure(double virial, double free_volume, double bulk_modulus) noexcept {
  const double at_rest = virial_pressure(virial, free_volume);  // p with V = V0
  if (at_rest == 0.0 || !(bulk_modulus > 0.0)) return at_rest;
  if (at_rest * std::numbers::e >= bulk_modulus) return at_rest * std::numbers::e;  // p V(p) is largest at V0/e
  double p = at_rest;
  for (int k = 0; k < 50; ++k) {  // Newton: monotone from the second iterate on, since p − p0 e^(p/K) is concave or convex
    const double grown = at_rest * std::exp(p / bulk_modulus), change = (grown - p) / (1.0 - grown / bulk_modulus);
    p += change;
    if (std::abs(change) <= 1e-14 * std::abs(p)) break;
  }
  return p;
}

}  // namespace morula::cbm
