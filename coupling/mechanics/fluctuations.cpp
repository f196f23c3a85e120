#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/contact/traction_law.h"
#include "core/random/philox.h"
#include "coupling/mechanics/mechanics.h"

namespace morula {
namespace {

/// Three independent standard normal numbers: the draws 2·index and 2·index + 1.
Vec3d normal_vector(const Random& random, CellId cell, std::uint64_t index) {
  const RandomPair one = random.normal(cell, 2 * index), two = random.normal(cell, 2 * index + 1);
  return {one.first, one.second, two.first};
}

/// Draws of a step: a cell has fewer than 2^20 nodes, edges or whatever else is drawn in one stream.
std::uint64_t draw(std::uint64_t step, std::uint64_t element) { return (step << 20) + element; }

/// A number of a contact point that no other point of the step shares: finalizer of SplitMix64 (Steele et al. 2014, doi:10.1145/2660193.2660195).
std::uint64_t mixed(std::uint64_t a) {
  a = (a ^ (a >> 30)) * 0xBF58476D1CE4E5B9ull;
  a = (a ^ (a >> 27)) * 0x94D049BB133111EBull;
  return a ^ (a >> 31);
}
std::uint64_t point_draw(std::uint64_t step, CellId partner, std::uint64_t point) {
  return mixed(mixed(mixed(partner.bits()) + step) + point) >> 1;
}

/// x parts of an isotropic friction a and an axial one b along n: a noise of covariance a (I − n nᵀ) + (a + b) n nᵀ.
Vec3d along_and_across(const Vec3d& noise, const Vec3d& n, double across, double along) {
  const double part = dot(noise, n);
  return (noise - n * part) * std::sqrt(across) + n * (part * std::sqrt(along));
}

/// What the noise of one shell is made from.
struct ShellNoise {
  const CellType& type;
  const dcm::ShellParameters& law;
  const Topology& topology;
  CellId cell;
  std::uint64_t step;
  double strength;  ///< √(2 k_B T/Δt)
  std::span<const Vec3d> x;
  std::span<Vec3d> force;
};

void add_edge_noise(const ShellNoise& s, std::uint32_t seed) {
  const Random random(seed, RandomStream::kFluctuationOfEdges);
  const double along = s.strength * std::sqrt(s.law.edge_damping), all = s.strength * std::sqrt(s.law.isotropic_damping);
  const auto edges = s.topology.edges();
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const Vec3d noise = normal_vector(random, s.cell, draw(s.step, 2 * k));
    Vec3d f = normalized(s.x[edges[k].j] - s.x[edges[k].i]) * (along * noise.x);
    if (all > 0.0) f += normal_vector(random, s.cell, draw(s.step, 2 * k + 1)) * all;
    s.force[edges[k].i] += f;
    s.force[edges[k].j] -= f;
  }
}

void add_bulk_noise(const ShellNoise& s, double volume, std::uint32_t seed) {
  if (s.law.bulk_viscosity == 0.0) return;
  const double noise = Random(seed, RandomStream::kFluctuationOfNodes).normal(s.cell, 2 * draw(s.step, s.x.size())).first;
  const double size = s.strength * std::sqrt(s.law.bulk_viscosity / volume) * noise / 6.0;
  for (const Triangle& t : s.topology.faces()) {
    const Vec3d part = cross(s.x[t[1]] - s.x[t[0]], s.x[t[2]] - s.x[t[0]]) * size;
    for (const std::uint32_t node : t) s.force[node] += part;
  }
}

}  // namespace

void Mechanics::add_fluctuations(const Tissue& tissue, double dt, std::span<Vec3d> external) {
  bool any = false;
  for (const CellType& type : model_.types) any = any || type.fluctuations.energy > 0.0;
  if (!any) return;
  prepare_step(tissue);
  add_shell_noise(tissue, dt, external);
  add_sphere_noise(tissue, dt, external);
  add_contact_noise(tissue, dt, external);
}

