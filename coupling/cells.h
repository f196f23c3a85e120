#pragma once
#include <cassert>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "core/cell_id.h"
#include "core/vec3.h"
#include "coupling/cell_variables.h"
#include "coupling/model.h"
#include "coupling/optional_column.h"

namespace morula {

enum class Phase : std::uint8_t {
  kGrowing,  ///< between birth and division
  kWaiting,  ///< a shell at its division volume; announced once
  kResting,  ///< its type does not cycle
  kDying,    ///< shrinks until it is removed
};

/// One cell: everything biological that every cell has, whatever its body. Plain bytes, so that it moves between ranks and into a
/// checkpoint as it is. What only the cells of some tissues have is kept apart: see OptionalValues.
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
  BodyKind own_body = BodyKind::kSphere;  ///< outside all regions and below all triggers: as placed, its mother's, or of the type it became
  std::uint8_t unused_[3] = {};
};
static_assert(std::is_trivially_copyable_v<CellRow>);

/// What is as it is here for all cells of most tissues.
struct OptionalValues {
  double death_time = -1.0;        ///< when it began to die, or -1 [s]
  double last_swap_time = -1e300;  ///< when its body was last exchanged [s]
  double reference_excess = 0.0;   ///< what is left of ln V0 beyond that of a free shell: eases after a swap, or follows the osmotic flux
  double inflation_left = 0.0;     ///< volume still to come of an inflating start [µm³]
  double inflation_rate = 0.0;     ///< [µm³/s]
  Vec3d polarity{};
  Vec3d migration_velocity{};  ///< u of the persistent walk [µm/s]
};
static_assert(std::is_trivially_copyable_v<OptionalValues>);
static_assert(sizeof(OptionalValues) == (5 + 2 * 3) * sizeof(double), "a new member needs a column in OptionalColumns");

/// A cell's row with all its optional values and variables: how a cell is born, divides, swaps its body, travels between ranks and comes out of a checkpoint.
struct CellState : CellRow, OptionalValues {
  CellState() = default;
  CellState(const CellRow& row, const OptionalValues& values) : CellRow(row), OptionalValues(values) {}

  std::vector<double> variables;  ///< by number of the variable; those beyond the last have their usual value, 0

  [[nodiscard]] double variable(std::size_t number) const { return number < variables.size() ? variables[number] : 0.0; }
};

/// How far the cell is from its type in a trait, as a part.
inline double deviation(const CellState& row, const CellType& type, Trait trait) {
  const std::optional<std::size_t> variable = type.traits.variable_of(trait);
  return variable ? row.variable(*variable) : 0.0;
}

/// A column of the rows or of their optional values.
struct CellColumn {
  const char* name;
  const char* unit;
  AtDivision at_division;
  bool grows = false;  ///< changed before the mechanics of a step: a refused step takes it back
};

/// visit(column, member of CellState) for everything that a row and its optional values hold beside the variables, in the order of the state hash: checkpoint, reading back, hash and
/// division walk this list. At an exchange of bodies the row stays as it is.
template <class Visit>
void for_each_cell_column(Visit&& visit) {
  using enum AtDivision;
  visit(CellColumn{"id", "1", kSet}, &CellState::id);
  visit(CellColumn{"parent", "1", kSet}, &CellState::parent);
  visit(CellColumn{"order", "1", kCopied}, &CellState::order);
  visit(CellColumn{"birth_time", "s", kSet}, &CellState::birth_time);
  visit(CellColumn{"birth_volume", "um^3", kSet}, &CellState::birth_volume);
  visit(CellColumn{"target_volume", "um^3", kSet, true}, &CellState::target_volume);
  visit(CellColumn{"division_volume", "um^3", kSet}, &CellState::division_volume);
  visit(CellColumn{"cycle_duration", "s", kSet}, &CellState::cycle_duration);
  visit(CellColumn{"pressure", "kPa", kCopied}, &CellState::pressure);
  visit(CellColumn{"death_time", "s", kUsual, true}, &CellState::death_time);
  visit(CellColumn{"last_swap_time", "s", kCopied}, &CellState::last_swap_time);
  visit(CellColumn{"reference_excess", "1", kCopied, true}, &CellState::reference_excess);
  visit(CellColumn{"inflation_left", "um^3", kUsual, true}, &CellState::inflation_left);
  visit(CellColumn{"inflation_rate", "um^3/s", kUsual}, &CellState::inflation_rate);
  visit(CellColumn{"polarity", "1", kCopied, true}, &CellState::polarity);
  visit(CellColumn{"migration_velocity", "um/s", kCopied, true}, &CellState::migration_velocity);
  visit(CellColumn{"draws", "1", kSet}, &CellState::draws);
  visit(CellColumn{"type", "1", kCopied}, &CellState::type);
  visit(CellColumn{"phase", "1", kSet, true}, &CellState::phase);
  visit(CellColumn{"body", "1", kCopied}, &CellState::body);
  visit(CellColumn{"own_body", "1", kCopied}, &CellState::own_body);
}

