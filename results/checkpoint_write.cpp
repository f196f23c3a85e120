#include <algorithm>
#include <array>
#include <type_traits>

#include "results/build_info.h"
#include "results/checkpoint.h"
#include "results/file_io.h"
#include "results/hdf5_plan.h"
#include "results/parcels.h"
#include "results/shape_table.h"
#include "results/state_fields.h"

namespace morula::scenarios {
namespace {

/// The values of a column, those of all bodies one after the other.
struct FlatColumn {
  std::vector<std::byte> bytes;
  std::vector<std::uint32_t> count;  ///< by body
};

/// All columns of a table in the order in which they are declared.
struct FlatTable {
  std::vector<std::uint32_t> shape;  ///< of shells: number of the shape, by body
  std::vector<FlatColumn> columns;
};

/// This rank's stretch of the sorted cells.
struct SortedCells {
  std::vector<CellState> rows;
  FlatTable spheres, shells, nuclei;            ///< nuclei: those that are shells
  std::vector<std::uint8_t> has_nuclear_shell;  ///< by shell
};

/// A body's values of a column, and how many there are.
template <class Column, class Bodies>
void pack_column(const Column& column, const Bodies& bodies, std::size_t i, ByteWriter& out) {
  const auto values = column.values(bodies, i);
  out.put(static_cast<std::uint32_t>(values.size()));
  out.put_all(values);
}

void pack_shell(const dcm::Shells& shells, std::size_t i, const ShapeNumbers& numbers, ByteWriter& out) {
  out.put(numbers.by_pointer.at(shells.shape[i].get()));
  dcm::for_each_shell_column([&](const auto& column) { pack_column(column, shells, i, out); });
}

Parcels pack_cells(const Tissue& tissue, const ShapeNumbers& numbers) {
  Parcels parcels;
  ByteWriter out;
  for (const BodyOfRow& body : bodies_of(tissue.cells)) {
    const CellState row = tissue.cells.state(body.row);
    out.clear();
    out.put(static_cast<const CellRow&>(row));
    out.put(static_cast<const OptionalValues&>(row));
    out.put_all(std::span(row.variables));
    if (body.is_shell) {
      pack_shell(tissue.shells, body.number, numbers, out);
      const std::size_t nuclear = tissue.nuclei.of_shell(body.number);
      out.put(std::uint8_t{nuclear < tissue.nuclei.size()});
      if (nuclear < tissue.nuclei.size()) pack_shell(tissue.nuclei.shells, nuclear, numbers, out);
    } else {
      cbm::for_each_sphere_column([&](const auto& column) { pack_column(column, tissue.spheres, body.number, out); });
    }
    parcels.add(row.id.bits(), out.bytes());
  }
  return parcels;
}

/// The next column of a body, whose values have this size.
void unpack_column(ByteReader& in, std::size_t size, std::size_t number, FlatTable& out) {
  if (out.columns.size() <= number) out.columns.resize(number + 1);
  FlatColumn& column = out.columns[number];
  column.count.push_back(in.get<std::uint32_t>());
  in.get_all(column.count.back() * size, column.bytes);
}

/// All columns of a body; `for_each_column` visits those of its table.
template <class ForEachColumn>
void unpack_columns(ForEachColumn&& for_each_column, ByteReader& in, FlatTable& out) {
  std::size_t number = 0;
  for_each_column(
      [&](const auto& column) { unpack_column(in, sizeof(typename std::remove_cvref_t<decltype(column)>::Value), number++, out); });
}

constexpr auto kShellColumns = [](auto&& visit) { dcm::for_each_shell_column(visit); };
constexpr auto kSphereColumns = [](auto&& visit) { cbm::for_each_sphere_column(visit); };

void unpack_shell(ByteReader& in, FlatTable& out) {
  out.shape.push_back(in.get<std::uint32_t>());
  unpack_columns(kShellColumns, in, out);
}

SortedCells unpack_cells(const Parcels& parcels, std::size_t variables) {
  SortedCells out;
  for (std::size_t i = 0; i < parcels.size(); ++i) {
    ByteReader in(parcels.bytes(i));
    const auto row = in.get<CellRow>();
    in.get_all(variables, out.rows.emplace_back(row, in.get<OptionalValues>()).variables);
    if (out.rows.back().body == BodyKind::kSphere) {
      unpack_columns(kSphereColumns, in, out.spheres);
      continue;
    }
    unpack_shell(in, out.shells);
    out.has_nuclear_shell.push_back(in.get<std::uint8_t>());
    if (out.has_nuclear_shell.back() != 0) unpack_shell(in, out.nuclei);
  }
  return out;
}

/// One dataset for a column that all bodies have; else another with how many values each body has, and none of both where no body has any. Collective.
template <class Column>
void add_column(StoragePlan& plan, const std::string& group, const Column& column, const FlatColumn& flat, const Comm& comm) {
  using Value = typename Column::Value;
  if (Column::kFill == Fill::kAllOrNone && !comm.any(!flat.bytes.empty())) return;
  if (Column::kFill != Fill::kAll) plan.add(group + column.name + "_count", "1", flat.count);
  const auto* values = reinterpret_cast<const Value*>(flat.bytes.data());  // NOLINT: plain data, as they were packed
  plan.add(group + column.name, column.unit, std::span(values, flat.bytes.size() / sizeof(Value)));
}

template <class ForEachColumn>
void add_columns(ForEachColumn&& for_each_column, StoragePlan& plan, const std::string& group, FlatTable& table, const Comm& comm) {
  std::size_t number = 0;
  for_each_column([&](const auto& column) {
    if (table.columns.size() <= number) table.columns.resize(number + 1);  // a rank without such bodies takes part
    add_column(plan, group, column, table.columns[number++], comm);
  });
}

void add_shells(StoragePlan& plan, const std::string& group, FlatTable& table, const Comm& comm) {
  plan.add(group + "shape", "1", table.shape);
  add_columns(kShellColumns, plan, group, table, comm);
}

void add_cells(StoragePlan& plan, const std::vector<VariableColumn>& variables, SortedCells& cells, const Comm& comm) {
  for_each_cell_column([&](const CellColumn& column, auto member) {
    std::vector<std::remove_cvref_t<decltype(cells.rows.front().*member)>> values;
    for (const CellState& row : cells.rows) values.push_back(row.*member);
    plan.add(std::string("cells/") + column.name, column.unit, values);
  });
  for (std::size_t v = 0; v < variables.size(); ++v) {
    std::vector<double> values;
    for (const CellState& row : cells.rows) values.push_back(row.variables[v]);
    plan.add("cells/" + variables[v].what.name, variables[v].what.unit, values);
  }
  add_columns(kSphereColumns, plan, "spheres/", cells.spheres, comm);
  add_shells(plan, "shells/", cells.shells, comm);
  if (!comm.any(!cells.nuclei.shape.empty())) return;
  plan.add("shells/has_nuclear_shell", "1", cells.has_nuclear_shell);
  add_shells(plan, "nuclear_shells/", cells.nuclei, comm);
}

Status add_field(StoragePlan& plan, const std::string& group, const fields::Field& field, const Comm& comm) {
  Parcels bricks;
  for (std::size_t b = 0; b < field.owned_bricks.size(); ++b)
    bricks.add(static_cast<std::uint64_t>(field.owned_bricks[b]), std::as_bytes(std::span(field.concentration[b])));
  const Parcels sorted = sort_over_ranks(bricks, comm);
  std::vector<std::int64_t> numbers;
  std::vector<double> values;
  bool sizes_right = true;
  for (std::size_t b = 0; b < sorted.size(); ++b) {
    numbers.push_back(static_cast<std::int64_t>(sorted.key(b)));
    const std::size_t count = sorted.bytes(b).size() / sizeof(double);
    sizes_right = sizes_right && numbers.back() < field.grid.brick_count() && count == brick_voxel_count(field.grid, numbers.back());
    ByteReader(sorted.bytes(b)).get_all(count, values);
  }
  const std::int64_t total = comm.sum(static_cast<std::int64_t>(numbers.size()));
  if (!comm.all(sizes_right) || total != field.grid.brick_count())
    return Error{ErrorKind::kInternal, "the bricks of " + group + " do not make its grid (" + std::to_string(total) + " bricks)", ""};
  plan.add_value(group + "/low", "um", field.grid.box.low);
  plan.add_value(group + "/high", "um", field.grid.box.high);
  plan.add_value(group + "/voxels", "1", field.grid.voxels);
  plan.add_value(group + "/bricks", "1", field.grid.bricks);
  for_each_field_number(
      [&](const char* name, const char* units, auto member) { plan.add_value(group + '/' + name, units, field.*member); });
  plan.add(group + "/brick", "1", numbers);
  plan.add(group + "/concentration", "mM", values);
  return {};
}

void add_globals(StoragePlan& plan, const Tissue& tissue, const CheckpointInfo& info) {
  plan.add_value("format_version", "1", kCheckpointFormat);
  plan.add_text("info/morula_version", build_info().version);
  plan.add_text("info/run_name", info.run_name);
  plan.add_text("info/study_hash", info.study_hash);
  plan.add_value("info/wall_time", "s", info.wall_time);
  plan.add_value("info/warned", "1", info.warned);
  plan.add_value("info/events_length", "1", info.texts.events);
  plan.add_value("info/log_length", "1", info.texts.log);
  for_each_interval_field([&](const std::string& name, const char* units, auto member) {
    plan.add_value("info/interval/" + name, units, info.interval.*member);
  });
  plan.add_value("info/field_count", "1", static_cast<std::uint32_t>(tissue.fields.size()));
  for_each_clock_field(
      [&](const std::string& name, const char* units, auto member) { plan.add_value("clock/" + name, units, tissue.clock.*member); });
  for_each_ledger_field(
      [&](const std::string& name, const char* units, auto member) { plan.add_value("ledger/" + name, units, tissue.ledger.*member); });
  for_each_field_ledger_field([&](const std::string& name, const char* units, auto member) {
    std::vector<double> by_field;
    for (const FieldLedger& field : tissue.ledger.fields) by_field.push_back(field.*member);
    plan.add_from_root("ledger/" + name, units, std::span<const double>(by_field));
  });
  plan.add_from_root("obstacles/offset", "um", std::span<const Vec3d>(tissue.obstacle_offset));
  if (!tissue.watched.empty())
    for_each_watched_field([&](const std::string& name, const char* units, auto member) {
      using Value = std::remove_cvref_t<decltype(tissue.watched.front().*member)>;
      std::vector<Value> column;
      for (const WatchedNeighbour& watched : tissue.watched) column.push_back(watched.*member);
      plan.add_from_root("watched/" + name, units, std::span<const Value>(column));
    });
  if (tissue.lumens.empty()) return;
  for_each_lumen_field([&](const std::string& name, const char* units, auto member) {
    std::vector<double> column;
    for (const LumenState& lumen : tissue.lumens) column.push_back(lumen.*member);
    plan.add_from_root("lumens/" + name, units, std::span<const double>(column));
  });
}

}  // namespace

std::size_t brick_voxel_count(const fields::Grid& grid, std::int64_t brick) {
  std::size_t count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t along = brick % grid.bricks[axis];
    brick /= grid.bricks[axis];
    count *= static_cast<std::size_t>(std::min<std::int64_t>(fields::Grid::kBrick, grid.voxels[axis] - along * fields::Grid::kBrick));
  }
  return count;
}

Status write_checkpoint(const std::filesystem::path& path, const Tissue& tissue, const CheckpointInfo& info, const Comm& comm) {
  StoragePlan plan(comm);
  add_globals(plan, tissue, info);
  auto shapes = tissue.shells.shape;
  shapes.insert(shapes.end(), tissue.nuclei.shells.shape.begin(), tissue.nuclei.shells.shape.end());
  const ShapeNumbers numbers = add_shapes(plan, shapes, comm);
  SortedCells cells = unpack_cells(sort_over_ranks(pack_cells(tissue, numbers), comm), tissue.cells.variables.size());
  add_cells(plan, tissue.cells.variables, cells, comm);
  for (std::size_t f = 0; f < tissue.fields.size(); ++f) MORULA_TRY(add_field(plan, "fields/" + std::to_string(f), tissue.fields[f], comm));
  return create_file(path, std::move(plan), comm);
}

}  // namespace morula::scenarios
