#include "coupling/cell_record.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <utility>

#include "core/mesh/shape_bytes.h"
#include "core/space/best_turn.h"

namespace morula {
namespace {

/// The shell of a cell behind the others, with its nucleus.
void add_shell_of(Tissue& tissue, CellRecord& cell) {
  cell.shell->type = cell.row.type;
  dcm::add_shell(tissue.shells, *cell.shell);
  if (!cell.shell->nuclear_shell) return;
  cell.shell->nuclear_shell->type = cell.row.type;
  dcm::add_shell(tissue.nuclei.shells, *cell.shell->nuclear_shell);
  tissue.nuclei.owner.push_back(static_cast<std::uint32_t>(tissue.shells.size() - 1));
}

/// A cell behind the others; its place in canonical order is the caller's.
void add_cell(Tissue& tissue, CellRecord& cell) {
  cell.row.body = cell.shell ? BodyKind::kShell : BodyKind::kSphere;
  tissue.cells.push_back(cell.row);
  if (!cell.sphere) return add_shell_of(tissue, cell);
  cell.sphere->type = cell.row.type;
  cbm::add_sphere(tissue.spheres, *cell.sphere);
}

/// The places of the cells in canonical order.
std::vector<std::size_t> canonical_order(std::span<const CellRecord> cells) {
  std::vector<std::size_t> sorted(cells.size());
  std::iota(sorted.begin(), sorted.end(), std::size_t{0});
  std::sort(sorted.begin(), sorted.end(), [&](std::size_t a, std::size_t b) { return before(cells[a].row, cells[b].row); });
  return sorted;
}

/// Some items of a sequence go, and others come in: all by numbers of the old sequence.
struct Replacement {
  std::vector<std::size_t> gone;    ///< increasing
  std::vector<std::size_t> before;  ///< of each that comes, in order: the old item before which it stands

