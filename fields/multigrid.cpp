#include "fields/multigrid.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace morula::fields {

namespace {

/// (n + 1) / 2 voxels of the next level along an axis.
std::int32_t halved(std::int32_t n) { return (n + 1) / 2; }

/// The Chebyshev polynomial of degree two for the part of the spectrum of D⁻¹A that a wider level does not see. No eigenvalue is above 2
/// (Gershgorin: the diagonal is no less than the rest of its row); a sixth of it and more is smoothed. First step: D⁻¹r/θ,
/// θ the middle of that interval; second step: c₁ times the first + c₂ D⁻¹r (Saad 2003, Iterative Methods for Sparse Linear Systems, alg. 12.1).
constexpr float kHighest = 2.0F, kLowest = kHighest / 6.0F;
constexpr float kCentre = 0.5F * (kHighest + kLowest), kHalf = 0.5F * (kHighest - kLowest);
constexpr float kSigma = kCentre / kHalf;
constexpr float kRho = 1.0F / (2.0F * kSigma - 1.0F / kSigma);
constexpr float kFirst = 1.0F / kCentre;
constexpr float kAgain = kRho / kSigma;         ///< c₁
constexpr float kSecond = 2.0F * kRho / kHalf;  ///< c₂

constexpr std::size_t kUsual = static_cast<std::size_t>(Grid::kBrick) + 2;

std::size_t size_of(std::int32_t n) { return static_cast<std::size_t>(n); }

/// Faces of an axis of voxels of these widths: D/(w d), d the distance of two centres, half a voxel to a face with a value.
template <class Axis>
void set_conductances(Axis& axis, const FieldSpec& spec, std::size_t a, bool periodic) {
  const std::size_t n = axis.width.size();
  const auto& w = axis.width;
  axis.lower.assign(n, 0.0), axis.upper.assign(n, 0.0);
  const auto across = [&](std::size_t i, std::size_t j) { return spec.diffusion / (w[i] * 0.5 * (w[i] + w[j])); };
  for (std::size_t i = 0; i + 1 < n; ++i) {
    axis.upper[i] = across(i, i + 1);
    axis.lower[i + 1] = across(i + 1, i);
  }
  if (periodic) {
    // A voxel that is its own neighbour exchanges nothing.
    if (n == 1) return;
    axis.lower[0] = across(0, n - 1), axis.upper[n - 1] = across(n - 1, 0);
    return;
  }
  const auto to_face = [&](std::size_t i) { return spec.diffusion / (w[i] * 0.5 * w[i]); };
  if (spec.boundary[a][0].kind == FaceCondition::Kind::kValue) axis.lower[0] = to_face(0);
  if (spec.boundary[a][1].kind == FaceCondition::Kind::kValue) axis.upper[n - 1] = to_face(n - 1);
}

template <class Axis>
Axis widened_axis(Axis& fine) {
  Axis out;
  const std::size_t n = fine.width.size();
  out.width.assign((n + 1) / 2, 0.0);
  for (std::size_t i = 0; i < n; ++i) out.width[i / 2] += fine.width[i];
  fine.share.resize(n);
  for (std::size_t i = 0; i < n; ++i) fine.share[i] = static_cast<float>(fine.width[i] / out.width[i / 2]);
  return out;
}

Layout widened_layout(const Layout& fine) {
  Layout out;
  out.offset.push_back(0);
  for (const auto& n : fine.extent) {
    out.extent.push_back({halved(n[0]), halved(n[1]), halved(n[2])});
    const auto& m = out.extent.back();
    out.offset.push_back(out.offset.back() + size_of(m[0]) * size_of(m[1]) * size_of(m[2]));
  }
  return out;
}

}  // namespace

