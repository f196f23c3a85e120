#include "fields/brick_vector.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fields/block_sum.h"

namespace morula::fields {

std::unique_ptr<std::vector<double>> BufferPool::take(std::size_t n) {
  if (free_.empty()) return std::make_unique<std::vector<double>>(n, 0.0);
  auto buffer = std::move(free_.back());
  free_.pop_back();
  buffer->assign(n, 0.0);
  return buffer;
}

namespace {

struct Content {
  const BrickVectorSpace* space;
  std::unique_ptr<std::vector<double>> values;
};

Content& content(N_Vector v) { return *static_cast<Content*>(v->content); }
const Layout& layout(N_Vector v) { return *content(v).space->layout; }
std::size_t unknowns(N_Vector v) { return content(v).values->size(); }
std::size_t concentrations(N_Vector v) { return layout(v).concentrations(); }

constexpr std::size_t kWorthThreads = 131072;  ///< unknowns; below, starting threads costs more than it saves

/// z_i = f(i) for all unknowns
template <class F>
void each(N_Vector z, F&& f) {
  double* out = unknowns_of(z);
  const std::size_t n = unknowns(z);
#pragma omp parallel for simd schedule(static) if (n > kWorthThreads)
  for (std::size_t i = 0; i < n; ++i) out[i] = f(i);
}

/// Σ over bricks of f(first voxel, voxels), the same bits on any number of ranks and threads.
template <class F>
double sum_over_bricks(N_Vector v, F&& f) {
  const Layout& l = layout(v);
  std::vector<double> partial(l.bricks());
#pragma omp parallel for schedule(static) if (unknowns(v) > kWorthThreads)
  for (std::size_t b = 0; b < l.bricks(); ++b) partial[b] = f(l.offset[b], l.offset[b + 1] - l.offset[b]);
  OrderFreeSum sum;
  for (const double p : partial) sum.add(p);
  return content(v).space->comm->sum(sum);
}

N_Vector_ID vector_id(N_Vector) { return SUNDIALS_NVEC_CUSTOM; }
sunindextype length(N_Vector v) { return static_cast<sunindextype>(layout(v).global_voxels); }
void* communicator(N_Vector) { return nullptr; }

N_Vector clone(N_Vector v) {
  N_Vector out = N_VNewEmpty(v->sunctx);
  if (out == nullptr) return nullptr;
  N_VCopyOps(v, out);
  const BrickVectorSpace* space = content(v).space;
  out->content = new Content{space, space->pool->take(space->layout->unknowns())};
  return out;
}
void destroy(N_Vector v) {
  if (v == nullptr) return;
  auto* c = static_cast<Content*>(v->content);
  c->space->pool->give_back(std::move(c->values));
  delete c;
  v->content = nullptr;
  N_VFreeEmpty(v);
}

void linear_sum(double a, N_Vector x, double b, N_Vector y, N_Vector z) {
  const double *xs = unknowns_of(x), *ys = unknowns_of(y);
  each(z, [=](std::size_t i) { return a * xs[i] + b * ys[i]; });
}
void fill(double value, N_Vector z) {
  each(z, [=](std::size_t) { return value; });
}
void product(N_Vector x, N_Vector y, N_Vector z) {
  const double *xs = unknowns_of(x), *ys = unknowns_of(y);
  each(z, [=](std::size_t i) { return xs[i] * ys[i]; });
}
void quotient(N_Vector x, N_Vector y, N_Vector z) {
  const double *xs = unknowns_of(x), *ys = unknowns_of(y);
  each(z, [=](std::size_t i) { return xs[i] / ys[i]; });
}
void scale(double a, N_Vector x, N_Vector z) {
  const double* xs = unknowns_of(x);
  each(z, [=](std::size_t i) { return a * xs[i]; });
}
void absolute(N_Vector x, N_Vector z) {
  const double* xs = unknowns_of(x);
  each(z, [=](std::size_t i) { return std::fabs(xs[i]); });
}
void inverse(N_Vector x, N_Vector z) {
  const double* xs = unknowns_of(x);
  each(z, [=](std::size_t i) { return 1.0 / xs[i]; });
}
void add_constant(N_Vector x, double b, N_Vector z) {
  const double* xs = unknowns_of(x);
  each(z, [=](std::size_t i) { return xs[i] + b; });
}
void compare(double c, N_Vector x, N_Vector z) {
  const double* xs = unknowns_of(x);
  each(z, [=](std::size_t i) { return std::fabs(xs[i]) >= c ? 1.0 : 0.0; });
}

int linear_combination(int count, double* factors, N_Vector* terms, N_Vector z) {
  // Each unknown is ((f0 x0 + f1 x1) + f2 x2) + ..., a block at a time so that z stays in the cache; z may be one of the terms.
  constexpr std::size_t block = 512;
  const std::size_t n = unknowns(z);
  double* out = unknowns_of(z);
#pragma omp parallel for schedule(static) if (n > kWorthThreads)
  for (std::size_t begin = 0; begin < n; begin += block) {
    const std::size_t m = std::min(block, n - begin);
    double sum[block];
    const double* first = unknowns_of(terms[0]) + begin;
    for (std::size_t i = 0; i < m; ++i) sum[i] = factors[0] * first[i];
    for (int t = 1; t < count; ++t) {
      const double* x = unknowns_of(terms[t]) + begin;
      const double f = factors[t];
      for (std::size_t i = 0; i < m; ++i) sum[i] += f * x[i];
    }
    std::copy_n(sum, m, out + begin);
  }
  return 0;
}

double dot_product(N_Vector x, N_Vector y) {
  const double *xs = unknowns_of(x), *ys = unknowns_of(y);
  return sum_over_bricks(x, [=](std::size_t at, std::size_t n) { return block_dot(xs + at, ys + at, n); });
}
double weighted_square_sum(N_Vector x, N_Vector w) {
  const double *xs = unknowns_of(x), *ws = unknowns_of(w);
  return sum_over_bricks(x, [=](std::size_t at, std::size_t n) { return block_weighted_square(xs + at, ws + at, n); });
}
double weighted_rms_norm(N_Vector x, N_Vector w) { return std::sqrt(weighted_square_sum(x, w) / static_cast<double>(length(x))); }
double weighted_norm(N_Vector x, N_Vector w) { return std::sqrt(weighted_square_sum(x, w)); }
double l1_norm(N_Vector x) {
  const double* xs = unknowns_of(x);
  return sum_over_bricks(x, [=](std::size_t at, std::size_t n) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) sum += std::fabs(xs[at + i]);
    return sum;
  });
}
double max_norm(N_Vector x) {
  const double* xs = unknowns_of(x);
  double out = 0.0;
  for (std::size_t i = 0; i < concentrations(x); ++i) out = std::max(out, std::fabs(xs[i]));
  return content(x).space->comm->max(out);
}
double minimum(N_Vector x) {
  const double* xs = unknowns_of(x);
  double out = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < concentrations(x); ++i) out = std::min(out, xs[i]);
  return content(x).space->comm->min(out);
}
int inverse_test(N_Vector x, N_Vector z) {
  const double* xs = unknowns_of(x);
  double* zs = unknowns_of(z);
  bool zero = false;
  for (std::size_t i = 0; i < concentrations(x); ++i) {
    if (xs[i] == 0.0)
      zero = true;
    else
      zs[i] = 1.0 / xs[i];
  }
  return content(x).space->comm->any(zero) ? SUNFALSE : SUNTRUE;
}

}  // namespace