  [[nodiscard]] bool empty() const { return gone.empty() && before.empty(); }
  /// Calls keep(first, last) for the stretches that stay, and come(k) for what comes, in the new order.
  template <class Keep, class Come>
  void for_all(std::size_t size, Keep&& keep, Come&& come) const {
    std::size_t at = 0, next_gone = 0;
    const auto keep_until = [&](std::size_t end) {
      for (; next_gone < gone.size() && gone[next_gone] < end; ++next_gone) {
        if (at < gone[next_gone]) keep(at, gone[next_gone]);
        at = gone[next_gone] + 1;
      }
      if (at < end) keep(at, end), at = end;
    };
    for (std::size_t k = 0; k < before.size(); ++k) {
      keep_until(before[k]);
      come(k);
    }
    keep_until(size);
  }
};

/// Makes the replacement in place, with value(k) for what comes: only what lies behind the first change is moved.
template <class T, class ValueOf>
void replace_in(std::vector<T>& items, const Replacement& what, ValueOf&& value) {
  if (what.empty()) return;
  std::size_t kept = what.gone.empty() ? items.size() : what.gone.front();
  for (std::size_t g = 0; g < what.gone.size(); ++g) {
    const std::size_t from = what.gone[g] + 1, to = g + 1 < what.gone.size() ? what.gone[g + 1] : items.size();
    std::move(items.begin() + static_cast<std::ptrdiff_t>(from), items.begin() + static_cast<std::ptrdiff_t>(to),
              items.begin() + static_cast<std::ptrdiff_t>(kept));
    kept += to - from;
  }
  const std::size_t size = kept + what.before.size();
  if (size > items.capacity()) items.reserve(size + size / 64);  // no growth by doubling
  items.resize(size);
  std::size_t end = kept;
  for (std::size_t k = what.before.size(); k-- > 0;) {
    const auto gone_before = static_cast<std::size_t>(std::ranges::lower_bound(what.gone, what.before[k]) - what.gone.begin());
    const std::size_t place = what.before[k] - gone_before;
    std::move_backward(items.begin() + static_cast<std::ptrdiff_t>(place), items.begin() + static_cast<std::ptrdiff_t>(end),
                       items.begin() + static_cast<std::ptrdiff_t>(end + k + 1));
    items[place + k] = value(k);
    end = place;
  }
}

/// The same of a column that has no room while all have the usual value, as `usual` has it.
template <class Column, class ValueOf>
void replace_in_column(Column& values, Column usual, const Replacement& what, std::size_t old_size, std::size_t size, ValueOf&& value) {
  std::size_t row = 0;
  const Column old = std::exchange(values, std::move(usual));
  what.for_all(
      old_size,
      [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last && !old.empty(); ++i) values.set(row + i - first, old[i], size);
        row += last - first;
      },
      [&](std::size_t k) { values.set(row++, value(k), size); });
}

void replace_rows(Cells& cells, const Replacement& what, std::span<CellRecord* const> fresh) {
  const std::size_t old_size = cells.size();
  replace_in(cells.rows, what, [&](std::size_t k) -> const CellRow& { return fresh[k]->row; });
  const Cells usual = cells.without_rows();
  OptionalColumns::for_each_member([&](auto column, auto member) {
    replace_in_column(cells.optional.*column, usual.optional.*column, what, old_size, cells.size(),
                      [&](std::size_t k) { return fresh[k]->row.*member; });
  });
  for (std::size_t v = 0; v < cells.variables.size(); ++v)
    replace_in_column(cells.variables[v].values, usual.variables[v].values, what, old_size, cells.size(),
                      [&](std::size_t k) { return fresh[k]->row.variable(v); });
}

void replace_spheres(cbm::Spheres& spheres, const Replacement& what, std::span<CellRecord* const> fresh) {
  if (what.empty()) return;
  cbm::for_each_sphere_column([&](const auto& column) {
    if constexpr (requires { column.all; }) {
      replace_in(spheres.*column.all, what, [&](std::size_t k) { return column.values(*fresh[k]->sphere)[0]; });
    } else {
      cbm::PartnerLists& lists = spheres.attached;
      for (const std::size_t sphere : what.gone) lists.leave(sphere);
      replace_in(lists.rows(), what, [&](std::size_t k) { return lists.store(column.values(*fresh[k]->sphere)); });
    }
  });
}

/// Shells with their nuclei.
void replace_shells(Tissue& tissue, const Replacement& what, std::span<CellRecord* const> fresh) {
  if (what.empty()) return;
  const dcm::Shells old = std::exchange(tissue.shells, {});
  const dcm::NuclearShells nuclei = std::exchange(tissue.nuclei, {});
  const auto keep = [&](std::size_t first, std::size_t last) {
    const auto shift = static_cast<std::uint32_t>(tissue.shells.size());
    dcm::add_shells(tissue.shells, old, first, last);
    const auto begin = std::ranges::lower_bound(nuclei.owner, first), end = std::lower_bound(begin, nuclei.owner.end(), last);
    dcm::add_shells(tissue.nuclei.shells, nuclei.shells, static_cast<std::size_t>(begin - nuclei.owner.begin()),
                    static_cast<std::size_t>(end - nuclei.owner.begin()));
    for (auto at = begin; at != end; ++at) tissue.nuclei.owner.push_back(*at - static_cast<std::uint32_t>(first) + shift);
  };
  what.for_all(old.size(), keep, [&](std::size_t k) { add_shell_of(tissue, *fresh[k]); });
}

/// Which shells, or spheres, go and come with the rows.
struct OfBodies {
  Replacement what;
  std::vector<CellRecord*> fresh;
};

OfBodies of_bodies(bool shells, const Tissue& tissue, const Replacement& rows, std::span<CellRecord* const> fresh) {
  OfBodies out;
  const Cells& cells = tissue.cells;
  const bool are_mixed = tissue.shells.size() > 0 && tissue.spheres.size() > 0;
  const auto is_one = [&](const CellRow& row) { return (row.body == BodyKind::kShell) == shells; };
  std::size_t row = 0, number = 0;
  const auto number_at = [&](std::size_t at) {  // how many there are before a row that is not before the last one
    if (!are_mixed && !cells.rows.empty()) return is_one(cells.rows.front()) ? at : std::size_t{0};
    for (; row < at; ++row) number += is_one(cells.rows[row]) ? 1 : 0;
    return number;
  };
  for (const std::size_t gone : rows.gone)
    if (is_one(cells.rows[gone])) out.what.gone.push_back(number_at(gone));
  row = number = 0;
  for (std::size_t k = 0; k < fresh.size(); ++k) {
    if (fresh[k]->shell.has_value() != shells) continue;
    out.what.before.push_back(number_at(rows.before[k]));
    out.fresh.push_back(fresh[k]);
  }
  return out;
}

}  // namespace

double volume_of(const dcm::ShellRecord& shell) {
  const auto faces = shell.shape->topology->faces();
  return enclosed_volume(faces, shell.position, volume_centroid(faces, shell.position));
}

