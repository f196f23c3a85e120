#include "coupling/loads/load_keys.h"
#include "coupling/loads/loads.h"
#include "coupling/loads/surface.h"
#include "coupling/model.h"

namespace morula {
namespace {

void push(const CellLoad& load, const LoadedShell& shell, std::span<Vec3d> force) {
  if (load.mark < 0) {
    const auto nodes = end_nodes(shell.shape, load.axis, load.part);
    for (const std::uint32_t node : nodes) force[node] += load.force * (shell.strength / static_cast<double>(nodes.size()));
    return;
  }
  const Topology& topology = *shell.shape.topology;
  double whole = 0.0;
  for_marked_faces(topology, shell.position, shell.marks, load.mark, [&](const Triangle&, const Vec3d& area) { whole += norm(area); });
  for_marked_faces(topology, shell.position, shell.marks, load.mark, [&](const Triangle& t, const Vec3d& area) {
    add_to_corners(t, load.force * (shell.strength * norm(area) / whole), force);
  });
}

std::vector<LawProblem> judge(const CellLoad& load, const Model& model) {
  std::vector<LawProblem> out;
  keys::judge_marked(load, model, {{"toward", load.axis == Vec3d{1, 0, 0}}, {"part", load.part == 0.02}}, out);
  return out;
}

}  // namespace

std::shared_ptr<const Load> patch_load() {
  using keys::Kind;
  static const auto load = std::make_shared<const Load>(Load{
      .info = {.name = "patch",
               .title = "Force on a part of a surface",
               .equation = "F_i = F/m on the m nodes of a side of the cell (m = 1: a point force), or F_T = F A_T/A on the marked faces",
               .source = "choice of this project",
               .parameters = {given_by_study("force", "force", "nN", "Size of F."), keys::part_of_nodes()}},
      .section = {.name = "patch",
                  .doc =
                      "A force in any direction on one side of the cell, on a single node, or on marked faces: a needle, a bead, a cilium.",
                  .example = "{force: [0 nN, 0 nN, -1 nN], toward: [0, 0, 1], part: 2 %}"},
      .keys =
          {keys::required(Kind::kVector, "force", "The force, in any direction.", Quantity::kForce, "[0 nN, 0 nN, -1 nN]"),
           {Kind::kDirection,
            {.name = "toward",
             .doc = "The side of the undeformed cell that bears it: direction from the centre.",
             .fallback = "[1, 0, 0]",
             .example = "[0, 0, 1]",
             .source = "chosen"}},
           keys::load_part("2 %",
                           "Part of the nodes, those furthest to that side, in equal parts: a fixed set, ties taken in; one node, a point "
                           "force, where that is less than one and a half."),
           keys::load_mark("In place of `toward` and `part`: the faces with this mark bear the force, each its share by area; none while "
                           "no face has it.")},
      .build =
          [](const OwnValues& values, CellLoad& out) {
            out.force = values.vector("force");
            out.axis = values.vector("toward");
            out.part = values("part");
            out.end = LoadEnd::kHigh;
          },
      .judge = &judge,
      .of_chosen_nodes = [](const CellLoad& one) { return one.mark < 0; },
      .push = &push});
  return load;
}

}  // namespace morula
