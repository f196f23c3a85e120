#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "coupling/cell_record.h"

namespace morula {
namespace {

/// A different value for each byte, so that a column that is left out, or that comes back as another, is noticed.
template <class Value>
std::vector<Value> some_values(std::size_t count, std::uint8_t& next) {
  std::vector<Value> out(count);
  auto* bytes = reinterpret_cast<std::uint8_t*>(out.data());
  for (std::size_t i = 0; i < count * sizeof(Value); ++i)
    bytes[i] = static_cast<std::uint8_t>(next++ % 127);  // no NaN, no id that is not valid
  return out;
}

template <class Column, class Record>
bool same_values(const Column& column, const Record& a, const Record& b) {
  const auto left = column.values(a), right = column.values(b);
  return left.size() == right.size() && (left.empty() || std::memcmp(left.data(), right.data(), left.size_bytes()) == 0);
}

CellRecord shell_cell(std::uint64_t number, ShapeLibrary& shapes, std::uint8_t seed, bool with_all) {
  CellRecord cell;
  cell.row.id = CellId::founder(number);
  cell.row.order = 1000 - 7 * number;
  cell.row.body = BodyKind::kShell;
  ShellRecord shell;
  shell.shape = shapes.icosphere(42).value();
  dcm::for_each_shell_column([&](const auto& column) {
    using Column = std::remove_cvref_t<decltype(column)>;
    if (Column::kFill == Fill::kAll || with_all)
      column.give(shell, some_values<typename Column::Value>(dcm::count_of(Column::kDomain, *shell.shape), seed));
  });
  cell.row.type = shell.type;
  cell.shell = std::move(shell);
  return cell;
}

CellRecord sphere_cell(std::uint64_t number, std::uint8_t seed) {
  CellRecord cell;
  cell.row.id = CellId::founder(number);
  cell.row.order = 1000 - 7 * number;
  SphereRecord sphere;
  cbm::for_each_sphere_column([&](const auto& column) {
    using Column = std::remove_cvref_t<decltype(column)>;
    column.give(sphere, some_values<typename Column::Value>(Column::kFill == Fill::kAll ? 1 : 3, seed));
  });
  cell.row.type = sphere.type;
  cell.sphere = std::move(sphere);
  return cell;
}

void expect_same(const CellRecord& a, const CellRecord& b) {
  EXPECT_EQ(a.row.id, b.row.id);
  ASSERT_EQ(a.sphere.has_value(), b.sphere.has_value());
  if (a.sphere)
    cbm::for_each_sphere_column([&](const auto& column) { EXPECT_TRUE(same_values(column, *a.sphere, *b.sphere)) << column.name; });
  else
    dcm::for_each_shell_column([&](const auto& column) { EXPECT_TRUE(same_values(column, *a.shell, *b.shell)) << column.name; });
  if (!a.shell) return;
  ASSERT_EQ(a.shell->nuclear_shell.has_value(), b.shell->nuclear_shell.has_value());
  if (a.shell->nuclear_shell)
    dcm::for_each_shell_column(
        [&](const auto& column) { EXPECT_TRUE(same_values(column, *a.shell->nuclear_shell, *b.shell->nuclear_shell)) << column.name; });
}

std::vector<CellRecord> mixed_cells(ShapeLibrary& shapes) {
  std::vector<CellRecord> cells;
  for (std::uint64_t n = 1; n <= 12; ++n) {
    const auto seed = static_cast<std::uint8_t>(11 * n);
    cells.push_back(n % 3 == 0 ? shell_cell(n, shapes, seed, n % 2 == 0) : sphere_cell(n, seed));
    if (n == 6 || n == 12) {
      CellRecord nucleus = shell_cell(n, shapes, static_cast<std::uint8_t>(seed + 5), false);
      nucleus.shell->type = cells.back().row.type;  // a nucleus has the type of its cell
      cells.back().shell->nuclear_shell = *nucleus.shell;
    }
  }
  return cells;
}

void expect_same_cells(Tissue a, Tissue b) {
  const auto left = take_apart(a), right = take_apart(b);
  ASSERT_EQ(left.size(), right.size());
  for (std::size_t i = 0; i < left.size(); ++i) expect_same(left[i], right[i]);
}

TEST(Columns, AllComeBackFromATissueAndFromBytes) {
  ShapeLibrary shapes;
  const std::vector<CellRecord> cells = mixed_cells(shapes);
  std::vector<std::byte> bytes;
  for (const CellRecord& cell : cells) append_bytes(cell, bytes);
  const auto read = read_records(bytes, shapes);
  Tissue tissue;
  put_together(tissue, cells);
  const auto taken = take_apart(tissue);
  ASSERT_EQ(read.size(), cells.size());
  ASSERT_EQ(taken.size(), cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    expect_same(cells[i], read[i]);
    expect_same(cells[i], taken[cells.size() - 1 - i]);  // the orders fall
  }
}

TEST(Columns, AreCountedInTheMemoryOfBodies) {
  ShapeLibrary shapes;
  Tissue tissue;
  put_together(tissue, mixed_cells(shapes));
  std::size_t least = 0;
  dcm::for_each_shell_column([&](const auto& column) {
    for (std::size_t i = 0; i < tissue.shells.size(); ++i) least += column.values(tissue.shells, i).size_bytes();
  });
  EXPECT_GE(dcm::memory_of(tissue.shells), least);
  EXPECT_GT(cbm::memory_of(tissue.spheres), 8 * (sizeof(Vec3d) + sizeof(double) + 3 * sizeof(CellId)));
}

/// What an event does to few cells is what taking all apart and putting them together again does.
TEST(ReplaceCells, IsAsSortingAllAgain) {
  ShapeLibrary shapes;
  const std::vector<std::vector<std::size_t>> leave = {{}, {0}, {11}, {2, 3, 4}, {0, 5, 11}, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}};
  for (const auto& gone : leave)
    for (const std::uint64_t come : {0, 1, 3}) {
      Tissue edited, sorted;
      put_together(edited, mixed_cells(shapes));
      put_together(sorted, mixed_cells(shapes));
      std::vector<CellRecord> fresh;
      for (std::uint64_t k = 0; k < come; ++k) {
        fresh.push_back(k == 1 ? shell_cell(100 + k, shapes, 3, true) : sphere_cell(100 + k, 9));
        fresh.back().row.order = k == 0 ? 0 : 1000 - 40 * k;  // before all, and between
      }
      std::vector<CellRecord> all = take_apart(sorted), kept;
      for (std::size_t i = 0; i < all.size(); ++i)
        if (!std::binary_search(gone.begin(), gone.end(), i)) kept.push_back(all[i]);
      kept.insert(kept.end(), fresh.begin(), fresh.end());
      put_together(sorted, kept);
      replace_cells(edited, gone, fresh);
      EXPECT_EQ(edited.nuclei.owner, sorted.nuclei.owner);
      expect_same_cells(edited, sorted);
    }
}

TEST(ReplaceCells, KeepsThePlaceOfACellThatChangesItsBody) {
  ShapeLibrary shapes;
  Tissue tissue;
  put_together(tissue, mixed_cells(shapes));
  const CellId second = tissue.cells.rows[1].id;
  CellRecord changed = sphere_cell(50, 77);
  changed.row.id = second;
  changed.row.order = tissue.cells.rows[1].order;
  replace_cells(tissue, std::vector<std::size_t>{1}, {changed});
  EXPECT_EQ(tissue.cells.rows[1].id, second);
  expect_same(take_apart(tissue)[1], changed);
}

}  // namespace
}  // namespace morula
