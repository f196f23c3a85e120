#include "dcm/shells.h"

namespace morula::dcm {
namespace {

void add_shape(Shells& shells, const std::shared_ptr<const ReferenceShape>& shape) {
  shells.shape.push_back(shape);
  shells.first_node.push_back(shells.first_node.back() + shape->topology->node_count());
  shells.first_edge.push_back(shells.first_edge.back() + shape->topology->edge_count());
}

}  // namespace

ShellRecord shell_out_of(const Shells& shells, std::size_t i) {
  ShellRecord out;
  out.shape = shells.shape[i];
  for_each_shell_column([&](const auto& column) { column.give(out, column.values(shells, i)); });
  return out;
}

void add_shell(Shells& shells, const ShellRecord& shell) {
  add_shape(shells, shell.shape);
  for_each_shell_column([&](const auto& column) { column.append(shells, column.values(shell)); });
}

void add_shells(Shells& shells, const Shells& from, std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    add_shape(shells, from.shape[i]);
    for_each_shell_column([&](const auto& column) { column.append(shells, column.values(from, i)); });
  }
}

std::size_t memory_of(const Shells& shells) {
  std::size_t bytes = shells.shape.capacity() * sizeof(shells.shape[0]) + shells.face.capacity() * sizeof(FaceState) +
                      (shells.first_node.capacity() + shells.first_edge.capacity()) * sizeof(std::uint32_t);
  for_each_shell_column([&](const auto& column) { bytes += column.memory(shells); });
  return bytes;
}

}  // namespace morula::dcm
