#include "fields/brick_operator.h"

#include <algorithm>

#include "fields/block_sum.h"

namespace morula::fields {

BrickOperator::BrickOperator(const Grid& grid, const FieldSpec& spec, const FieldReactions& reactions, const Layout& layout,
                             Halo<double>& halo)
    : spec_(spec),
      reactions_(reactions),
      layout_(layout),
      halo_(halo),
      voxel_volume_(grid.voxel_volume()),
      slope_(layout.concentrations(), 0.0),
      diagonal_(layout.concentrations()) {
  const Vec3d h = grid.spacing();
  for (std::size_t a = 0; a < 3; ++a) conductance_[a] = spec.diffusion / (h[a] * h[a]);
  std::fill(diagonal_.begin(), diagonal_.end(), 2.0 * (conductance_[0] + conductance_[1] + conductance_[2]) + reactions.first_order());
  for (std::size_t b = 0; b < layout.bricks(); ++b) {
    for (std::size_t side = 0; side < kSides; ++side) {
      // The ghost −c (value given) or +c (no flux) adds to the diagonal; a brick that is its own periodic neighbour need not be exact.
      if (halo.source(b, side).kind != GhostSource::Kind::kBoundary) continue;
      const double extra = face(side).kind == FaceCondition::Kind::kValue ? conductance_[side / 2] : -conductance_[side / 2];
      for_each_in_layer(layout.extent[b], side, [&](std::size_t voxel, std::size_t) { diagonal_[layout.offset[b] + voxel] += extra; });
    }
  }
}

void BrickOperator::fill(std::size_t brick, const double* values, double scale, Padded& padded) const {
  const auto& n = layout_.extent[brick];
  const auto nx = static_cast<std::size_t>(n[0]), ny = static_cast<std::size_t>(n[1]), nz = static_cast<std::size_t>(n[2]);
  const double* c = values + layout_.offset[brick];
  for (std::size_t k = 0; k < nz; ++k)
    for (std::size_t j = 0; j < ny; ++j) {
      double* row = padded.data() + ((k + 1) * kPadded + j + 1) * kPadded + 1;
      std::copy_n(c + (k * ny + j) * nx, nx, row);
    }
  for (std::size_t side = 0; side < kSides; ++side) fill_ghosts(brick, side, values, scale, padded);
}

void BrickOperator::fill_ghosts(std::size_t brick, std::size_t side, const double* values, double scale, Padded& padded) const {
  const auto& n = layout_.extent[brick];
  constexpr std::array<std::size_t, 3> padded_stride{1, kPadded, kPadded * kPadded};
  const std::size_t axis = side / 2, u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
  const auto nu = static_cast<std::size_t>(n[u]), nv = static_cast<std::size_t>(n[v]);
  const std::size_t su = padded_stride[u], sv = padded_stride[v];
  const std::size_t ghost = (side % 2) ? static_cast<std::size_t>(n[axis] + 1) : 0;
  double* to = padded.data() + ghost * padded_stride[axis] + su + sv;
  // Beyond the faces of the domain: the ghost mirrors the outermost voxel, 2 c_b − c or c.
  const GhostSource& source = halo_.source(brick, side);
  if (source.kind == GhostSource::Kind::kBoundary) {
    const bool held = face(side).kind == FaceCondition::Kind::kValue;
    const double twice = held ? 2.0 * scale * face(side).at(time_) : 0.0;
    const double* inner = (side % 2) ? to - padded_stride[axis] : to + padded_stride[axis];
    for (std::size_t j = 0; j < nv; ++j)
      for (std::size_t i = 0; i < nu; ++i) to[i * su + j * sv] = held ? twice - inner[i * su + j * sv] : inner[i * su + j * sv];
    return;
  }
  if (source.kind == GhostSource::Kind::kOtherRank) {
    const double* layer = halo_.received() + source.at;
    for (std::size_t j = 0; j < nv; ++j)
      for (std::size_t i = 0; i < nu; ++i) to[i * su + j * sv] = layer[j * nu + i];
    return;
  }
  const auto& m = layout_.extent[source.at];
  const std::array<std::size_t, 3> stride{1, static_cast<std::size_t>(m[0]),
                                          static_cast<std::size_t>(m[0]) * static_cast<std::size_t>(m[1])};
  const double* layer = values + layout_.offset[source.at] + ((side % 2) ? 0 : static_cast<std::size_t>(m[axis] - 1) * stride[axis]);
  for (std::size_t j = 0; j < nv; ++j)
    for (std::size_t i = 0; i < nu; ++i) to[i * su + j * sv] = layer[i * stride[u] + j * stride[v]];
}

void BrickOperator::stencil(std::size_t brick, const Padded& padded, double* out) const {
  const auto& n = layout_.extent[brick];
  const auto nx = static_cast<std::size_t>(n[0]), ny = static_cast<std::size_t>(n[1]), nz = static_cast<std::size_t>(n[2]);
  constexpr std::size_t row = kPadded, plane = kPadded * kPadded;
  const auto [kx, ky, kz] = conductance_;
  const double decay = reactions_.first_order();
  const auto one_row = [&](const double* p, double* to, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const double c = p[i];
      to[i] = (kx * ((p[i + 1] - c) + (p[i - 1] - c)) + ky * ((p[i + row] - c) + (p[i - row] - c))) +
              (kz * ((p[i + plane] - c) + (p[i - plane] - c)) - decay * c);
    }
  };
  for (std::size_t k = 0; k < nz; ++k)
    for (std::size_t j = 0; j < ny; ++j) {
      const double* p = padded.data() + ((k + 1) * kPadded + j + 1) * kPadded + 1;
      double* to = out + (k * ny + j) * nx;
      if (nx == Grid::kBrick)
        one_row(p, to, Grid::kBrick);
      else
        one_row(p, to, nx);
    }
}

