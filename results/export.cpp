#include "results/export.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <type_traits>

#include "core/numbers/number_text.h"
#include "results/file_io.h"
#include "results/parcels.h"
#include "results/snapshot_columns.h"
#include "results/snapshot_file.h"
#include "results/vtk_writer.h"

namespace morula::scenarios {
namespace fs = std::filesystem;
namespace {

std::string as_text(const Snapshot&, CellId value) { return value.text(); }
std::string as_text(const Snapshot&, double value) { return shortest_text(value); }
std::string as_text(const Snapshot& s, std::uint16_t type) {
  return type < s.type_names.size() ? csv_field(s.type_names[type]) : std::to_string(type);
}
template <std::size_t kCount>
std::string name_at(const std::array<const char*, kCount>& names, std::size_t kind) {
  return kind < kCount ? names[kind] : "unknown";
}
std::string as_text(const Snapshot&, BodyKind body) { return name_at(kBodyNames, static_cast<std::size_t>(body)); }
std::string as_text(const Snapshot&, Phase phase) { return name_at(kPhaseNames, static_cast<std::size_t>(phase)); }
std::string as_text(const Snapshot&, const Vec3d& v) { return shortest_text(v.x) + ',' + shortest_text(v.y) + ',' + shortest_text(v.z); }

/// Columns of the header that belong to one member.
template <class Value>
std::string heading(const std::string& name, const std::string& units) {
  const std::string unit = units == "1" ? "" : " [" + units + ']';
  if constexpr (std::is_same_v<Value, Vec3d>) return "x" + unit + ",y" + unit + ",z" + unit;
  return name + unit;
}

void put_triangle(ByteWriter& out, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d across = cross(b - a, c - a);
  const double length = std::sqrt(norm2(across));
  const Vec3d normal = length > 0.0 ? across * (1.0 / length) : Vec3d{};
  for (const Vec3d& v : {normal, a, b, c})
    for (std::size_t axis = 0; axis < 3; ++axis) out.put(static_cast<float>(v[axis]));
  out.put(std::uint16_t{0});
}

std::string file_name(const char* stem, std::size_t number, const char* suffix) {
  char text[48];
  std::snprintf(text, sizeof text, "%s_%06zu%s", stem, number, suffix);
  return text;
}

}  // namespace

std::string cells_as_csv(const Snapshot& s) {
  std::string out;
  for_each_snapshot_column([&](const std::string& name, const std::string& units, const char*, auto member) {
    out += (out.empty() ? "" : ",") + heading<std::remove_cvref_t<decltype(s.cells.front().*member)>>(name, units);
  });
  for (const Snapshot::Variable& variable : s.variables) out += ',' + heading<double>(title_of(variable), variable.unit);
  out += '\n';
  for (std::size_t i = 0; i < s.cells.size(); ++i) {
    std::string line;
    for_each_snapshot_column(
        [&](const char*, const char*, const char*, auto member) { line += (line.empty() ? "" : ",") + as_text(s, s.cells[i].*member); });
    for (const Snapshot::Variable& variable : s.variables) line += ',' + shortest_text(variable.values[i]);
    out += line + '\n';
  }
  return out;
}

Result<std::string> surfaces_as_stl(const Snapshot& s, ShapeLibrary& library, std::ptrdiff_t only_cell) {
  MORULA_TRY_ASSIGN(const std::shared_ptr<const ReferenceShape> ball, library.icosphere(162));
  const auto wanted = [&](std::size_t cell) { return only_cell < 0 || static_cast<std::size_t>(only_cell) == cell; };
  ByteWriter triangles;
  std::uint32_t count = 0;
  for (const Snapshot::Shell& shell : s.shells) {
    if (!wanted(shell.cell)) continue;
    const std::span<const Vec3d> nodes = std::span(s.nodes).subspan(shell.first_node, shell.node_count);
    for (const Triangle& f : s.topologies[shell.topology]) put_triangle(triangles, nodes[f[0]], nodes[f[1]], nodes[f[2]]), ++count;
  }
  for (std::size_t c = 0; c < s.cells.size(); ++c) {
    const Snapshot::Cell& cell = s.cells[c];
    if (!wanted(c) || cell.body != BodyKind::kSphere) continue;
    const auto on_surface = [&](std::uint32_t node) {
      const Vec3d& p = ball->position[node];
      return cell.centroid + p * (cell.radius / std::sqrt(norm2(p)));
    };
    for (const Triangle& f : ball->topology->faces())
      put_triangle(triangles, on_surface(f[0]), on_surface(f[1]), on_surface(f[2])), ++count;
  }
  std::string out(80, ' ');
  const std::string title = "binary STL, um, written by Morula";
  out.replace(0, title.size(), title);
  char number[4];
  std::memcpy(number, &count, 4);
  out.append(number, 4);
  const auto bytes = triangles.bytes();
  return out.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

Result<std::size_t> export_snapshots(const fs::path& results, const fs::path& folder, ExportFormat format, const ExportRange& range) {
  MORULA_TRY_ASSIGN(std::vector<SnapshotEntry> entries, list_snapshots(results));
  const std::size_t count = entries.size();
  std::size_t seen = 0;
  std::erase_if(entries, [&](const SnapshotEntry& entry) {
    return entry.time < range.from || entry.time > range.to || seen++ % std::max<std::size_t>(range.every, 1) != 0;
  });
  if (entries.empty())
    return Error{ErrorKind::kInput,
                 "'" + results.string() + "' has no snapshot in this range of time (it has " + std::to_string(count) + " in all)",
                 "see --from, --to and --every"};
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return file_error(folder, "create folder", error.value());
  ShapeLibrary library;
  std::vector<std::size_t> numbers;
  std::vector<double> times;
  std::vector<std::string> field_names;
  for (const SnapshotEntry& entry : entries) {
    MORULA_TRY_ASSIGN(const Snapshot snapshot, read_snapshot(results, entry.index));
    if (format == ExportFormat::kVtk) {
      MORULA_TRY(write_vtk(snapshot, folder, entry.index));
    } else if (format == ExportFormat::kCsv) {
      MORULA_TRY(write_file_atomically(folder / file_name("cells", entry.index, ".csv"), cells_as_csv(snapshot)));
    } else {
      MORULA_TRY_ASSIGN(const std::string stl, surfaces_as_stl(snapshot, library));
      MORULA_TRY(write_file_atomically(folder / file_name("tissue", entry.index, ".stl"), stl));
    }
    numbers.push_back(entry.index);
    times.push_back(entry.time);
    if (field_names.empty())
      for (const Snapshot::Grid& grid : snapshot.fields) field_names.push_back(grid.name);
  }
  if (format == ExportFormat::kVtk) MORULA_TRY(write_vtk_collections(folder, numbers, times, field_names));
  return numbers.size();
}

}  // namespace morula::scenarios
