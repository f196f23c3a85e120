#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <type_traits>

#include "core/numbers/hash128.h"
#include "results/build_info.h"
#include "results/checkpoint.h"
#include "results/file_io.h"
#include "results/hdf5_plan.h"
#include "results/hdf5_reader.h"
#include "results/parcels.h"
#include "results/snapshot_columns.h"
#include "results/snapshot_file.h"

namespace morula::scenarios {
namespace {

template <class T>
void add(StoragePlan& plan, const ResultsDataset& dataset, const std::vector<T>& local, const std::string& group = "") {
  plan.add(group + dataset.path, dataset.label(), local);
}

/// Adds every face list of all ranks once; returns the number in the file of each of this rank's.
std::vector<std::uint32_t> add_topologies(StoragePlan& plan, const Snapshot& local, const Comm& comm) {
  std::vector<Hash128> hashes;
  Parcels parcels;
  ByteWriter bytes;
  for (const std::vector<Triangle>& faces : local.topologies) {
    hashes.push_back(hash128(std::as_bytes(std::span(faces))));
    bytes.clear();
    bytes.put(hashes.back());
    bytes.put_all(std::span(faces));
    parcels.add(hashes.back().low, bytes.bytes());
  }
  const Parcels sorted = sort_over_ranks(parcels, comm);
  std::vector<std::uint32_t> face_count;
  std::vector<Triangle> all_faces;
  std::vector<Hash128> order;
  std::set<Hash128> kept;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    ByteReader reader(sorted.bytes(i));
    const auto hash = reader.get<Hash128>();
    if (!kept.insert(hash).second) continue;
    const std::size_t count = (sorted.bytes(i).size() - sizeof(Hash128)) / sizeof(Triangle);
    order.push_back(hash);
    face_count.push_back(static_cast<std::uint32_t>(count));
    reader.get_all(count, all_faces);
  }
  add(plan, results::kFaceCount, face_count);
  add(plan, results::kFaces, all_faces);

  const std::vector<std::byte> gathered = comm.gather_to_all(std::as_bytes(std::span(order)));
  std::map<Hash128, std::uint32_t> number;
  for (ByteReader reader(gathered); !reader.empty();) number.emplace(reader.get<Hash128>(), static_cast<std::uint32_t>(number.size()));
  std::vector<std::uint32_t> numbers;
  for (const Hash128& hash : hashes) numbers.push_back(number.at(hash));
  return numbers;
}

Parcels pack_cells(const Snapshot& local, const std::vector<std::uint32_t>& topology_number) {
  std::vector<const Snapshot::Shell*> shell_of(local.cells.size(), nullptr);
  for (const Snapshot::Shell& shell : local.shells) shell_of[shell.cell] = &shell;
  std::vector<const Snapshot::Nucleus*> nucleus_of(local.cells.size(), nullptr);
  for (const Snapshot::Nucleus& nucleus : local.nuclei) nucleus_of[nucleus.cell] = &nucleus;
  std::vector<const Snapshot::NuclearShell*> nuclear_shell_of(local.cells.size(), nullptr);
  for (const Snapshot::NuclearShell& nucleus : local.nuclear_shells) nuclear_shell_of[nucleus.cell] = &nucleus;
  std::vector<std::size_t> first_face(local.cells.size(), 0);
  std::size_t faces = 0;
  for (const Snapshot::Shell& shell : local.shells) {
    first_face[shell.cell] = faces;
    faces += local.topologies[shell.topology].size();
  }
  Parcels parcels;
  ByteWriter out;
  for (std::size_t c = 0; c < local.cells.size(); ++c) {
    out.clear();
    out.put(local.cells[c]);
    for (const Snapshot::Variable& variable : local.variables) out.put(variable.values[c]);
    const Snapshot::Shell* shell = shell_of[c];
    out.put(std::uint32_t{shell == nullptr ? 0 : shell->node_count});
    if (shell != nullptr) {
      out.put(topology_number[shell->topology]);
      out.put_all(std::span(local.nodes).subspan(shell->first_node, shell->node_count));
      out.put(std::uint8_t{nucleus_of[c] != nullptr});
      if (nucleus_of[c] != nullptr) {
        out.put(nucleus_of[c]->center);
        out.put(nucleus_of[c]->radius);
      }
      const Snapshot::NuclearShell* nuclear = nuclear_shell_of[c];
      out.put(std::uint32_t{nuclear == nullptr ? 0 : nuclear->node_count});
      if (nuclear != nullptr) {
        out.put(topology_number[nuclear->topology]);
        out.put_all(std::span(local.nuclear_nodes).subspan(nuclear->first_node, nuclear->node_count));
      }
      if (!local.mark_names.empty())
        out.put_all(std::span(local.face_marks)
                        .subspan(first_face[c] * local.mark_width(), local.topologies[shell->topology].size() * local.mark_width()));
    }
    parcels.add(local.cells[c].id.bits(), out.bytes());
  }
  return parcels;
}

/// Surfaces as columns: those of cells, or of nuclei.
struct SurfaceColumns {
  std::vector<std::uint64_t> cell, first_node;
  std::vector<std::uint32_t> node_count, topology;
  std::vector<Vec3d> nodes;

