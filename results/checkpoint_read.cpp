#include <algorithm>
#include <numeric>
#include <set>
#include <type_traits>

#include "coupling/cell_record.h"
#include "coupling/mechanics/contact_setup.h"
#include "results/build_info.h"
#include "results/checkpoint.h"
#include "results/file_io.h"
#include "results/hdf5_reader.h"
#include "results/shape_table.h"
#include "results/state_fields.h"

namespace morula::scenarios {
namespace {

/// This rank's stretch of `count` things.
struct Stretch {
  std::uint64_t begin, end;
  Stretch(std::uint64_t count, const Comm& comm) : Stretch(count, comm.rank(), comm.size()) {}
  Stretch(std::uint64_t count, int rank, int ranks)
      : begin(count * static_cast<std::uint64_t>(rank) / static_cast<std::uint64_t>(ranks)),
        end(count * (static_cast<std::uint64_t>(rank) + 1) / static_cast<std::uint64_t>(ranks)) {}
  [[nodiscard]] std::uint64_t size() const { return end - begin; }
};

std::uint64_t before_mine(std::uint64_t mine, const Comm& comm) {
  return static_cast<std::uint64_t>(comm.exclusive_scan(static_cast<std::int64_t>(mine)));
}

template <class Visit>
Status first_failure(Visit&& each) {
  Status status;
  each([&](Status next) {
    if (status.ok() && !next.ok()) status = std::move(next);
  });
  return status;
}

/// Neighbours of cells that exchanged their bodies shortly before; none in a file that has none, or is older than they are.
Status read_watched(const Hdf5Reader& file, std::vector<WatchedNeighbour>& out) {
  if (!file.exists("watched/exchanged")) return {};
  return first_failure([&](auto note) {
    for_each_watched_field([&](const std::string& name, const char*, auto member) {
      using Value = std::remove_cvref_t<decltype(out.front().*member)>;
      auto column = file.read<Value>("watched/" + name);
      if (!column.ok()) return note(Status(std::move(column).error()));
      out.resize(std::max(out.size(), column.value().size()));
      for (std::size_t i = 0; i < column.value().size(); ++i) out[i].*member = column.value()[i];
      note(Status{});
    });
  });
}

Status read_globals(const Hdf5Reader& file, LoadedCheckpoint& out) {
  MORULA_TRY_ASSIGN(out.info.morula_version, file.text("info/morula_version"));
  MORULA_TRY_ASSIGN(out.info.run_name, file.text("info/run_name"));
  MORULA_TRY_ASSIGN(out.info.study_hash, file.text("info/study_hash"));
  MORULA_TRY_ASSIGN(out.info.wall_time, file.value<double>("info/wall_time"));
  if (file.exists("info/warned")) {
    MORULA_TRY_ASSIGN(out.info.warned, file.value<std::uint32_t>("info/warned"));
    MORULA_TRY_ASSIGN(out.info.texts.events, file.value<std::uint64_t>("info/events_length"));
    MORULA_TRY_ASSIGN(out.info.texts.log, file.value<std::uint64_t>("info/log_length"));
  }
  if (file.exists("info/interval/steps")) {
    Status read;
    for_each_interval_field([&](const std::string& name, const char*, auto member) {
      if (!read.ok()) return;
      auto value = file.value<std::remove_cvref_t<decltype(out.info.interval.*member)>>("info/interval/" + name);
      if (value.ok())
        out.info.interval.*member = *value;
      else
        read = value.error();
    });
    MORULA_TRY(std::move(read));
  }
  MORULA_TRY_ASSIGN(out.tissue.obstacle_offset, file.read<Vec3d>("obstacles/offset"));
  const auto read_one = [&](const std::string& path, auto& member) -> Status {
    using Value = std::remove_cvref_t<decltype(member)>;
    using Kept = std::conditional_t<std::is_same_v<Value, bool>, std::uint8_t, Value>;  // a vector of bool has no bytes
    MORULA_TRY_ASSIGN(const Kept kept, file.value<Kept>(path));
    member = static_cast<Value>(kept);
    return {};
  };
  const auto read_by_field = [&](const std::string& path, auto member) -> Status {
    MORULA_TRY_ASSIGN(const auto values, file.read<double>(path));
    out.tissue.ledger.fields.resize(values.size());
    for (std::size_t f = 0; f < values.size(); ++f) out.tissue.ledger.fields[f].*member = values[f];
    return {};
  };
  Status lumens;
  for_each_lumen_field([&](const std::string& name, const char*, auto member) {
    if (!lumens.ok() || !file.exists("lumens/" + name)) return;
    auto column = file.read<double>("lumens/" + name);
    if (!column.ok()) {
      lumens = std::move(column).error();
      return;
    }
    out.tissue.lumens.resize(column.value().size());
    for (std::size_t i = 0; i < out.tissue.lumens.size(); ++i) out.tissue.lumens[i].*member = column.value()[i];
  });
  MORULA_TRY(lumens);
  MORULA_TRY(read_watched(file, out.tissue.watched));
  Clock& clock = out.tissue.clock;
  Ledger& ledger = out.tissue.ledger;
  return first_failure([&](auto note) {
    for_each_clock_field([&](const std::string& name, const char*, auto member) { note(read_one("clock/" + name, clock.*member)); });
    for_each_field_ledger_field([&](const std::string& name, const char*, auto member) { note(read_by_field("ledger/" + name, member)); });
    for_each_ledger_field([&](const std::string& name, const char*, auto member) { note(read_one("ledger/" + name, ledger.*member)); });
  });
}

Status read_rows(const Hdf5Reader& file, const Stretch& mine, Cells& cells) {
  std::vector<CellState> rows(mine.size());
  Status read = first_failure([&](auto note) {
    for_each_cell_column([&](const CellColumn& column, auto member) {
      using Value = std::remove_cvref_t<decltype(rows.front().*member)>;
      auto values = file.read<Value>(std::string("cells/") + column.name, mine.begin, mine.size());
      if (values.ok())
        for (std::size_t i = 0; i < rows.size(); ++i) rows[i].*member = values.value()[i];
      else
        note(std::move(values).error());
    });
  });
  MORULA_TRY(read);
  for (const VariableColumn& variable : cells.variables) {
    MORULA_TRY_ASSIGN(const auto values, file.read<double>("cells/" + variable.what.name, mine.begin, mine.size()));
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].variables.push_back(values[i]);
  }
  cells.rows.reserve(rows.size());
  for (const CellState& row : rows) cells.push_back(row);
  return {};
}

/// Where this rank's bodies of a table are in the file.
struct Rows {
  std::uint64_t first = 0, count = 0;
};

/// The values of a column by body: `expected(i)` of them where all bodies have it, else as many as its dataset of counts says. Collective.
template <class Column, class Expected>
Result<std::vector<std::vector<typename Column::Value>>> read_column(const Hdf5Reader& file, const std::string& group, const Column& column,
                                                                     const Rows& rows, Expected&& expected, const Comm& comm) {
  using Value = typename Column::Value;
  const std::string name = group + column.name;
  std::vector<std::vector<Value>> out(rows.count);
  std::vector<std::uint32_t> count(rows.count);
  if (Column::kFill == Fill::kAll) {
    for (std::size_t i = 0; i < count.size(); ++i) count[i] = static_cast<std::uint32_t>(expected(i));
  } else {
    if (Column::kFill == Fill::kAllOrNone && !file.exists(name)) return out;
    const auto read_counts = [&]() -> Status {
      MORULA_TRY_ASSIGN(count, file.read<std::uint32_t>(name + "_count", rows.first, rows.count));
      return {};
    };
    MORULA_TRY(agree(read_counts(), comm));
  }
  const std::uint64_t total = std::accumulate(count.begin(), count.end(), std::uint64_t{0}), first = before_mine(total, comm);
  const auto read_values = [&]() -> Status {
    MORULA_TRY_ASSIGN(const std::vector<Value> values, file.read<Value>(name, first, total));
    auto next = values.begin();
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i].assign(next, next + count[i]);
      next += count[i];
    }
    return {};
  };
  MORULA_TRY(agree(read_values(), comm));
  return out;
}

