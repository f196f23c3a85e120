#include <cmath>

#include "coupling/loads/load_keys.h"
#include "coupling/loads/loads.h"
#include "coupling/model.h"

namespace morula {
namespace {

std::vector<Anchor> hold(const CellLoad& load, const ReferenceShape& shape, double target_volume, double time) {
  std::vector<Anchor> out;
  const double stiffness = load.size * load.course.at(time);
  if (!(stiffness > 0.0)) return out;
  const Vec3d center = load.center + (load.way.empty() ? Vec3d{} : load.direction * load.way.at(time));
  const double size = std::cbrt(target_volume);
  const auto add = [&](const Vec3d& outward) {
    const auto nodes = end_nodes(shape, outward, load.part);
    for (const std::uint32_t node : nodes)
      out.push_back({node, stiffness / static_cast<double>(nodes.size()), center + shape.position[node] * size});
  };
  if (load.end != LoadEnd::kLow) add(load.axis);
  if (load.end != LoadEnd::kHigh) add(load.axis * -1.0);
  return out;
}

void build(const OwnValues& values, CellLoad& out) {
  out.size = values("stiffness");
  keys::set_ends(values, out);
  out.center = values.vector("center");
  out.direction = values.vector("direction");
  out.way = values.course("way");
}

std::vector<OwnKey> grip_keys() {
  using keys::Kind;
  return {
      keys::hold_stiffness("Stiffness of the springs of one end together."),
      keys::required(Kind::kVector, "center",
                     "Centre of the undeformed cell whose end nodes the grip holds; where the cell is placed, unless the grip shall push "
                     "at once.",
                     Quantity::kLength, "[0 um, 0 um, 6 um]"),
      keys::load_axis("Axis that tells the ends."),
      keys::load_part("10 %", "Part of the nodes at each end that are held: a fixed set, ties taken in."),
      keys::load_ends(),
      keys::way_direction(),
      keys::way()};
}

}  // namespace

std::shared_ptr<const Load> grip_load() {
  static const auto load = std::make_shared<const Load>(Load{
      .info = {.name = "grip",
               .title = "Springs that hold or move the ends of a cell",
               .equation =
                   "E = ½ K/m Σ |x_i − X_i(t)|² over the m nodes of an end; X_i: where they are on the undeformed cell at the grip's "
                   "place",
               .source = "choice of this project",
               .parameters = {given_by_study("stiffness", "tension", "nN/µm", "K of the springs of an end together."),
                              keys::part_of_nodes()}},
      .section = {.name = "grip",
                  .doc =
                      "Springs that hold the nodes at the ends of an axis where they are on an undeformed cell, and move them: a holding "
                      "pipette, a glued bead. `course` is a factor of the stiffness.",
                  .example = "{stiffness: 10 mN/m, center: [0 um, 0 um, 6 um], part: 10 %, ends: high}"},
      .keys = grip_keys(),
      .build = &build,
      .judge = &keys::judge_places,
      .of_chosen_nodes = [](const CellLoad&) { return true; },
      .hold = &hold});
  return load;
}

}  // namespace morula
