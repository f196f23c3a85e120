#pragma once
#include <memory>
#include <vector>

#include "core/contact/rigid_surface.h"
#include "coupling/mechanics/following_loads.h"
#include "coupling/mechanics/held_nodes.h"
#include "coupling/mechanics/interior_system.h"
#include "coupling/mechanics/membranes.h"
#include "coupling/mechanics/node_friction.h"
#include "coupling/mechanics/nucleus_system.h"
#include "coupling/mechanics/sphere_contacts.h"
#include "coupling/mechanics/surface_contacts.h"
#include "coupling/mechanics/term.h"

namespace morula {

/// All that acts on points, in the order in which forces and friction are summed: it is a part of the result's bits.
///
/// Beside the list, those that somebody asks for what they found.
struct Terms {
  std::vector<std::unique_ptr<Term>> all;
  Membranes* membranes = nullptr;
  NodeFriction* node_friction = nullptr;
  SurfaceContacts* contacts = nullptr;
  SphereContacts* spheres = nullptr;
  InteriorSystem* interior = nullptr;
  NucleusSystem* nuclei = nullptr;
  Grips* grips = nullptr;
  FollowingLoads* following = nullptr;
  HeldNodes* kinks = nullptr;
};

/// The list: here a new term gets its line.
Terms make_terms(const Model& model, RigidSurfaces obstacles, int threads);

}  // namespace morula
