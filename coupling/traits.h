#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "coupling/distribution.h"

namespace morula {

/// What cells of a type may differ in, each cell by factors of its own on the numbers of its type.
enum class Trait : std::uint8_t {
  kTension,    ///< of a shell's cortex and of its regions
  kStiffness,  ///< Young's modulus of a sphere; of a shell its moduli in the plane and against bending
  kAdhesion,   ///< W of two bodies is that of their types times the geometric mean of their factors
};
inline constexpr std::array<const char*, 3> kTraitNames{"tension", "stiffness", "adhesion"};
inline constexpr std::array kTraits{Trait::kTension, Trait::kStiffness, Trait::kAdhesion};

constexpr std::size_t number_of(Trait trait) { return static_cast<std::size_t>(trait); }

/// How the traits of a type vary.
struct Traits {
  std::array<Distribution, kTraits.size()> factor{Distribution{1.0, 0.0}, Distribution{1.0, 0.0}, Distribution{1.0, 0.0}};
  /// What variable_of() reads; −1: none.
  std::array<int, kTraits.size()> variable{-1, -1, -1};

  [[nodiscard]] const Distribution& of(Trait trait) const { return factor[number_of(trait)]; }
  [[nodiscard]] bool vary_in(Trait trait) const { return of(trait).relative_spread > 0.0; }
  /// Number of the variable of cells that holds their own factor less 1; none where no type of the model varies in it.
  [[nodiscard]] std::optional<std::size_t> variable_of(Trait trait) const {
    const int number = variable[number_of(trait)];
    return number < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(number));
  }
};

}  // namespace morula
