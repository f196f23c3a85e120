#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <type_traits>

#include "scenarios/results/checkpoint.h"
#include "scenarios/results/file_io.h"
#include "scenarios/results/hash128.h"
#include "scenarios/results/hdf5_plan.h"
#include "scenarios/results/parcels.h"
#include "scenarios/results/snapshot_columns.h"
#include "scenarios/results/snapshot_file.h"

namespace morula::scenarios {
namespace {

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
  plan.add("topologies/face_count", "1", face_count);
  plan.add("topologies/faces", "1", all_faces);

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
        out.put_all(std::span(local.face_marks).subspan(first_face[c], local.topologies[shell->topology].size()));
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
    plan.add(group + "cell", "1", cell);
    plan.add(group + "first_node", "1", first_node);
    plan.add(group + "node_count", "1", node_count);
    plan.add(group + "topology", "1", topology);
    plan.add(group + "node", "um", nodes);
  }
};

void add_cells(StoragePlan& plan, const Parcels& sorted, bool marks, const Comm& comm) {
  std::vector<Snapshot::Cell> cells;
  SurfaceColumns shells, nuclear_shells;
  std::vector<Vec3d> nucleus_center;
  std::vector<std::uint64_t> nucleus_cell;
  std::vector<double> nucleus_radius;
  std::vector<std::uint8_t> face_marks;
  const auto first_cell = static_cast<std::uint64_t>(comm.exclusive_scan(static_cast<std::int64_t>(sorted.size())));
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    ByteReader in(sorted.bytes(i));
    cells.push_back(in.get<Snapshot::Cell>());
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
  for_each_snapshot_column([&](const std::string& name, const char* units, auto member) {
    std::vector<std::remove_cvref_t<decltype(cells.front().*member)>> column;
    for (const Snapshot::Cell& cell : cells) column.push_back(cell.*member);
    plan.add("cells/" + name, units, column);
  });
  shells.add_to(plan, "shells/", comm);
  if (marks) plan.add("shells/face_marks", "1", face_marks);
  if (comm.any(!nuclear_shells.cell.empty())) nuclear_shells.add_to(plan, "nuclear_shells/", comm);
  if (!comm.any(!nucleus_cell.empty())) return;
  plan.add("nuclei/cell", "1", nucleus_cell);
  plan.add("nuclei/center", "um", nucleus_center);
  plan.add("nuclei/radius", "um", nucleus_radius);
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
  const std::string group = "fields/" + name;
  plan.add_value(group + "/low", "um", grid.box.low);
  plan.add_value(group + "/spacing", "um", grid.spacing());
  plan.add_value(group + "/voxels", "1", grid.voxels);
  plan.add(group + "/concentration", "mM", values);
}

Status check_local(const Snapshot& local, std::span<const fields::Field> fields) {
  if (local.fields.size() != fields.size())
    return Error{ErrorKind::kInternal,
                 "a snapshot names " + std::to_string(local.fields.size()) + " fields of " + std::to_string(fields.size()), ""};
  std::size_t faces = 0;
  for (const Snapshot::Shell& shell : local.shells)
    if (shell.topology < local.topologies.size()) faces += local.topologies[shell.topology].size();
  if (!local.mark_names.empty() && local.face_marks.size() != faces)
    return Error{ErrorKind::kInternal, "a snapshot has marks of " + std::to_string(local.face_marks.size()) + " of its faces", ""};
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

/// The snapshots in the file, the root's list on all ranks; none if there is no file.
Result<std::vector<SnapshotEntry>> list_on_all(const std::filesystem::path& path, const Comm& comm) {
  std::vector<SnapshotEntry> entries;
  Status status;
  std::error_code ignored;
  if (comm.is_root() && std::filesystem::exists(path, ignored)) {
    auto listed = list_snapshots(path);
    if (listed.ok())
      entries = std::move(listed).value();
    else
      status = std::move(listed).error();
  }
  MORULA_TRY(agree(std::move(status), comm));
  ByteWriter writer;
  writer.put_all(std::span(entries));
  std::vector<std::byte> bytes(writer.bytes().begin(), writer.bytes().end());
  comm.broadcast(bytes);
  entries.clear();
  ByteReader(bytes).get_all(bytes.size() / sizeof(SnapshotEntry), entries);
  return entries;
}

std::vector<std::string> groups_from(const std::vector<SnapshotEntry>& entries, double time, bool with_equal) {
  std::vector<std::string> groups;
  for (const SnapshotEntry& entry : entries)
    if (entry.time > time || (with_equal && entry.time == time)) groups.push_back(snapshot_group(entry.index));
  return groups;
}

}  // namespace

Status append_snapshot(const std::filesystem::path& path, const Snapshot& local, std::span<const fields::Field> fields, const Comm& comm) {
  MORULA_TRY(agree(check_local(local, fields), comm));
  MORULA_TRY_ASSIGN(const auto entries, list_on_all(path, comm));
  const std::vector<std::string> removed = groups_from(entries, local.time, true);
  StoragePlan plan(comm, snapshot_group(entries.size() - removed.size()) + '/');
  plan.add_value("time", "s", local.time);
  plan.add_text("type_names", local.type_names);
  std::vector<std::string> names;
  for (const Snapshot::Grid& grid : local.fields) names.push_back(grid.name);
  plan.add_text("field_names", names);
  const std::vector<std::uint32_t> numbers = add_topologies(plan, local, comm);
  if (!local.mark_names.empty()) plan.add_text("mark_names", local.mark_names);
  add_cells(plan, sort_over_ranks(pack_cells(local, numbers), comm), !local.mark_names.empty(), comm);
  for (std::size_t f = 0; f < fields.size(); ++f) add_field(plan, names[f], fields[f], comm);
  return add_to_file(path, std::move(plan), removed, comm);
}

Status truncate_snapshots(const std::filesystem::path& path, double time, const Comm& comm) {
  MORULA_TRY_ASSIGN(const auto entries, list_on_all(path, comm));
  const std::vector<std::string> removed = groups_from(entries, time, false);
  return removed.empty() ? Status{} : add_to_file(path, StoragePlan(comm), removed, comm);
}

}  // namespace morula::scenarios
