#include <algorithm>
#include <cmath>

#include "core/mesh/mesh_check.h"
#include "core/space/space.h"
#include "scenarios/study/build.h"
#include "scenarios/study/read_section.h"

namespace morula::scenarios {
namespace {

constexpr double kWithin = 0.5;     // of the larger radius: nearer centres are not driven apart by the contact of the surfaces
constexpr double kCertain = 2.0;    // times the limit: meshes lie a little within their balls
constexpr double kMostFaces = 3e7;  // that are looked at: seconds

struct Placed {
  Vec3d at;
  double radius;
  Place place;
};

std::string place_text(const Vec3d& p) { return "[" + short_number(p.x) + ", " + short_number(p.y) + ", " + short_number(p.z) + "] um"; }

/// Cells with given places that begin as shells.
std::vector<Placed> placed_shells(const BuildContext& c) {
  std::vector<Placed> out;
  const Study& study = c.study;
  for (std::size_t i = 0; i < study.initial.size() && i < c.draft.initial.size(); ++i) {
    const InitialCells& block = study.initial[i];
    if (block.source != InitialCells::Source::kPositions || block.type >= c.draft.cell_types.size()) continue;
    const Given<double>& radius = c.draft.cell_types[block.type].content.radius.mean;
    const BodyKind body = block.body_given ? block.body : study.model.types[block.type].initial_body;
    if (body != BodyKind::kShell || !radius.known() || block.shape != CellShape::kSphere) continue;
    for (const Vec3d& at : block.positions)
      out.push_back({at, radius.value * std::cbrt(block.start_volume_fraction), c.draft.initial[i].content.at.place});
  }
  return out;
}

void check_each_other(BuildContext& c, std::vector<Placed> cells) {
  std::sort(cells.begin(), cells.end(), [](const Placed& a, const Placed& b) { return a.at.x < b.at.x; });
  double largest = 0.0;
  for (const Placed& cell : cells) largest = std::max(largest, cell.radius);
  const double allowed = c.study.model.step.start_cap > 0.0 ? 1e300 : kCertain * c.study.model.limits.overlap;
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (std::size_t j = i + 1; j < cells.size() && cells[j].at.x - cells[i].at.x < 2.0 * largest; ++j) {
      const double apart = norm(cells[j].at - cells[i].at), reach = std::max(cells[i].radius, cells[j].radius);
      const double depth = cells[i].radius + cells[j].radius - apart;
      if (apart >= kWithin * reach && depth > allowed)
        return c.diagnostics.error(597, cells[j].place,
                                   "cells at " + place_text(cells[i].at) + " and " + place_text(cells[j].at) + " overlap by " +
                                       short_number(std::round(100.0 * depth) / 100.0) + " um: the run would stop at its limit",
                                   "place them " + short_number(std::ceil(10.0 * (cells[i].radius + cells[j].radius)) / 10.0) +
                                       " um apart, or let them come apart first with `numerics: {start_cap: 0.2 um}`");
      if (apart >= kWithin * reach) continue;
      return c.diagnostics.error(
          596, cells[j].place,
          "a cell at " + place_text(cells[j].at) + " lies within another one: its centre is " + short_number(apart) + " um from " +
              place_text(cells[i].at),
          "place them at least " + short_number(reach) + " um apart; smaller overlaps come apart with `numerics: {start_cap: 0.2 um}`");
    }
}

void check_obstacles(BuildContext& c, const std::vector<Placed>& cells) {
  for (const ObstacleSpec& obstacle : c.study.model.obstacles) {
    Box box;
    for (const Vec3d& p : obstacle.position) box.include(p);
    if (static_cast<double>(obstacle.faces.size()) * static_cast<double>(cells.size()) > kMostFaces) continue;
    for (const Placed& cell : cells) {
      const bool within = box.contains(cell.at) && std::lround(winding_number(obstacle.position, obstacle.faces, cell.at)) != 0;
      if (within == obstacle.inside) continue;
      c.diagnostics.error(
          596, cell.place,
          "a cell at " + place_text(cell.at) + " has its centre " + (within ? "inside" : "outside") + " obstacle '" + obstacle.name + "'",
          within ? "place it outside, or write `side: inside`" : "with `side: inside` cells begin within the surface");
      break;
    }
  }
}

}  // namespace

void check_places(BuildContext& c) {
  const std::vector<Placed> cells = placed_shells(c);
  check_each_other(c, cells);
  check_obstacles(c, cells);
}

}  // namespace morula::scenarios
