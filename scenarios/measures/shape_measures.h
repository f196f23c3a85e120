#pragma once
#include <optional>
#include <span>
#include <vector>

#include "core/mesh/topology.h"
#include "core/vec3.h"
#include "results/snapshot.h"

namespace morula::scenarios {

/// A shell of a snapshot with what measures look at.
struct ShellView {
  std::span<const Vec3d> nodes;
  std::span<const Triangle> faces;
  const Snapshot::Cell* cell = nullptr;
};

/// The shells of a cell type in a snapshot, in the order of their ids.
std::vector<ShellView> shells_of(const Snapshot& snapshot, std::size_t type);

/// Largest minus smallest coordinate along an axis of length 1 [µm].
double extent(std::span<const Vec3d> nodes, const Vec3d& axis);

/// How much the nodes of an icosphere lie outside the sphere of the same volume: radius of that sphere over the nodes' distance from the
/// centre (0.9886, 0.9971, 0.9993 for 162, 642, 2562 nodes). A sphere through nodes, times this, is the surface that the mesh stands for.
/// 1 for another number of nodes.
double node_to_volume_radius(std::size_t nodes);

/// Radial displacement of a shell against its unloaded state as u0 + u2 P2(cos θ), θ from the axis, by least squares weighted with the
/// unloaded state's node areas.
struct SecondMode {
  double axial = 0.0;       ///< strain (u0 + u2)/R
  double transverse = 0.0;  ///< strain (u0 − u2/2)/R
  double residual = 0.0;    ///< root mean square of what the two modes leave over, relative to R
};
/// Both states have the same nodes; each is measured from its own centroid. R: mean radius of the unloaded state.
SecondMode fit_second_mode(const ShellView& unloaded, const ShellView& loaded, const Vec3d& axis);

/// A cell sitting on a plane as a spherical cap.
struct CapFit {
  double radius = 0.0;          ///< R of the free surface [µm]
  double angle = 0.0;           ///< between the plane and the free surface; 0: a sphere that touches, π/2: a hemisphere [rad]
  double contact_radius = 0.0;  ///< R sin(angle) [µm]
  double height = 0.0;          ///< R (1 + cos(angle)) [µm]
};
/// Sphere by linear least squares (Σ (|x|² − 2 c·x − k)² least) through the nodes of the half that is farther from the plane, its radius
/// times node_to_volume_radius. `point` lies on the plane, `normal` (of length 1) points from it to the cell. Nothing when the nodes span no
/// sphere.
std::optional<CapFit> fit_cap(const ShellView& shell, const Vec3d& point, const Vec3d& normal);

/// Area of the surface within `distance` of the plane, by the nodes: the radius of a disc that holds the nodes nearer than that, measured as
/// their largest distance from the normal through their mean [µm]. 0: none.
double flat_radius(const ShellView& shell, const Vec3d& point, const Vec3d& normal, double distance);

/// Mean curvature 1/R of the side of a shell that looks along `axis` (of length 1), positive where it bulges outwards [1/µm]: a paraboloid, however tilted,
/// by least squares through the nodes nearer than `radius` to the line through the centroid [µm]. Nothing when fewer than six nodes lie there.
std::optional<double> curvature_along(const ShellView& shell, const Vec3d& axis, double radius);

}  // namespace morula::scenarios
