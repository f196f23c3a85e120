#include "core/mesh/renewal/renew_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/mesh/renewal/even_out.h"
#include "core/mesh/renewal/surface_fit.h"
#include "core/mesh/self_intersection.h"

namespace morula {
namespace {

constexpr int kSweeps = 30;
constexpr double kJudgedSpacing = 0.8;  // of the mean edge, between samples of both surfaces
constexpr double kVolumeError = 1e-12;

/// A strong hold along the surface makes even faces and rounds edges off, a weak one lets nodes go into sharp edges; a large θ keeps nodes
/// in long tips (decision 0038).
constexpr std::array<RenewalWay, 5> kWays = {{{1.0, 0.2}, {3.0, 0.1, 10}, {0.3, 0.5}, {3.0, 0.5}, {1.0, 1.0}}};

bool is_close_and_even(const RenewalReport& report, const RenewalLimits& limits) {
  return report.least_quality >= limits.least_quality && report.distance.largest() <= limits.most_distance * report.mean_edge;
}

}  // namespace

RenewalReport judge(const AskedSurface& surface, const Topology& topology, std::span<const Vec3d> position, double volume,
                    const RenewalLimits& limits) {
  RenewalReport out;
  const AskedSurface mesh(SurfaceView{position, &topology});
  out.least_quality = least_quality(topology.faces(), position);
  out.mean_edge = std::sqrt(4.0 * mesh.area() / (std::sqrt(3.0) * topology.face_count()));
  out.distance = surface_distance(surface, mesh, kJudgedSpacing * out.mean_edge);
  const Vec3d center = volume_centroid(topology.faces(), position);
  out.volume_error = enclosed_volume(topology.faces(), position, center) / volume - 1.0;
  out.area_change = mesh.area() / surface.area() - 1.0;
  if (is_close_and_even(out, limits)) out.crosses_itself = !find_self_intersections(position, topology.faces(), 1).empty();
  return out;
}

bool is_within(const RenewalReport& report, const RenewalLimits& limits) {
  return is_close_and_even(report, limits) && !report.crosses_itself && std::abs(report.volume_error) <= kVolumeError;
}

RenewedSurface renew_by(const AskedSurface& surface, std::span<const AskedSurface* const> walls, const Topology& topology,
                        std::vector<SurfacePlace> place, double volume, const RenewalWay& way, const RenewalLimits& limits) {
  even_out(surface, topology, way.theta, kSweeps, place);
  RenewedSurface out;
  out.position = fit_to_surface(surface, walls, topology, place, volume, {way.tangential_hold, way.steps, way.crease_width});
  out.report = judge(surface, topology, out.position, volume, limits);
  return out;
}

Result<RenewedSurface> renew_by_ladder(const AskedSurface& surface, std::span<const AskedSurface* const> walls, const Topology& topology,
                                       const std::vector<SurfacePlace>& place, double volume, const RenewalLimits& limits,
                                       const std::string& what) {
  RenewalReport best;
  for (std::size_t rung = 0; rung < kWays.size(); ++rung) {
    RenewedSurface tried = renew_by(surface, walls, topology, place, volume, kWays[rung], limits);
    tried.report.rung = static_cast<int>(rung);
    if (is_within(tried.report, limits)) return tried;
    if (rung == 0 || tried.report.least_quality > best.least_quality) best = tried.report;
  }
  return no_mesh_holds(what, best, limits);
}

Error no_mesh_holds(const std::string& what, const RenewalReport& best, const RenewalLimits& limits) {
  char text[200];
  std::snprintf(text, sizeof text, ": the best try has a least quality of %.2f (%.2f needed), is %.2f edges off (%.2f allowed)%s",
                best.least_quality, limits.least_quality, best.distance.largest() / best.mean_edge, limits.most_distance,
                best.crosses_itself ? " and crosses itself" : "");
  return {ErrorKind::kPhysics, what + text, "it needs connectivity of its own, or more nodes"};
}

Result<RenewedSurface> redistribute(const SurfaceView& surface, std::span<const SurfaceView> neighbours, const RenewalLimits& limits) {
  const Topology& topology = *surface.topology;
  MORULA_TRY_ASSIGN(const auto old, SurfaceAmongWalls::of(surface, neighbours));
  std::vector<SurfacePlace> start;
  for (std::uint32_t n = 0; n < topology.node_count(); ++n) start.push_back({topology.faces_of_node(n)[0], surface.position[n]});

  return renew_by_ladder(old.surface, old.walls(), topology, start, old.volume, limits,
                         "the nodes of this surface cannot be redistributed");
}

}  // namespace morula