  void take(std::uint64_t of_cell, std::uint32_t count, ByteReader& in) {
    cell.push_back(of_cell);
    first_node.push_back(nodes.size());
    node_count.push_back(count);
    topology.push_back(in.get<std::uint32_t>());
    in.get_all(count, nodes);
  }
  void add_to(StoragePlan& plan, const std::string& group, const Comm& comm) {
    const auto before = static_cast<std::uint64_t>(comm.exclusive_scan(static_cast<std::int64_t>(nodes.size())));
    for (std::uint64_t& first : first_node) first += before;
    add(plan, results::kSurfaceCell, cell, group);
    add(plan, results::kFirstNode, first_node, group);
    add(plan, results::kNodeCount, node_count, group);
    add(plan, results::kTopology, topology, group);
    add(plan, results::kNode, nodes, group);
  }
};

void add_ids(StoragePlan& plan, const std::string& path, const DatasetLabel& label, const std::vector<CellId>& ids, const Comm& comm) {
  std::vector<std::string> texts;
  std::size_t width = 1;
  for (const CellId id : ids) width = std::max(width, texts.emplace_back(id.text()).size());
  plan.add_text_rows(path, label, texts, static_cast<std::uint32_t>(comm.max(static_cast<std::int64_t>(width))));
}

/// Names of the values of a column, for those that are kinds.
template <class Value>
std::vector<std::string> kinds_of(const Snapshot& local) {
  if constexpr (std::is_same_v<Value, BodyKind>) return {kBodyNames.begin(), kBodyNames.end()};
  if constexpr (std::is_same_v<Value, Phase>) return {kPhaseNames.begin(), kPhaseNames.end()};
  // The names stand in the dataset's header, which has room for 64 KiB; beyond that `type_names` tells them.
  std::size_t length = 0;
  for (const std::string& name : local.type_names) length += name.size() + 4;
  if (std::is_same_v<Value, std::uint16_t> && length < 32768) return local.type_names;
  return {};
}

/// This rank's stretch of the sorted cells.
struct CellsOfRank {
  std::vector<Snapshot::Cell> cells;
  std::vector<double> variables;  ///< all of a cell, then all of the next
};

/// What a dataset of a variable says of itself.
std::string description_of(const Snapshot::Variable& variable) {
  if (variable.name.starts_with("concentration/")) return "concentration that the cell sees";
  if (variable.name.starts_with("amount/")) return "amount taken from the field since time 0; daughters share their mother's by volume";
  if (variable.name == "mesh_renewal/done") return "how often the nodes of the shell were spread evenly since its birth";
  if (variable.name == "mesh_renewal/refused") return "how often they could not be";
  if (variable.name == "mesh_renewal/next_try") return "after one that could not be";
  if (variable.name == "mesh_renewal/area_change") return "largest relative change of area of a renewal";
  if (variable.name == "mesh_renewal/distance") return "largest distance between old and new surface, in mean edges";
  if (variable.name == "own_mesh/passes") return "how often the connectivity of the shell was changed since its birth";
  if (variable.name == "own_mesh/changes") return "how many of its edges were split, drawn together or turned";
  if (variable.name == "own_mesh/skipped") return "changes that were wanted and could not be made";
  if (variable.name == "own_mesh/returns") return "how often it went back to the mesh of its type";
  if (variable.name == "own_mesh/next_pass") return "after one that gained nothing";
  if (variable.name == "own_mesh/area_change") return "largest relative change of area of a pass";
  if (variable.name == "own_mesh/volume_change") return "largest relative change of volume of a pass";
  if (variable.name == "own_mesh/off_surface") return "farthest that a pass has put a node off the surface, in mean edges";
  if (variable.name == "outside_law") return "how far the cell as a sphere is beyond the range of its laws; 1 at the end of the range";
  if (variable.name.starts_with("polarity/")) return "direction of the cell, of length 1, in components; 0 where it has none";
  return "state of the cell, of a law of the study";
}

/// The columns of the cells' table, each a dataset, and their variables.
void add_cell_columns(StoragePlan& plan, const Snapshot& local, const CellsOfRank& table, const Comm& comm) {
  const std::vector<Snapshot::Cell>& cells = table.cells;
  for_each_snapshot_column([&](const std::string& name, const char* units, const char* description, auto member) {
    using Value = std::remove_cvref_t<decltype(cells.front().*member)>;
    std::vector<Value> column;
    for (const Snapshot::Cell& cell : cells) column.push_back(cell.*member);
    const DatasetLabel label(units, description, kinds_of<Value>(local));
    if constexpr (std::is_same_v<Value, CellId>) {
      add_ids(plan, "cells/" + name, label, column, comm);
    } else {
      plan.add("cells/" + name, label, column);
    }
  });
  const std::size_t count = local.variables.size();
  for (std::size_t v = 0; v < count; ++v) {
    std::vector<double> column;
    for (std::size_t i = 0; i < cells.size(); ++i) column.push_back(table.variables[i * count + v]);
    const Snapshot::Variable& variable = local.variables[v];
    plan.add("cells/" + variable.name, DatasetLabel(variable.unit, description_of(variable)), column);
  }
}

void add_cells(StoragePlan& plan, const Parcels& sorted, const Snapshot& local, const Comm& comm) {
  const bool marks = !local.mark_names.empty();
  CellsOfRank table;
  SurfaceColumns shells, nuclear_shells;
  std::vector<Vec3d> nucleus_center;
  std::vector<std::uint64_t> nucleus_cell;
  std::vector<double> nucleus_radius;
  std::vector<std::uint8_t> face_marks;
  const auto first_cell = static_cast<std::uint64_t>(comm.exclusive_scan(static_cast<std::int64_t>(sorted.size())));
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    ByteReader in(sorted.bytes(i));
    table.cells.push_back(in.get<Snapshot::Cell>());
    in.get_all(local.variables.size(), table.variables);
    const auto count = in.get<std::uint32_t>();
    if (count == 0) continue;
    shells.take(first_cell + i, count, in);
    if (in.get<std::uint8_t>() != 0) {
      nucleus_cell.push_back(first_cell + i);
      nucleus_center.push_back(in.get<Vec3d>());
      nucleus_radius.push_back(in.get<double>());
    }
    if (const auto nuclear = in.get<std::uint32_t>(); nuclear > 0) nuclear_shells.take(first_cell + i, nuclear, in);
    if (marks) in.get_all(in.rest(), face_marks);
  }
  add_cell_columns(plan, local, table, comm);
  shells.add_to(plan, "shells/", comm);
  if (marks) add(plan, results::kFaceMarks, face_marks);
  if (comm.any(!nuclear_shells.cell.empty())) nuclear_shells.add_to(plan, "nuclear_shells/", comm);
  if (!comm.any(!nucleus_cell.empty())) return;
  add(plan, results::kNucleusCell, nucleus_cell);
  add(plan, results::kNucleusCenter, nucleus_center);
  add(plan, results::kNucleusRadius, nucleus_radius);
}

