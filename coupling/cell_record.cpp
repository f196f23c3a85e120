#include "coupling/cell_record.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

#include "core/mesh/shape_bytes.h"

namespace morula {
namespace {

/// A cell behind the others; its place in canonical order is the caller's.
void add_cell(Tissue& tissue, CellRecord& cell) {
  cell.row.body = cell.shell ? BodyKind::kShell : BodyKind::kSphere;
  tissue.cells.push_back(cell.row);
  if (cell.sphere) {
    cell.sphere->type = cell.row.type;
    cbm::add_sphere(tissue.spheres, *cell.sphere);
    return;
  }
  cell.shell->type = cell.row.type;
  dcm::add_shell(tissue.shells, *cell.shell);
  if (!cell.shell->nuclear_shell) return;
  cell.shell->nuclear_shell->type = cell.row.type;
  dcm::add_shell(tissue.nuclei.shells, *cell.shell->nuclear_shell);
  tissue.nuclei.owner.push_back(static_cast<std::uint32_t>(tissue.shells.size() - 1));
}

/// The places of the cells in canonical order.
std::vector<std::size_t> canonical_order(std::span<const CellRecord> cells) {
  std::vector<std::size_t> sorted(cells.size());
  std::iota(sorted.begin(), sorted.end(), std::size_t{0});
  std::sort(sorted.begin(), sorted.end(), [&](std::size_t a, std::size_t b) { return before(cells[a].row, cells[b].row); });
  return sorted;
}

/// Cells and bodies of a tissue.
struct Population {
  Cells cells;
  cbm::Spheres spheres;
  dcm::Shells shells;
  dcm::NuclearShells nuclei;
};

Population take_population(Tissue& tissue) {
  Cells none = tissue.cells.without_rows();
  return {std::exchange(tissue.cells, std::move(none)), std::exchange(tissue.spheres, {}), std::exchange(tissue.shells, {}),
          std::exchange(tissue.nuclei, {})};
}

/// Where a stretch of rows begins: its row, and how many shells come before it.
struct Place {
  std::size_t row = 0, shells = 0;
  [[nodiscard]] std::size_t spheres() const { return row - shells; }
};

/// The cells from `first` to before `last` behind those of the tissue.
void add_stretch(Tissue& tissue, const Population& from, const Place& first, const Place& last) {
  tissue.cells.add(from.cells, first.row, last.row);
  cbm::add_spheres(tissue.spheres, from.spheres, first.spheres(), last.spheres());
  const auto shift = static_cast<std::uint32_t>(tissue.shells.size());
  dcm::add_shells(tissue.shells, from.shells, first.shells, last.shells);
  const auto& owner = from.nuclei.owner;
  const auto begin = std::lower_bound(owner.begin(), owner.end(), first.shells), end = std::lower_bound(begin, owner.end(), last.shells);
  dcm::add_shells(tissue.nuclei.shells, from.nuclei.shells, static_cast<std::size_t>(begin - owner.begin()),
                  static_cast<std::size_t>(end - owner.begin()));
  for (auto at = begin; at != end; ++at) tissue.nuclei.owner.push_back(*at - static_cast<std::uint32_t>(first.shells) + shift);
}

}  // namespace

Vec3d CellRecord::center() const { return sphere ? sphere->position : volume_centroid(shell->shape->topology->faces(), shell->position); }

CellRecord record_of(const Tissue& tissue, const BodyOfRow& body) {
  CellRecord out;
  out.row = tissue.cells.state(body.row);
  if (!body.is_shell) {
    out.sphere = cbm::sphere_out_of(tissue.spheres, body.number);
    return out;
  }
  out.shell = dcm::shell_out_of(tissue.shells, body.number);
  if (const std::size_t n = tissue.nuclei.of_shell(body.number); n < tissue.nuclei.size())
    out.shell->nuclear_shell = dcm::shell_out_of(tissue.nuclei.shells, n);
  return out;
}

std::vector<CellRecord> take_apart(Tissue& tissue) {
  std::vector<CellRecord> out;
  out.reserve(tissue.cells.size());
  for (const BodyOfRow& body : bodies_of(tissue.cells)) out.push_back(record_of(tissue, body));
  take_population(tissue);
  return out;
}

void put_together(Tissue& tissue, std::vector<CellRecord> cells) {
  assert(tissue.cells.size() == 0 && tissue.spheres.size() == 0 && tissue.shells.size() == 0);
  tissue.cells.rows.reserve(cells.size());
  const auto is_sphere = [](const CellRecord& cell) { return cell.sphere.has_value(); };
  const auto spheres = static_cast<std::size_t>(std::count_if(cells.begin(), cells.end(), is_sphere));
  cbm::for_each_sphere_column([&](const auto& column) { column.reserve(tissue.spheres, spheres); });
  for (const std::size_t place : canonical_order(cells)) add_cell(tissue, cells[place]);
}

void replace_cells(Tissue& tissue, std::span<const std::size_t> gone, std::vector<CellRecord> fresh) {
  assert(std::is_sorted(gone.begin(), gone.end()) && (gone.empty() || gone.back() < tissue.cells.size()));
  const Population old = take_population(tissue);
  tissue.cells.rows.reserve(old.cells.size() - gone.size() + fresh.size());
  cbm::for_each_sphere_column([&](const auto& column) { column.reserve(tissue.spheres, old.spheres.size() + fresh.size()); });
  const auto after = [&](Place at, std::size_t row) {  // the place of a row that is not before
    for (; at.row < row; ++at.row) at.shells += old.cells.rows[at.row].body == BodyKind::kShell ? 1 : 0;
    return at;
  };
  Place at;
  std::size_t next_gone = 0;
  const auto keep_until = [&](std::size_t row) {
    for (; next_gone < gone.size() && gone[next_gone] < row; ++next_gone) {
      const Place last = after(at, gone[next_gone]);
      add_stretch(tissue, old, at, last);
      at = after(last, last.row + 1);
    }
    const Place last = after(at, row);
    add_stretch(tissue, old, at, last);
    at = last;
  };
  for (const std::size_t k : canonical_order(fresh)) {
    CellRecord& cell = fresh[k];
    const auto& rows = old.cells.rows;
    const auto place =
        std::lower_bound(rows.begin(), rows.end(), cell.row, [](const CellRow& a, const CellRow& b) { return before(a, b); });
    keep_until(std::max(at.row, static_cast<std::size_t>(place - rows.begin())));
    add_cell(tissue, cell);
  }
  keep_until(old.cells.size());
}

std::vector<double> free_rest_lengths(const ReferenceShape& shape, double rest_volume) {
  std::vector<double> out(shape.edge_length);
  const double scale = std::cbrt(rest_volume);  // the reference shape encloses 1
  for (double& length : out) length *= scale;
  return out;
}

std::vector<std::size_t> rows_of(const Cells& cells, std::span<const CellId> sorted) {
  assert(std::ranges::is_sorted(sorted));
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (std::ranges::binary_search(sorted, cells.rows[i].id)) out.push_back(i);
  return out;
}

ShellRecord spherical_shell(std::shared_ptr<const ReferenceShape> shape, const Vec3d& center, double volume, double reference_volume) {
  ShellRecord body;
  const double scale = std::cbrt(volume);  // the reference shape encloses 1
  body.position.reserve(shape->position.size());
  for (const Vec3d& p : shape->position) body.position.push_back(center + p * scale);
  body.velocity.assign(shape->position.size(), Vec3f{});
  body.rest_length = free_rest_lengths(*shape, volume);
  body.reference_volume = reference_volume;
  body.rest_volume = volume;
  body.shape = std::move(shape);
  return body;
}

void place_nucleus(ShellRecord& shell, const CellType& type, ShapeLibrary& shapes) {
  const dcm::InteriorParameters& interior = type.interior;
  shell.nucleus.reset();
  shell.nuclear_shell.reset();
  if (!interior.has_nucleus()) return;
  const Vec3d center = volume_centroid(shell.shape->topology->faces(), shell.position);
  if (interior.has_rigid_nucleus()) {
    shell.nucleus = center;
    return;
  }
  const double volume = interior.nucleus_fraction * shell.rest_volume;
  ShellRecord nucleus = spherical_shell(shapes.icosphere(interior.nucleus_nodes).value(), center, volume,
                                        dcm::nucleus_reference_volume(volume, shell.rest_volume, interior.nucleus_shell, type.shell));
  if (!shell.velocity.empty())
    std::ranges::fill(nucleus.velocity, mean_of(std::span<const Vec3f>(shell.velocity)));  // it comes along with its cell
  shell.nuclear_shell = std::move(nucleus);
}

namespace {

template <class T>
void append(std::vector<std::byte>& out, const T* items, std::size_t count) {
  const auto* bytes = reinterpret_cast<const std::byte*>(items);  // NOLINT: plain data
  out.insert(out.end(), bytes, bytes + count * sizeof(T));
}

/// Reads plain data from the front of a byte range.
struct Reader {
  std::span<const std::byte> rest;

