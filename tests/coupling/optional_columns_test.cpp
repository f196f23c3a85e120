#include <gtest/gtest.h>

#include <cmath>

#include "coupling/cell_record.h"
#include "tests/coupling/same_rows.h"

namespace morula {
namespace {

CellState restless(std::uint64_t number) {
  CellState row;
  row.id = CellId::founder(number);
  row.order = 100 - number;  // the canonical order turns them around
  row.death_time = 7.0;
  row.last_swap_time = 12.0;
  row.reference_excess = 0.25;
  row.inflation_left = 3.0;
  row.inflation_rate = 0.5;
  row.polarity = {0, 0, 1};
  row.migration_velocity = {0, -0.0, 0};
  row.variables = {1, 2, 3, 4, -0.0, 6};
  return row;
}

CellState plain(std::uint64_t number) {
  CellState row;
  row.id = CellId::founder(number);
  row.order = 100 - number;
  return row;
}

/// Of three fields.
std::vector<CellVariable> six_variables() {
  Model model;
  model.fields.resize(3);
  return cell_variables(model);
}

/// The row as cells with six variables give it back.
CellState whole(CellState row) {
  row.variables.resize(6);
  return row;
}

TEST(OptionalColumns, TakeNoRoomWhereAllCellsHaveTheUsualValues) {
  Cells cells;
  cells.rows.reserve(3);
  cells.declare(six_variables());
  for (std::uint64_t n = 1; n <= 3; ++n) cells.push_back(plain(n));
  EXPECT_EQ(cells.memory(), 3 * sizeof(CellRow));
  OptionalColumns::for_each(cells.optional, [](const auto& column) { EXPECT_TRUE(column.empty()); });
  EXPECT_TRUE(same_rows(cells.state(1), whole(plain(2))));
}

TEST(OptionalColumns, ComeBackAsTheyWereSet) {
  Cells cells;
  cells.rows.reserve(8);
  cells.declare(six_variables());
  for (std::uint64_t n = 1; n <= 8; ++n) cells.push_back(n == 3 || n == 5 ? restless(n) : plain(n));
  for (std::uint64_t n = 1; n <= 8; ++n) EXPECT_TRUE(same_rows(cells.state(n - 1), n == 3 || n == 5 ? restless(n) : whole(plain(n)))) << n;
  EXPECT_EQ(cells.memory(), 8 * sizeof(CellRow) + 8 * sizeof(OptionalValues) + 8 * 6 * sizeof(double))
      << "room for all rows at once, and not more";
  cells.set_optional(2, {});
  for (VariableColumn& variable : cells.variables) variable.values.set(2, 0.0);
  EXPECT_TRUE(same_rows(cells.state(2), whole(plain(3))));
  EXPECT_TRUE(same_rows(cells.state(4), restless(5)));
}

TEST(OptionalColumns, MinusZeroIsNotZero) {
  OptionalColumn<double> column;
  column.set(2, -0.0);
  EXPECT_TRUE(std::signbit(column[2]));
  EXPECT_FALSE(std::signbit(column[1]));
  column.set(2, 0.0);
  EXPECT_FALSE(std::signbit(column[2]));
}

TEST(OptionalColumns, GoWithTheirCellThroughSortingAndBytes) {
  Tissue tissue;
  tissue.cells.declare(six_variables());
  std::vector<CellRecord> cells;
  for (std::uint64_t n = 1; n <= 6; ++n) {
    CellRecord& cell = cells.emplace_back();
    cell.row = n == 2 ? restless(n) : plain(n);
    cell.sphere = SphereRecord{{1.0 * static_cast<double>(n), 0, 0}, 5.0, {}, {}};
  }
  put_together(tissue, std::move(cells));
  ShapeLibrary shapes;
  std::vector<std::byte> bytes;
  for (const CellRecord& cell : take_apart(tissue)) append_bytes(cell, bytes);
  EXPECT_TRUE(tissue.cells.optional.polarity.empty());
  cells = read_records(bytes, shapes);
  ASSERT_EQ(cells.size(), 6u);
  for (std::uint64_t n = 1; n <= 6; ++n) EXPECT_TRUE(same_rows(cells[6 - n].row, n == 2 ? restless(n) : whole(plain(n)))) << n;
  std::erase_if(cells, [](const CellRecord& cell) { return cell.row.id == CellId::founder(4); });  // rows move up
  put_together(tissue, std::move(cells));
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(tissue.cells.variables[3].values[i], tissue.cells.rows[i].id == CellId::founder(2) ? 4.0 : 0.0);
}

TEST(CellRecords, CopyTheirShellDeeply) {
  ShapeLibrary shapes;
  CellRecord cell;
  cell.row = plain(1);
  cell.shell = spherical_shell(shapes.icosphere(42).value(), {}, 500.0, 510.0);
  CellRecord copy = cell;
  cell.shell->position[0].x += 1.0;
  EXPECT_EQ(copy.shell->position[0].x + 1.0, cell.shell->position[0].x);
  copy = CellRecord{};
  EXPECT_FALSE(copy.shell.has_value());
  EXPECT_TRUE(cell.shell);
}

}  // namespace
}  // namespace morula