/// Obstacles and cavities, which every rank knows whole.
void add_surroundings(StoragePlan& plan, const Snapshot& local) {
  using results::kObstacleName, results::kObstacleOffset, results::kLumenName, results::kLumenCenter, results::kLumenVolume,
      results::kLumenPressure;
  std::vector<std::string> names;
  std::vector<Vec3d> places;
  for (const Snapshot::Obstacle& obstacle : local.obstacles) names.push_back(obstacle.name), places.push_back(obstacle.offset);
  if (!names.empty()) {
    plan.add_text(kObstacleName.path, names, kObstacleName.label());
    plan.add_from_root(kObstacleOffset.path, kObstacleOffset.label(), std::span<const Vec3d>(places));
  }
  if (local.lumens.empty()) return;
  names.clear(), places.clear();
  std::vector<double> volume, pressure;
  for (const Snapshot::Lumen& lumen : local.lumens) {
    names.push_back(lumen.name), places.push_back(lumen.center);
    volume.push_back(lumen.volume), pressure.push_back(lumen.pressure);
  }
  plan.add_text(kLumenName.path, names, kLumenName.label());
  plan.add_from_root(kLumenCenter.path, kLumenCenter.label(), std::span<const Vec3d>(places));
  plan.add_from_root(kLumenVolume.path, kLumenVolume.label(), std::span<const double>(volume));
  plan.add_from_root(kLumenPressure.path, kLumenPressure.label(), std::span<const double>(pressure));
}

