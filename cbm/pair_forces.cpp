#include "cbm/pair_forces.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "cbm/laws/table.h"

namespace morula::cbm {
namespace {

/// Lanes of more than one law: each law's loop is run over its pairs, which stand in for the others, too.
void evaluate_several_laws(PairBlock& block, int count) noexcept {
  const PairBlock given = block;
  for (int first = 0; first < count; ++first) {
    const SphereLaw* law = given.contact[first]->law;
    bool done = false;
    for (int lane = 0; lane < first; ++lane) done = done || given.contact[lane]->law == law;
    if (done) continue;
    PairBlock part = given;
    for (int lane = 0; lane < PairBlock::kWidth; ++lane)
      if (given.contact[lane]->law != law) part.copy_pair(first, lane);
    law->evaluate(part);
    for (int lane = first; lane < count; ++lane)
      if (given.contact[lane]->law == law) block.take_result(part, lane);
  }
}

/// Where the fits of both types hold; without ends where one has none, or another law stands in.
OverlapRange fitted_range(const SphereParameters& a, const SphereParameters* b, const SphereLaw* law) {
  if (b == nullptr || law != a.law.get() || !a.fitted.has_ends() || !b->fitted.has_ends()) return {};
  return {std::max(a.fitted.least, b->fitted.least), std::min(a.fitted.most, b->fitted.most)};
}

}  // namespace

ContactTable::ContactTable(std::span<const SphereParameters> types, std::span<const SurfacePair> surfaces)
    : types_(types.size()), materials_(types.empty() ? 0 : surfaces.size() / types.size()) {
  assert(surfaces.size() == types_ * materials_ && materials_ >= types_);
  entries_.reserve(surfaces.size());
  for (std::size_t a = 0; a < types_; ++a) {
    for (std::size_t b = 0; b < materials_; ++b) {
      const SurfacePair& surface = surfaces[a * materials_ + b];
      // Always from the lower type's side, so that (a, b) and (b, a) are the same numbers to the last bit.
      const SphereParameters& first = types[std::min(a, b)];
      const SphereParameters* second = b < types_ ? &types[std::max(a, b)] : nullptr;
      const auto adheres_as = [&](std::size_t type) { return surface.adhesion == surfaces[type * materials_ + type].adhesion; };
      const bool adhere_alike = second == nullptr || (adheres_as(a) && adheres_as(b));
      const SphereLaw* law = law_of(first, second, adhere_alike);
      const auto of_two = [&](double SphereParameters::*factor) {
        return second != nullptr ? std::sqrt(first.*factor * second->*factor) : 1.0;
      };
      entries_.push_back({{law, law->couple(first, second, surface.adhesion), fitted_range(first, second, law)},
                          surface.normal_friction * of_two(&SphereParameters::approach_factor),
                          surface.tangential_friction * of_two(&SphereParameters::along_factor)});
    }
  }
}

const SphereLaw* ContactTable::law_of(const SphereParameters& a, const SphereParameters* b, bool adhere_alike) const {
  const auto stand_in = [](const SphereLaw* law) { return law->elsewhere != nullptr ? law->elsewhere.get() : law; };
  // A table has its adhesion in it: it is that of two types which have it both, of one file, and adhere to each other as each to itself.
  const auto same_table = [&] { return a.law->table && b->law->table && *a.law->table == *b->law->table && adhere_alike; };
  if (b != nullptr && (a.law->table ? same_table() : a.law == b->law)) return a.law.get();
  const SphereLaw* law = stand_in(a.law.get());
  return b == nullptr || stand_in(b->law.get()) == law ? law : other_.get();
}

void evaluate(PairBlock& block, int count) noexcept {
  for (int lane = count; lane < PairBlock::kWidth; ++lane) block.copy_pair(0, lane);  // idle lanes repeat the first
  const SphereLaw* law = block.contact[0]->law;
  bool same = true;
  for (int lane = 1; lane < count; ++lane) same = same && block.contact[lane]->law == law;
  if (same)
    law->evaluate(block);
  else
    evaluate_several_laws(block, count);
}

PairResponse evaluate_pair(const PairContact& contact, const Vec3d& between, double radius_a, double radius_b, bool attached,
                           double offset) noexcept {
  PairBlock block;
  block.set(0, between, radius_a, radius_b, contact, attached, offset);
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
