#pragma once
#include <array>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "core/cell_id.h"
#include "core/vec3.h"
#include "coupling/model.h"
#include "coupling/side_column.h"

namespace morula {

inline constexpr std::size_t kMaxFields = 4;

enum class Phase : std::uint8_t {
  kGrowing,  ///< between birth and division
  kWaiting,  ///< a shell at its division volume; announced once
  kResting,  ///< its type does not cycle
  kDying,    ///< shrinks until it is removed
};

/// One cell: everything biological that every cell has, whatever its body. Plain bytes, so that it moves between ranks and into a
/// checkpoint as it is. What only the cells of some tissues have is kept apart: see CellSides.
struct CellRow {
  CellId id;
  CellId parent;
  std::uint64_t order = 0;       ///< place along the space-filling curve: the canonical order of cells is (order, id)
  double birth_time = 0.0;       ///< [s]
  double birth_volume = 0.0;     ///< [µm³]
  double target_volume = 0.0;    ///< what growth drives; the free volume of the body [µm³]
  double division_volume = 0.0;  ///< [µm³]
  double cycle_duration = 0.0;   ///< of this cell [s]
  double pressure = 0.0;         ///< averaged over the last minute [kPa]
  std::uint64_t draws = 0;       ///< rare events drawn so far: index of the next rare random number
  std::uint16_t type = 0;
  Phase phase = Phase::kGrowing;
  BodyKind body = BodyKind::kSphere;
  BodyKind own_body = BodyKind::kSphere;  ///< what it has outside all regions and below all triggers: as placed, or its mother's
  std::uint8_t unused_[3] = {};
};
static_assert(std::is_trivially_copyable_v<CellRow>);

/// What is as it is here for all cells of most tissues.
struct CellSides {
  double death_time = -1.0;        ///< when it began to die, or -1 [s]
  double last_swap_time = -1e300;  ///< when its body was last exchanged [s]
  double reference_excess = 0.0;   ///< what is left of ln V0 beyond that of a free shell: eases after a swap, or follows the osmotic flux
  double inflation_left = 0.0;     ///< volume still to come of an inflating start [µm³]
  double inflation_rate = 0.0;     ///< [µm³/s]
  Vec3d polarity{};
  Vec3d migration_velocity{};                      ///< u of the persistent walk [µm/s]
  std::array<double, kMaxFields> amount{};         ///< taken from each field so far [amol]
  std::array<double, kMaxFields> concentration{};  ///< seen in each field [mM]
};
static_assert(sizeof(CellSides) == (5 + 2 * 3 + 2 * kMaxFields) * sizeof(double), "a new member needs a column in SideColumns");

/// A cell's row with all its sides: how a cell is born, divides, swaps its body, travels between ranks and comes out of a checkpoint.
struct FullRow : CellRow, CellSides {
  FullRow() = default;
  FullRow(const CellRow& row, const CellSides& sides) : CellRow(row), CellSides(sides) {}
};
static_assert(std::is_trivially_copyable_v<FullRow>);

/// The sides of all rows: a column for each, which takes no room while all have the value of CellSides().
struct SideColumns {
  SideColumn<double> death_time{CellSides().death_time}, last_swap_time{CellSides().last_swap_time};
  SideColumn<double> reference_excess, inflation_left, inflation_rate;
  SideColumn<Vec3d> polarity, migration_velocity;
  std::array<SideColumn<double>, kMaxFields> amount, concentration;

  /// function(column) for all columns, or function(column, the same of `sides`).
  template <class Self, class F>
  static void for_each(Self& self, F&& function) {
    for_each(self, CellSides{}, [&](auto& column, const auto&) { function(column); });
  }
  template <class Self, class Sides, class F>
  static void for_each(Self& self, Sides&& sides, F&& function) {
    function(self.death_time, sides.death_time);
    function(self.last_swap_time, sides.last_swap_time);
    function(self.reference_excess, sides.reference_excess);
    function(self.inflation_left, sides.inflation_left);
    function(self.inflation_rate, sides.inflation_rate);
    function(self.polarity, sides.polarity);
    function(self.migration_velocity, sides.migration_velocity);
    for (std::size_t field = 0; field < kMaxFields; ++field) {
      function(self.amount[field], sides.amount[field]);
      function(self.concentration[field], sides.concentration[field]);
    }
  }
};

/// Rows of a rank in canonical order (order, id). The k-th row with a shell owns the k-th shell, and likewise for spheres.
struct Cells {
  std::vector<CellRow> rows;
  SideColumns side;  ///< by row: side.polarity[i] belongs to rows[i]

  [[nodiscard]] std::size_t size() const { return rows.size(); }
  /// A row with its sides.
  [[nodiscard]] FullRow full(std::size_t i) const {
    FullRow out(rows[i], {});
    SideColumns::for_each(side, out, [&](const auto& column, auto& value) { value = column[i]; });
    return out;
  }
  void set_sides(std::size_t i, const CellSides& sides) {
    SideColumns::for_each(side, sides, [&](auto& column, const auto& value) { column.set(i, value, rows.capacity()); });
  }
  void push_back(const FullRow& row) {
    rows.push_back(row);
    set_sides(rows.size() - 1, row);
  }
  [[nodiscard]] std::size_t memory() const {
    std::size_t total = rows.capacity() * sizeof(CellRow);
    SideColumns::for_each(side, [&](const auto& column) { total += column.memory(); });
    return total;
  }
};

/// Canonical order: along the curve, ties by id.
inline bool before(const CellRow& a, const CellRow& b) { return a.order != b.order ? a.order < b.order : a.id < b.id; }

}  // namespace morula
