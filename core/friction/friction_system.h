#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/contact/traction_law.h"
#include "core/friction/contact_element.h"
#include "core/friction/float4.h"
#include "core/friction/sphere_pairs.h"
#include "core/parallel/comm.h"
#include "core/result.h"
#include "core/vec3.h"

namespace morula {

/// Unknowns of one body: points first .. first+count−1. A partial sum of a body never depends on threads or ranks.
struct BodyPoints {
  std::uint32_t first, count;
};

/// Contact elements of one direction of a pair. Groups come in canonical order; only the points of owned bodies are written.
struct ElementGroup {
  std::span<const ContactElement> elements;
  std::uint32_t source_body = 0, target_body = 0;    ///< places in the list of bodies
  std::uint32_t source_first = 0, target_first = 0;  ///< first points
  bool write_source = true, write_target = true;     ///< false: ghost
  bool target_moves = true;                          ///< false: rigid, not an unknown
};

/// A part of the matrix that somebody else can apply: the shells' own mechanics. It acts on the first point_count() points, all owned.
class OperatorPart {
 public:
  virtual ~OperatorPart() = default;
  [[nodiscard]] virtual std::size_t point_count() const = 0;
  /// q = A p on its points.
  virtual void multiply(std::span<const Float4> p, std::span<Float4> q) const = 0;
  /// Add the 3×3 diagonal blocks.
  virtual void add_diagonal(std::span<SymMat3<float>> diagonal) const = 0;
};

struct SolveReport {
  int iterations = 0;
  double residual = 0.0;  ///< ‖r‖/‖b‖ reached
  bool converged = true;
};

struct SolveFault {
  std::string what;
};

/// The matrix of the force balance, (Γ + Δt K) v = F: sparse, symmetric, positive definite, over sphere centres and shell nodes together,
/// never assembled. Preconditioned conjugate gradients with 3×3 block-Jacobi and a start vector (time_stepping.md §10.7).
///
/// Vectors are float, sums are double in fixed order within a body and order-free over bodies, so that the solution has the same bits on
/// any number of threads and ranks. Ghost points of p are refreshed through `exchange` before each product.
class FrictionSystem {
 public:
  struct Layout {
    std::size_t point_count = 0;                      ///< owned and ghost points
    std::vector<BodyPoints> bodies;                   ///< all bodies; ghosts too
    std::vector<char> owned;                          ///< by body
    std::function<void(std::span<Float4>)> exchange;  ///< fills the ghost points; may be empty
  };

  void set_layout(Layout layout, int threads);

  /// Diagonal friction [nN·s/µm] by point: of the spheres, and 0 where the shells' part has its own; ghosts are ignored.
  void set_point_friction(std::span<const float> friction) { point_friction_.assign(friction.begin(), friction.end()); }
  [[nodiscard]] std::span<const float> point_friction() const { return point_friction_; }
  void set_elements(std::vector<ElementGroup> groups, const FaceQuadrature& quadrature);
  void set_sphere_pairs(const SpherePairs* pairs) { sphere_pairs_ = pairs; }
  void set_shells(const OperatorPart* shells) { shells_ = shells; }
  void set_step(double dt) { dt_ = static_cast<float>(dt); }

  /// Solve A v = b from the start in v, until ‖r‖ ≤ tolerance ‖b‖. v of ghost points is not written.
  Result<SolveReport, SolveFault> solve(std::span<const Float4> b, std::span<Float4> v, double tolerance, int max_iterations,
                                        const Comm& comm);

  /// Bytes of all vectors.
  [[nodiscard]] std::size_t memory() const;

  /// q = A p on owned points (p must hold the ghosts). For tests and for the residual.
  void apply(std::span<const Float4> p, std::span<Float4> q) const;

 private:
  void build_preconditioner();
  void precondition(std::size_t body);
  template <class Body>
  void for_owned_bodies(Body&& body) const;
  [[nodiscard]] double dot(std::span<const Float4> a, std::span<const Float4> b, const Comm& comm) const;
  void apply_elements(int thread, std::span<const Float4> p, std::span<Float4> q) const;

  struct ThreadWork {
    std::uint32_t first_body = 0, last_body = 0;  ///< owned bodies of this thread: first <= body < last
    std::vector<std::uint32_t> groups;            ///< that touch them, in canonical order
  };

  Layout layout_;
  int threads_ = 1;
  float dt_ = 0.0f;
  std::vector<float> point_friction_;
  std::vector<ElementGroup> groups_;
  const SpherePairs* sphere_pairs_ = nullptr;
  const OperatorPart* shells_ = nullptr;
  float beta_[4][3] = {};
  std::vector<ThreadWork> work_;
  std::vector<SymMat3<float>> inverse_;
  std::vector<Float4> p_, q_, r_, z_;
};

}  // namespace morula
