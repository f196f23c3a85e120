#pragma once
#include "core/mesh/topology.h"
#include "core/parallel/comm.h"
#include "core/parallel/partition.h"
#include "coupling/tissue.h"

namespace morula {

/// Cost of a cell relative to a sphere, for the balance.
inline double cell_weight(const CellRow& row, std::size_t nodes) {
  return row.body == BodyKind::kShell ? 3.0 * static_cast<double>(nodes) : 1.0;
}

struct BalanceReport {
  double imbalance = 1.0;  ///< largest weight of a rank over the mean, after
  std::int64_t moved = 0;  ///< cells that changed their rank
};

/// Give every cell its place along the curve anew. Done at times that do not depend on the number of ranks, because the place decides the
/// order of sums.
void renew_order(Tissue& tissue);

/// Cut space anew by weight and move cells to their new ranks. Never changes a result. Collective.
BalanceReport balance(Tissue& tissue, Partition& partition, ShapeLibrary& shapes, const Comm& comm);

/// Largest weight of a rank over the mean weight. Collective.
double imbalance(const Tissue& tissue, const Comm& comm);

}  // namespace morula