void Mechanics::add_shell_noise(const Tissue& tissue, double dt, std::span<Vec3d> external) const {
  const Random random(model_.seed, RandomStream::kFluctuationOfNodes);
  const dcm::Shells& shells = tissue.shells;
  const std::vector<SymMat3<double>> blocks = node_terms_.friction(tissue, geometry_);
  for (std::size_t k = 0; k < shells.size(); ++k) {
    const CellType& type = model_.types[shells.type[k]];
    if (type.fluctuations.energy == 0.0) continue;
    const std::uint32_t first = shells.first_node[k], count = shells.first_node[k + 1] - first;
    const ShellNoise s{type,
                       shells_.parameters()[shells.type[k]],
                       shells.topology(k),
                       scene_.bodies()[k].id,
                       tissue.clock.steps,
                       std::sqrt(2.0 * type.fluctuations.energy / dt),
                       shells.nodes(k),
                       external.subspan(first, count)};
    for (std::uint32_t i = 0; i < count; ++i) {
      const double area = geometry_.node_area[first + i];
      const Vec3d noise = normal_vector(random, s.cell, draw(s.step, i));
      // Across the surface and along it there may be different friction; springs rub alike in all directions.
      const double base = s.law.medium_friction * area;
      const Vec3d n = geometry_.node_normal[first + i];
      const double along = blocks.empty() ? 0.0 : morula::dot(n, blocks[first + i] * n);
      const double trace = blocks.empty() ? 0.0 : blocks[first + i].xx + blocks[first + i].yy + blocks[first + i].zz;
      s.force[i] += along_and_across(noise, n, base + std::max(0.0, 0.5 * (trace - along)), base + along) * s.strength;
    }
    add_edge_noise(s, model_.seed);
    add_bulk_noise(s, geometry_.volume[k], model_.seed);
  }
}

void Mechanics::add_sphere_noise(const Tissue& tissue, double dt, std::span<Vec3d> external) const {
  const Random random(model_.seed, RandomStream::kFluctuationOfNodes), contact(model_.seed, RandomStream::kFluctuationOfContacts);
  const std::span<Vec3d> force = external.subspan(scene_.owned_nodes());
  const auto energy = [&](std::size_t sphere) {
    return model_.types[scene_.bodies()[scene_.first_sphere() + sphere].material].fluctuations.energy;
  };
  const auto id = [&](std::size_t sphere) { return scene_.bodies()[scene_.first_sphere() + sphere].id; };
  for (std::size_t i = 0; i < force.size(); ++i) {
    if (energy(i) == 0.0) continue;
    const double r = tissue.spheres.radius[i], area = 4.0 * std::numbers::pi * r * r;
    const double friction = model_.types[tissue.spheres.type[i]].medium_friction * area;
    force[i] += normal_vector(random, id(i), draw(tissue.clock.steps, 0)) * std::sqrt(2.0 * energy(i) * friction / dt);
  }
  const SpherePairs& list = spheres_.pairs();
  for (std::size_t k = 0; k < list.elements.size(); ++k) {
    const SpherePair& pair = list.pairs[k];
    const SpherePairElement& e = list.elements[k];
    const double kt = 0.5 * (energy(pair.a) + energy(pair.b));
    if (kt == 0.0 || !(e.area > 0.0f)) continue;
    const PairFriction friction = list.friction(pair);
    const Vec3d n{e.n[0], e.n[1], e.n[2]};
    const Vec3d noise = normal_vector(contact, id(pair.a), point_draw(tissue.clock.steps, id(pair.b), 0));
    const double across = static_cast<double>(e.area) * friction.tangential, along = across + static_cast<double>(e.area) * friction.extra;
    const Vec3d f = along_and_across(noise, n, across, along) * std::sqrt(2.0 * kt / dt);
    if (pair.a < force.size()) force[pair.a] += f;
    if (pair.b < force.size()) force[pair.b] -= f;
  }
  std::uint64_t number = 0;  // of the obstacle that a sphere touches
  for (std::size_t k = 0; k < list.rigid.size(); ++k) {
    const RigidPairElement& e = list.rigid[k];
    if (k > 0 && list.rigid[k - 1].sphere != e.sphere) number = 0;
    if (e.sphere >= force.size() || energy(e.sphere) == 0.0 || !(e.isotropic + e.axial > 0.0f)) continue;
    const Vec3d noise = normal_vector(contact, id(e.sphere), point_draw(tissue.clock.steps, CellId(), ++number));
    force[e.sphere] += along_and_across(noise, {e.n[0], e.n[1], e.n[2]}, e.isotropic, static_cast<double>(e.isotropic) + e.axial) *
                       std::sqrt(2.0 * energy(e.sphere) / dt);
  }
}

