#pragma once
#include <bit>
#include <cstdint>
#include <span>

#include "core/friction/edge_block.h"
#include "core/mesh/topology.h"

namespace morula {

/// One contact point: a quadrature point of a source face against a point of a target face (or a sphere, or a rigid surface).
///
/// With the relative velocity u = Σ β_i v(source node i) − Σ μ_j v(target node j), the element's force on the source point is
/// −(a u + (b + Δt k) (n·u) n) with a = w γ_t, b = w (γ_n − γ_t). It enters the operator only, never the forces, so that weights and
/// normal are rounded to 16 bits, stiffness to 8 (weights still sum to one exactly, so that rigid motion feels nothing).
struct ContactElement {
  std::uint32_t source;  ///< 4 × source face + quadrature point, which gives β
  std::uint32_t target;  ///< target face; 0 for a sphere, whose centre has all the weight
  std::uint16_t mu[2];   ///< weights of target nodes 0 and 1 in units of 1/65535; the third is the rest
  std::int16_t n[3];     ///< unit normal in units of 1/32767
  std::uint16_t k;       ///< contact stiffness: upper half of a float, rounded [nN/µm]; where a sign would be: 1 when the point is inside
  float w;               ///< area that bears friction [µm²]

  static constexpr std::int32_t kWeightUnits = 65535, kNormalUnits = 32767;

  [[nodiscard]] std::uint32_t source_face() const { return source >> 2; }
  [[nodiscard]] std::uint32_t point() const { return source & 3u; }
  template <class Real>
  void weights(Real (&out)[3]) const {
    constexpr Real unit = Real(1.0) / Real(kWeightUnits);
    out[0] = static_cast<Real>(mu[0]) * unit;
    out[1] = static_cast<Real>(mu[1]) * unit;
    out[2] = static_cast<Real>(kWeightUnits - mu[0] - mu[1]) * unit;
  }
  /// Weights in units of 1/65535, rounded; the second gives way so that the third is not negative.
  void set_weights(std::int32_t mu0, std::int32_t mu1) {
    mu[0] = static_cast<std::uint16_t>(mu0);
    mu[1] = static_cast<std::uint16_t>(mu1 < kWeightUnits - mu0 ? mu1 : kWeightUnits - mu0);
  }
  /// Stiffness, which is not negative, and on which side of the target the point is.
  void set_stiffness(float stiffness, bool inside = false) {
    k = static_cast<std::uint16_t>(((std::bit_cast<std::uint32_t>(stiffness) + 0x8000u) >> 16) | (inside ? 0x8000u : 0u));
  }
  [[nodiscard]] float stiffness() const { return std::bit_cast<float>((k & 0x7FFFu) << 16); }
  [[nodiscard]] bool inside() const { return (k & 0x8000u) != 0; }  ///< the gap is negative
  template <class Real>
  [[nodiscard]] Vec3<Real> normal() const {
    constexpr Real unit = Real(1.0) / Real(kNormalUnits);
    return {static_cast<Real>(n[0]) * unit, static_cast<Real>(n[1]) * unit, static_cast<Real>(n[2]) * unit};
  }
};
static_assert(sizeof(ContactElement) == 24);

/// All contact points of a pair of bodies, both directions. Groups come in canonical order; only the points of active bodies are written.
struct ElementGroup {
  std::span<const ContactElement> elements[2];               ///< [0]: points of body 0 against body 1; [1]: the other way round
  const Topology* topology[2] = {nullptr, nullptr};          ///< null: a sphere
  std::uint32_t body[2] = {0, 0};                            ///< places in the list of bodies
  std::uint32_t first[2] = {0, 0};                           ///< first points
  bool write[2] = {true, true};                              ///< false: ghost, or held
  bool rigid = false;                                        ///< body 1 is an obstacle, not an unknown
  float normal_friction = 0.0f, tangential_friction = 0.0f;  ///< γ_n, γ_t per area [nN·s/µm³]
};

}  // namespace morula