/// Collective.
Status read_spheres(const Hdf5Reader& file, const Rows& rows, const Comm& comm, cbm::Spheres& out) {
  Status status;
  cbm::for_each_sphere_column([&](const auto& column) {
    if (!status.ok()) return;  // the same on all ranks
    auto values = read_column(
        file, "spheres/", column, rows, [](std::size_t) { return 1; }, comm);
    if (!values.ok())
      status = std::move(values).error();
    else
      for (const auto& of_sphere : *values) column.append(out, of_sphere);
  });
  return status;
}

Status read_shell_shapes(const Hdf5Reader& file, const std::string& group, const Rows& rows, ShapeLibrary& library,
                         std::vector<std::shared_ptr<const ReferenceShape>>& out) {
  MORULA_TRY_ASSIGN(const std::vector<std::uint32_t> shape, file.read<std::uint32_t>(group + "shape", rows.first, rows.count));
  const std::set<std::uint32_t> used(shape.begin(), shape.end());
  MORULA_TRY_ASSIGN(const auto shapes, read_shapes(file, {used.begin(), used.end()}, library));
  for (const std::uint32_t number : shape) out.push_back(shapes.at(number));
  return {};
}

/// `group`: `shells/`, or that of the nuclei that are shells. Collective.
Status read_shells(const Hdf5Reader& file, const std::string& group, const Rows& rows, ShapeLibrary& library, const Comm& comm,
                   dcm::Shells& out) {
  std::vector<ShellRecord> shells(rows.count);
  std::vector<std::shared_ptr<const ReferenceShape>> shape;
  Status status = agree(read_shell_shapes(file, group, rows, library, shape), comm);
  if (status.ok())
    for (std::size_t i = 0; i < shells.size(); ++i) shells[i].shape = shape[i];
  dcm::for_each_shell_column([&](const auto& column) {
    if (!status.ok()) return;  // the same on all ranks
    const auto expected = [&](std::size_t i) { return dcm::count_of(column.kDomain, *shells[i].shape); };
    auto values = read_column(file, group, column, rows, expected, comm);
    if (!values.ok())
      status = std::move(values).error();
    else
      for (std::size_t i = 0; i < shells.size(); ++i) column.give(shells[i], (*values)[i]);
  });
  MORULA_TRY(status);
  for (const ShellRecord& shell : shells) dcm::add_shell(out, shell);
  return {};
}

