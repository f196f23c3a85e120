#include "core/mesh/renewal/divide_surface.h"

#include <algorithm>
#include <cmath>

#include "core/mesh/remesh.h"
#include "core/mesh/renewal/transfer_marks.h"

namespace morula {
namespace {

/// Another pole first; then ways that draw nodes into sharp edges, and strong holds along the surface, which make even faces (decision 0038).
struct Rung {
  RenewalWay way;
  int tilt;
};
constexpr std::array<Rung, 9> kLadder = {{{{1.0, 0.2}, 0},
                                          {{1.0, 0.2}, 1},
                                          {{1.0, 0.2, 8, 0.05}, 0},
                                          {{1.0, 0.4, 8, 0.1}, 0},
                                          {{1.0, 0.8, 8, 0.3}, 1},
                                          {{3.0, 0.1, 10}, 0},
                                          {{0.3, 0.5}, 0},
                                          {{3.0, 0.5}, 0},
                                          {{1.0, 1.0}, 0}}};

/// A half of a ball has 0.63 of its area, the cap not counted.
constexpr double kAreaOfHalf = 0.63;

void measure_rim(const ClosedHalf& half, const Topology& topology, Daughter& daughter) {
  const TriangleTree tree(daughter.position, topology.faces());
  double sum = 0.0, largest = 0.0;
  for (std::uint32_t k = 0; k < half.rim_nodes; ++k) {
    const double d2 = tree.nearest(half.mesh.position[half.first_rim_node + k])->closest.distance2;
    sum += d2;
    largest = std::max(largest, d2);
  }
  daughter.rim_rms = std::sqrt(sum / half.rim_nodes);
  daughter.rim_largest = std::sqrt(largest);
}

}  // namespace

Result<Daughter> map_half(const ClosedHalf& half, const AskedSurface& surface, std::span<const AskedSurface* const> walls,
                          const ReferenceShape& shape, double volume, const RenewalLimits& limits) {
  const Topology& topology = *shape.topology;
  const TwoDiskMap map(half);
  std::vector<Vec3d> direction;
  for (const Vec3d& x : shape.position) direction.push_back(normalized(x));
  RenewalReport best;
  for (std::size_t rung = 0; rung < kLadder.size(); ++rung) {
    RenewedSurface tried =
        renew_by(surface, walls, topology, place_nodes(map, direction, kLadder[rung].tilt), volume, kLadder[rung].way, limits);
    tried.report.rung = static_cast<int>(rung);
    if (!is_within(tried.report, limits)) {
      if (rung == 0 || tried.report.least_quality > best.least_quality) best = tried.report;
      continue;
    }
    Daughter out;
    out.position = std::move(tried.position);
    out.report = tried.report;
    measure_rim(half, topology, out);
    std::vector<char> in_cap(half.mesh.faces.size(), 0);
    std::fill(in_cap.begin() + half.first_cap_face, in_cap.end(), char{1});
    out.is_cap = transfer_marks(surface, in_cap, {out.position, &topology});
    return out;
  }
  return no_mesh_holds("no mesh of " + std::to_string(topology.node_count()) + " nodes holds this half", best, limits);
}

Result<Division> divide_surface(const SurfaceView& surface, const DivisionPlan& plan) {
  const auto faces = surface.topology->faces();
  const TriangleMesh mother{{surface.position.begin(), surface.position.end()}, {faces.begin(), faces.end()}};
  Division out;
  const double spacing = edge_of_nodes(kAreaOfHalf * surface_area(mother), plan.shape->topology->node_count());
  MORULA_TRY_ASSIGN(out.cut, cut_in_two(surface, plan.normal, plan.share, spacing));
  const double volume = enclosed_volume(faces, surface.position, volume_centroid(faces, surface.position));

  for (const ClosedHalf& half : out.cut.half) {
    MORULA_TRY_ASSIGN(AskedSurface asked, AskedSurface::build(half.mesh));
    out.asked.push_back(std::move(asked));
  }
  const double reach = spacing;
  std::vector<AskedSurface> neighbours;
  for (const SurfaceView& neighbour : plan.neighbours) {
    Box box, own;
    for (const Vec3d& x : neighbour.position) box.include(x);
    for (const Vec3d& x : surface.position) own.include(x);
    if (box.overlaps(own.inflated(reach))) neighbours.emplace_back(neighbour);
  }
  for (std::size_t side = 0; side < 2; ++side) {
    std::vector<const AskedSurface*> walls;
    for (const AskedSurface& neighbour : neighbours) walls.push_back(&neighbour);
    walls.push_back(&out.asked[1 - side]);
    const double part = side == 0 ? plan.share : 1.0 - plan.share;
    auto daughter = map_half(out.cut.half[side], out.asked[side], walls, *plan.shape, part * volume, plan.limits);
    if (!daughter.ok()) {
      Error error = std::move(daughter).error();
      error.message = (side == 0 ? "the daughter above the plane: " : "the daughter below the plane: ") + error.message;
      return error;
    }
    out.daughter[side] = std::move(daughter).value();
  }
  return out;
}

}  // namespace morula
