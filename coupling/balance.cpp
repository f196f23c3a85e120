#include "coupling/balance.h"

#include "core/space/curve.h"
#include "coupling/cell_record.h"

namespace morula {
namespace {

double local_weight(const Tissue& tissue) {
  return static_cast<double>(tissue.spheres.size()) +
         3.0 * static_cast<double>(tissue.shells.node_count() + tissue.nuclei.shells.node_count());
}

std::size_t node_count(const ShellRecord& shell) {
  return shell.position.size() + (shell.nuclear_shell ? shell.nuclear_shell->position.size() : 0);
}

}  // namespace

void renew_order(Tissue& tissue) {
  auto cells = take_apart(tissue);
  for (CellRecord& cell : cells) cell.row.order = curve_place(cell.center());
  put_together(tissue, std::move(cells));
}

double imbalance(const Tissue& tissue, const Comm& comm) {
  const double mine = local_weight(tissue);
  OrderFreeSum sum;
  sum.add(mine);
  const double total = comm.sum(sum);
  return total > 0.0 ? comm.max(mine) * comm.size() / total : 1.0;
}

BalanceReport balance(Tissue& tissue, Partition& partition, ShapeLibrary& shapes, const Comm& comm) {
  if (comm.size() == 1) return {};
  auto cells = take_apart(tissue);
  std::vector<Vec3d> position;
  std::vector<double> weight;
  for (const CellRecord& cell : cells) {
    position.push_back(cell.center());
    weight.push_back(cell_weight(cell.row, cell.shell ? node_count(*cell.shell) : 1));
  }
  const std::vector<int> owner = partition.balance(position, weight, comm);
  std::vector<CellRecord> kept;
  Mail outgoing;
  BalanceReport report;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (owner[i] == comm.rank()) {
      kept.push_back(std::move(cells[i]));
    } else {
      append_bytes(cells[i], outgoing[owner[i]]);
      ++report.moved;
    }
  }
  for (const auto& [rank, bytes] : comm.exchange(std::move(outgoing))) {
    auto arrived = read_records(bytes, shapes);
    std::move(arrived.begin(), arrived.end(), std::back_inserter(kept));
  }
  put_together(tissue, std::move(kept));
  report.moved = comm.sum(report.moved);
  report.imbalance = imbalance(tissue, comm);
  return report;
}

}  // namespace morula
