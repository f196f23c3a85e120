#include "fields/brick_cg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "fields/block_sum.h"

namespace morula::fields {

namespace {

struct Solver {
  BrickOperator* op = nullptr;
  Multigrid* multigrid = nullptr;
  double largest_rate = 0.0;
  const BrickVectorSpace* space = nullptr;
  std::function<double()> gamma;
  int most_iterations = 0;
  N_Vector weights = nullptr;  ///< of the norm in which the tolerance is meant; owned by ARKODE
  std::unique_ptr<std::vector<double>> residual, direction, image, preconditioned;
  std::vector<std::array<double, 2>> partial;  ///< sums per brick
  int iterations = 0;
  double residual_norm = 0.0;
  sunindextype last_flag = 0;
};

Solver& solver(SUNLinearSolver s) { return *static_cast<Solver*>(s->content); }

/// x += α p, r −= α q; returns r·D⁻¹r (m the inverse diagonal) and |r|² in the weighted norm, summed over all ranks in one message.
std::array<double, 2> step_and_sum(Solver& s, double alpha, double* x) {
  const Layout& layout = *s.space->layout;
  double* r = s.residual->data();
  const double *p = s.direction->data(), *q = s.image->data(), *m = s.preconditioned->data(), *w = unknowns_of(s.weights);
  s.partial.resize(layout.bricks());
#pragma omp parallel for schedule(static) if (layout.bricks() >= kBricksWorthThreads)
  for (std::size_t b = 0; b < layout.bricks(); ++b) {
    const std::size_t at = layout.offset[b], end = layout.offset[b + 1];
    for (std::size_t i = at; i < end; ++i) {
      x[i] += alpha * p[i];
      r[i] -= alpha * q[i];
    }
    s.partial[b] = {block_triple(r + at, m + at, end - at), block_weighted_square(r + at, w + at, end - at)};
  }
  std::array<OrderFreeSum, 2> local;
  for (const auto& part : s.partial) {
    local[0].add(part[0]);
    local[1].add(part[1]);
  }
  std::array<double, 2> total{};
  s.space->comm->sum(local, total);
  return total;
}

/// p = M⁻¹r + β p, M the diagonal
void turn_by_diagonal(Solver& s, double beta) {
  double* p = s.direction->data();
  const double *r = s.residual->data(), *m = s.preconditioned->data();
  const std::size_t n = s.space->layout->concentrations();
#pragma omp parallel for simd schedule(static) if (s.space->layout->bricks() >= kBricksWorthThreads)
  for (std::size_t i = 0; i < n; ++i) p[i] = m[i] * r[i] + beta * p[i];
}
/// p = z + β p
void turn(Solver& s, double beta) {
  double* p = s.direction->data();
  const double* z = s.preconditioned->data();
  const std::size_t n = s.space->layout->concentrations();
#pragma omp parallel for simd schedule(static) if (s.space->layout->bricks() >= kBricksWorthThreads)
  for (std::size_t i = 0; i < n; ++i) p[i] = z[i] + beta * p[i];
}

/// z = M⁻¹r by multigrid; returns r·z over all ranks.
double precondition(Solver& s) {
  const Layout& layout = *s.space->layout;
  const double* r = s.residual->data();
  double* z = s.preconditioned->data();
  s.multigrid->apply(r, z);
  OrderFreeSum sum;
  for (std::size_t b = 0; b < layout.bricks(); ++b)
    sum.add(block_dot(r + layout.offset[b], z + layout.offset[b], layout.offset[b + 1] - layout.offset[b]));
  return s.space->comm->sum(sum);
}

int solve(SUNLinearSolver ls, SUNMatrix, N_Vector x_vector, N_Vector b_vector, double tolerance) {
  Solver& s = solver(ls);
  const Layout& layout = *s.space->layout;
  const std::size_t n = layout.concentrations();
  const double gamma = s.gamma();
  const bool by_multigrid = s.multigrid != nullptr && is_worth_multigrid(gamma, s.largest_rate);
  double* x = unknowns_of(x_vector);
  // The guess is zero: SUNDIALS solves for corrections. The amounts take no part.
  std::fill(x, x + layout.unknowns(), 0.0);
  std::copy_n(unknowns_of(b_vector), n, s.residual->data());
  for (auto* buffer : {s.direction.get(), s.image.get()}) std::fill(buffer->begin(), buffer->end(), 0.0);
  if (by_multigrid)
    s.multigrid->prepare(gamma, *s.op);
  else
    s.op->inverse_diagonal(gamma, s.preconditioned->data());
  auto [rho, square] = step_and_sum(s, 0.0, x);
  const double start_norm = std::sqrt(square);
  s.iterations = 0;
  s.residual_norm = start_norm;
  double beta = 0.0;
  while (s.residual_norm > tolerance && s.iterations < s.most_iterations) {
    if (by_multigrid) {
      const double next_rho = precondition(s);
      if (s.iterations > 0) beta = next_rho / rho;
      rho = next_rho;
      turn(s, beta);
    } else {
      turn_by_diagonal(s, beta);
    }
    const double p_image = s.op->shifted_product(gamma, s.direction->data(), s.image->data(), *s.space->comm);
    const auto [next_rho, next_square] = step_and_sum(s, rho / p_image, x);
    if (!by_multigrid) {
      beta = next_rho / rho;
      rho = next_rho;
    }
    s.residual_norm = std::sqrt(next_square);
    ++s.iterations;
    if (!std::isfinite(s.residual_norm)) break;
  }
  s.last_flag = s.residual_norm <= tolerance ? SUNLS_SUCCESS : s.residual_norm < start_norm ? SUNLS_RES_REDUCED : SUNLS_CONV_FAIL;
  return static_cast<int>(s.last_flag);
}

SUNLinearSolver_Type type(SUNLinearSolver) { return SUNLINEARSOLVER_ITERATIVE; }
SUNLinearSolver_ID identity(SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; }
int initialize(SUNLinearSolver) { return SUNLS_SUCCESS; }
int set_up(SUNLinearSolver, SUNMatrix) { return SUNLS_SUCCESS; }
/// The product comes from the BrickOperator itself; SUNDIALS demands that a matrix-free solver has this function.
int set_product(SUNLinearSolver, void*, SUNATimesFn) { return SUNLS_SUCCESS; }
int set_weights(SUNLinearSolver ls, N_Vector first, N_Vector) {
  solver(ls).weights = first;
  return SUNLS_SUCCESS;
}
int iterations(SUNLinearSolver ls) { return solver(ls).iterations; }
double residual_norm(SUNLinearSolver ls) { return solver(ls).residual_norm; }
sunindextype last_flag(SUNLinearSolver ls) { return solver(ls).last_flag; }
int release(SUNLinearSolver ls) {
  Solver& s = solver(ls);
  for (auto* buffer : {&s.residual, &s.direction, &s.image, &s.preconditioned}) s.space->pool->give_back(std::move(*buffer));
  delete &s;
  ls->content = nullptr;
  SUNLinSolFreeEmpty(ls);
  return SUNLS_SUCCESS;
}

}  // namespace

bool is_worth_multigrid(double gamma, double largest_rate) { return gamma * largest_rate > 100.0; }

SUNLinearSolver make_brick_cg(BrickOperator& op, Multigrid* multigrid, double largest_rate, const BrickVectorSpace& space,
                              std::function<double()> gamma, int most_iterations, SUNContext context) {
  SUNLinearSolver out = SUNLinSolNewEmpty(context);
  if (out == nullptr) return nullptr;
  auto* content = new Solver;
  content->op = &op;
  content->multigrid = multigrid;
  content->largest_rate = largest_rate;
  content->space = &space;
  content->gamma = std::move(gamma);
  content->most_iterations = most_iterations;
  for (auto* buffer : {&content->residual, &content->direction, &content->image, &content->preconditioned})
    *buffer = space.pool->take(space.layout->unknowns());
  out->content = content;
  SUNLinearSolver_Ops ops = out->ops;
  ops->gettype = type;
  ops->getid = identity;
  ops->initialize = initialize;
  ops->setup = set_up;
  ops->setatimes = set_product;
  ops->setscalingvectors = set_weights;
  ops->solve = solve;
  ops->numiters = iterations;
  ops->resnorm = residual_norm;
  ops->lastflag = last_flag;
  ops->free = release;
  return out;
}

}  // namespace morula::fields