std::span<const Sink> BrickOperator::sinks_of(std::size_t brick) const {
  return std::span(layout_.sinks).subspan(layout_.first_sink[brick], layout_.first_sink[brick + 1] - layout_.first_sink[brick]);
}

void BrickOperator::boundary_amounts(std::size_t brick, const double* c, double* amounts) const {
  for (std::size_t side = 0; side < kSides; ++side) {
    amounts[side] = 0.0;
    if (halo_.source(brick, side).kind != GhostSource::Kind::kBoundary || face(side).kind != FaceCondition::Kind::kValue) continue;
    double gradient = 0.0;
    const double twice = 2.0 * face(side).at(time_);
    for_each_in_layer(layout_.extent[brick], side, [&](std::size_t voxel, std::size_t) { gradient += (twice - c[voxel]) - c[voxel]; });
    amounts[side] = conductance_[side / 2] * voxel_volume_ * gradient;
  }
}

void BrickOperator::evaluate(double time, const double* unknowns, double* rate, bool amounts) {
  time_ = time;
  halo_.exchange(unknowns);
  double* taken_rate = amounts ? rate + layout_.sinks_at() : nullptr;
  if (!amounts) std::fill(rate + layout_.concentrations(), rate + layout_.unknowns(), 0.0);
#pragma omp parallel for schedule(static) if (layout_.bricks() >= kBricksWorthThreads)
  for (std::size_t b = 0; b < layout_.bricks(); ++b) {
    Padded padded;
    fill(b, unknowns, 1.0, padded);
    const std::span c(unknowns + layout_.offset[b], layout_.offset[b + 1] - layout_.offset[b]);
    stencil(b, padded, rate + layout_.offset[b]);
    double* taken = amounts ? taken_rate + layout_.first_sink[b] : nullptr;
    const double in_volume = reactions_.add_rates(sinks_of(b), c, voxel_volume_, rate + layout_.offset[b], taken);
    if (!amounts) continue;
    boundary_amounts(b, c.data(), rate + layout_.amounts_at(b));
    const double decay = reactions_.first_order();
    rate[layout_.amounts_at(b) + Layout::kDecayed] =
        (decay == 0.0 ? 0.0 : decay * voxel_volume_ * block_sum(c.data(), c.size())) + in_volume;
  }
}

void BrickOperator::linearize(const double* unknowns) {
#pragma omp parallel for schedule(static) if (layout_.bricks() >= kBricksWorthThreads)
  for (std::size_t b = 0; b < layout_.bricks(); ++b) {
    const std::size_t at = layout_.offset[b];
    const std::span c(unknowns + at, layout_.offset[b + 1] - at);
    std::fill_n(slope_.begin() + static_cast<std::ptrdiff_t>(at), c.size(), 0.0);
    reactions_.add_slopes(sinks_of(b), c, voxel_volume_, slope_.data() + at);
  }
}

double BrickOperator::shifted_product(double gamma, const double* x, double* out, const Comm& comm) {
  halo_.exchange(x);
  partial_.resize(layout_.bricks());
#pragma omp parallel for schedule(static) if (layout_.bricks() >= kBricksWorthThreads)
  for (std::size_t b = 0; b < layout_.bricks(); ++b) {
    Padded padded;
    fill(b, x, 0.0, padded);
    const std::size_t at = layout_.offset[b], end = layout_.offset[b + 1];
    stencil(b, padded, out + at);
    for (std::size_t i = at; i < end; ++i) out[i] = x[i] - gamma * (out[i] - slope_[i] * x[i]);
    partial_[b] = block_dot(x + at, out + at, end - at);
  }
  OrderFreeSum sum;
  for (const double p : partial_) sum.add(p);
  return comm.sum(sum);
}

void BrickOperator::inverse_diagonal(double gamma, double* out) const {
  for (std::size_t i = 0; i < layout_.concentrations(); ++i) out[i] = 1.0 / (1.0 + gamma * (diagonal_[i] + slope_[i]));
}

double BrickOperator::largest_rate(double highest) const {
  double by_cells = 0.0, in_voxel = 0.0;
  for (std::size_t s = 0; s < layout_.sinks.size(); ++s) {
    const Sink& sink = layout_.sinks[s];
    const bool same = s > 0 && layout_.sinks[s - 1].brick == sink.brick && layout_.sinks[s - 1].voxel == sink.voxel;
    in_voxel = (same ? in_voxel : 0.0) + reactions_.steepest_of_sink(sink, highest) / voxel_volume_;
    by_cells = std::max(by_cells, in_voxel);
  }
  return 4.0 * (conductance_[0] + conductance_[1] + conductance_[2]) + reactions_.first_order() + by_cells +
         reactions_.steepest_in_volume(highest);
}

}  // namespace morula::fields
