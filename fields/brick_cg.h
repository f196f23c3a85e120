#pragma once
#include <sundials/sundials_linearsolver.h>

#include <functional>

#include "fields/brick_operator.h"
#include "fields/brick_vector.h"
#include "fields/multigrid.h"

namespace morula::fields {

/// Whether conjugate gradients for 1 − γJ, no eigenvalue of −J above `largest_rate` [1/s], need less time with multigrid than with the
/// diagonal as preconditioner (measured: decision 0046).
bool is_worth_multigrid(double gamma, double largest_rate);

/// A SUNDIALS linear solver for (1 − γJ) x = b on bricks: conjugate gradients with a preconditioner, the diagonal or `multigrid`, whichever is cheaper
/// for the γ of a solve (nullptr: always the diagonal).
///
/// The same mathematics as SUNLinSol_PCG, with the vector passes of an iteration fused into three (measured: a third of the time per
/// iteration) and its two inner products in one message. Sums are order-free: the same iterations on any number of ranks.
/// `gamma` is asked for at the beginning of each solve. Everything must outlive the solver. Freed by SUNLinSolFree; nullptr when memory
/// is short.
SUNLinearSolver make_brick_cg(BrickOperator& op, Multigrid* multigrid, double largest_rate, const BrickVectorSpace& space,
                              std::function<double()> gamma, int most_iterations, SUNContext context);

}  // namespace morula::fields