/// The size of a row that the list above covers, to notice a member that was added to one and not to the other.
inline constexpr std::size_t kListedRowBytes = 3 * 8 + 11 * 8 + 2 * sizeof(Vec3d) + 8 + 2 + 1 + 1 + 1;
static_assert(sizeof(CellRow) + sizeof(OptionalValues) == kListedRowBytes + sizeof(CellRow::unused_),
              "list every member of CellRow and OptionalValues in for_each_cell_column");

/// The optional values of all rows: a column for each, which takes no room while all have the value of OptionalValues().
struct OptionalColumns {
  OptionalColumn<double> death_time{OptionalValues().death_time}, last_swap_time{OptionalValues().last_swap_time};
  OptionalColumn<double> reference_excess, inflation_left, inflation_rate;
  OptionalColumn<Vec3d> polarity, migration_velocity;

  /// function(column) for all columns, or function(column, its value of `values`).
  template <class Self, class F>
  static void for_each(Self& self, F&& function) {
    for_each(self, OptionalValues{}, [&](auto& column, const auto&) { function(column); });
  }
  template <class Self, class Values, class F>
  static void for_each(Self& self, Values&& values, F&& function) {
    for_each_member([&](auto column, auto value) { function(self.*column, values.*value); });
  }
  /// function(member of OptionalColumns, member of OptionalValues) for all columns.
  template <class F>
  static void for_each_member(F&& function) {
    function(&OptionalColumns::death_time, &OptionalValues::death_time);
    function(&OptionalColumns::last_swap_time, &OptionalValues::last_swap_time);
    function(&OptionalColumns::reference_excess, &OptionalValues::reference_excess);
    function(&OptionalColumns::inflation_left, &OptionalValues::inflation_left);
    function(&OptionalColumns::inflation_rate, &OptionalValues::inflation_rate);
    function(&OptionalColumns::polarity, &OptionalValues::polarity);
    function(&OptionalColumns::migration_velocity, &OptionalValues::migration_velocity);
  }
};

/// A variable and its values by row, which take no room while all are 0.
struct VariableColumn {
  CellVariable what;
  OptionalColumn<double> values;
};

/// Number of the first variable of the cycle's phases; that of none is the number of variables.
inline std::size_t first_cycle_variable(std::span<const VariableColumn> variables) {
  std::size_t first = 0;
  while (first < variables.size() && variables[first].what.name != kPhaseVariable) ++first;
  return first;
}

/// Rows of a rank in canonical order (order, id). The k-th row with a shell owns the k-th shell, and likewise for spheres.
struct Cells {
  std::vector<CellRow> rows;
  OptionalColumns optional;               ///< by row: optional.polarity[i] belongs to rows[i]
  std::vector<VariableColumn> variables;  ///< those that declare() named