void Mechanics::add_contact_noise(const Tissue& tissue, double dt, std::span<Vec3d> external) const {
  const Random random(model_.seed, RandomStream::kFluctuationOfContacts);
  const FaceQuadrature& quadrature = FaceQuadrature::with_points(contacts_.settings().points_per_face);
  const auto bodies = scene_.bodies();
  const auto add = [&](const ContactBody& body, std::uint32_t node, const Vec3d& f) {
    if (!body.owned) return;
    const std::uint32_t point = body.first_point + node;
    external[body.shape == BodyShape::kSurface ? point : point - scene_.sphere_point() + scene_.owned_nodes()] += f;
  };
  const auto energy = [&](std::uint16_t material) {
    return material < model_.types.size() ? model_.types[material].fluctuations.energy : 0.0;
  };
  const bool objective = contacts_.own_friction() != nullptr;
  const ObjectiveFriction friction = objective ? contacts_.friction_now(contact_scene()) : ObjectiveFriction();
  std::size_t next = 0;  // of its elements, which come in the order of this loop
  for (const SurfacePair& pair : contacts_.pairs()) {
    for (int d = 0; d < 2; ++d) {
      const std::size_t first = next;
      next += pair.present(d).size();
      if (pair.present(d).empty()) continue;
      const std::uint32_t from = d == 0 ? pair.a : pair.b, to = d == 0 ? pair.b : pair.a;
      const ContactBody& source = bodies[from];
      const ContactBody* target = pair.rigid ? nullptr : &bodies[to];
      const std::uint16_t partner = target != nullptr ? target->material : contacts_.obstacles()[pair.b].material;
      const double kt = target != nullptr ? 0.5 * (energy(source.material) + energy(partner)) : energy(source.material);
      if (kt == 0.0) continue;
      const ContactMaterial& material = contacts_.material(source.material, partner);
      const std::uint64_t step = mixed(tissue.clock.steps + std::uint64_t{d == 0 ? 0u : 1u << 30});
      for (const ContactElement& e : pair.present(d)) {
        const Triangle& face = scene_.topologies()[from]->faces()[e.source_face()];
        const Vec3d noise =
            normal_vector(random, source.id, point_draw(step, target != nullptr ? target->id : CellId(pair.b + 1), e.place()));
        const double across = static_cast<double>(e.area()) * material.tangential_friction,
                     along = static_cast<double>(e.area()) * material.normal_friction;
        const Vec3d f = along_and_across(noise, normalized(e.normal<double>()), across, along) * std::sqrt(2.0 * kt / dt);
        if (objective) {
          const ObjectiveElement& element = friction.elements()[first + static_cast<std::size_t>(&e - pair.present(d).data())];
          for (int c = 0; c < element.count; ++c) {
            const ContactBody& body = c < 3 ? source : *target;
            add(body, element.point[c] - body.first_point, element.share(c, f));
          }
          continue;
        }
        for (std::size_t k = 0; k < 3; ++k) add(source, face[k], f * quadrature.weight[e.point()][k]);
        if (target == nullptr) continue;
        if (target->shape == BodyShape::kSphere) {
          add(*target, 0, -f);
          continue;
        }
        double mu[3];
        e.weights(mu);
        const Triangle& opposite = scene_.topologies()[to]->faces()[e.target()];
        for (std::size_t k = 0; k < 3; ++k) add(*target, opposite[k], f * -mu[k]);
      }
    }
  }
}

}  // namespace morula
