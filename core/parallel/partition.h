#pragma once
#include <memory>
#include <span>
#include <vector>

#include "core/parallel/comm.h"
#include "core/vec3.h"

namespace morula {

/// A division of space into one box-like region per rank: recursive coordinate bisection of weighted points (Zoltan RCB).
///
/// The physics never depends on it: it only says who computes what.
class Partition {
 public:
  Partition();
  ~Partition();
  Partition(Partition&&) noexcept;
  Partition& operator=(Partition&&) noexcept;

  /// Cut space so that every rank gets about the same weight. `position` and `weight` are this rank's points. Collective.
  /// Returns the new owner of each of this rank's points.
  std::vector<int> balance(std::span<const Vec3d> position, std::span<const double> weight, const Comm& comm);

  /// The rank whose region a point lies in, after balance(); the same answer on every rank.
  [[nodiscard]] int owner(const Vec3d& point) const;

 private:
  struct Cuts;
  std::unique_ptr<Cuts> cuts_;
};

}  // namespace morula
