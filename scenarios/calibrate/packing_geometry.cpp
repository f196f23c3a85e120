#include "scenarios/calibrate/packing_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "cbm/laws/sphere_caps.h"
#include "core/ball.h"

namespace morula::calibrate {
namespace {

constexpr double kBall = 4.0 / 3.0 * std::numbers::pi;
constexpr std::size_t kMostDistances = 10, kMostParts = 8;  // of a packing without order

/// The parts are known: their sums.
void add_up(PackingGeometry& to) {
  double weighted = 0.0;
  for (const PackedPart& part : to.parts) to.press += part.press, weighted += part.press * part.packing;
  to.packing = to.press > 0.0 ? weighted / to.press : 0.0;
}

/// Calls of(first, last) for at most so many runs of nearly equal lengths.
template <class Of>
void in_groups(std::size_t count, std::size_t most, const Of& of) {
  const std::size_t groups = std::min(count, most);
  for (std::size_t g = 0; g < groups; ++g) of(g * count / groups, (g + 1) * count / groups);
}

/// From x to the nearest image, in a period.
double nearest(double x, double period) { return x - period * std::round(x / period); }

/// Spheres in rooms of this volume over R³; `edge`: of a periodic cube [µm], none: no box.
PackingGeometry geometry(std::span<const Vec3d> centers, std::optional<double> edge, double room, double radius) {
  PackingGeometry out;
  out.room = room;
  const auto cells = static_cast<double>(centers.size());
  std::vector<double> distances;
  std::vector<PackedPart> each(centers.size());
  for (std::size_t i = 0; i < centers.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      Vec3d between = centers[i] - centers[j];
      if (edge) between = {nearest(between.x, *edge), nearest(between.y, *edge), nearest(between.z, *edge)};
      const double d = norm(between) / radius;
      if (!(d < 2.0)) continue;
      distances.push_back(d);
      const cbm::SphereCaps caps = cbm::sphere_caps(1.0, 1.0, d);
      for (const std::size_t of : {i, j}) {
        each[of].packing += caps.volume_a / kBall;
        each[of].press += d * caps.slope_a / (3.0 * cells * out.room);
      }
    }
  std::ranges::sort(distances);
  in_groups(distances.size(), kMostDistances, [&](std::size_t first, std::size_t last) {
    double sum = 0.0;
    for (std::size_t k = first; k < last; ++k) sum += distances[k];
    const auto pairs = static_cast<double>(last - first);
    out.neighbours.push_back({2.0 * pairs / cells, sum / pairs});
  });
  std::ranges::stable_sort(each, {}, &PackedPart::packing);
  in_groups(each.size(), kMostParts, [&](std::size_t first, std::size_t last) {
    PackedPart part;
    for (std::size_t k = first; k < last; ++k) part.press += each[k].press, part.packing += each[k].press * each[k].packing;
    if (!(part.press > 0.0)) return;  // nobody touches these
    part.packing /= part.press;
    out.parts.push_back(part);
  });
  add_up(out);
  return out;
}

}  // namespace

PackingGeometry lattice_geometry(Arrangement lattice, double volume_ratio) {
  PackingGeometry out;
  out.room = volume_ratio * kBall;
  if (lattice == Arrangement::kFaceCentred) {
    const double d = std::cbrt(std::numbers::sqrt2 * out.room);
    out.neighbours = {{12.0, d}, {6.0, std::numbers::sqrt2 * d}};
  } else {
    const double d = std::cbrt(0.75 * std::numbers::sqrt3 * out.room);
    out.neighbours = {{8.0, d}, {6.0, 2.0 / std::numbers::sqrt3 * d}};
  }
  if (out.neighbours[1].distance > 2.0) out.neighbours.pop_back();
  PackedPart all;
  for (const Neighbours& shell : out.neighbours) {
    const cbm::SphereCaps caps = cbm::sphere_caps(1.0, 1.0, shell.distance);
    all.packing += shell.count * caps.volume_a / kBall;
    // The disc between two equal spheres bears the mean of their pressures, on both caps half of it each.
    all.press += shell.count * shell.distance * (caps.slope_a + caps.slope_b) / (6.0 * out.room);
  }
  out.parts.push_back(all);
  add_up(out);
  return out;
}

PackingGeometry geometry_of_places(std::span<const Vec3d> centers, double edge, double radius) {
  return geometry(centers, edge, std::pow(edge / radius, 3.0) / static_cast<double>(centers.size()), radius);
}

PackingGeometry geometry_of_cluster(std::span<const Vec3d> centers, double radius) { return geometry(centers, {}, kBall, radius); }

double packing_of_pair(double overlap) { return cbm::sphere_caps(1.0, 1.0, 2.0 - overlap).volume_a / kBall; }

double packing_force_of_pair(const cbm::PackingCurve& curve, double radius_a, double radius_b, double overlap) {
  if (curve.empty() || !(overlap > 0.0)) return 0.0;
  const cbm::SphereCaps caps = cbm::sphere_caps(radius_a, radius_b, radius_a + radius_b - overlap);
  return caps.slope_a * curve.at(caps.volume_a / ball_volume(radius_a)).pressure +
         caps.slope_b * curve.at(caps.volume_b / ball_volume(radius_b)).pressure;
}

PairModel with_packing(PairModel pair, cbm::PackingCurve curve) {
  return [pair = std::move(pair), curve = std::move(curve)](double overlap, double reduced_radius) {
    PairAnswer out = pair(overlap, reduced_radius);
    out.force += packing_force_of_pair(curve, 2.0 * reduced_radius, 2.0 * reduced_radius, overlap);
    return out;
  };
}

double pair_pressure(const PackingGeometry& at, double radius, const PairModel& pair) {
  double sum = 0.0;
  for (const Neighbours& shell : at.neighbours)
    sum += shell.count * shell.distance * pair((2.0 - shell.distance) * radius, 0.5 * radius).force;
  return sum / (6.0 * at.room * radius * radius) + at.extra;
}

double curve_pressure(const PackingGeometry& at, const cbm::PackingCurve& curve) {
  double sum = 0.0;
  for (const PackedPart& part : at.parts) sum += part.press * curve.at(part.packing).pressure;
  return sum;
}

}  // namespace morula::calibrate
