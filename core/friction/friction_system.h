#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/friction/contact_element.h"
#include "core/friction/float4.h"
#include "core/friction/pair_blocks.h"
#include "core/friction/sphere_pairs.h"
#include "core/parallel/comm.h"
#include "core/result.h"
#include "core/vec3.h"

namespace morula {

/// Unknowns of one body: points first .. first+count−1. A partial sum of a body never depends on threads or ranks.
struct BodyPoints {
  std::uint32_t first, count;
};

/// A part of the matrix that somebody else can apply: the shells' own mechanics. It acts on the first point_count() points, all owned,
/// which belong to the first bodies; a few bodies at a time, which are called a batch.
class OperatorPart {
 public:
  virtual ~OperatorPart() = default;
  [[nodiscard]] virtual std::size_t point_count() const = 0;
  [[nodiscard]] virtual std::size_t batch_count() const = 0;
  [[nodiscard]] virtual std::span<const std::uint32_t> bodies_of(std::size_t batch) const = 0;
  /// q = A p on the points of the batches first .. last−1; by one thread.
  virtual void multiply(std::size_t first, std::size_t last, std::span<const Float4> p, std::span<Float4> q) const = 0;
  /// Add the 3×3 diagonal blocks.
  virtual void add_diagonal(std::span<SymMat3<float>> diagonal) const = 0;
};

/// Something that adds to the matrix on owned points of its own choice.
class AddedPart {
 public:
  virtual ~AddedPart() = default;
  /// Adds nothing at all to the present matrix; on this rank, so that what is collective must not say so.
  [[nodiscard]] virtual bool empty() const { return false; }
  /// q += A p.
  virtual void add_product(std::span<const Float4> p, std::span<Float4> q) const = 0;
  /// Add the 3×3 diagonal blocks.
  virtual void add_diagonal(std::span<SymMat3<float>> diagonal) const = 0;
};

/// A symmetric positive definite 3×3 matrix in 16 bytes: words xx|yy, xy|yz, xz|zz of 16 bits each, and their unit, 1/32764 of the largest. What
/// rounding may take from an eigenvalue is given back, so that it stays positive definite.
struct alignas(16) NodeInverse {
  std::int32_t word[4] = {};

  NodeInverse() = default;
  explicit NodeInverse(const SymMat3<float>& m);
};

struct SolveReport {
  int iterations = 0;
  double residual = 0.0;  ///< ‖r‖/‖b‖ reached
  bool converged = true;
};

struct SolveFault {
  std::string what;
};

/// The matrix of the force balance, (Γ + Δt K) v = F: sparse, symmetric, positive definite, over sphere centres and shell nodes together.
/// Preconditioned conjugate gradients with 3×3 block-Jacobi and a start vector (time_stepping.md §10.7). Contacts of surfaces are condensed
/// to blocks over pairs of nodes (pair_blocks.h).
///
/// Vectors are float, sums are double in fixed order within a body and order-free over bodies, so that the solution has the same bits on
/// any number of threads and ranks. Ghost points of p are refreshed through `exchange` before each product.
///
/// A large tissue waits for memory. An iteration therefore goes over it twice only: once portion by portion (direction, shells, the contacts
/// whose bodies are done by then, p·q of the bodies whose contacts are), once for the residual.
class FrictionSystem {
 public:
  struct Layout {
    std::size_t point_count = 0;                      ///< owned and ghost points
    std::vector<BodyPoints> bodies;                   ///< those of several points, in their order; ghosts too
    std::vector<char> owned;                          ///< by body; those after `bodies` have one point each, from where these end
    std::function<void(std::span<Float4>)> exchange;  ///< fills the ghost points; may be empty

    [[nodiscard]] std::size_t body_count() const { return owned.size(); }
    [[nodiscard]] BodyPoints points_of(std::size_t body) const {
      if (body < bodies.size()) return bodies[body];
      return {first_single() + static_cast<std::uint32_t>(body - bodies.size()), 1};
    }
    /// First point of the bodies that have one each.
    [[nodiscard]] std::uint32_t first_single() const { return bodies.empty() ? 0 : bodies.back().first + bodies.back().count; }
  };

  void set_layout(Layout layout, int threads);

  /// Diagonal friction [nN·s/µm] of the bodies of one point, in their order; ghosts are ignored. The shells' part has its own.
  void set_point_friction(std::span<const float> friction) { point_friction_.assign(friction.begin(), friction.end()); }
  /// The same as room for so many, all zero, that the caller fills.
  [[nodiscard]] std::span<float> clear_point_friction(std::size_t count) {
    point_friction_.assign(count, 0.0f);
    return point_friction_;
  }
  /// The shells' own part, with what contacts couple within a shell (edge_blocks_of()).
  void set_shells(OperatorPart* shells) { shells_ = shells; }
  /// Something that adds to the matrix: what lives inside the shells, friction of its own form. In this order; set_layout() forgets all.
  void add_part(const AddedPart* part) { added_.push_back(part); }
  void set_step(double dt) { dt_ = static_cast<float>(dt); }
  /// Contacts of surfaces at the present step size; read now, not kept. Groups come in canonical order: by the later of their bodies, then by
  /// the other, so that those of early bodies come early.
  void set_elements(std::span<const ElementGroup> groups, const FaceQuadrature& quadrature);
  /// The spheres' own part; may be null.
  void set_sphere_pairs(const SpherePairs* pairs) { sphere_pairs_ = pairs; }
  [[nodiscard]] std::span<const float> point_friction() const { return point_friction_; }