/// A row of voxels along x: the operand with its neighbours, and what stands before each of them.
struct Multigrid::Row {
  std::size_t at = 0;     ///< of the first voxel in the level's vectors
  std::size_t count = 0;  ///< voxels
  const float* v = nullptr;
  std::size_t next_row = 0, next_plane = 0;
  const float *below = nullptr, *above = nullptr;  ///< along x, by voxel
  float y_below = 0.0F, y_above = 0.0F, z_below = 0.0F, z_above = 0.0F;
  const float* shift = nullptr;

  [[nodiscard]] float diagonal(std::size_t i) const {
    return (shift[i] + (below[i] + above[i])) + ((y_below + y_above) + (z_below + z_above));
  }
  /// (A v)_i
  [[nodiscard]] float product(std::size_t i) const {
    const float c = v[i];
    const float x = below[i] * (c - (v + i)[-1]) + above[i] * (c - v[i + 1]);
    const float y = y_below * (c - *(v + i - next_row)) + y_above * (c - v[i + next_row]);
    const float z = z_below * (c - *(v + i - next_plane)) + z_above * (c - v[i + next_plane]);
    return (shift[i] * c + x) + (y + z);
  }
  /// Call f(i) for each voxel; the usual length is known when the code is compiled.
  template <class F>
  void for_each(F&& f) const {
    if (count == Grid::kBrick) {
#pragma omp simd
      for (std::size_t i = 0; i < Grid::kBrick; ++i) f(i);
    } else {
#pragma omp simd
      for (std::size_t i = 0; i < count; ++i) f(i);
    }
  }
};

Multigrid::Multigrid(const Field& field, const FieldSpec& spec, const Layout& layout, const Space& space, const Comm& comm)
    : comm_(comm), bricks_(field.owned_bricks) {
  for (int rank = 0; rank < comm.size(); ++rank)
    for (std::int64_t brick = 0; brick < field.grid.brick_count(); ++brick)
      if (field.owner[static_cast<std::size_t>(brick)] == rank) gather_order_.push_back(brick);

  const Vec3d h = field.grid.spacing();
  std::array<Axis, 3> axes;
  for (std::size_t a = 0; a < 3; ++a) axes[a].width.assign(size_of(field.grid.voxels[a]), h[a]);

  // What is gathered is one brick, all of it on every rank.
  static const Comm alone;
  Field whole;
  whole.grid.bricks = {1, 1, 1};
  whole.owned_bricks = {0};
  whole.owner = {0};

  Layout next = layout;
  next.sinks.clear();
  for (std::size_t l = 0;; ++l) {
    if (l == kShared) {
      next = Layout{};
      next.extent = {field.grid.bricks};
      next.offset = {0, static_cast<std::size_t>(field.grid.brick_count())};
    }
    levels_.emplace_back();
    Level& level = levels_.back();
    level.layout = std::move(next);
    for (std::size_t b = 0; b < level.layout.bricks(); ++b) {
      const auto place = is_gathered(l) ? std::array<std::int32_t, 3>{} : field.grid.place(bricks_[b]);
      const std::size_t side = static_cast<std::size_t>(Grid::kBrick) >> l;
      level.start.push_back({size_of(place[0]) * side, size_of(place[1]) * side, size_of(place[2]) * side});
    }
    for (std::size_t a = 0; a < 3; ++a) set_conductances(axes[a], spec, a, space.periodic(static_cast<int>(a)));
    const bool last = is_gathered(l) && level.layout.concentrations() == 1;
    std::array<Axis, 3> wide;
    if (!last)
      for (std::size_t a = 0; a < 3; ++a) wide[a] = widened_axis(axes[a]);
    level.axes = std::exchange(axes, std::move(wide));
    for (Values* values : {&level.shift, &level.b, &level.x, &level.y, &level.residual})
      values->assign(level.layout.concentrations(), 0.0F);
    if (last) break;
    next = widened_layout(level.layout);
  }
  // Halos keep references to layouts, which stay where they are from here on.
  for (std::size_t l = 0; l < levels_.size(); ++l)
    levels_[l].halo =
        std::make_unique<Halo<float>>(is_gathered(l) ? whole : field, levels_[l].layout, space, is_gathered(l) ? alone : comm_);
}

