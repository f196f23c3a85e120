#include "coupling/before_step.h"

#include <cstring>
#include <type_traits>

namespace morula {
namespace {

/// visit(member) for the columns of CellRow that grow.
template <class Visit>
void for_each_growing_member(Visit&& visit) {
  for_each_cell_column([&](const CellColumn& column, auto member) {
    if constexpr (requires(const CellRow& row) { row.*member; })
      if (column.grows) visit(member);
  });
}

/// Bytes of a row's values that grow.
std::size_t growing_bytes() {
  std::size_t bytes = 0;
  for_each_growing_member([&](auto member) { bytes += sizeof(CellRow().*member); });
  return bytes;
}

/// Whether an optional value is declared to grow.
template <class T>
bool grows(T OptionalValues::*value) {
  bool out = false;
  for_each_cell_column([&](const CellColumn& column, auto member) {
    if constexpr (std::is_same_v<decltype(member), T OptionalValues::*>) out = out || (member == value && column.grows);
  });
  return out;
}

/// visit(member of OptionalColumns) for those that grow.
template <class Visit>
void for_each_growing_optional(Visit&& visit) {
  OptionalColumns::for_each_member([&](auto column, auto value) {
    if (grows(value)) visit(column);
  });
}

void copy_growing(dcm::Shells& to, const dcm::Shells& from) {
  dcm::for_each_shell_column([&](const auto& column) {
    if (column.rules.grows) column.copy(to, from);
  });
}

void copy_growing(cbm::Spheres& to, const cbm::Spheres& from) {
  cbm::for_each_sphere_column([&](const auto& column) {
    if (column.rules.grows) column.copy(to, from);
  });
}

}  // namespace

void BeforeStep::keep(const Tissue& tissue) {
  const Cells& cells = tissue.cells;
  of_rows_.resize(cells.size() * growing_bytes());
  std::byte* next = of_rows_.data();
  for (const CellRow& row : cells.rows)
    for_each_growing_member([&](auto member) {
      std::memcpy(next, &(row.*member), sizeof(row.*member));
      next += sizeof(row.*member);
    });
  for_each_growing_optional([&](auto member) { optional_.*member = cells.optional.*member; });
  std::size_t k = 0;
  for (const VariableColumn& variable : cells.variables) {
    if (!variable.what.grows) continue;
    if (variables_.size() == k) variables_.emplace_back();
    variables_[k++] = variable.values;
  }
  copy_growing(shells_, tissue.shells);
  copy_growing(nuclei_, tissue.nuclei.shells);
  copy_growing(spheres_, tissue.spheres);
}

void BeforeStep::restore(Tissue& tissue) const {
  Cells& cells = tissue.cells;
  const std::byte* next = of_rows_.data();
  for (CellRow& row : cells.rows)
    for_each_growing_member([&](auto member) {
      std::memcpy(&(row.*member), next, sizeof(row.*member));
      next += sizeof(row.*member);
    });
  for_each_growing_optional([&](auto member) { cells.optional.*member = optional_.*member; });
  std::size_t k = 0;
  for (VariableColumn& variable : cells.variables)
    if (variable.what.grows) variable.values = variables_[k++];
  copy_growing(tissue.shells, shells_);
  copy_growing(tissue.nuclei.shells, nuclei_);
  copy_growing(tissue.spheres, spheres_);
}

std::size_t BeforeStep::memory() const {
  std::size_t bytes = cbm::memory_of(spheres_) + dcm::memory_of(shells_) + dcm::memory_of(nuclei_) + of_rows_.capacity();
  OptionalColumns::for_each(optional_, [&](const auto& column) { bytes += column.memory(); });
  for (const auto& column : variables_) bytes += column.memory();
  return bytes;
}

}  // namespace morula