/// The voxels of all bricks as one array over the whole grid, x fastest: rows of voxels are sorted by where they belong.
void add_field(StoragePlan& plan, const std::string& name, const fields::Field& field, const Comm& comm) {
  const fields::Grid& grid = field.grid;
  Parcels rows;
  for (std::size_t b = 0; b < field.owned_bricks.size(); ++b) {
    const std::int64_t number = field.owned_bricks[b];
    const std::array<std::int64_t, 3> brick{number % grid.bricks[0], number / grid.bricks[0] % grid.bricks[1],
                                            number / grid.bricks[0] / grid.bricks[1]};
    std::array<std::int64_t, 3> first{}, count{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      first[axis] = brick[axis] * fields::Grid::kBrick;
      count[axis] = std::min<std::int64_t>(fields::Grid::kBrick, grid.voxels[axis] - first[axis]);
    }
    const std::span<const double> values(field.concentration[b]);
    for (std::int64_t z = 0; z < count[2]; ++z)
      for (std::int64_t y = 0; y < count[1]; ++y) {
        const std::int64_t place = ((first[2] + z) * grid.voxels[1] + first[1] + y) * grid.bricks[0] + brick[0];
        const auto row = values.subspan(static_cast<std::size_t>((z * count[1] + y) * count[0]), static_cast<std::size_t>(count[0]));
        rows.add(static_cast<std::uint64_t>(place), std::as_bytes(row));
      }
  }
  const Parcels sorted = sort_over_ranks(rows, comm);
  std::vector<double> values;
  for (std::size_t i = 0; i < sorted.size(); ++i) ByteReader(sorted.bytes(i)).get_all(sorted.bytes(i).size() / sizeof(double), values);
  const std::string group = "fields/" + name + '/';
  plan.add_value(group + results::kFieldLow.path, results::kFieldLow.label(), grid.box.low);
  plan.add_value(group + results::kFieldSpacing.path, results::kFieldSpacing.label(), grid.spacing());
  plan.add_value(group + results::kFieldVoxels.path, results::kFieldVoxels.label(), grid.voxels);
  add(plan, results::kFieldConcentration, values, group);
}

