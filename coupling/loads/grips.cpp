#include "coupling/loads/grips.h"

#include "core/mesh/volume_centroid_gradient.h"
#include "core/parallel/order_free_sum.h"
#include "coupling/loads/loads.h"

namespace morula {

Anchor on_center(Anchor spring, const Tissue& tissue, bool is_shell, std::size_t number) {
  const auto& first = tissue.shells.first_node;
  spring.node = is_shell ? first[number] : static_cast<std::uint32_t>(tissue.shells.node_count() + number);
  spring.shell = is_shell ? static_cast<int>(number) : -1;
  return spring;
}

namespace {

/// Function(load number, anchor) for every spring of every load.
template <class F>
void for_anchors(const Model& model, const Tissue& tissue, double time, F&& function) {
  for (std::size_t l = 0; l < model.loads.size(); ++l) {
    const CellLoad& load = model.loads[l];
    if (!load.what->holds()) continue;
    for (const auto [k, is_shell, number] : bodies_of(tissue.cells)) {
      const CellRow& row = tissue.cells.rows[k];
      if (row.type != load.type) continue;
      if (load.what->hold_center != nullptr) {
        function(l, on_center(load.what->hold_center(load, time), tissue, is_shell, number));
      } else if (is_shell) {
        for (Anchor anchor : load.what->hold(load, *tissue.shells.shape[number], row.target_volume, time)) {
          anchor.node += tissue.shells.first_node[number];
          function(l, anchor);
        }
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

Vec3d held_place(const Anchor& anchor, const Tissue& tissue) {
  const dcm::Shells& shells = tissue.shells;
  if (anchor.shell >= 0) {
    const auto shell = static_cast<std::size_t>(anchor.shell);
    return volume_centroid(shells.topology(shell).faces(), shells.nodes(shell));
  }
  return anchor.node < shells.node_count() ? shells.position[anchor.node] : tissue.spheres.position[anchor.node - shells.node_count()];
}

Vec3d pull_of(const Anchor& anchor, const Tissue& tissue) { return (anchor.target - held_place(anchor, tissue)) * anchor.stiffness; }

void add_pull(const Anchor& anchor, const Tissue& tissue, std::span<Vec3d> force) {
  const dcm::Shells& shells = tissue.shells;
  if (anchor.node >= shells.node_count()) return;
  const Vec3d pull = pull_of(anchor, tissue);
  if (anchor.shell < 0) {
    force[anchor.node] += pull;
    return;
  }
  const auto shell = static_cast<std::size_t>(anchor.shell);
  const auto gradient = volume_centroid_gradient(shells.topology(shell).faces(), shells.nodes(shell));
  for (std::size_t i = 0; i < gradient.size(); ++i) force[anchor.node + i] += transposed_product(gradient[i], pull);
}

std::vector<Vec3d> grip_forces(const Model& model, const Tissue& tissue, const Comm& comm) {
  std::vector<Vec3d> out(model.loads.size());
  if (out.empty()) return out;
  std::vector<OrderFreeSum> sums(3 * out.size());
  for_anchors(model, tissue, tissue.clock.time, [&](std::size_t load, const Anchor& anchor) {
    const Vec3d force = pull_of(anchor, tissue);
    for (std::size_t axis = 0; axis < 3; ++axis) sums[3 * load + axis].add(force[axis]);
  });
  std::vector<double> totals(sums.size());
  comm.sum(sums, totals);
  for (std::size_t l = 0; l < out.size(); ++l) out[l] = {totals[3 * l], totals[3 * l + 1], totals[3 * l + 2]};
  return out;
}

}  // namespace morula