Vec3d CellRecord::center() const { return sphere ? sphere->position : volume_centroid(shell->shape->topology->faces(), shell->position); }

std::vector<BodyOfRow> bodies_of(const Cells& cells, std::span<const std::size_t> rows) {
  std::vector<BodyOfRow> out;
  out.reserve(rows.size());
  std::size_t row = 0, shells = 0;
  for (const std::size_t wanted : rows) {
    for (; row < wanted; ++row) shells += cells.rows[row].body == BodyKind::kShell ? 1 : 0;
    const bool is_shell = cells.rows[wanted].body == BodyKind::kShell;
    out.push_back({wanted, is_shell, is_shell ? shells : wanted - shells});
  }
  return out;
}

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
  tissue.cells = tissue.cells.without_rows();
  tissue.spheres = {};
  tissue.shells = {};
  tissue.nuclei = {};
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
  Replacement rows{{gone.begin(), gone.end()}, {}};
  std::vector<CellRecord*> sorted;
  for (const std::size_t k : canonical_order(fresh)) {
    CellRecord& cell = fresh[k];
    cell.row.body = cell.shell ? BodyKind::kShell : BodyKind::kSphere;
    if (cell.sphere) cell.sphere->type = cell.row.type;
    const auto& old = tissue.cells.rows;
    const auto place = std::lower_bound(old.begin(), old.end(), cell.row, [](const CellRow& a, const CellRow& b) { return before(a, b); });
    rows.before.push_back(static_cast<std::size_t>(place - old.begin()));
    sorted.push_back(&cell);
  }
  const OfBodies spheres = of_bodies(false, tissue, rows, sorted), shells = of_bodies(true, tissue, rows, sorted);
  replace_rows(tissue.cells, rows, sorted);
  replace_spheres(tissue.spheres, spheres.what, spheres.fresh);
  replace_shells(tissue, shells.what, shells.fresh);
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

namespace {

/// How far the planes of the faces are from a point within, at least; and the outward normal of the nearest.
struct Clearance {
  double distance = 0.0;
  Vec3d towards;
};
Clearance clearance_at(const Vec3d& x, std::span<const Triangle> faces, std::span<const Vec3d> node) {
  Clearance out{std::numeric_limits<double>::infinity(), {}};
  for (const Triangle& t : faces) {
    const Vec3d normal = normalized(cross(node[t[1]] - node[t[0]], node[t[2]] - node[t[0]]));
    if (const double distance = dot(node[t[0]] - x, normal); distance < out.distance) out = {distance, normal};
  }
  return out;
}

/// Where a ball of this radius lies in a cell: in its middle, or where the middle leaves it no room, as in the flat part that a division has cut off, where
/// there is most room (by going away from the nearest face, ever less far).
Vec3d middle_for(double radius, std::span<const Triangle> faces, std::span<const Vec3d> node) {
  constexpr int kSteps = 60;
  Vec3d x = volume_centroid(faces, node), best = x;
  Clearance at = clearance_at(x, faces, node);
  for (double most = at.distance, step = 0.2 * radius; most < radius && step > 0.2 * radius / kSteps; step -= 0.2 * radius / kSteps) {
    x -= at.towards * step;
    at = clearance_at(x, faces, node);
    if (at.distance > most) most = at.distance, best = x;
  }
  return best;
}

}  // namespace

void place_nucleus(ShellRecord& shell, const CellType& type, ShapeLibrary& shapes) {
  const dcm::InteriorParameters& interior = type.interior;
  shell.nucleus.reset();
  shell.nuclear_shell.reset();
  if (!interior.has_nucleus()) return;
  const Vec3d center = middle_for(dcm::nucleus_radius(interior, shell.rest_volume), shell.shape->topology->faces(), shell.position);
  if (interior.has_rigid_nucleus()) {
    shell.nucleus = center;
    return;
  }
  const double volume = interior.nucleus_fraction * shell.rest_volume;
  ShellRecord nucleus =
      spherical_shell(shapes.icosphere(interior.nucleus_nodes).value(), center, volume,
                      dcm::nucleus_reference_volume(volume, shell.rest_volume, interior.nucleus_shell, type.shell.tension));
  const Rotation turn = best_turn(shell.shape->position, shell.position);  // links are chosen between meshes that lie alike
  for (Vec3d& p : nucleus.position) p = center + turn * (p - center);
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
