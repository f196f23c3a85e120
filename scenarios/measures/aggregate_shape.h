#pragma once
#include <optional>
#include <span>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/vec3.h"

namespace morula::scenarios {

/// The sphere that the free surface of a cell is a part of.
struct FreeSphere {
  Vec3d center;           ///< [µm]
  double radius = 0.0;    ///< [µm]
  double rms = 0.0;       ///< of the nodes' distances from it [µm]
  std::size_t nodes = 0;  ///< free ones
};

/// Two cells whose free surfaces meet in a line that can be seen from outside.
struct JunctionAngle {
  std::size_t a = 0, b = 0;
  double angle = 0.0;  ///< between the free surface and the contact, half the turn of the two spheres where they meet [rad]
};

/// What the shapes of cells in contact say about their forces, without any model.
struct AggregateShape {
  std::vector<double> contact_part;               ///< by cell: share of its area in contact
  std::vector<std::optional<FreeSphere>> sphere;  ///< by cell; none where it has no free surface to speak of
  std::vector<JunctionAngle> angles;
  double contact_fraction = 0.0;  ///< of the whole surface of all cells

  [[nodiscard]] double mean_angle() const;  ///< [rad]; 0 when no junction is seen
};

/// Measure closed surfaces of cells. A node is in contact when it lies within `contact_gap` of another cell's surface, and free when it lies more than
/// 2.5 µm from all others; areas are thirds of the faces around a node. Spheres are fitted through the free nodes by linear least squares.
/// Cells of equal tension meet in circles: cos ψ = (R_a² + R_b² − d²)/(2 R_a R_b) with the distance d of the centres, angle (π − ψ)/2 (two
/// soap bubbles). A pair counts when free nodes of both come within 5 µm and 0.4 mean edges of each other. (Physics: scenarios.md S17.)
AggregateShape measure_aggregate(std::span<const TriangleMesh> cells, double contact_gap = 0.6);

/// Root mean square, by area, of how far nodes moved along their normals, after the rigid motion of all of them that makes it least [µm].
/// The motion is small: its turn is taken to first order. Both have the same nodes and faces.
double rms_normal_motion(std::span<const TriangleMesh> before, std::span<const TriangleMesh> after);

}  // namespace morula::scenarios
