#pragma once
#include <sundials/sundials_nvector.h>

#include <memory>
#include <vector>

#include "core/parallel/comm.h"
#include "fields/layout.h"

namespace morula::fields {

/// Buffers that vectors of unknowns are made from and given back to, so that an interval does not allocate. Content never survives.
class BufferPool {
 public:
  /// A buffer of n zeros.
  std::unique_ptr<std::vector<double>> take(std::size_t n);
  void give_back(std::unique_ptr<std::vector<double>> buffer) { free_.push_back(std::move(buffer)); }

 private:
  std::vector<std::unique_ptr<std::vector<double>>> free_;
};

/// What all vectors of one integration share.
struct BrickVectorSpace {
  const Layout* layout = nullptr;
  const Comm* comm = nullptr;
  BufferPool* pool = nullptr;
};

/// A SUNDIALS vector of the unknowns of Layout, distributed over the ranks.
///
/// Element-wise operations act on concentrations and amounts. Lengths, norms, dot products, minima and maxima see the concentrations
/// only: the amounts are quadratures that follow the same Runge–Kutta weights, but steer neither the step size nor a solver. Sums run
/// over each brick in voxel order, and the bricks are added without rounding (OrderFreeSum), so that step sizes and iteration
/// counts are the same on any number of ranks and threads. `space` must outlive the vector and its clones.
/// Returns nullptr when memory is short; freed by N_VDestroy.
N_Vector make_brick_vector(const BrickVectorSpace& space, SUNContext context);

/// The unknowns of a vector made by make_brick_vector or cloned from one.
double* unknowns_of(N_Vector vector);

}  // namespace morula::fields
