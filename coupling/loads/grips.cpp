#include "coupling/loads/grips.h"

#include "core/parallel/order_free_sum.h"
#include "coupling/loads/loads.h"

namespace morula {
namespace {

/// Function(load number, anchor) for every spring of every grip.
template <class F>
void for_anchors(const Model& model, const Tissue& tissue, double time, F&& function) {
  for (std::size_t l = 0; l < model.loads.size(); ++l) {
    const CellLoad& load = model.loads[l];
    if (load.what->hold == nullptr) continue;
    for (const auto [k, is_shell, shell] : bodies_of(tissue.cells)) {
      const CellRow& row = tissue.cells.rows[k];
      if (!is_shell || row.type != load.type) continue;
      for (Anchor anchor : load.what->hold(load, *tissue.shells.shape[shell], row.target_volume, time)) {
        anchor.node += tissue.shells.first_node[shell];
        function(l, anchor);
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