Status check_local(const Snapshot& local, std::span<const fields::Field> fields) {
  if (local.fields.size() != fields.size())
    return Error{ErrorKind::kInternal,
                 "a snapshot names " + std::to_string(local.fields.size()) + " fields of " + std::to_string(fields.size()), ""};
  for (const Snapshot::Variable& variable : local.variables)
    if (variable.values.size() != local.cells.size())
      return Error{ErrorKind::kInternal, "a snapshot has " + variable.name + " of " + std::to_string(variable.values.size()) + " cells",
                   ""};
  std::size_t faces = 0;
  for (const Snapshot::Shell& shell : local.shells)
    if (shell.topology < local.topologies.size()) faces += local.topologies[shell.topology].size();
  if (!local.mark_names.empty() && local.face_marks.size() != faces * local.mark_width())
    return Error{ErrorKind::kInternal, "a snapshot has " + std::to_string(local.face_marks.size()) + " bytes for the marks of its faces",
                 ""};
  for (const Snapshot::Shell& shell : local.shells)
    if (shell.cell >= local.cells.size() || shell.topology >= local.topologies.size() || shell.node_count == 0 ||
        std::size_t{shell.first_node} + shell.node_count > local.nodes.size())
      return Error{ErrorKind::kInternal, "a snapshot's shell points outside its arrays", ""};
  for (const Snapshot::Nucleus& nucleus : local.nuclei)
    if (nucleus.cell >= local.cells.size() || local.cells[nucleus.cell].body != BodyKind::kShell)
      return Error{ErrorKind::kInternal, "a snapshot's nucleus is in no shell", ""};
  for (const Snapshot::NuclearShell& nucleus : local.nuclear_shells)
    if (nucleus.cell >= local.cells.size() || local.cells[nucleus.cell].body != BodyKind::kShell ||
        nucleus.topology >= local.topologies.size() || nucleus.node_count == 0 ||
        std::size_t{nucleus.first_node} + nucleus.node_count > local.nuclear_nodes.size())
      return Error{ErrorKind::kInternal, "a snapshot's nucleus points outside its arrays", ""};
  return {};
}

/// The snapshots of the file that are earlier than `time` (`with_equal`: or at it) and all that it has, as the root finds them; none if there is no file.
Result<SnapshotCounts> count_on_all(const std::filesystem::path& path, double time, bool with_equal, const Comm& comm) {
  SnapshotCounts counts;
  Status status;
  std::error_code ignored;
  if (comm.is_root() && std::filesystem::exists(path, ignored)) {
    auto counted = count_snapshots(path, time, with_equal);
    if (counted.ok())
      counts = counted.value();
    else
      status = std::move(counted).error();
  }
  MORULA_TRY(agree(std::move(status), comm));
  ByteWriter writer;
  writer.put(counts);
  std::vector<std::byte> bytes(writer.bytes().begin(), writer.bytes().end());
  comm.broadcast(bytes);
  return ByteReader(bytes).get<SnapshotCounts>();
}

/// The groups of write_results_tables that are in the file, the root's list on all ranks.
std::vector<std::string> tables_in(const std::filesystem::path& path, const Comm& comm) {
  std::array<bool, 2> has{};
  std::error_code ignored;
  if (comm.is_root() && std::filesystem::exists(path, ignored))
    if (const auto file = Hdf5Reader::open(path); file.ok()) has = {file->exists("series"), file->exists("events")};
  std::vector<std::string> out;
  if (comm.any(has[0])) out.emplace_back("series");
  if (comm.any(has[1])) out.emplace_back("events");
  return out;
}