std::size_t Multigrid::wide_at(std::size_t level, std::size_t brick) const {
  return level + 1 == kShared ? static_cast<std::size_t>(bricks_[brick]) : levels_[level + 1].layout.offset[brick];
}

void Multigrid::prepare(double gamma, const BrickOperator& op) {
  Level& finest = levels_.front();
#pragma omp parallel for schedule(static) if (finest.layout.bricks() >= kBricksWorthThreads)
  for (std::size_t i = 0; i < finest.shift.size(); ++i) finest.shift[i] = static_cast<float>(1.0 + gamma * op.reaction_slope(i));
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    for (Axis& axis : levels_[l].axes) {
      axis.below.resize(axis.lower.size()), axis.above.resize(axis.upper.size());
      std::transform(axis.lower.begin(), axis.lower.end(), axis.below.begin(), [&](double k) { return static_cast<float>(gamma * k); });
      std::transform(axis.upper.begin(), axis.upper.end(), axis.above.begin(), [&](double k) { return static_cast<float>(gamma * k); });
    }
    if (l + 1 < levels_.size()) average(l, levels_[l].shift, levels_[l + 1].shift);
  }
}

void Multigrid::fill(const Level& level, std::size_t brick, const Values& v, float* padded) const {
  const auto& n = level.layout.extent[brick];
  const std::size_t nx = size_of(n[0]), ny = size_of(n[1]), nz = size_of(n[2]);
  const std::array<std::size_t, 3> stride{1, nx + 2, (nx + 2) * (ny + 2)};
  const float* from = v.data() + level.layout.offset[brick];
  for (std::size_t k = 0; k < nz; ++k)
    for (std::size_t j = 0; j < ny; ++j) std::copy_n(from + (k * ny + j) * nx, nx, padded + (k + 1) * stride[2] + (j + 1) * stride[1] + 1);
  for (std::size_t side = 0; side < kSides; ++side) {
    const std::size_t axis = side / 2, u = axis == 0 ? 1 : 0, w = axis == 2 ? 1 : 2;
    const std::size_t nu = size_of(n[u]), nw = size_of(n[w]);
    float* to = padded + ((side % 2) ? size_of(n[axis]) + 1 : 0) * stride[axis] + stride[u] + stride[w];
    const GhostSource& source = level.halo->source(brick, side);
    const auto copy = [&](const float* layer, std::size_t along_u, std::size_t along_w) {
      for (std::size_t j = 0; j < nw; ++j)
        for (std::size_t i = 0; i < nu; ++i) to[i * stride[u] + j * stride[w]] = layer[i * along_u + j * along_w];
    };
    switch (source.kind) {
      case GhostSource::Kind::kBoundary:  // a face with a value holds 0 for a correction
        for (std::size_t j = 0; j < nw; ++j)
          for (std::size_t i = 0; i < nu; ++i) to[i * stride[u] + j * stride[w]] = 0.0F;
        break;
      case GhostSource::Kind::kOtherRank:
        copy(level.halo->received() + source.at, 1, nu);
        break;
      case GhostSource::Kind::kSameRank: {
        const auto& m = level.layout.extent[source.at];
        const std::array<std::size_t, 3> their{1, size_of(m[0]), size_of(m[0]) * size_of(m[1])};
        copy(v.data() + level.layout.offset[source.at] + ((side % 2) ? 0 : size_of(m[axis] - 1) * their[axis]), their[u], their[w]);
        break;
      }
    }
  }
}

