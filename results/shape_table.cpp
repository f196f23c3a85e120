#include "results/shape_table.h"

#include <set>

#include "results/parcels.h"
#include "results/state_hash.h"

namespace morula::scenarios {
namespace {

/// Flat arrays of shapes, one after the other.
struct FlatShapes {
  std::vector<std::uint32_t> node_count, face_count, edge_count;
  std::vector<Triangle> faces;
  std::vector<Vec3d> position;
  std::vector<double> edge_length, face_area, hinge_angle;
};

void put_shape(ByteWriter& out, const Hash128& hash, const ReferenceShape& shape) {
  out.put(hash);
  out.put(shape.topology->node_count());
  out.put(shape.topology->face_count());
  out.put(shape.topology->edge_count());
  out.put_all(shape.topology->faces());
  out.put_all(std::span(shape.position));
  out.put_all(std::span(shape.edge_length));
  out.put_all(std::span(shape.face_area));
  out.put_all(std::span(shape.hinge_angle));
}

void take_shape(ByteReader& in, FlatShapes& out) {
  const auto nodes = in.get<std::uint32_t>(), faces = in.get<std::uint32_t>(), edges = in.get<std::uint32_t>();
  out.node_count.push_back(nodes);
  out.face_count.push_back(faces);
  out.edge_count.push_back(edges);
  in.get_all(faces, out.faces);
  in.get_all(nodes, out.position);
  in.get_all(edges, out.edge_length);
  in.get_all(faces, out.face_area);
  in.get_all(edges, out.hinge_angle);
}

void add_flat(StoragePlan& plan, const FlatShapes& flat) {
  plan.add("shapes/node_count", "1", flat.node_count);
  plan.add("shapes/face_count", "1", flat.face_count);
  plan.add("shapes/edge_count", "1", flat.edge_count);
  plan.add("shapes/faces", "1", flat.faces);
  plan.add("shapes/position", "1", flat.position);
  plan.add("shapes/edge_length", "1", flat.edge_length);
  plan.add("shapes/face_area", "1", flat.face_area);
  plan.add("shapes/hinge_angle", "rad", flat.hinge_angle);
}

/// Where each shape begins in the flat arrays.
struct Places {
  std::vector<std::uint32_t> nodes, faces, edges;
  std::vector<std::uint64_t> first_node{0}, first_face{0}, first_edge{0};
};

Result<Places> read_places(const Hdf5Reader& file) {
  Places places;
  MORULA_TRY_ASSIGN(places.nodes, file.read<std::uint32_t>("shapes/node_count"));
  MORULA_TRY_ASSIGN(places.faces, file.read<std::uint32_t>("shapes/face_count"));
  MORULA_TRY_ASSIGN(places.edges, file.read<std::uint32_t>("shapes/edge_count"));
  for (const std::uint32_t n : places.nodes) places.first_node.push_back(places.first_node.back() + n);
  for (const std::uint32_t n : places.faces) places.first_face.push_back(places.first_face.back() + n);
  for (const std::uint32_t n : places.edges) places.first_edge.push_back(places.first_edge.back() + n);
  return places;
}

Result<std::shared_ptr<const ReferenceShape>> read_shape(const Hdf5Reader& file, const Places& places, std::uint32_t number) {
  auto shape = std::make_shared<ReferenceShape>();
  MORULA_TRY_ASSIGN(std::vector<Triangle> faces, file.read<Triangle>("shapes/faces", places.first_face[number], places.faces[number]));
  MORULA_TRY_ASSIGN(shape->topology, Topology::build(places.nodes[number], std::move(faces)));
  MORULA_TRY_ASSIGN(shape->position, file.read<Vec3d>("shapes/position", places.first_node[number], places.nodes[number]));
  MORULA_TRY_ASSIGN(shape->edge_length, file.read<double>("shapes/edge_length", places.first_edge[number], places.edges[number]));
  MORULA_TRY_ASSIGN(shape->face_area, file.read<double>("shapes/face_area", places.first_face[number], places.faces[number]));
  MORULA_TRY_ASSIGN(shape->hinge_angle, file.read<double>("shapes/hinge_angle", places.first_edge[number], places.edges[number]));
  if (shape->topology->edge_count() != places.edges[number])
    return Error{ErrorKind::kFile, "the checkpoint's shape " + std::to_string(number) + " does not fit its faces", ""};
  return std::shared_ptr<const ReferenceShape>(shape);
}

}  // namespace

ShapeNumbers add_shapes(StoragePlan& plan, const std::vector<std::shared_ptr<const ReferenceShape>>& shapes, const Comm& comm) {
  std::map<const ReferenceShape*, Hash128> hashes;
  std::set<Hash128> seen;
  Parcels local;
  ByteWriter bytes;
  for (const auto& shape : shapes) {
    const auto [entry, is_new] = hashes.try_emplace(shape.get());
    if (!is_new) continue;
    entry->second = shape_hash(*shape);
    if (!seen.insert(entry->second).second) continue;
    bytes.clear();
    put_shape(bytes, entry->second, *shape);
    local.add(entry->second.low, bytes.bytes());
  }
  const Parcels sorted = sort_over_ranks(local, comm);  // equal shapes of several ranks meet on one
  FlatShapes flat;
  std::set<Hash128> kept;
  std::vector<Hash128> order;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    ByteReader reader(sorted.bytes(i));
    const auto hash = reader.get<Hash128>();
    if (!kept.insert(hash).second) continue;
    order.push_back(hash);
    take_shape(reader, flat);
  }
  add_flat(plan, flat);

  const std::vector<std::byte> gathered = comm.gather_to_all(std::as_bytes(std::span(order)));
  std::map<Hash128, std::uint32_t> number;
  for (ByteReader reader(gathered); !reader.empty();) number.emplace(reader.get<Hash128>(), static_cast<std::uint32_t>(number.size()));
  ShapeNumbers numbers;
  for (const auto& [pointer, hash] : hashes) numbers.by_pointer[pointer] = number.at(hash);
  return numbers;
}

Result<std::map<std::uint32_t, std::shared_ptr<const ReferenceShape>>> read_shapes(const Hdf5Reader& file,
                                                                                   const std::vector<std::uint32_t>& numbers,
                                                                                   ShapeLibrary& library) {
  std::map<std::uint32_t, std::shared_ptr<const ReferenceShape>> out;
  MORULA_TRY_ASSIGN(const Places places, read_places(file));
  for (const std::uint32_t number : numbers) {
    if (number >= places.nodes.size())
      return Error{ErrorKind::kFile, "the checkpoint names shape " + std::to_string(number) + ", which it does not hold", ""};
    MORULA_TRY_ASSIGN(std::shared_ptr<const ReferenceShape> shape, read_shape(file, places, number));
    const auto known = library.icosphere(shape->topology->node_count());
    shape = known.ok() && shape_hash(**known) == shape_hash(*shape) ? *known : library.adopt(std::move(shape));
    out[number] = std::move(shape);
  }
  return out;
}

}  // namespace morula::scenarios
