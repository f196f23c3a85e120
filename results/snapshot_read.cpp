#include <charconv>
#include <cstdio>
#include <string_view>
#include <type_traits>

#include "results/hdf5_reader.h"
#include "results/snapshot_columns.h"
#include "results/snapshot_file.h"

namespace morula::scenarios {
namespace {

Error no_such_snapshot(const std::filesystem::path& path, std::size_t index, std::size_t count) {
  return Error{ErrorKind::kFile,
               "'" + path.string() + "' has no snapshot " + std::to_string(index) + " (it has " + std::to_string(count) + ")", ""};
}

/// The file is of the schema that this program writes.
Status check_schema(const Hdf5Reader& file, const std::filesystem::path& path) {
  const std::uint64_t schema = file.root_number("schema").value_or(1);
  if (schema == kResultsSchema) return {};
  return Error{
      ErrorKind::kFile,
      "'" + path.string() + "' has schema " + std::to_string(schema) + ", this program reads schema " + std::to_string(kResultsSchema),
      "results are no checkpoint: read the file with the version that wrote it, or move it aside and run or resume again"};
}

/// The id with this name (CellId::text); invalid for "0" and for what is no name.
CellId id_of_text(std::string_view text) {
  const std::size_t point = text.find('.');
  std::uint64_t founder = 0;
  const std::string_view number = text.substr(0, point);
  const auto [end, problem] = std::from_chars(number.data(), number.data() + number.size(), founder);
  if (problem != std::errc() || end != number.data() + number.size() || founder == 0 || founder >> CellId::kFounderBits != 0) return {};
  CellId id = CellId::founder(founder);
  for (const char c : point == std::string_view::npos ? std::string_view() : text.substr(point + 1)) {
    if ((c != '0' && c != '1') || !id.can_divide()) return {};
    id = id.daughter(c - '0');
  }
  return id;
}

Result<std::vector<CellId>> read_ids(const Hdf5Reader& file, const std::string& path, std::uint64_t count) {
  MORULA_TRY_ASSIGN(const std::vector<std::string> texts, file.texts(path));
  std::vector<CellId> ids;
  for (const std::string& text : texts) {
    ids.push_back(id_of_text(text));
    if (!ids.back().valid() && text != CellId().text()) return Error{ErrorKind::kFile, "'" + text + "' in " + path + " names no cell", ""};
  }
  if (ids.size() != count) return Error{ErrorKind::kFile, path + " has another length than its table", ""};
  return ids;
}

/// A column of the cells' table, the values of `Value` in the order of the cells.
template <class Value>
Result<std::vector<Value>> read_column(const Hdf5Reader& file, const std::string& path, std::uint64_t count) {
  if constexpr (std::is_same_v<Value, CellId>) {
    return read_ids(file, path, count);
  } else {
    return file.read<Value>(path, 0, count);
  }
}

Status read_cells(const Hdf5Reader& file, const std::string& group, const std::vector<std::string>& field_names, Snapshot& out) {
  MORULA_TRY_ASSIGN(const std::uint64_t count, file.rows(group + "cells/id"));
  out.cells.resize(count);
  Status status;
  for_each_snapshot_column([&](const std::string& name, const char*, const char*, auto member) {
    using Value = std::remove_cvref_t<decltype(out.cells.front().*member)>;
    auto column = read_column<Value>(file, group + "cells/" + name, count);
    if (!column.ok()) {
      if (status.ok()) status = std::move(column).error();
      return;
    }
    for (std::size_t i = 0; i < count; ++i) out.cells[i].*member = column.value()[i];
  });
  MORULA_TRY(status);
  std::vector<std::string> variables, units;
  if (file.exists(group + "variable_names")) {
    MORULA_TRY_ASSIGN(variables, file.texts(group + "variable_names"));
    MORULA_TRY_ASSIGN(units, file.texts(group + "variable_units"));
    if (units.size() != variables.size()) return Error{ErrorKind::kFile, "the names and units in " + group + " are not as many", ""};
  } else {  // written before there were any but these
    for (const std::string& field : field_names) variables.push_back("concentration/" + field), units.emplace_back("mM");
  }
  for (std::size_t v = 0; v < variables.size(); ++v) {
    MORULA_TRY_ASSIGN(auto values, file.read<double>(group + "cells/" + variables[v], 0, count));
    out.variables.push_back({variables[v], units[v], std::move(values)});
  }
  return {};
}

/// Obstacles with their surfaces, and cavities.
Status read_surroundings(const Hdf5Reader& file, const std::string& group, Snapshot& out) {
  if (file.exists(group + "obstacles/name")) {
    MORULA_TRY_ASSIGN(const auto names, file.texts(group + "obstacles/name"));
    MORULA_TRY_ASSIGN(const auto offset, file.read<Vec3d>(group + "obstacles/offset", 0, names.size()));
    for (std::size_t i = 0; i < names.size(); ++i) {
      Snapshot::Obstacle& obstacle = out.obstacles.emplace_back();
      obstacle.name = names[i];
      obstacle.offset = offset[i];
      const std::string surface = "obstacles/" + names[i] + '/';
      if (!file.exists(surface + "faces")) continue;
      MORULA_TRY_ASSIGN(obstacle.position, file.read<Vec3d>(surface + "position"));
      MORULA_TRY_ASSIGN(obstacle.faces, file.read<Triangle>(surface + "faces"));
      for (const Triangle& face : obstacle.faces)
        for (const std::uint32_t node : face)
          if (node >= obstacle.position.size()) return Error{ErrorKind::kFile, "a face of obstacle " + names[i] + " points outside it", ""};
    }
  }
  if (!file.exists(group + "lumens/name")) return {};
  MORULA_TRY_ASSIGN(const auto names, file.texts(group + "lumens/name"));
  MORULA_TRY_ASSIGN(const auto center, file.read<Vec3d>(group + "lumens/center", 0, names.size()));
  MORULA_TRY_ASSIGN(const auto volume, file.read<double>(group + "lumens/volume", 0, names.size()));
  MORULA_TRY_ASSIGN(const auto pressure, file.read<double>(group + "lumens/pressure", 0, names.size()));
  for (std::size_t i = 0; i < names.size(); ++i) out.lumens.push_back({names[i], center[i], volume[i], pressure[i]});
  return {};
}

/// Surfaces of cells, or of nuclei.
Status read_surfaces(const Hdf5Reader& file, const std::string& group, const Snapshot& snapshot, std::vector<Snapshot::Shell>& shells,
                     std::vector<Vec3d>& nodes) {
  MORULA_TRY_ASSIGN(const auto cell, file.read<std::uint64_t>(group + "cell"));
  MORULA_TRY_ASSIGN(const auto first, file.read<std::uint64_t>(group + "first_node", 0, cell.size()));
  MORULA_TRY_ASSIGN(const auto count, file.read<std::uint32_t>(group + "node_count", 0, cell.size()));
  MORULA_TRY_ASSIGN(const auto topology, file.read<std::uint32_t>(group + "topology", 0, cell.size()));
  MORULA_TRY_ASSIGN(nodes, file.read<Vec3d>(group + "node"));
  for (std::size_t i = 0; i < cell.size(); ++i) {
    if (cell[i] >= snapshot.cells.size() || topology[i] >= snapshot.topologies.size() || first[i] + count[i] > nodes.size())
      return Error{ErrorKind::kFile, "a shell in " + group + " points outside its arrays", ""};
    for (const Triangle& face : snapshot.topologies[topology[i]])
      for (const std::uint32_t node : face)
        if (node >= count[i]) return Error{ErrorKind::kFile, "a face in " + group + " points outside its shell", ""};
    shells.push_back({static_cast<std::uint32_t>(cell[i]), static_cast<std::uint32_t>(first[i]), count[i], topology[i]});
  }
  return {};
}

Status read_shells(const Hdf5Reader& file, const std::string& group, Snapshot& out) {
  MORULA_TRY_ASSIGN(const auto face_count, file.read<std::uint32_t>(group + "topologies/face_count"));
  // At once: a checksum is of a whole dataset.
  MORULA_TRY_ASSIGN(const std::vector<Triangle> all_faces, file.read<Triangle>(group + "topologies/faces"));
  std::size_t place = 0;
  for (const std::uint32_t faces : face_count) {
    if (faces > all_faces.size() - place) return Error{ErrorKind::kFile, "the lists of faces in " + group + " are cut short", ""};
    const auto begin = all_faces.begin() + static_cast<std::ptrdiff_t>(place);
    out.topologies.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(faces));
    place += faces;
  }
  MORULA_TRY(read_surfaces(file, group + "shells/", out, out.shells, out.nodes));
  if (file.exists(group + "nuclear_shells/cell"))
    MORULA_TRY(read_surfaces(file, group + "nuclear_shells/", out, out.nuclear_shells, out.nuclear_nodes));
  if (!file.exists(group + "mark_names")) return {};
  MORULA_TRY_ASSIGN(out.mark_names, file.texts(group + "mark_names"));
  MORULA_TRY_ASSIGN(out.face_marks, file.read<std::uint8_t>(group + "shells/face_marks"));
  std::size_t faces = 0;
  for (const Snapshot::Shell& shell : out.shells) faces += out.topologies[shell.topology].size();
  if (out.face_marks.size() != faces * out.mark_width())
    return Error{ErrorKind::kFile, "the marks in " + group + " are not those of its faces", ""};
  return {};
}

Status read_nuclei(const Hdf5Reader& file, const std::string& group, Snapshot& out) {
  if (!file.exists(group + "nuclei/cell")) return {};
  MORULA_TRY_ASSIGN(const auto cell, file.read<std::uint64_t>(group + "nuclei/cell"));
  MORULA_TRY_ASSIGN(const auto center, file.read<Vec3d>(group + "nuclei/center", 0, cell.size()));
  MORULA_TRY_ASSIGN(const auto radius, file.read<double>(group + "nuclei/radius", 0, cell.size()));
  for (std::size_t i = 0; i < cell.size(); ++i) {
    if (cell[i] >= out.cells.size()) return Error{ErrorKind::kFile, "a nucleus in " + group + " belongs to no cell", ""};
    out.nuclei.push_back({static_cast<std::uint32_t>(cell[i]), center[i], radius[i]});
  }
  return {};
}

Status read_fields(const Hdf5Reader& file, const std::string& group, const std::vector<std::string>& names, Snapshot& out) {
  for (const std::string& name : names) {
    Snapshot::Grid grid;
    const std::string field = group + "fields/" + name;
    grid.name = name;
    MORULA_TRY_ASSIGN(grid.low, file.value<Vec3d>(field + "/low"));
    MORULA_TRY_ASSIGN(grid.spacing, file.value<Vec3d>(field + "/spacing"));
    MORULA_TRY_ASSIGN(grid.voxels, (file.value<std::array<std::int32_t, 3>>(field + "/voxels")));
    MORULA_TRY_ASSIGN(grid.concentration, file.read<double>(field + "/concentration"));
    out.fields.push_back(std::move(grid));
  }
  return {};
}

Result<Snapshot> read_one(const Hdf5Reader& file, std::size_t index) {
  const std::string group = snapshot_group(index) + '/';
  Snapshot out;
  MORULA_TRY_ASSIGN(out.time, file.value<double>(group + "time"));
  if (file.exists(group + "box/low")) {
    MORULA_TRY_ASSIGN(out.box.low, file.value<Vec3d>(group + "box/low"));
    MORULA_TRY_ASSIGN(out.box.high, file.value<Vec3d>(group + "box/high"));
  }
  MORULA_TRY_ASSIGN(out.type_names, file.texts(group + "type_names"));
  MORULA_TRY_ASSIGN(const std::vector<std::string> field_names, file.texts(group + "field_names"));
  MORULA_TRY(read_cells(file, group, field_names, out));
  MORULA_TRY(read_shells(file, group, out));
  MORULA_TRY(read_nuclei(file, group, out));
  MORULA_TRY(read_surroundings(file, group, out));
  MORULA_TRY(read_fields(file, group, field_names, out));
  return out;
}

/// How many there are in a file of this schema.
Result<std::uint64_t> count_all(const Hdf5Reader& file, const std::filesystem::path& path) {
  MORULA_TRY(check_schema(file, path));
  return file.exists("snapshots") ? file.links("snapshots") : Result<std::uint64_t>(std::uint64_t{0});
}

}  // namespace

