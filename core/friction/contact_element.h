#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

#include "core/friction/edge_block.h"
#include "core/mesh/topology.h"

namespace morula {

/// One contact point: a quadrature point of a source face against a point of a target face (or a sphere, or a rigid surface).
///
/// With the relative velocity u = Σ β_i v(source node i) − Σ μ_j v(target node j), the element's force on the source point is
/// −(a u + (b + Δt k) (n·u) n) with a = w γ_t, b = w (γ_n − γ_t), and −Δt k u across the gap too where the target's point
/// is on an edge (not along that) or at a node (decision 0065). It enters the operator and friction only, never other forces, so that it is
/// kept in 16 bytes: weights in 14 bits (they still sum to one exactly, so that rigid motion feels nothing), the two smaller components of the
/// normal in 15 bits (to 3e-5: a stiff contact that slides would feel more; the largest makes its length 1, so that a I + b n nᵀ stays
/// positive whatever γ_n/γ_t), w to 1 in 2048, k to 1 in 256. Faces are numbered below
/// kMostSourceFaces and kMostTargetFaces.
struct ContactElement {
  static constexpr std::int32_t kWeightUnits = 16383;
  static constexpr std::uint32_t kMostSourceFaces = 1u << 16, kMostTargetFaces = 1u << 17;

  ContactElement() = default;
  /// Point q of face `source` against face `target` (0 for a sphere, whose centre has all the weight).
  ContactElement(std::uint32_t source, std::uint32_t q, std::uint32_t target)
      : source_(source), point_(q), target_(target), mu0_(0), mu1_(0), inside_(0), next_(0), other_(0), axis_(0), k_(0), w_(0) {}

  [[nodiscard]] std::uint32_t source_face() const { return static_cast<std::uint32_t>(source_); }
  [[nodiscard]] std::uint32_t point() const { return static_cast<std::uint32_t>(point_); }
  /// Place of the point among those of its surface: elements of a pair are sorted by it.
  [[nodiscard]] std::uint32_t place() const { return 4 * source_face() + point(); }
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
    using std::sqrt;
    constexpr Real unit = Real(1.0 / kNormalUnits);
    const Real next = static_cast<Real>(static_cast<std::int32_t>(next_)) * unit,
               other = static_cast<Real>(static_cast<std::int32_t>(other_)) * unit;
    const auto axis = static_cast<std::uint32_t>(axis_);
    const Real size = sqrt(Real(1.0) - next * next - other * other), largest = axis >= 4 ? -size : size;
    switch (axis & 3u) {
      case 0:
        return {largest, next, other};
      case 1:
        return {other, largest, next};
      default:
        return {next, other, largest};
    }
  }
  /// Of length 1.
  void set_normal(const Vec3d& n) {
    const Vec3d size{std::abs(n.x), std::abs(n.y), std::abs(n.z)};
    const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto in_units = [](double a) { return static_cast<std::int32_t>(a * kNormalUnits + (a < 0.0 ? -0.5 : 0.5)); };
    next_ = in_units(n[(axis + 1) % 3]);
    other_ = in_units(n[(axis + 2) % 3]);
    axis_ = static_cast<std::uint32_t>(axis) + (n[axis] < 0.0 ? 4u : 0u);
  }
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
  /// The target's point is on an edge of its face, or at a node: the distance has a curvature there. Of a sphere this says nothing.
  [[nodiscard]] bool at_edge() const { return mu0_ == 0 || mu1_ == 0 || mu0_ + mu1_ == static_cast<std::uint64_t>(kWeightUnits); }
  /// The gap is negative.
  [[nodiscard]] bool inside() const { return inside_ != 0; }
  void set_inside(bool inside) { inside_ = inside; }
  void set_stiffness(float stiffness) { k_ = (std::bit_cast<std::uint32_t>(stiffness) + 0x8000u) >> 16; }

 private:
  static constexpr double kNormalUnits = 16383 * 1.41421356;      // none of the smaller components exceeds 1/√2
  static constexpr std::uint32_t kAreaBase = (127u - 44u) << 23;  // 6 bits of exponent, 10 of fraction: from 2⁻⁴⁴ to 2²⁰
  std::uint64_t source_ : 16, point_ : 2, target_ : 17, mu0_ : 14, mu1_ : 14, inside_ : 1;
  std::int64_t next_ : 15, other_ : 15;       // the components after the largest, in cyclic order
  std::uint64_t axis_ : 3, k_ : 15, w_ : 16;  // which is the largest, and 4 where it is negative
};
static_assert(sizeof(ContactElement) == 16);

/// All contact points of a pair of bodies, both directions. Groups come in canonical order; only the points of active bodies are written.
struct ElementGroup {
  std::span<const ContactElement> elements[2];               ///< [0]: points of body 0 against body 1; [1]: the other way round
  const Topology* topology[2] = {nullptr, nullptr};          ///< an obstacle's too; null: a sphere
  const Vec3d* position[2] = {nullptr, nullptr};             ///< of their nodes; an obstacle's as it is defined, wherever it is
  std::uint32_t body[2] = {0, 0};                            ///< places in the list of bodies
  std::uint32_t first[2] = {0, 0};                           ///< first points
  bool write[2] = {true, true};                              ///< false: ghost, or held
  bool rigid = false;                                        ///< body 1 is an obstacle, not an unknown
  std::uint32_t obstacle = 0;                                ///< which, if so
  float normal_friction = 0.0f, tangential_friction = 0.0f;  ///< γ_n, γ_t per area [nN·s/µm³]
};

}  // namespace morula
