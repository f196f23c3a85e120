#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "core/contact/rigid_surface.h"
#include "core/mesh/renewal/surface_view.h"
#include "core/space/space.h"
#include "coupling/mechanics/scene.h"

namespace morula {

/// The surfaces around a shell of a scene.
struct Surroundings {
  std::vector<SurfaceView> surfaces;        ///< spans of the scene or of `moved`: they hold as long as both stay
  std::vector<std::vector<Vec3d>> moved{};  ///< positions of those that are nearest through a periodic face [µm]
};

/// The other shells of the scene, ghosts too, whose boxes come closer than `reach` [µm] to that of an owned shell; in a periodic space they are
/// where they are nearest. The same on any number of ranks for a reach within that of the ghosts.
Surroundings surroundings_of(const Scene& scene, const Space& space, std::size_t shell, double reach);

/// Adds the obstacles, moved by `offset` each [µm], and their images across periodic faces, whose boxes come closer than that to a shell.
void add_obstacles(std::span<const RigidSurface> obstacles, std::span<const Vec3d> offset, const Space& space, std::span<const Vec3d> shell,
                   double reach, Surroundings& around);

}  // namespace morula