std::vector<std::string> later_groups(const SnapshotCounts& counts) {
  std::vector<std::string> groups;
  for (std::size_t index = counts.earlier; index < counts.all; ++index) groups.push_back(snapshot_group(index));
  return groups;
}

/// What every results.h5 says of itself, also one whose run is not known.
void add_program(StoragePlan& plan) {
  const BuildInfo build = build_info();
  plan.add_attribute("program", "Morula");
  plan.add_attribute("version", build.version);
  plan.add_attribute("schema", kResultsSchema);
}

}  // namespace

Status begin_results(const std::filesystem::path& path, const ResultsHead& head, const Comm& comm) {
  std::error_code ignored;
  if (comm.any(comm.is_root() && std::filesystem::exists(path, ignored))) return {};
  StoragePlan plan(comm);
  add_program(plan);
  plan.add_attribute("study", head.study);
  plan.add_attribute("title", head.title);
  plan.add_attribute("seed", head.seed);
  plan.add_text(results::kSourceStudy.path, head.source_study, results::kSourceStudy.label());
  plan.add_text(results::kResolvedStudy.path, head.resolved_study, results::kResolvedStudy.label());
  for (const Snapshot::Obstacle& obstacle : head.obstacles) {
    const std::string group = "obstacles/" + obstacle.name + '/';
    plan.add_from_root(group + results::kObstaclePosition.path, results::kObstaclePosition.label(), std::span(obstacle.position));
    plan.add_from_root(group + results::kObstacleFaces.path, results::kObstacleFaces.label(), std::span(obstacle.faces));
  }
  return add_to_file(path, std::move(plan), {}, comm);
}

Status append_snapshot(const std::filesystem::path& path, const Snapshot& local, std::span<const fields::Field> fields, const Comm& comm) {
  MORULA_TRY(agree(check_local(local, fields), comm));
  MORULA_TRY_ASSIGN(const SnapshotCounts counts, count_on_all(path, local.time, false, comm));
  StoragePlan plan(comm, snapshot_group(counts.earlier) + '/');
  add_program(plan);
  plan.add_value(results::kTime.path, results::kTime.label(), local.time);
  plan.add_value(results::kBoxLow.path, results::kBoxLow.label(), local.box.low);
  plan.add_value(results::kBoxHigh.path, results::kBoxHigh.label(), local.box.high);
  plan.add_text(results::kTypeNames.path, local.type_names, results::kTypeNames.label());
  std::vector<std::string> names;
  for (const Snapshot::Grid& grid : local.fields) names.push_back(grid.name);
  plan.add_text(results::kFieldNames.path, names, results::kFieldNames.label());
  std::vector<std::string> variables, units;
  for (const Snapshot::Variable& variable : local.variables) variables.push_back(variable.name), units.push_back(variable.unit);
  plan.add_text(results::kVariableNames.path, variables, results::kVariableNames.label());
  plan.add_text(results::kVariableUnits.path, units, results::kVariableUnits.label());
  const std::vector<std::uint32_t> numbers = add_topologies(plan, local, comm);
  if (!local.mark_names.empty()) plan.add_text(results::kMarkNames.path, local.mark_names, results::kMarkNames.label());
  add_cells(plan, sort_over_ranks(pack_cells(local, numbers), comm), local, comm);
  add_surroundings(plan, local);
  for (std::size_t f = 0; f < fields.size(); ++f) add_field(plan, local.fields[f].name, fields[f], comm);
  return add_to_file(path, std::move(plan), later_groups(counts), comm);
}

Status truncate_snapshots(const std::filesystem::path& path, double time, const Comm& comm) {
  MORULA_TRY_ASSIGN(const SnapshotCounts counts, count_on_all(path, time, true, comm));
  std::vector<std::string> removed = later_groups(counts);
  for (const std::string& table : tables_in(path, comm)) removed.push_back(table);
  return removed.empty() ? Status{} : add_to_file(path, StoragePlan(comm), removed, comm);
}

}  // namespace morula::scenarios