/// Nuclei that are shells, in the order of the shells. Collective.
Status read_nuclear_shells(const Hdf5Reader& file, const Rows& shells, ShapeLibrary& library, const Comm& comm, dcm::NuclearShells& out) {
  const char* name = "shells/has_nuclear_shell";
  if (!file.exists(name)) return {};
  std::vector<std::uint8_t> has;
  const auto read_flags = [&]() -> Status {
    MORULA_TRY_ASSIGN(has, file.read<std::uint8_t>(name, shells.first, shells.count));
    return {};
  };
  MORULA_TRY(agree(read_flags(), comm));
  for (std::uint32_t s = 0; s < has.size(); ++s)
    if (has[s] != 0) out.owner.push_back(s);
  return read_shells(file, "nuclear_shells/", {before_mine(out.size(), comm), out.size()}, library, comm, out.shells);
}

/// Rows and bodies of this rank in the order of ids. Collective: where a rank's bodies begin follows from the ranks before it.
Status read_cells(const Hdf5Reader& file, ShapeLibrary& library, const Comm& comm, Tissue& out) {
  std::uint64_t total = 0;
  MORULA_TRY_ASSIGN(total, file.rows("cells/id"));
  MORULA_TRY(agree(read_rows(file, Stretch(total, comm), out.cells), comm));
  const auto is_sphere = [](const CellRow& row) { return row.body == BodyKind::kSphere; };
  const auto spheres = static_cast<std::uint64_t>(std::count_if(out.cells.rows.begin(), out.cells.rows.end(), is_sphere));
  const std::uint64_t shells = out.cells.rows.size() - spheres;
  const Rows my_spheres{before_mine(spheres, comm), spheres}, my_shells{before_mine(shells, comm), shells};
  MORULA_TRY(read_spheres(file, my_spheres, comm, out.spheres));
  MORULA_TRY(read_shells(file, "shells/", my_shells, library, comm, out.shells));
  return read_nuclear_shells(file, my_shells, library, comm, out.nuclei);
}

/// The same cells in canonical order, bodies with them.
void put_in_canonical_order(Tissue& tissue) {
  std::vector<CellRecord> cells = take_apart(tissue);
  put_together(tissue, std::move(cells));
}

Status read_field(const Hdf5Reader& file, const std::string& group, const Comm& comm, fields::Field& field) {
  MORULA_TRY_ASSIGN(field.grid.box.low, file.value<Vec3d>(group + "/low"));
  MORULA_TRY_ASSIGN(field.grid.box.high, file.value<Vec3d>(group + "/high"));
  MORULA_TRY_ASSIGN(field.grid.voxels, (file.value<std::array<std::int32_t, 3>>(group + "/voxels")));
  MORULA_TRY_ASSIGN(field.grid.bricks, (file.value<std::array<std::int32_t, 3>>(group + "/bricks")));
  Status read;
  for_each_field_number([&](const char* name, const char*, auto member) {
    auto value = file.value<double>(group + '/' + name);
    if (!value.ok())
      read = value.error();
    else
      field.*member = *value;
  });
  MORULA_TRY(read);
  const auto bricks = static_cast<std::uint64_t>(field.grid.brick_count());
  for (int rank = 0; rank < comm.size(); ++rank) field.owner.resize(Stretch(bricks, rank, comm.size()).end, rank);
  const Stretch mine(bricks, comm);
  std::uint64_t place = 0;
  for (std::uint64_t b = 0; b < mine.begin; ++b) place += brick_voxel_count(field.grid, static_cast<std::int64_t>(b));
  for (std::uint64_t b = mine.begin; b < mine.end; ++b) {
    const std::size_t count = brick_voxel_count(field.grid, static_cast<std::int64_t>(b));
    field.owned_bricks.push_back(static_cast<std::int64_t>(b));
    MORULA_TRY_ASSIGN(std::vector<double> values, file.read<double>(group + "/concentration", place, count));
    field.concentration.push_back(std::move(values));
    place += count;
  }
  return {};
}

