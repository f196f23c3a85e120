#include "coupling/loads/load_keys.h"
#include "coupling/loads/loads.h"

namespace morula {
namespace {

void push(const CellLoad& load, const LoadedShell& shell, std::span<Vec3d> force) {
  const double size = load.size * shell.strength;
  const auto add = [&](const Vec3d& outward) {
    const auto nodes = end_nodes(shell.shape, outward, load.part);
    for (const std::uint32_t node : nodes) force[node] += outward * (size / static_cast<double>(nodes.size()));
  };
  if (load.end != LoadEnd::kLow) add(load.axis);
  if (load.end != LoadEnd::kHigh) add(load.axis * -1.0);
}

}  // namespace

std::shared_ptr<const Load> pull_load() {
  using keys::Kind;
  static const auto load = std::make_shared<const Load>(Load{
      .info = {.name = "pull",
               .title = "Pull at both ends of a cell (optical tweezers)",
               .equation = "F_i = ±F a/m on the m nodes of an end of the axis a",
               .source = "Dao, Lim & Suresh 2003, doi:10.1016/j.jmps.2003.09.019",
               .parameters = {given_by_study("force", "force", "nN", "F at each end."), keys::part_of_nodes()}},
      .section = {.name = "pull",
                  .doc = "A force spread evenly over the nodes at the ends of an axis, outwards: beads, grips, tweezers.",
                  .example = "{force: 100 pN, axis: [1, 0, 0], part: 2 %}"},
      .keys = {keys::required(Kind::kQuantity, "force", "Force at each end, outwards.", Quantity::kForce, "100 pN"),
               keys::load_axis("Axis along which the force acts."),
               keys::load_part("2 %", "Part of the nodes at each end that bear the force: a fixed set, ties taken in."), keys::load_ends()},
      .build =
          [](const OwnValues& values, CellLoad& out) {
            out.size = values("force");
            keys::set_ends(values, out);
          },
      .of_chosen_nodes = [](const CellLoad&) { return true; },
      .push = &push});
  return load;
}

}  // namespace morula
