#include "results/state_hash.h"

#include <algorithm>
#include <map>
#include <span>

#include "results/parcels.h"
#include "results/state_fields.h"

namespace morula::scenarios {
namespace {

/// Keeps the parts of a state apart, so that equal bytes in different places do not stand for each other.
enum class Part : std::uint64_t { kCell = 1, kBrick, kGrid, kGlobal, kShape };

Hash128 hash_of(const ByteWriter& writer, Part part) { return hash128(writer.bytes(), static_cast<std::uint64_t>(part)); }

void put_row(ByteWriter& out, const FullRow& row) {
  for_each_row_field([&](const char*, const char*, auto member) { out.put(row.*member); });
}

void put_sphere(ByteWriter& out, const cbm::Spheres& spheres, std::size_t i) {
  out.put(spheres.position[i]);
  out.put(spheres.radius[i]);
  out.put(spheres.type[i]);
  out.put(spheres.velocity[i]);
  const std::span<const CellId> partners = spheres.attached[i];  // sorted
  out.put(std::uint64_t{partners.size()});
  out.put_all(partners);
}

void put_shell(ByteWriter& out, const dcm::Shells& shells, std::size_t i, const Hash128& shape) {
  const std::size_t node = shells.first_node[i], edge = shells.first_edge[i];
  const std::size_t nodes = shells.first_node[i + 1] - node, edges = shells.first_edge[i + 1] - edge;
  out.put(shape);
  out.put(shells.type[i]);
  out.put(shells.reference_volume[i]);
  out.put(shells.rest_volume[i]);
  out.put_all(std::span(shells.position).subspan(node, nodes));
  out.put_all(std::span(shells.velocity).subspan(node, nodes));
  out.put_all(std::span(shells.rest_length).subspan(edge, edges));
  if (const Vec3d* nucleus = shells.nucleus_of(i)) out.put(*nucleus);
  const dcm::FaceState& face = shells.faces_of(i);  // shells without have the bytes that they had before there were marks
  if (face.empty()) return;
  out.put(std::uint64_t{face.mark.size()});
  out.put_all(std::span(face.mark));
  out.put_all(std::span(face.contact));
}

Hash128 hash_of_cells(const Tissue& tissue) {
  std::map<const ReferenceShape*, Hash128> shapes;
  Hash128 sum;
  ByteWriter bytes;
  std::size_t sphere = 0, shell = 0;
  for (std::size_t i = 0; i < tissue.cells.size(); ++i) {
    const FullRow row = tissue.cells.full(i);
    bytes.clear();
    put_row(bytes, row);
    if (row.body == BodyKind::kSphere) {
      put_sphere(bytes, tissue.spheres, sphere++);
    } else {
      const auto [shape, is_new] = shapes.try_emplace(tissue.shells.shape[shell].get());
      if (is_new) shape->second = shape_hash(*shape->first);
      put_shell(bytes, tissue.shells, shell, shape->second);
      if (const std::size_t n = tissue.nuclei.of_shell(shell++); n < tissue.nuclei.size()) {
        const auto [nuclear, is_new_too] = shapes.try_emplace(tissue.nuclei.shells.shape[n].get());
        if (is_new_too) nuclear->second = shape_hash(*nuclear->first);
        put_shell(bytes, tissue.nuclei.shells, n, nuclear->second);
      }
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
  const auto put = [&](const char*, const char*, auto member) { bytes.put(tissue.ledger.*member); };
  for_each_ledger_field(put, put);
  bytes.put(std::uint64_t{tissue.obstacle_offset.size()});
  bytes.put_all(std::span(tissue.obstacle_offset));
  for (const LumenState& lumen : tissue.lumens)
    for_each_lumen_field([&](const char*, const char*, auto member) { bytes.put(lumen.*member); });
  for (const fields::Field& field : tissue.fields) {
    bytes.put(field.grid.box.low);
    bytes.put(field.grid.box.high);
    bytes.put(field.grid.voxels);
    bytes.put(field.grid.bricks);
    bytes.put(field.next_step);
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
  const std::vector<std::byte> all = comm.gather_to_all(std::as_bytes(std::span(&local, 1)));
  Hash128 sum;
  for (ByteReader reader(all); !reader.empty();) sum += reader.get<Hash128>();
  return sum;
}

}  // namespace morula::scenarios