Status read_fields(const Hdf5Reader& file, const Comm& comm, Tissue& out) {
  MORULA_TRY_ASSIGN(const std::uint32_t count, file.value<std::uint32_t>("info/field_count"));
  out.fields.resize(count);
  for (std::uint32_t f = 0; f < count; ++f) MORULA_TRY(read_field(file, "fields/" + std::to_string(f), comm, out.fields[f]));
  return {};
}

Error differs(const char* what, std::size_t in_file, std::size_t in_study) {
  return {ErrorKind::kInput, "the checkpoint has " + std::to_string(in_file) + ' ' + what + ", the study " + std::to_string(in_study),
          "resume with the study that the run was started with"};
}

/// The cells of the tissue get the variables of the model, if the fields in the file are as many.
Status declare_variables(const Hdf5Reader& file, const Model& model, Tissue& out) {
  MORULA_TRY_ASSIGN(const std::uint32_t fields, file.value<std::uint32_t>("info/field_count"));
  if (fields != model.fields.size()) return differs("fields", fields, model.fields.size());
  out.cells.declare(cell_variables(model));
  return {};
}

Status check_against(const Model& model, const Tissue& tissue) {
  const std::size_t obstacles = contact_obstacle_count(model);
  if (tissue.obstacle_offset.size() != obstacles) return differs("obstacles and walls", tissue.obstacle_offset.size(), obstacles);
  if (tissue.lumens.size() > model.lumens.size()) return differs("lumens", tissue.lumens.size(), model.lumens.size());
  for (const CellRow& row : tissue.cells.rows)
    if (row.type >= model.types.size()) return differs("cell types or more", row.type + std::size_t{1}, model.types.size());
  for (std::size_t s = 0; s < tissue.shells.size(); ++s) {
    const dcm::InteriorParameters& interior = model.types[tissue.shells.type[s]].interior;
    const bool has = tissue.shells.nucleus_of(s) != nullptr, wanted = interior.has_rigid_nucleus();
    if (has != wanted) return differs("rigid nuclei in a shell", has, wanted);
    const std::size_t n = tissue.nuclei.of_shell(s);
    const std::size_t nodes = n < tissue.nuclei.size() ? tissue.nuclei.shells.topology(n).node_count() : 0;
    const std::size_t wanted_nodes = interior.has_nuclear_shell() ? interior.nucleus_nodes : 0;
    if (nodes != wanted_nodes) return differs("nodes in the nucleus of a shell", nodes, wanted_nodes);
  }
  return {};
}

}  // namespace

Status check_checkpoint_version(const std::filesystem::path& path, const Hdf5Reader& file) {
  MORULA_TRY_ASSIGN(const std::uint32_t version, file.value<std::uint32_t>("format_version"));
  if (version == kCheckpointFormat) return {};
  std::string writer = "another Morula";
  if (const auto text = file.text("info/morula_version"); text.ok()) writer = "Morula " + text.value();
  return Error{ErrorKind::kInput,
               "checkpoint '" + path.string() + "' has format version " + std::to_string(version) + " (written by " + writer +
                   "), and this Morula " + build_info().version + " reads version " + std::to_string(kCheckpointFormat),
               "resume with the version of Morula that wrote it"};
}

Result<LoadedCheckpoint> read_checkpoint(const std::filesystem::path& path, const Model& model, ShapeLibrary& shapes, const Comm& comm) {
  auto opened = Hdf5Reader::open(path);
  MORULA_TRY(agree(opened.ok() ? Status{} : Status(opened.error()), comm));
  const Hdf5Reader file = std::move(opened).value();
  MORULA_TRY(agree(check_checkpoint_version(path, file), comm));
  MORULA_TRY(file.verify(comm));
  LoadedCheckpoint out;
  MORULA_TRY(agree(read_globals(file, out), comm));
  MORULA_TRY(agree(declare_variables(file, model, out.tissue), comm));
  MORULA_TRY(read_cells(file, shapes, comm, out.tissue));
  MORULA_TRY(agree(read_fields(file, comm, out.tissue), comm));
  MORULA_TRY(agree(check_against(model, out.tissue), comm));
  put_in_canonical_order(out.tissue);
  return out;
}

}  // namespace morula::scenarios
