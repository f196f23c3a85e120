#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/contact/surface_pair.h"
#include "core/friction/friction_system.h"
#include "core/mesh/face_quadrature.h"
#include "core/parallel/order_free_sum.h"

namespace morula {

/// Friction of a contact point that does not feel a common rotation of both surfaces (dcm.md §1).
///
/// The two points of a contact lie apart by g n, so that a rotation Ω of the whole pair moves them against each other by g Ω × n. That is taken off:
///   u = Σ β_i v_i − Σ μ_j v_j − ½ g (ṅ_B − ṅ_A),   ṅ = −Σ_c (n × e_c)(n·v_c)/(2A) of a face with the corners c, e_c opposite to c,
/// x on face A, y on face B. u is linear in the velocities, u = J v with J_c = w_c I + k_c mᵀ (m: normal of the corner's face), so that
/// Γ = Σ Jᵀ D J with D = w [γ_n n nᵀ + γ_t (I − n nᵀ)] is symmetric and positive semi-definite; u is exactly zero in a common rotation of opposed
/// parallel faces. An obstacle does not turn; a sphere has no rotation, and its contacts keep the plain form.
struct ObjectiveElement {
  std::uint32_t body[2];   ///< of the source and of the target
  std::uint32_t point[6];  ///< corners of the source's face, then of the target's; an obstacle has none, a sphere one
  int count;               ///< how many of them there are
  Vec3f normal[2];         ///< m of both faces
  Vec3f n;                 ///< of the contact, from the target to the source
  float weight[6];         ///< w_c: β, then −μ
  Vec3f lever[6];          ///< k_c
  float across, along;     ///< w γ_t, and w (γ_n − γ_t)

  /// u of velocities (or ways) by point.
  template <class Of>
  [[nodiscard]] auto jump(Of&& velocity) const {
    decltype(velocity(point[0])) u{};
    using Real = decltype(u.x);
    for (int c = 0; c < count; ++c) {
      const auto v = velocity(point[c]);
      const Vec3f& m = normal[c < 3 ? 0 : 1];
      const Real turn = v.x * Real(m.x) + v.y * Real(m.y) + v.z * Real(m.z);
      u += v * Real(weight[c]) + Vec3<Real>{Real(lever[c].x), Real(lever[c].y), Real(lever[c].z)} * turn;
    }
    return u;
  }
  /// D u.
  template <class Real>
  [[nodiscard]] Vec3<Real> drag(const Vec3<Real>& u) const {
    const Vec3<Real> normal_of_contact{Real(n.x), Real(n.y), Real(n.z)};
    return u * Real(across) + normal_of_contact * (Real(along) * dot(normal_of_contact, u));
  }
  /// J_cᵀ f of corner c.
  template <class Real>
  [[nodiscard]] Vec3<Real> share(int c, const Vec3<Real>& f) const {
    const Vec3f& m = normal[c < 3 ? 0 : 1];
    const Vec3<Real> k{Real(lever[c].x), Real(lever[c].y), Real(lever[c].z)};
    return f * Real(weight[c]) + Vec3<Real>{Real(m.x), Real(m.y), Real(m.z)} * dot(k, f);
  }
};

/// All contact points of a step, as a part of the matrix of its own beside the condensed blocks, which hold their stiffness.
class ObjectiveFriction : public AddedPart {
 public:
  /// Begin anew, with the bodies of a step.
  void clear(std::span<const ContactBody> bodies, int threads) {
    elements_.clear(), pairs_.clear();
    bodies_ = bodies, threads_ = threads;
  }
  /// The points of a pair as they are at present positions, after those of the pairs before.
  void add(const SurfacePair& pair, const PairBody (&body)[2], const ContactScene& scene, const FrictionPerArea& friction,
           const FaceQuadrature& quadrature);

  /// Adds Γ d to `out` at active bodies, and dᵀΓ d of the pairs that this rank counts to the sum, for the ways d from `start` to `position` and those
  /// of the obstacles.
  void rub(std::span<const Vec3d> position, std::span<const Vec3d> start, std::span<const Vec3d> obstacle_way, std::span<Vec3d> out,
           OrderFreeSum& quadratic) const;
  [[nodiscard]] std::span<const ObjectiveElement> elements() const { return elements_; }
  /// Calls function(element) for the points of active bodies on obstacles, in canonical order. A common velocity V of the body gives the jump V there.
  template <class F>
  void for_elements_on_obstacles(F&& function) const {
    for (const Pair& pair : pairs_)
      for (std::size_t k = pair.begin; pair.rigid && k < pair.end; ++k)
        if (bodies_[elements_[k].body[0]].active()) function(elements_[k]);
  }
  [[nodiscard]] std::size_t memory() const { return elements_.capacity() * sizeof(ObjectiveElement); }

  void add_product(std::span<const Float4> p, std::span<Float4> q) const override;
  void add_diagonal(std::span<SymMat3<float>> diagonal) const override;

 private:
  /// Calls function(element, corner) for all corners of active bodies, those of a body by one thread and in canonical order.
  template <class F>
  void for_corners(F&& function) const;

  std::span<const ContactBody> bodies_;
  int threads_ = 1;
  std::vector<ObjectiveElement> elements_;
  struct Pair {
    std::size_t begin, end;
    bool counts, rigid;
    std::uint32_t obstacle;
  };
  std::vector<Pair> pairs_;
};

}  // namespace morula
