#pragma once
#include <algorithm>
#include <type_traits>
#include <utility>

#include "fields/reaction.h"

namespace morula::fields {

/// A law as the struct of its coefficients.
template <class Law>
Law law_of(const ReactionCoefficients& c) noexcept {
  constexpr std::size_t kCount = sizeof(Law) / sizeof(double);
  static_assert(kCount <= std::tuple_size_v<ReactionCoefficients>);
  return [&c]<std::size_t... I>(std::index_sequence<I...>) { return Law{c[I]...}; }
  (std::make_index_sequence<kCount>());
}

/// The slope that the implicit method works with: where a reaction speeds itself up, its slope is left out of the matrix, which stays positive
/// definite; the iteration corrects for it.
template <class Law>
double damping_slope(const Law& law, double c) noexcept {
  return std::max(0.0, law.slope(c));
}

template <class Law>
void add_rates_of_cells(const CellReactionBlock& block, double* rate, double* taken) {
  for (std::size_t s = 0; s < block.sinks.size(); ++s) {
    const Sink& sink = block.sinks[s];
    const TypeCoefficients& of = block.of_type[sink.type];
    if (!of.acts) continue;
    const double amount = sink.cells * law_of<Law>(of.value).taken(block.concentration[sink.voxel]);
    rate[sink.voxel] -= amount / block.voxel_volume;
    if (taken != nullptr) taken[s] += amount;
  }
}

template <class Law>
void add_slopes_of_cells(const CellReactionBlock& block, double* slope) {
  for (const Sink& sink : block.sinks) {
    const TypeCoefficients& of = block.of_type[sink.type];
    if (!of.acts) continue;
    slope[sink.voxel] += sink.cells * damping_slope(law_of<Law>(of.value), block.concentration[sink.voxel]) / block.voxel_volume;
  }
}

template <class Law>
double add_rates(const ReactionCoefficients& coefficients, std::span<const double> c, double* rate) {
  const Law law = law_of<Law>(coefficients);
  double sum = 0.0;
  for (std::size_t i = 0; i < c.size(); ++i) {
    const double taken = law.taken(c[i]);
    rate[i] -= taken;
    sum += taken;
  }
  return sum;
}

template <class Law>
void add_slopes(const ReactionCoefficients& coefficients, std::span<const double> c, double* slope) {
  const Law law = law_of<Law>(coefficients);
  for (std::size_t i = 0; i < c.size(); ++i) slope[i] += damping_slope(law, c[i]);
}

/// A reaction with the loops of its struct. `Law` is a plain struct of coefficients with
///   taken(c)          what is taken away [amol/s] by a cell or [mM/s] in the volume,
///   slope(c)          its derivative [µm³/s] or [1/s],
///   steepest(highest) a bound of |slope| for concentrations between 0 and `highest`, for the explicit method's step.
/// Concentrations below 0 come by errors of the integration: taken() must go on smoothly there, so that the concentration is drawn back to 0.
template <class Law>
std::shared_ptr<const Reaction> make_reaction(Reaction reaction) {
  reaction.taken = [](const ReactionCoefficients& k, double c) { return law_of<Law>(k).taken(c); };
  reaction.slope = [](const ReactionCoefficients& k, double c) { return law_of<Law>(k).slope(c); };
  reaction.steepest = [](const ReactionCoefficients& k, double highest) { return law_of<Law>(k).steepest(highest); };
  reaction.add_rates_of_cells = &add_rates_of_cells<Law>;
  reaction.add_slopes_of_cells = &add_slopes_of_cells<Law>;
  reaction.add_rates = &add_rates<Law>;
  reaction.add_slopes = &add_slopes<Law>;
  return std::make_shared<const Reaction>(std::move(reaction));
}

}  // namespace morula::fields
