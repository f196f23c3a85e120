#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

#include "core/friction/edge_block.h"
#include "core/mesh/topology.h"

namespace morula {

/// One contact point: a quadrature point of a source face against a point of a target face (or a sphere, or a rigid surface).
///
/// With the relative velocity u = Σ β_i v(source node i) − Σ μ_j v(target node j), the element's force on the source point is
/// −(a u + (b + Δt k) (n·u) n) with a = w γ_t, b = w (γ_n − γ_t). It enters the operator and friction only, never other forces, so that it is
/// kept in 16 bytes: weights in 14 bits (they still sum to one exactly, so that rigid motion feels nothing), the normal in 11 bits an axis (cut,
/// not rounded, so that it is never longer than 1 and a I + b n nᵀ stays positive whatever γ_n/γ_t), w to 1 in 4096, k to 1 in 256. Faces
/// go up to kMostFaces.
struct ContactElement {
  static constexpr std::int32_t kWeightUnits = 16383, kNormalUnits = 1023;
  static constexpr std::uint32_t kMostFaces = 1u << 17;

  ContactElement() = default;
  /// Point q of face `source` against face `target` (0 for a sphere, whose centre has all the weight).
  ContactElement(std::uint32_t source, std::uint32_t q, std::uint32_t target)
      : source_(source), point_(q), target_(target), mu0_(0), mu1_(0), nx_(0), ny_(0), nz_(0), k_(0), w_(0) {}

  [[nodiscard]] std::uint32_t source_face() const { return static_cast<std::uint32_t>(source_); }
  [[nodiscard]] std::uint32_t point() const { return static_cast<std::uint32_t>(point_); }
  [[nodiscard]] std::uint32_t target() const { return static_cast<std::uint32_t>(target_); }
  /// μ of the target's nodes.
  template <class Real>
  void weights(Real (&out)[3]) const {
    constexpr Real unit = Real(1.0) / Real(kWeightUnits);
    const auto mu0 = static_cast<std::int32_t>(mu0_), mu1 = static_cast<std::int32_t>(mu1_);
    out[0] = static_cast<Real>(mu0) * unit;
    out[1] = static_cast<Real>(mu1) * unit;
    out[2] = static_cast<Real>(kWeightUnits - mu0 - mu1) * unit;
  }
  /// In units of 1/kWeightUnits, rounded; the second gives way so that the third is not negative.
  void set_weights(std::int32_t mu0, std::int32_t mu1) {
    mu0_ = static_cast<std::uint32_t>(mu0);
    mu1_ = static_cast<std::uint32_t>(mu1 < kWeightUnits - mu0 ? mu1 : kWeightUnits - mu0);
  }
  template <class Real>
  [[nodiscard]] Vec3<Real> normal() const {
    constexpr Real unit = Real(1.0) / Real(kNormalUnits);
    return {static_cast<Real>(static_cast<std::int32_t>(nx_)) * unit, static_cast<Real>(static_cast<std::int32_t>(ny_)) * unit,
            static_cast<Real>(static_cast<std::int32_t>(nz_)) * unit};
  }
  /// In units of 1/kNormalUnits, cut.
  void set_normal(std::int32_t x, std::int32_t y, std::int32_t z) { nx_ = x, ny_ = y, nz_ = z; }
  /// w: area that bears friction [µm²]; 0 below 1e-13.
  [[nodiscard]] float area() const {
    const auto code = static_cast<std::uint32_t>(w_);
    return code == 0 ? 0.0f : std::bit_cast<float>((code << 13) + kAreaBase);
  }
  void set_area(float area) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(area) + 0x1000u;
    w_ = !(area >= 1e-13f) ? 0 : std::min((bits - kAreaBase) >> 13, 0xFFFFu);
  }
  /// k: contact stiffness [nN/µm], not negative.
  [[nodiscard]] float stiffness() const { return std::bit_cast<float>(static_cast<std::uint32_t>(k_) << 16); }
  void set_stiffness(float stiffness) { k_ = (std::bit_cast<std::uint32_t>(stiffness) + 0x8000u) >> 16; }

 private:
  static constexpr std::uint32_t kAreaBase = (127u - 44u) << 23;  // 6 bits of exponent, 10 of fraction: from 2⁻⁴⁴ to 2²⁰
  std::uint64_t source_ : 17, point_ : 2, target_ : 17, mu0_ : 14, mu1_ : 14;
  std::int64_t nx_ : 11, ny_ : 11, nz_ : 11;
  std::uint64_t k_ : 15, w_ : 16;
};
static_assert(sizeof(ContactElement) == 16);

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
