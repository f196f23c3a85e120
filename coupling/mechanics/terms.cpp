#include "coupling/mechanics/terms.h"

#include <utility>

#include "coupling/mechanics/apical_dampers.h"
#include "coupling/mechanics/apical_springs.h"
#include "coupling/mechanics/face_tensions.h"

namespace morula {

Terms make_terms(const Model& model, RigidSurfaces obstacles, int threads) {
  Terms out;
  const auto add = [&out](auto term) {
    auto* const here = term.get();
    out.all.push_back(std::move(term));
    return here;
  };
  auto node_friction = std::make_unique<NodeFriction>(model);
  out.membranes = add(std::make_unique<Membranes>(model, *node_friction));
  out.node_friction = add(std::move(node_friction));
  out.contacts = add(std::make_unique<SurfaceContacts>(model, std::move(obstacles), threads));
  out.spheres = add(std::make_unique<SphereContacts>(model, *out.contacts));
  out.interior = add(std::make_unique<InteriorSystem>(model));
  out.nuclei = add(std::make_unique<NucleusSystem>(model, *out.membranes, threads));
  add(std::make_unique<FaceTensions>(model));
  add(std::make_unique<ApicalSprings>(model));
  add(std::make_unique<ApicalDampers>(model));
  add(std::make_unique<ContactFriction>(*out.contacts));
  add(std::make_unique<SphereFriction>(*out.spheres));
  out.grips = add(std::make_unique<Grips>());
  out.following = add(std::make_unique<FollowingLoads>());
  out.kinks = add(std::make_unique<HeldNodes>());
  return out;
}

}  // namespace morula
