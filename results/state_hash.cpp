#include "results/state_hash.h"

#include <algorithm>
#include <map>
#include <span>

#include "results/hash_sums.h"
#include "results/parcels.h"
#include "results/state_fields.h"

namespace morula::scenarios {
namespace {

/// Keeps the parts of a state apart, so that equal bytes in different places do not stand for each other.
enum class Part : std::uint64_t { kCell = 1, kBrick, kGrid, kGlobal, kShape };

Hash128 hash_of(const ByteWriter& writer, Part part) { return hash128(writer.bytes(), static_cast<std::uint64_t>(part)); }

void put_row(ByteWriter& out, const CellState& row) {
  for_each_cell_column([&](const CellColumn&, auto member) { out.put(row.*member); });
  out.put_all(std::span(row.variables));
}

/// A body's values of a column; the length of a list goes before it.
template <class Column, class Bodies>
void put_column(const Column& column, const Bodies& bodies, std::size_t i, ByteWriter& out) {
  const auto values = column.values(bodies, i);
  if constexpr (Column::kFill == Fill::kAny) out.put(std::uint64_t{values.size()});
  out.put_all(values);
}

/// Hashes of the shapes that were met.
using ShapeHashes = std::map<const ReferenceShape*, Hash128>;

void put_shell(ByteWriter& out, const dcm::Shells& shells, std::size_t i, ShapeHashes& shapes) {
  const auto [shape, is_new] = shapes.try_emplace(shells.shape[i].get());
  if (is_new) shape->second = shape_hash(*shape->first);
  out.put(shape->second);
  dcm::for_each_shell_column([&](const auto& column) { put_column(column, shells, i, out); });
}

Hash128 hash_of_cells(const Tissue& tissue) {
  ShapeHashes shapes;
  Hash128 sum;
  ByteWriter bytes;
  for (const BodyOfRow& body : bodies_of(tissue.cells)) {
    bytes.clear();
    put_row(bytes, tissue.cells.state(body.row));
    if (body.is_shell) {
      put_shell(bytes, tissue.shells, body.number, shapes);
      if (const std::size_t n = tissue.nuclei.of_shell(body.number); n < tissue.nuclei.size())
        put_shell(bytes, tissue.nuclei.shells, n, shapes);
    } else {
      cbm::for_each_sphere_column([&](const auto& column) { put_column(column, tissue.spheres, body.number, bytes); });
    }
    sum += hash_of(bytes, Part::kCell);
  }
  return sum;
}

Hash128 hash_of_bricks(const Tissue& tissue) {
  Hash128 sum;
  ByteWriter bytes;
  for (std::size_t f = 0; f < tissue.fields.size(); ++f) {
    const fields::Field& field = tissue.fields[f];
    for (std::size_t b = 0; b < field.owned_bricks.size(); ++b) {
      bytes.clear();
      bytes.put(std::uint64_t{f});
      bytes.put(field.owned_bricks[b]);
      bytes.put_all(std::span(field.concentration[b]));
      sum += hash_of(bytes, Part::kBrick);
    }
  }
  return sum;
}

/// What every rank holds alike.
Hash128 hash_of_globals(const Tissue& tissue) {
  ByteWriter bytes;
  for_each_clock_field([&](const char*, const char*, auto member) { bytes.put(tissue.clock.*member); });
  for_each_field_ledger_field([&](const char*, const char*, auto member) {
    for (const FieldLedger& field : tissue.ledger.fields) bytes.put(field.*member);
  });
  for_each_ledger_field([&](const char*, const char*, auto member) { bytes.put(tissue.ledger.*member); });
  bytes.put(std::uint64_t{tissue.obstacle_offset.size()});
  bytes.put_all(std::span(tissue.obstacle_offset));
  for (const LumenState& lumen : tissue.lumens)
    for_each_lumen_field([&](const char*, const char*, auto member) { bytes.put(lumen.*member); });
  for (const fields::Field& field : tissue.fields) {
    bytes.put(field.grid.box.low);
    bytes.put(field.grid.box.high);
    bytes.put(field.grid.voxels);
    bytes.put(field.grid.bricks);
    for_each_field_number([&](const char*, const char*, auto member) { bytes.put(field.*member); });
  }
  return hash_of(bytes, Part::kGlobal);
}

}  // namespace

Hash128 shape_hash(const ReferenceShape& shape) {
  ByteWriter bytes;
  bytes.put(std::uint64_t{shape.topology->node_count()});
  bytes.put(std::uint64_t{shape.topology->face_count()});
  bytes.put_all(shape.topology->faces());
  bytes.put_all(std::span(shape.position));
  bytes.put_all(std::span(shape.edge_length));
  bytes.put_all(std::span(shape.face_area));
  bytes.put_all(std::span(shape.hinge_angle));
  return hash_of(bytes, Part::kShape);
}

Hash128 state_hash(const Tissue& tissue, const Comm& comm) {
  Hash128 local = hash_of_cells(tissue);
  local += hash_of_bricks(tissue);
  if (comm.is_root()) local += hash_of_globals(tissue);
  sum_over_ranks(std::span(&local, 1), comm);
  return local;
}

}  // namespace morula::scenarios
