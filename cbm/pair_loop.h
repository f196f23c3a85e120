#pragma once
#include <memory>
#include <type_traits>
#include <utility>

#include "cbm/pair_block.h"

namespace morula::cbm {

using PairLanes = Lane<double, PairBlock::kWidth>;

/// What all laws start from; directions and distances are stored in the block.
struct PairGeometry {
  PairLanes overlap, reduced_radius;

  static PairGeometry of(PairBlock& block) noexcept {
    using L = PairLanes;
    const L x = L::load(block.between[0]), y = L::load(block.between[1]), z = L::load(block.between[2]);
    const L distance = sqrt(x * x + y * y + z * z);
    const auto apart = distance > L(kCoincident);
    const L inverse = select(apart, L(1.0) / distance, L(0.0));
    (x * inverse).store(block.normal[0]);
    (y * inverse).store(block.normal[1]);
    select(apart, z * inverse, L(1.0)).store(block.normal[2]);
    distance.store(block.distance);
    const L radius_a = L::load(block.radius_a), radius_b = L::load(block.radius_b);
    return {radius_a + radius_b - distance - L::load(block.offset), radius_a * radius_b / (radius_a + radius_b)};
  }
};

/// A law as the struct of its coefficients for all lanes of a block.
template <template <class> class Law>
Law<PairLanes> law_of_pairs(const PairBlock& block) noexcept {
  constexpr std::size_t kCount = sizeof(Law<double>) / sizeof(double);
  static_assert(kCount <= std::tuple_size_v<PairCoefficients>);
  PairLanes c[kCount];
  for (int lane = 0; lane < PairBlock::kWidth; ++lane)
    for (std::size_t i = 0; i < kCount; ++i) c[i].set(lane, block.contact[lane]->coefficient[i]);
  return [&c]<std::size_t... I>(std::index_sequence<I...>) { return Law<PairLanes>{c[I]...}; }
  (std::make_index_sequence<kCount>());
}
template <template <class> class Law>
Law<double> law_of_pair(const PairCoefficients& c) noexcept {
  return [&c]<std::size_t... I>(std::index_sequence<I...>) { return Law<double>{c[I]...}; }
  (std::make_index_sequence<sizeof(Law<double>) / sizeof(double)>());
}

/// A law that remembers whether a pair is attached answers with the response and the pairs that are attached after the step; any other law with
/// the response alone.
template <class Real>
using MaskOf = decltype(Real() > Real());
template <class Real>
struct Remembered {
  ContactResponse<Real> response;
  MaskOf<Real> attached_next;
};

/// The loop of one law over the pairs of a block. `Law<Real>` is a plain struct of coefficients with respond(reduced_radius, overlap), or, if it
/// remembers, respond(reduced_radius, overlap, attached).
template <template <class> class Law>
void evaluate_pairs(PairBlock& block) noexcept {
  using L = PairLanes;
  const PairGeometry at = PairGeometry::of(block);
  const Law<L> law = law_of_pairs<Law>(block);
  const auto store = [&block](const ContactResponse<L>& response) {
    response.force.store(block.force);
    response.stiffness.store(block.stiffness);
    response.area.store(block.area);
    response.energy.store(block.energy);
  };
  if constexpr (requires { law.respond(at.reduced_radius, at.overlap); }) {
    store(law.respond(at.reduced_radius, at.overlap));
    for (bool& attached : block.attached_next) attached = false;
  } else {
    const Remembered<L> out = law.respond(at.reduced_radius, at.overlap, L::load(block.attached) > L(0.0));
    store(out.response);
    for (int lane = 0; lane < PairBlock::kWidth; ++lane) block.attached_next[lane] = out.attached_next[lane] != 0;
  }
}

/// The same for one pair by its overlap.
template <template <class> class Law>
PairOutcome respond_to_overlap(const PairContact& contact, double reduced_radius, double overlap, bool attached) {
  const Law<double> law = law_of_pair<Law>(contact.coefficient);
  if constexpr (requires { law.respond(reduced_radius, overlap); }) {
    return {law.respond(reduced_radius, overlap), false};
  } else {
    const Remembered<double> out = law.respond(reduced_radius, overlap, attached);
    return {out.response, out.attached_next};
  }
}

/// A law with the loops of its struct.
template <template <class> class Law>
std::shared_ptr<const SphereLaw> make_sphere_law(SphereLaw law) {
  law.evaluate = &evaluate_pairs<Law>;
  law.respond = &respond_to_overlap<Law>;
  return std::make_shared<const SphereLaw>(std::move(law));
}

}  // namespace morula::cbm
