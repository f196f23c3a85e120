// The one file that includes CGAL's mesh processing: its headers take long to compile, and are under GPL-3-or-later. A build without them has
// no_remeshing.cpp in its place.
#include "core/mesh/isotropic_remeshing.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

namespace morula {

bool has_isotropic_remeshing() { return true; }

std::optional<TriangleMesh> isotropic_remeshing(const TriangleMesh& mesh, double edge, int iterations) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
  namespace parameters = CGAL::parameters;
  // CGAL reports broken preconditions by exceptions: they end here.
  try {
    Surface surface;
    for (const Vec3d& p : mesh.position) surface.add_vertex(Kernel::Point_3(p.x, p.y, p.z));
    using Vertex = Surface::Vertex_index;
    for (const Triangle& face : mesh.faces)
      if (surface.add_face(Vertex(face[0]), Vertex(face[1]), Vertex(face[2])) == Surface::null_face()) return std::nullopt;
    CGAL::Polygon_mesh_processing::isotropic_remeshing(
        surface.faces(), edge, surface,
        parameters::number_of_iterations(static_cast<unsigned int>(iterations)).number_of_relaxation_steps(3).do_project(true));
    surface.collect_garbage();
    TriangleMesh out;
    for (const Vertex v : surface.vertices()) out.position.push_back({surface.point(v).x(), surface.point(v).y(), surface.point(v).z()});
    for (const auto f : surface.faces()) {
      Triangle face{};
      std::size_t corner = 0;
      for (const Vertex v : surface.vertices_around_face(surface.halfedge(f)))
        if (corner < 3) face[corner++] = static_cast<std::uint32_t>(v.idx());
      out.faces.push_back(face);
    }
    return out;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace morula