  template <class T>
  T one() {
    T out;
    std::memcpy(static_cast<void*>(&out), rest.data(), sizeof(T));
    rest = rest.subspan(sizeof(T));
    return out;
  }
  template <class T>
  std::vector<T> many(std::size_t count) {
    std::vector<T> out(count);
    if (count != 0) std::memcpy(static_cast<void*>(out.data()), rest.data(), count * sizeof(T));
    rest = rest.subspan(count * sizeof(T));
    return out;
  }
};

/// The values of a column, and how many there are where the shape does not say so.
template <class Column, class Record>
void append_column(const Column& column, const Record& record, std::vector<std::byte>& out) {
  const auto values = column.values(record);
  const auto count = static_cast<std::uint32_t>(values.size());
  if constexpr (Column::kFill != Fill::kAll) append(out, &count, 1);
  append(out, values.data(), count);
}

/// `expected`: how many values a record has where all have as many.
template <class Column, class Record>
void read_column(const Column& column, Reader& reader, std::size_t expected, Record& record) {
  std::size_t count = expected;
  if constexpr (Column::kFill != Fill::kAll) count = reader.one<std::uint32_t>();
  column.give(record, reader.many<typename Column::Value>(count));
}

void append_row(const CellState& row, std::vector<std::byte>& out) {
  append(out, static_cast<const CellRow*>(&row), 1);
  append(out, static_cast<const OptionalValues*>(&row), 1);
  const auto count = static_cast<std::uint32_t>(row.variables.size());
  append(out, &count, 1);
  append(out, row.variables.data(), count);
}

CellState read_row(Reader& reader) {
  const auto row = reader.one<CellRow>();
  CellState out(row, reader.one<OptionalValues>());
  out.variables = reader.many<double>(reader.one<std::uint32_t>());
  return out;
}

void append_shell(const ShellRecord& body, std::vector<std::byte>& out) {
  append_shape(*body.shape, out);
  dcm::for_each_shell_column([&](const auto& column) { append_column(column, body, out); });
  const std::uint8_t nuclear = body.nuclear_shell.has_value();
  append(out, &nuclear, 1);
  if (body.nuclear_shell) append_shell(*body.nuclear_shell, out);
}

ShellRecord read_shell(Reader& reader, ShapeLibrary& shapes) {
  ShellRecord body;
  body.shape = read_shape(reader.rest, shapes);
  dcm::for_each_shell_column([&](const auto& column) { read_column(column, reader, dcm::count_of(column.kDomain, *body.shape), body); });
  if (reader.one<std::uint8_t>() != 0) body.nuclear_shell = read_shell(reader, shapes);
  return body;
}

}  // namespace

void append_bytes(const CellRecord& cell, std::vector<std::byte>& out) {
  append_row(cell.row, out);
  if (cell.sphere)
    cbm::for_each_sphere_column([&](const auto& column) { append_column(column, *cell.sphere, out); });
  else
    append_shell(*cell.shell, out);
}

std::vector<CellRecord> read_records(std::span<const std::byte> bytes, ShapeLibrary& shapes) {
  std::vector<CellRecord> out;
  Reader reader{bytes};
  while (!reader.rest.empty()) {
    CellRecord& cell = out.emplace_back();
    cell.row = read_row(reader);
    if (cell.row.body == BodyKind::kSphere) {
      cell.sphere.emplace();
      cbm::for_each_sphere_column([&](const auto& column) { read_column(column, reader, 1, *cell.sphere); });
    } else {
      cell.shell = read_shell(reader, shapes);
    }
  }
  return out;
}

}  // namespace morula