template <class Update>
void Multigrid::sweep(Level& level, const Values& v, Update&& update) const {
  level.halo->exchange(v.data());
#pragma omp parallel for schedule(static) if (level.layout.bricks() >= kBricksWorthThreads)
  for (std::size_t b = 0; b < level.layout.bricks(); ++b) {
    const auto& n = level.layout.extent[b];
    const std::size_t nx = size_of(n[0]), ny = size_of(n[1]), nz = size_of(n[2]);
    std::array<float, kUsual * kUsual * kUsual> usual;
    Values large;
    const std::size_t size = (nx + 2) * (ny + 2) * (nz + 2);
    if (size > usual.size()) large.resize(size);
    float* padded = large.empty() ? usual.data() : large.data();
    fill(level, b, v, padded);
    const auto& [ax, ay, az] = level.axes;
    const auto& start = level.start[b];
    Row row;
    row.count = nx;
    row.next_row = nx + 2, row.next_plane = (nx + 2) * (ny + 2);
    row.below = ax.below.data() + start[0], row.above = ax.above.data() + start[0];
    for (std::size_t k = 0; k < nz; ++k)
      for (std::size_t j = 0; j < ny; ++j) {
        row.at = level.layout.offset[b] + (k * ny + j) * nx;
        row.v = padded + (k + 1) * row.next_plane + (j + 1) * row.next_row + 1;
        row.y_below = ay.below[start[1] + j], row.y_above = ay.above[start[1] + j];
        row.z_below = az.below[start[2] + k], row.z_above = az.above[start[2] + k];
        row.shift = level.shift.data() + row.at;
        update(std::as_const(row));
      }
  }
}

void Multigrid::smooth_from_zero(Level& level) const {
  // The first step needs the diagonal alone. Its ghosts are those of a vector like any other, so it is written out.
#pragma omp parallel for schedule(static) if (level.layout.bricks() >= kBricksWorthThreads)
  for (std::size_t b = 0; b < level.layout.bricks(); ++b) {
    const auto& n = level.layout.extent[b];
    const auto& start = level.start[b];
    const auto& [ax, ay, az] = level.axes;
    Row row;
    row.count = size_of(n[0]);
    row.below = ax.below.data() + start[0], row.above = ax.above.data() + start[0];
    for (std::size_t k = 0; k < size_of(n[2]); ++k)
      for (std::size_t j = 0; j < size_of(n[1]); ++j) {
        const std::size_t at = level.layout.offset[b] + (k * size_of(n[1]) + j) * row.count;
        row.y_below = ay.below[start[1] + j], row.y_above = ay.above[start[1] + j];
        row.z_below = az.below[start[2] + k], row.z_above = az.above[start[2] + k];
        row.shift = level.shift.data() + at;
        float* y = level.y.data() + at;
        const float* rhs = level.b.data() + at;
        row.for_each([&](std::size_t i) { y[i] = kFirst * rhs[i] / row.diagonal(i); });
      }
  }
  sweep(level, level.y, [&](const Row& row) {
    float* x = level.x.data() + row.at;
    const float* rhs = level.b.data() + row.at;
    row.for_each([&](std::size_t i) { x[i] = (1.0F + kAgain) * row.v[i] + kSecond * (rhs[i] - row.product(i)) / row.diagonal(i); });
  });
}

void Multigrid::smooth(Level& level) const {
  sweep(level, level.x, [&](const Row& row) {
    float* y = level.y.data() + row.at;
    const float* rhs = level.b.data() + row.at;
    row.for_each([&](std::size_t i) { y[i] = row.v[i] + kFirst * (rhs[i] - row.product(i)) / row.diagonal(i); });
  });
  sweep(level, level.y, [&](const Row& row) {
    float* x = level.x.data() + row.at;
    const float* rhs = level.b.data() + row.at;
    row.for_each(
        [&](std::size_t i) { x[i] = row.v[i] + kAgain * (row.v[i] - x[i]) + kSecond * (rhs[i] - row.product(i)) / row.diagonal(i); });
  });
}

