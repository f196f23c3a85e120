/// The noise of what rubs in contacts: surfaces on each other, spheres on each other, on obstacles and on the medium (dcm.md §10).

#include "core/ball.h"
#include "coupling/mechanics/noise.h"
#include "coupling/mechanics/sphere_contacts.h"
#include "coupling/mechanics/surface_contacts.h"

namespace morula {
namespace {

/// k_B T of a material; obstacles and walls do not fluctuate.
double energy_of(const Model& model, std::uint16_t material) {
  return material < model.types.size() ? model.types[material].fluctuations.energy : 0.0;
}

/// Two surfaces that touch, seen from the one whose points are looked at.
struct Touching {
  const ContactBody& source;
  const ContactBody* target;  ///< null: an obstacle
  const Topology* source_topology;
  const Topology* target_topology;  ///< null: a sphere or an obstacle
};

/// Adds the force f on a point of the source to the corners of its face, and the opposite to the target's.
void add_to_corners(const Touching& pair, const FaceQuadrature& quadrature, const ContactElement& e, const Vec3d& f,
                    std::span<Vec3d> force) {
  const Triangle& face = pair.source_topology->faces()[e.source_face()];
  for (std::size_t k = 0; k < 3; ++k) force[pair.source.first_point + face[k]] += f * quadrature.weight[e.point()][k];
  if (pair.target == nullptr) return;
  if (pair.target_topology == nullptr) {
    force[pair.target->first_point] -= f;
    return;
  }
  double mu[3];
  e.weights(mu);
  const Triangle& opposite = pair.target_topology->faces()[e.target()];
  for (std::size_t k = 0; k < 3; ++k) force[pair.target->first_point + opposite[k]] += f * -mu[k];
}

}  // namespace

void ContactFriction::add_noise(const World& world, const Noise& noise, std::span<Vec3d> force) const {
  const Random random(noise.seed, RandomStream::kFluctuationOfContacts);
  const ContactLayer& layer = contacts_.layer();
  const FaceQuadrature& quadrature = FaceQuadrature::with_points(layer.settings().points_per_face);
  const auto bodies = world.scene.bodies();
  const auto topology_of = [&](std::uint32_t body) { return body < world.scene.shells() ? world.scene.topologies()[body] : nullptr; };
  const ObjectiveFriction* objective = layer.own_friction();
  std::size_t next = 0;  // of its elements, which come in the order of this loop
  for (const SurfacePair& pair : layer.pairs()) {
    for (int d = 0; d < 2; ++d) {
      const std::size_t first = next;
      next += pair.present(d).size();
      if (pair.present(d).empty()) continue;
      const std::uint32_t from = d == 0 ? pair.a : pair.b, to = d == 0 ? pair.b : pair.a;
      const Touching touching{bodies[from], pair.rigid ? nullptr : &bodies[to], topology_of(from), pair.rigid ? nullptr : topology_of(to)};
      const ContactBody& source = touching.source;
      const std::uint16_t partner = pair.rigid ? layer.obstacles()[pair.b].material : touching.target->material;
      const double own = energy_of(world.model, source.material);
      const double energy = pair.rigid ? own : 0.5 * (own + energy_of(world.model, partner));
      if (energy == 0.0) continue;
      const FrictionPerArea friction = layer.friction_of(bodies, pair);
      const CellId other = pair.rigid ? CellId(pair.b + 1) : touching.target->id;
      const std::uint64_t step = mixed(noise.step + std::uint64_t{d == 0 ? 0u : 1u << 30});
      for (std::size_t k = 0; k < pair.present(d).size(); ++k) {
        const ContactElement& e = pair.present(d)[k];
        const Vec3d numbers = normal_vector(random, source.id, point_draw(step, other, e.place()));
        const double across = static_cast<double>(e.area()) * friction.tangential, along = static_cast<double>(e.area()) * friction.normal;
        const Vec3d f = along_and_across(numbers, normalized(e.normal<double>()), across, along) * noise.strength(energy);
        if (objective == nullptr) {
          add_to_corners(touching, quadrature, e, f, force);
          continue;
        }
        const ObjectiveElement& element = objective->elements()[first + k];
        for (int c = 0; c < element.count; ++c) force[element.point[c]] += element.share(c, f);
      }
    }
  }
}

void SphereFriction::add_noise(const World& world, const Noise& noise, std::span<Vec3d> force) const {
  const Random random(noise.seed, RandomStream::kFluctuationOfNodes), contact(noise.seed, RandomStream::kFluctuationOfContacts);
  const auto bodies = world.scene.bodies().subspan(world.scene.first_sphere());
  const std::span<Vec3d> on = force.subspan(world.scene.sphere_point());
  const auto energy = [&](std::size_t sphere) { return energy_of(world.model, bodies[sphere].material); };
  const cbm::Spheres& spheres = world.tissue.spheres;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    if (energy(i) == 0.0) continue;
    const double friction = world.model.types[spheres.type[i]].medium_friction * ball_surface(spheres.radius[i]);
    on[i] += normal_vector(random, bodies[i].id, noise.draw(0)) * std::sqrt(2.0 * energy(i) * friction / noise.dt);
  }
  const SpherePairs& list = contacts_.pairs();
  for (std::size_t k = 0; k < list.elements.size(); ++k) {
    const SpherePair& pair = list.pairs[k];
    const SpherePairElement& e = list.elements[k];
    const double kt = 0.5 * (energy(pair.a) + energy(pair.b));
    if (kt == 0.0 || !(e.area > 0.0f)) continue;
    const PairFriction friction = list.friction(pair);
    const Vec3d n{e.n[0], e.n[1], e.n[2]};
    const Vec3d numbers = normal_vector(contact, bodies[pair.a].id, point_draw(noise.step, bodies[pair.b].id, 0));
    const double across = static_cast<double>(e.area) * friction.tangential, along = across + static_cast<double>(e.area) * friction.extra;
    const Vec3d f = along_and_across(numbers, n, across, along) * noise.strength(kt);
    on[pair.a] += f;
    on[pair.b] -= f;
  }
  std::uint64_t number = 0;  // of the obstacle that a sphere touches
  for (std::size_t k = 0; k < list.rigid.size(); ++k) {
    const RigidPairElement& e = list.rigid[k];
    if (k > 0 && list.rigid[k - 1].sphere != e.sphere) number = 0;
    if (energy(e.sphere) == 0.0 || !(e.isotropic + e.axial > 0.0f)) continue;
    const Vec3d numbers = normal_vector(contact, bodies[e.sphere].id, point_draw(noise.step, CellId(), ++number));
    on[e.sphere] += along_and_across(numbers, {e.n[0], e.n[1], e.n[2]}, e.isotropic, static_cast<double>(e.isotropic) + e.axial) *
                    noise.strength(energy(e.sphere));
  }
}

}  // namespace morula
