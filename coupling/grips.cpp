#include "coupling/grips.h"

#include <cmath>

#include "core/parallel/order_free_sum.h"
#include "coupling/loads.h"

namespace morula {
namespace {

/// Function(load number, anchor) for every spring of every grip.
template <class F>
void for_anchors(const Model& model, const Tissue& tissue, double time, F&& function) {
  for (std::size_t l = 0; l < model.loads.size(); ++l) {
    const CellLoad& load = model.loads[l];
    if (load.kind != LoadKind::kGrip) continue;
    const double stiffness = load.size * load.course.at(time);
    if (!(stiffness > 0.0)) continue;
    const Vec3d center = load.center + (load.way.empty() ? Vec3d{} : load.direction * load.way.at(time));
    for (const auto [k, is_shell, shell] : bodies_of(tissue.cells)) {
      const CellRow& row = tissue.cells.rows[k];
      if (is_shell && row.type == load.type) {
        const ReferenceShape& shape = *tissue.shells.shape[shell];
        const double size = std::cbrt(row.target_volume);
        const auto hold = [&, number = shell](const Vec3d& outward) {
          const auto nodes = end_nodes(shape, outward, load.part);
          for (const std::uint32_t node : nodes)
            function(l, Anchor{tissue.shells.first_node[number] + node, stiffness / static_cast<double>(nodes.size()),
                               center + shape.position[node] * size});
        };
        if (load.end != LoadEnd::kLow) hold(load.axis);
        if (load.end != LoadEnd::kHigh) hold(load.axis * -1.0);
      }
    }
  }
}

}  // namespace

std::vector<Anchor> grip_anchors(const Model& model, const Tissue& tissue, double time) {
  std::vector<Anchor> out;
  for_anchors(model, tissue, time, [&](std::size_t, const Anchor& anchor) { out.push_back(anchor); });
  return out;
}

std::vector<Vec3d> grip_forces(const Model& model, const Tissue& tissue, const Comm& comm) {
  std::vector<Vec3d> out(model.loads.size());
  if (out.empty()) return out;
  std::vector<OrderFreeSum> sums(3 * out.size());
  for_anchors(model, tissue, tissue.clock.time, [&](std::size_t load, const Anchor& anchor) {
    const Vec3d force = (anchor.target - tissue.shells.position[anchor.node]) * anchor.stiffness;
    for (std::size_t axis = 0; axis < 3; ++axis) sums[3 * load + axis].add(force[axis]);
  });
  std::vector<double> totals(sums.size());
  comm.sum(sums, totals);
  for (std::size_t l = 0; l < out.size(); ++l) out[l] = {totals[3 * l], totals[3 * l + 1], totals[3 * l + 2]};
  return out;
}

}  // namespace morula