std::string snapshot_group(std::size_t index) {
  char name[40];
  std::snprintf(name, sizeof name, "snapshots/%06zu", index);
  return name;
}

Result<std::vector<SnapshotEntry>> list_snapshots(const std::filesystem::path& path) {
  MORULA_TRY_ASSIGN(const Hdf5Reader file, Hdf5Reader::open(path));
  std::vector<SnapshotEntry> entries;
  MORULA_TRY_ASSIGN(const std::uint64_t count, count_all(file, path));
  while (entries.size() < count) {
    SnapshotEntry entry;
    entry.index = entries.size();
    const std::string group = snapshot_group(entry.index);
    MORULA_TRY_ASSIGN(entry.time, file.value<double>(group + "/time"));
    MORULA_TRY_ASSIGN(entry.cells, file.rows(group + "/cells/id"));
    entries.push_back(entry);
  }
  return entries;
}

Result<SnapshotCounts> count_snapshots(const std::filesystem::path& path, double time, bool with_equal) {
  MORULA_TRY_ASSIGN(const Hdf5Reader file, Hdf5Reader::open(path));
  SnapshotCounts counts;
  MORULA_TRY_ASSIGN(counts.all, count_all(file, path));
  for (counts.earlier = counts.all; counts.earlier > 0; --counts.earlier) {
    MORULA_TRY_ASSIGN(const double last, file.value<double>(snapshot_group(counts.earlier - 1) + "/time"));
    if (last < time || (with_equal && last == time)) break;
  }
  return counts;
}

Result<Snapshot> read_snapshot(const std::filesystem::path& path, std::size_t index) {
  MORULA_TRY_ASSIGN(const Hdf5Reader file, Hdf5Reader::open(path));
  MORULA_TRY_ASSIGN(const std::uint64_t count, count_all(file, path));
  if (index >= count) return no_such_snapshot(path, index, count);
  return read_one(file, index);
}

Result<std::vector<Snapshot>> read_snapshots(const std::filesystem::path& path) {
  MORULA_TRY_ASSIGN(const Hdf5Reader file, Hdf5Reader::open(path));
  MORULA_TRY_ASSIGN(const std::uint64_t count, count_all(file, path));
  std::vector<Snapshot> out;
  while (out.size() < count) {
    MORULA_TRY_ASSIGN(Snapshot one, read_one(file, out.size()));
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace morula::scenarios
