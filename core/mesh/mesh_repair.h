#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace morula {

/// A mesh after mending, and what was mended.
struct MeshRepair {
  TriangleMesh mesh;
  std::vector<std::uint32_t> face;   ///< number in the given mesh of each face that is left
  std::vector<std::string> repairs;  ///< for the log: what and where, with numbers of the given mesh; empty: nothing had to be mended
};

/// Mend what can be mended without a guess about the shape:
/// - points nearer than 10⁻⁶ of the diagonal become one, points without faces go;
/// - faces that name a node twice, and double faces, go; two faces with the same nodes that face each other go both;
/// - a face without area is given to its neighbours: a needle's short edge is drawn together, a cap's long edge is turned;
/// - patches of faces that run against the rest of their surface are turned over, as is a closed surface that is inside out.
/// Holes, crossings and surfaces that are none (edges with three faces) stay: check_mesh() names them. Precondition: indices valid, coordinates
/// finite.
MeshRepair repair_mesh(const TriangleMesh& mesh);

}  // namespace morula
