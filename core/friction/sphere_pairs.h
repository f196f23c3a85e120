#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/friction/float4.h"
#include "core/parallel/order_free_sum.h"
#include "core/vec3.h"

namespace morula {

/// Two spheres that may touch, numbered among the spheres of a rank (owned ones first, ghosts after). a comes first in the canonical order.
struct SpherePair {
  std::uint32_t a;
  std::uint32_t b : 31;
  std::uint32_t attached : 1;  ///< branch of the contact law: fixed within a step
};
static_assert(sizeof(SpherePair) == 8);

/// What the friction system knows of a pair: force on a −A γ_t u − (A (γ_n − γ_t) + Δt k)(n·u) n, u = v_a − v_b; on b the opposite.
///
/// Area and normal are those of the step's start wherever the pair touched then (its friction is fixed for the step), k is the present one.
struct SpherePairElement {
  float n[3] = {0.0f, 0.0f, 1.0f};
  float area = 0.0f;       ///< A [µm²]
  float stiffness = 0.0f;  ///< k [nN/µm]
};

/// A sphere against something rigid: the same with v_b = 0. Few, so that it carries its own coefficients.
struct RigidPairElement {
  std::uint32_t sphere = 0, obstacle = 0;
  float n[3] = {0.0f, 0.0f, 1.0f};
  float isotropic = 0.0f;  ///< A γ_t [nN·s/µm]
  float axial = 0.0f;      ///< A (γ_n − γ_t) [nN·s/µm]
  float stiffness = 0.0f;  ///< k [nN/µm]
};

/// Friction per contact area of two materials.
struct PairFriction {
  float tangential = 0.0f;  ///< γ_t [nN·s/µm³]
  float extra = 0.0f;       ///< γ_n − γ_t [nN·s/µm³]
};

/// What the operator knows of spheres that resist their packing (cbm.md §3): the positive semi-definite part of ∂²(V_i Ψ(φ_i)), which ties each
/// sphere to all its neighbours at once, c_i g_i g_iᵀ with g_i the gradient of the volume of its caps.
struct SpherePacking {
  /// How fast the caps of a pair grow with its approach [µm²].
  struct Slopes {
    float a = 0.0f, b = 0.0f;
  };
  bool on = false;                                  ///< some sphere resists: the same on all ranks
  std::vector<float> resistance;                    ///< c = Ψ″/V by sphere, ghosts too [nN/µm⁵]
  std::vector<Slopes> slopes;                       ///< by pair
  std::function<void(std::span<Float4>)> exchange;  ///< fills the ghost points of a vector by point; may be empty

  [[nodiscard]] std::size_t memory() const { return resistance.capacity() * sizeof(float) + slopes.capacity() * sizeof(Slopes); }
};

/// The list of sphere pairs of a rank in canonical order, and its part of the friction matrix.
///
/// Sums over the pairs of a sphere run in the order of the list. Each thread writes one contiguous range of the owned spheres and visits
/// all pairs that touch it, so that the bits do not depend on the number of threads.
class SpherePairs {
 public:
  /// Stretches of the list, first <= pair < last.
  struct Run {
    std::uint32_t first, last;
  };
  /// What one thread does: it writes the spheres first <= sphere < last.
  struct Share {
    std::uint32_t first = 0, last = 0;
    std::vector<Run> runs;
    [[nodiscard]] bool has(std::uint32_t sphere) const { return sphere >= first && sphere < last; }
  };

  std::vector<SpherePair> pairs;
  std::vector<SpherePairElement> elements;  ///< by pair
  std::vector<RigidPairElement> rigid;
  std::vector<std::uint16_t> material;  ///< by sphere, ghosts too; not needed while the table is uniform
  SpherePacking packing;

  /// Friction of material pairs, `count` × `count`, row by row.
  void set_friction(std::vector<PairFriction> friction, std::size_t count);
  /// The pairs are new: spheres 0 .. owned−1 are points first_point .. first_point+owned−1, ghosts follow. Shares the work out.
  void set_layout(std::uint32_t first_point, std::uint32_t owned, int threads);

  /// All material pairs rub alike.
  [[nodiscard]] bool uniform() const { return uniform_; }
  [[nodiscard]] std::span<const Share> shares() const { return shares_; }
  [[nodiscard]] const PairFriction& friction(std::uint16_t a, std::uint16_t b) const { return friction_[a * materials_ + b]; }
  [[nodiscard]] const PairFriction& friction(const SpherePair& pair) const {
    return uniform_ ? friction_[0] : friction(material[pair.a], material[pair.b]);
  }

  /// Add the pairs' part of A p to q, for owned spheres. Collective where spheres resist their packing.
  void add_product(std::span<const Float4> p, std::span<Float4> q, float dt) const;
  /// Add the 3×3 diagonal blocks.
  void add_diagonal(std::span<SymMat3<float>> diagonal, float dt) const;
  /// Friction alone, in double, on displacements d = to − from, against obstacles d − their ways: adds Γ d to `out` (owned spheres), and dᵀΓ d of the pairs that
  /// this rank counts (whose first sphere it owns).
  void add_friction(std::span<const Vec3d> from, std::span<const Vec3d> to, std::span<const Vec3d> obstacle_way, std::span<Vec3d> out,
                    OrderFreeSum& quadratic) const;

  [[nodiscard]] std::size_t memory() const;

 private:
  template <class F>
  void for_shares(F&& function) const;
  /// on_pair(share, pair, n, isotropic, axial) and on_rigid(element, axial) for all that rub or resist, by the thread that writes them;
  /// isotropic, axial: entries of the matrix at this step size.
  template <class OnPair, class OnRigid>
  void for_entries(float dt, OnPair&& on_pair, OnRigid&& on_rigid) const;

  /// on_pair(share, number of the pair) for all pairs with caps.
  template <class OnPair>
  void for_caps(OnPair&& on_pair) const;
  void add_packing_product(std::span<const Float4> p, std::span<Float4> q, float dt) const;
  void add_packing_diagonal(std::span<SymMat3<float>> diagonal, float dt) const;

  std::vector<PairFriction> friction_{PairFriction{}};
  std::size_t materials_ = 1;
  bool uniform_ = true;
  std::uint32_t first_point_ = 0, owned_ = 0;
  std::vector<Share> shares_;
};

}  // namespace morula