  [[nodiscard]] std::size_t size() const { return rows.size(); }
  /// How far the cell of a row is from its type in a trait, as a part.
  [[nodiscard]] double deviation(std::size_t i, const CellType& type, Trait trait) const {
    const std::optional<std::size_t> variable = type.traits.variable_of(trait);
    return variable ? variables[*variable].values[i] : 0.0;
  }
  /// The cells have these variables, all 0, unless they have them already.
  void declare(const std::vector<CellVariable>& wanted) {
    for (std::size_t v = variables.size(); v < wanted.size(); ++v) variables.push_back({wanted[v], {}});
  }
  /// No rows, and the same variables.
  [[nodiscard]] Cells without_rows() const {
    Cells out;
    for (const VariableColumn& variable : variables) out.variables.push_back({variable.what, {}});
    return out;
  }
  /// A row with its optional values and variables.
  [[nodiscard]] CellState state(std::size_t i) const {
    CellState out(rows[i], {});
    OptionalColumns::for_each(optional, out, [&](const auto& column, auto& value) { value = column[i]; });
    for (const VariableColumn& variable : variables) out.variables.push_back(variable.values[i]);
    return out;
  }
  void set_optional(std::size_t i, const OptionalValues& values) {
    OptionalColumns::for_each(optional, values, [&](auto& column, const auto& value) { column.set(i, value, rows.capacity()); });
  }
  /// A row behind the others; the cells have all of its variables.
  void push_back(const CellState& row) {
    assert(row.variables.size() <= variables.size());
    rows.push_back(row);
    set_optional(rows.size() - 1, row);
    for (std::size_t v = 0; v < variables.size(); ++v) variables[v].values.set(rows.size() - 1, row.variable(v), rows.capacity());
  }
  /// Adds the rows first, …, last − 1 of `from`, which has the same variables, behind the others.
  void add(const Cells& from, std::size_t first, std::size_t last) {
    assert(first <= last && last <= from.size() && variables.size() == from.variables.size());
    for (std::size_t i = first; i < last; ++i) {
      rows.push_back(from.rows[i]);
      const auto copy = [&](auto& column, const auto& other) {
        if (!other.empty()) column.set(rows.size() - 1, other[i], rows.capacity());
      };
      OptionalColumns::for_each_member([&](auto column, auto) { copy(optional.*column, from.optional.*column); });
      for (std::size_t v = 0; v < variables.size(); ++v) copy(variables[v].values, from.variables[v].values);
    }
  }
  [[nodiscard]] std::size_t memory() const {
    std::size_t total = rows.capacity() * sizeof(CellRow);
    OptionalColumns::for_each(optional, [&](const auto& column) { total += column.memory(); });
    for (const VariableColumn& variable : variables) total += variable.values.memory();
    return total;
  }
};

/// A row and which body it owns.
struct BodyOfRow {
  std::size_t row;
  bool is_shell;
  std::size_t number;  ///< among the shells, or among the spheres

  /// Its place among all bodies of the rank: the shells, then the spheres.
  [[nodiscard]] std::size_t place(std::size_t shells) const { return is_shell ? number : shells + number; }
};

/// The rows in their order, each with its body: for (const BodyOfRow& it : bodies_of(cells)). The only place that knows which body belongs to which row.
class BodiesOfRows {
 public:
  explicit BodiesOfRows(const std::vector<CellRow>& rows) : rows_(&rows) {}

  class Iterator {
   public:
    Iterator(const std::vector<CellRow>& rows, std::size_t row) : rows_(&rows), row_(row) {}
    BodyOfRow operator*() const { return {row_, is_shell(), is_shell() ? shells_ : row_ - shells_}; }
    Iterator& operator++() {
      shells_ += is_shell() ? 1 : 0;
      ++row_;
      return *this;
    }
    bool operator==(const Iterator& other) const { return row_ == other.row_; }

   private:
    [[nodiscard]] bool is_shell() const { return (*rows_)[row_].body == BodyKind::kShell; }
    const std::vector<CellRow>* rows_;
    std::size_t row_, shells_ = 0;
  };
  [[nodiscard]] Iterator begin() const { return {*rows_, 0}; }
  [[nodiscard]] Iterator end() const { return {*rows_, rows_->size()}; }

 private:
  const std::vector<CellRow>* rows_;
};
inline BodiesOfRows bodies_of(const Cells& cells) { return BodiesOfRows(cells.rows); }

/// Canonical order: along the curve, ties by id.
inline bool before(const CellRow& a, const CellRow& b) { return a.order != b.order ? a.order < b.order : a.id < b.id; }

}  // namespace morula