double* unknowns_of(N_Vector vector) { return content(vector).values->data(); }

N_Vector make_brick_vector(const BrickVectorSpace& space, SUNContext context) {
  N_Vector out = N_VNewEmpty(context);
  if (out == nullptr) return nullptr;
  N_Vector_Ops ops = out->ops;
  ops->nvgetvectorid = vector_id;
  ops->nvgetlength = length;
  ops->nvgetcommunicator = communicator;
  ops->nvclone = clone;
  ops->nvdestroy = destroy;
  ops->nvgetarraypointer = unknowns_of;
  ops->nvlinearsum = linear_sum;
  ops->nvconst = fill;
  ops->nvprod = product;
  ops->nvdiv = quotient;
  ops->nvscale = scale;
  ops->nvabs = absolute;
  ops->nvinv = inverse;
  ops->nvaddconst = add_constant;
  ops->nvcompare = compare;
  ops->nvlinearcombination = linear_combination;
  ops->nvdotprod = dot_product;
  ops->nvwrmsnorm = weighted_rms_norm;
  ops->nvwl2norm = weighted_norm;
  ops->nvl1norm = l1_norm;
  ops->nvmaxnorm = max_norm;
  ops->nvmin = minimum;
  ops->nvinvtest = inverse_test;
  out->content = new Content{&space, space.pool->take(space.layout->unknowns())};
  return out;
}

}  // namespace morula::fields
