/// How the ghosts of a scene come to be: which bodies go where, and where those that come have their place.
#include <algorithm>

#include "core/mesh/shape_bytes.h"
#include "core/parallel/pack.h"
#include "core/space/images.h"
#include "coupling/mechanics/scene.h"

namespace morula {
namespace {

/// What a ghost is announced with; the shapes of the shells stand after all headers, its positions follow by exchange().
struct GhostHeader {
  CellId id;
  std::uint64_t order;
  double radius, birth_radius, birth_time;
  std::uint32_t nodes;  ///< 1 for a sphere
  std::uint16_t type;
  BodyShape shape;
  std::uint8_t unused[1];
};

bool overlaps_any_image(const Box& a, const Box& b, const Space& space) {
  bool found = false;
  for_boxes_around(space, [&](const Vec3d& shift) { found = found || a.overlaps({b.low + shift, b.high + shift}); });
  return found;
}

/// A ghost that has come.
struct Arrival {
  GhostHeader header;
  int rank;                                    ///< where it came from
  std::size_t at;                              ///< its number among all that came from there
  std::shared_ptr<const ReferenceShape> form;  ///< of a shell
};

ContactBody body_of(const GhostHeader& header) {
  ContactBody body;
  body.id = header.id;
  body.material = header.type;
  body.shape = header.shape;
  body.radius = header.radius;
  body.point_count = header.nodes;
  body.owned = false;
  return body;
}

/// All ghosts that one rank has sent, shells and spheres apart. Gives how many there are.
std::size_t unpack_ghosts(std::span<const std::byte> bytes, int rank, ShapeLibrary& library, std::vector<Arrival>& shells,
                          std::vector<Arrival>& spheres) {
  if (bytes.empty()) return 0;
  const auto count = unpack<std::uint64_t>(bytes.first(sizeof(std::uint64_t)))[0];
  const auto headers = unpack<GhostHeader>(bytes.subspan(sizeof(std::uint64_t), count * sizeof(GhostHeader)));
  bytes = bytes.subspan(sizeof(std::uint64_t) + count * sizeof(GhostHeader));
  for (std::size_t k = 0; k < headers.size(); ++k) {
    if (headers[k].shape == BodyShape::kSurface)
      shells.push_back({headers[k], rank, k, read_shape(bytes, library)});
    else
      spheres.push_back({headers[k], rank, k, nullptr});
  }
  return headers.size();
}

/// Cells by owned body.
std::vector<const CellRow*> rows_by_body(const Tissue& tissue) {
  std::vector<const CellRow*> out(tissue.cells.size());
  for (const BodyOfRow& owned : bodies_of(tissue.cells)) out[owned.place(tissue.shells.size())] = &tissue.cells.rows[owned.row];
  return out;
}

}  // namespace

std::vector<std::byte> Scene::pack_ghosts(std::span<const std::uint32_t> bodies, std::span<const CellRow* const> rows) const {
  std::vector<GhostHeader> headers;
  std::vector<std::byte> shapes;
  for (const std::uint32_t i : bodies) {
    const ContactBody& body = bodies_[i];
    const Birth birth = birth_of(*rows[i]);
    headers.push_back({body.id, rows[i]->order, body.radius, birth.radius, birth.time, body.point_count, body.material, body.shape, {}});
    if (body.shape == BodyShape::kSurface) append_shape(*shapes_[i], shapes);
  }
  std::vector<std::byte> out = pack(std::vector<std::uint64_t>{headers.size()});
  const auto bytes = pack(headers);
  out.insert(out.end(), bytes.begin(), bytes.end());
  out.insert(out.end(), shapes.begin(), shapes.end());
  return out;
}

Mail Scene::send_to_neighbours(const Tissue& tissue, const Space& space, double reach, std::span<const CellRow* const> rows,
                               const Comm& comm) {
  std::vector<Box> box(bodies_.size());
  Box mine;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (i < count_.owned_shells)
      for (const Vec3d& p : tissue.shells.nodes(i)) box[i].include(p);
    else
      box[i].include(tissue.spheres.position[i - count_.owned_shells]);
    box[i] = box[i].inflated(0.5 * reach + bodies_[i].radius);
    mine.include(box[i]);
  }
  const auto all = items_of_all_ranks(std::vector<Box>{mine}, comm);  // 48 bytes of each rank
  Mail outgoing;
  for (int r = 0; r < comm.size(); ++r) {
    const Box& there = all[static_cast<std::size_t>(r)];
    if (r == comm.rank() || there.empty() || !overlaps_any_image(mine, there, space)) continue;
    std::vector<std::uint32_t> send;
    for (std::uint32_t i = 0; i < bodies_.size(); ++i)
      if (overlaps_any_image(box[i], there, space)) send.push_back(i);
    if (send.empty()) continue;
    outgoing[r] = pack_ghosts(send, rows);
    ghosts_.neighbours[r].send = std::move(send);
  }
  return comm.exchange(std::move(outgoing));
}

std::vector<std::uint64_t> Scene::find_ghosts(const Tissue& tissue, const Space& space, double reach, ShapeLibrary& library,
                                              const Comm& comm) {
  const std::size_t owned_shells = count_.owned_shells;
  ghosts_ = {};
  const std::vector<const CellRow*> rows = rows_by_body(tissue);
  std::vector<Arrival> shells, spheres;
  for (const auto& [rank, bytes] : send_to_neighbours(tissue, space, reach, rows, comm))
    ghosts_.neighbours[rank].receive.resize(unpack_ghosts(bytes, rank, library, shells, spheres));

  // Owned shells, ghost shells, owned spheres, ghost spheres.
  std::vector<ContactBody> bodies(bodies_.begin(), bodies_.begin() + static_cast<std::ptrdiff_t>(owned_shells));
  std::vector<std::uint64_t> orders;
  for (std::size_t i = 0; i < owned_shells; ++i) orders.push_back(rows[i]->order);
  const auto add = [&](const Arrival& arrival) {
    ghosts_.neighbours[arrival.rank].receive[arrival.at] = static_cast<std::uint32_t>(bodies.size());
    bodies.push_back(body_of(arrival.header));
    orders.push_back(arrival.header.order);
  };
  for (const Arrival& arrival : shells) {
    add(arrival);
    shapes_.push_back(arrival.form);
  }
  for (std::size_t i = owned_shells; i < bodies_.size(); ++i) {
    bodies.push_back(bodies_[i]);
    orders.push_back(rows[i]->order);
  }
  for (const Arrival& arrival : spheres) {
    add(arrival);
    ghosts_.birth.push_back({arrival.header.birth_radius, arrival.header.birth_time});
  }
  for (auto& [rank, neighbour] : ghosts_.neighbours)
    for (std::uint32_t& body : neighbour.send)
      if (body >= owned_shells) body += static_cast<std::uint32_t>(shells.size());
  bodies_ = std::move(bodies);
  return orders;
}

}  // namespace morula
