#include "coupling/mechanics/apical_dampers.h"

#include <algorithm>
#include <cmath>

namespace morula {
namespace {

constexpr double kLeastPivot = 1e-10;  // of a common motion, below which the motions before it hold it, as with nodes on a line
constexpr std::uint64_t kDrawsOfDampers = std::uint64_t{1} << 31;  // begin of their points among those of contacts
constexpr std::uint64_t kMostNodes = std::uint64_t{1} << 20;       // of a cell

}  // namespace

ApicalDampers::ApicalDampers(const Model& model) : model_(model) {
  for (const ApicalSpring& spring : model.apical_springs)
    if (spring.friction > 0.0) dampers_.push_back({.mark = spring.mark, .friction = spring.friction});
}

ApicalDampers::Common ApicalDampers::Node::sum_of(const Vec3d& v) const {
  const Vec3d turn = cross(from, v);
  return {v.x, v.y, v.z, turn.x, turn.y, turn.z, dot(outward, v)};
}

Vec3d ApicalDampers::Node::common(const Common& y) const {
  return Vec3d{y[0], y[1], y[2]} + cross(Vec3d{y[3], y[4], y[5]}, from) + outward * y[6];
}

ApicalDampers::Common ApicalDampers::Damper::fit(Common y) const {
  for (std::size_t k = 0; k < kCommon; ++k) {
    for (std::size_t j = 0; j < k; ++j) y[k] -= factor[k][j] * y[j];
    y[k] = factor[k][k] > 0.0 ? y[k] / factor[k][k] : 0.0;
  }
  for (std::size_t k = kCommon; k-- > 0;) {
    for (std::size_t j = k + 1; j < kCommon; ++j) y[k] -= factor[j][k] * y[j];
    y[k] = factor[k][k] > 0.0 ? y[k] / factor[k][k] : 0.0;
  }
  return y;
}

void ApicalDampers::fit_common_motions(Damper& damper, const Comm& comm) const {
  const auto sums = total<kCommon * kCommon>(damper.marked, comm, [](const Node& at) {
    std::array<double, kCommon * kCommon> out;
    for (std::size_t k = 0; k < kCommon; ++k) {
      Common unit{};
      unit[k] = at.area;
      std::ranges::copy(at.sum_of(at.common(unit)), out.begin() + static_cast<std::ptrdiff_t>(k * kCommon));
    }
    return out;
  });
  auto& l = damper.factor;
  l = {};
  for (std::size_t k = 0; k < kCommon; ++k) {
    const double whole = sums[k * kCommon + k];
    double rest = whole;
    for (std::size_t j = 0; j < k; ++j) {
      double value = sums[k * kCommon + j];
      for (std::size_t i = 0; i < j; ++i) value -= l[k][i] * l[j][i];
      l[k][j] = l[j][j] > 0.0 ? value / l[j][j] : 0.0;
      rest -= l[k][j] * l[k][j];
    }
    if (rest > kLeastPivot * whole)
      l[k][k] = std::sqrt(rest);
    else
      l[k] = {};
  }
}

void ApicalDampers::freeze(const dcm::Shells& shells, std::span<const Vec3d> x, const Comm& comm) {
  for (Damper& damper : dampers_) {
    const NodesByShell<MarkedNode> marked = marked_nodes(shells, damper.mark);
    const auto sums = total<4>(marked, comm, [&](const MarkedNode& at) {
      const Vec3d v = x[at.node] * at.area;
      return std::array{at.area, v.x, v.y, v.z};
    });
    damper.marked = {};
    const double share = sums[0] > 0.0 ? 1.0 / sums[0] : 0.0;
    const Vec3d center = Vec3d{sums[1], sums[2], sums[3]} * share;
    marked.for_each([&](std::uint32_t shell, const MarkedNode& at) {
      const Vec3d from = x[at.node] - center;
      damper.marked.add(shell, {at.node, at.area, from, direction(from)});
    });
    fit_common_motions(damper, comm);
  }
}

void ApicalDampers::add_friction_of(std::span<const Vec3d> way, std::span<Vec3d> out, OrderFreeSum& quadratic, const Comm& comm) const {
  for (const Damper& damper : dampers_) {
    const Common common =
        damper.fit(total<kCommon>(damper.marked, comm, [&](const Node& at) { return at.sum_of(way[at.node] * at.area); }));
    std::size_t n = 0;
    for (const std::size_t end : damper.marked.ends) {
      double of_shell = 0.0;
      for (; n < end; ++n) {
        const Node& at = damper.marked.nodes[n];
        const Vec3d own = way[at.node] - at.common(common);
        out[at.node] += own * (damper.friction * at.area);
        of_shell += damper.friction * at.area * norm2(own);
      }
      quadratic.add(of_shell);
    }
  }
}

void ApicalDampers::add_friction(const World& world, const Way& way, std::span<Vec3d> out, OrderFreeSum& quadratic) {
  if (empty() || !way.moved) return;
  std::vector<Vec3d> gone(world.tissue.shells.node_count());
  for (std::size_t i = 0; i < gone.size(); ++i) gone[i] = way.position[i] - way.start[i];
  add_friction_of(gone, out, quadratic, world.comm);
}

void ApicalDampers::add_noise(const World& world, const Noise& noise, std::span<Vec3d> force) const {
  const auto fluctuates = [](const CellType& type) { return type.fluctuations.energy > 0.0; };
  if (std::ranges::none_of(model_.types, fluctuates)) return;
  const Random random(noise.seed, RandomStream::kFluctuationOfContacts);
  const dcm::Shells& shells = world.tissue.shells;
  for (std::size_t d = 0; d < dampers_.size(); ++d) {
    const Damper& damper = dampers_[d];
    std::vector<Vec3d> drawn(shells.node_count());  // √A ξ
    std::vector<double> energy(shells.node_count());
    damper.marked.for_each([&](std::uint32_t shell, const Node& at) {
      const std::uint64_t point = d * kMostNodes + (at.node - shells.first_node[shell]);
      const std::uint64_t draw = point_draw(mixed(noise.step + kDrawsOfDampers), CellId(), point);
      drawn[at.node] = normal_vector(random, world.scene.bodies()[shell].id, draw) * std::sqrt(at.area);
      energy[at.node] = model_.types[shells.type[shell]].fluctuations.energy;
    });
    const auto sums = total<kCommon + 2>(damper.marked, world.comm, [&](const Node& at) {
      std::array<double, kCommon + 2> out;
      std::ranges::copy(at.sum_of(drawn[at.node]), out.begin());
      out[kCommon] = at.area, out[kCommon + 1] = at.area * energy[at.node];
      return out;
    });
    Common common;
    std::copy_n(sums.begin(), kCommon, common.begin());
    common = damper.fit(common);
    const double strength = sums[kCommon] > 0.0 ? noise.strength(damper.friction * sums[kCommon + 1] / sums[kCommon]) : 0.0;
    for (const Node& at : damper.marked.nodes) force[at.node] += (drawn[at.node] - at.common(common) * at.area) * strength;
  }
}

void ApicalDampers::assemble(const World& world, double, Assembly&) {
  if (!empty()) assemble_of(moving_shells(world.scene), world.comm);
}

void ApicalDampers::assemble_of(std::span<const char> moves, const Comm& comm) {
  comm_ = &comm;
  for (Damper& damper : dampers_) {
    damper.moving = {};
    damper.marked.for_each([&](std::uint32_t shell, const Node& at) {
      if (moves.empty() || moves[shell] != 0) damper.moving.add(shell, at);
    });
  }
}

void ApicalDampers::drop_matrix() {
  for (Damper& damper : dampers_) damper.moving = {};
}

void ApicalDampers::add_product(std::span<const Float4> p, std::span<Float4> q) const {
  for (const Damper& damper : dampers_) {
    const Common common =
        damper.fit(total<kCommon>(damper.moving, *comm_, [&](const Node& at) { return at.sum_of(to_double(p[at.node]) * at.area); }));
    for (const Node& at : damper.moving.nodes) {
      const Vec3f add = to_float((to_double(p[at.node]) - at.common(common)) * (damper.friction * at.area));
      Float4& to = q[at.node];
      to.x += add.x, to.y += add.y, to.z += add.z;
    }
  }
}

void ApicalDampers::add_diagonal(std::span<SymMat3<float>> diagonal) const {
  // Without what the common motions take away: it is shared by all nodes.
  for (const Damper& damper : dampers_)
    for (const Node& at : damper.moving.nodes) diagonal[at.node] += to_float(isotropic(damper.friction * at.area));
}

std::size_t ApicalDampers::memory() const {
  std::size_t total = dampers_.capacity() * sizeof(Damper);
  for (const Damper& damper : dampers_) total += damper.marked.memory() + damper.moving.memory();
  return total;
}

}  // namespace morula