void Multigrid::average(std::size_t l, const Values& fine, Values& wide) {
  const Level& level = levels_[l];
  const bool gather = l + 1 == kShared;
  Values own(gather ? level.layout.bricks() : 0);
#pragma omp parallel for schedule(static) if (level.layout.bricks() >= kBricksWorthThreads)
  for (std::size_t b = 0; b < level.layout.bricks(); ++b) {
    const auto& n = level.layout.extent[b];
    const auto& start = level.start[b];
    const std::size_t mx = size_of(halved(n[0])), my = size_of(halved(n[1])), mz = size_of(halved(n[2]));
    float* to = gather ? own.data() + b : wide.data() + wide_at(l, b);
    std::fill_n(to, mx * my * mz, 0.0F);
    const float* from = fine.data() + level.layout.offset[b];
    for (std::size_t k = 0; k < size_of(n[2]); ++k)
      for (std::size_t j = 0; j < size_of(n[1]); ++j) {
        const float across = level.axes[1].share[start[1] + j] * level.axes[2].share[start[2] + k];
        float* row = to + ((k / 2) * my + j / 2) * mx;
        for (std::size_t i = 0; i < size_of(n[0]); ++i) row[i / 2] += across * level.axes[0].share[start[0] + i] * *from++;
      }
  }
  if (!gather) return;
  const std::vector<std::byte> bytes = comm_.gather_to_all(std::as_bytes(std::span(own)));
  Values all(gather_order_.size());
  std::memcpy(all.data(), bytes.data(), bytes.size());
  for (std::size_t i = 0; i < all.size(); ++i) wide[static_cast<std::size_t>(gather_order_[i])] = all[i];
}

void Multigrid::add_correction(std::size_t l) {
  Level& level = levels_[l];
  const Values& wide = levels_[l + 1].x;
#pragma omp parallel for schedule(static) if (level.layout.bricks() >= kBricksWorthThreads)
  for (std::size_t b = 0; b < level.layout.bricks(); ++b) {
    const auto& n = level.layout.extent[b];
    const std::size_t mx = size_of(halved(n[0])), my = size_of(halved(n[1]));
    const float* from = wide.data() + wide_at(l, b);
    float* to = level.x.data() + level.layout.offset[b];
    for (std::size_t k = 0; k < size_of(n[2]); ++k)
      for (std::size_t j = 0; j < size_of(n[1]); ++j) {
        const float* row = from + ((k / 2) * my + j / 2) * mx;
        for (std::size_t i = 0; i < size_of(n[0]); ++i) *to++ += row[i / 2];
      }
  }
}

void Multigrid::cycle(std::size_t l) {
  Level& level = levels_[l];
  if (l + 1 == levels_.size()) {
    const auto& [ax, ay, az] = level.axes;
    const float diagonal = level.shift[0] + ax.below[0] + ax.above[0] + ay.below[0] + ay.above[0] + az.below[0] + az.above[0];
    level.x[0] = level.b[0] / diagonal;
    return;
  }
  smooth_from_zero(level);
  sweep(level, level.x, [&](const Row& row) {
    float* r = level.residual.data() + row.at;
    const float* rhs = level.b.data() + row.at;
    row.for_each([&](std::size_t i) { r[i] = rhs[i] - row.product(i); });
  });
  average(l, level.residual, levels_[l + 1].b);
  cycle(l + 1);
  add_correction(l);
  smooth(level);
}

void Multigrid::apply(const double* r, double* z) {
  Level& finest = levels_.front();
  const std::size_t n = finest.b.size();
#pragma omp parallel for simd schedule(static) if (finest.layout.bricks() >= kBricksWorthThreads)
  for (std::size_t i = 0; i < n; ++i) finest.b[i] = static_cast<float>(r[i]);
  cycle(0);
#pragma omp parallel for simd schedule(static) if (finest.layout.bricks() >= kBricksWorthThreads)
  for (std::size_t i = 0; i < n; ++i) z[i] = finest.x[i];
}

}  // namespace morula::fields