  /// Where the caller puts b by point (owned points), anew before each solve().
  [[nodiscard]] std::span<Float4> right_hand_side() {
    r_.resize(layout_.point_count);
    return r_;
  }
  /// Solve A v = b from the start in v, until ‖r‖ ≤ tolerance ‖b‖. v of ghost points is not written; b is used up.
  Result<SolveReport, SolveFault> solve(std::span<Float4> v, double tolerance, int max_iterations, const Comm& comm);

  /// Give back the memory of the matrix and the vectors until the next set_elements(): forces need as much.
  void drop_matrix();

  /// q = A p on owned points (p must hold the ghosts). For tests and for the residual.
  void apply(std::span<const Float4> p, std::span<Float4> q) const;

  /// Bytes that vectors and blocks take.
  [[nodiscard]] std::size_t memory() const;

 private:
  /// Blocks of a pair of bodies; those of a thread lie one after the other in blocks_[arena].
  struct PairBlocks {
    std::uint32_t arena = 0, count = 0, row_count = 0;
    std::size_t begin = 0, first_row = 0;
    std::uint32_t body[2] = {0, 0}, first[2] = {0, 0};
    bool write[2] = {true, true}, rigid = false;
  };

  /// What is worked on while it is in cache: batches of the shells, or bodies of one point.
  struct Portion {
    std::uint32_t first_batch = 0, last_batch = 0;
    std::uint32_t first_run = 0, last_run = 0;      ///< its owned bodies, in runs_
    std::uint32_t first_group = 0, last_group = 0;  ///< contacts that its thread can apply when it is done, in the thread's groups
    std::uint32_t first_done = 0, last_done = 0;    ///< bodies whose last contact is then done, in the thread's `done`
  };
  /// Bodies first <= body < last.
  struct BodyRun {
    std::uint32_t first, last;
  };

  /// What one thread works on: portions first <= k < last, and the contacts of their bodies.
  struct ThreadWork {
    std::uint32_t first_portion = 0, last_portion = 0;
    std::uint16_t number = 0;
    std::vector<std::uint32_t> groups;  ///< that touch its bodies, in canonical order
    std::vector<std::uint32_t> done;    ///< its bodies, in the order in which they are done; empty unless complete_
  };

  void lay_out_portions();
  void divide_work();
  void schedule_contacts(ThreadWork& work);
  void build_preconditioner();
  template <class Body>
  void for_bodies_of(const Portion& portion, Body&& body) const;
  template <class Body>
  void for_owned_bodies(Body&& body) const;
  template <class Point>
  void for_points_of(const Portion& portion, Point&& point) const;
  /// A side of a pair that this thread writes.
  [[nodiscard]] bool writes(const ThreadWork& work, const PairBlocks& pair, int side) const {
    return pair.write[side] && (thread_of_.empty() || thread_of_[pair.body[side]] == work.number);
  }
  [[nodiscard]] double dot(std::span<const Float4> a, std::span<const Float4> b, const Comm& comm) const;
  void multiply(const Portion& portion, std::span<const Float4> p, std::span<Float4> q) const;
  void apply_contacts(const ThreadWork& work, const Portion& portion, std::span<const Float4> p, std::span<Float4> q) const;
  void add_contact_diagonal(const ThreadWork& work, std::span<SymMat3<float>> sum) const;
  void add_others(std::span<const Float4> p, std::span<Float4> q) const;
  /// q = A p but for what add_others() adds; before(portion) and after(thread, portion) come with each portion.
  template <class Before, class After>
  void multiply_own(std::span<const Float4> p, std::span<Float4> q, const Before& before, const After& after) const;
  /// v += α p, p = M⁻¹ r + β p, q = A p; gives p·q.
  [[nodiscard]] double turn(float alpha, float beta, std::span<Float4> v, const Comm& comm);
  /// r −= α q; gives (r·r, r·z) with z = M⁻¹ r.
  void reduce(float alpha, const Comm& comm, double (&sums)[2]);
  [[nodiscard]] NodePairBlocks blocks_of(const PairBlocks& pair) const {
    const NodePairArena& arena = blocks_[pair.arena];
    return {std::span(arena.rows).subspan(pair.first_row, pair.row_count), std::span(arena.blocks).subspan(pair.begin, pair.count)};
  }

  Layout layout_;
  int threads_ = 1;
  float dt_ = 0.0f;
  std::vector<float> point_friction_;
  std::vector<PairBlocks> pairs_;
  std::vector<NodePairArena> blocks_;
  const SpherePairs* sphere_pairs_ = nullptr;
  OperatorPart* shells_ = nullptr;
  std::vector<const AddedPart*> added_;
  std::vector<ThreadWork> work_;
  std::vector<Portion> portions_;
  std::vector<BodyRun> runs_;
  std::vector<std::uint16_t> thread_of_;  ///< by body, with several threads
  bool complete_ = false;                 ///< portions and contacts are all that there is to q
  std::vector<NodeInverse> inverse_;
  std::vector<Float4> p_, q_, r_;
};

}  // namespace morula
