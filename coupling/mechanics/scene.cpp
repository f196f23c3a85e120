#include "coupling/mechanics/scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>

#include "core/mesh/shape_bytes.h"

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

template <class T>
std::vector<T> unpack(std::span<const std::byte> bytes) {
  std::vector<T> out(bytes.size() / sizeof(T));
  if (!out.empty()) std::memcpy(out.data(), bytes.data(), bytes.size());
  return out;
}
template <class T>
std::vector<std::byte> pack(const std::vector<T>& items) {
  std::vector<std::byte> out(items.size() * sizeof(T));
  if (!out.empty()) std::memcpy(out.data(), items.data(), out.size());
  return out;
}

Scene::Birth birth_of(const CellRow& row) { return {std::cbrt(3.0 * row.birth_volume / (4.0 * std::numbers::pi)), row.birth_time}; }

bool overlaps_any_image(const Box& a, const Box& b, const Space& space) {
  if (!space.any_periodic()) return a.overlaps(b);
  const Vec3d size = space.box.size();
  const auto most = [&](int axis) { return space.periodic(axis) ? 1 : 0; };
  for (int x = -most(0); x <= most(0); ++x)
    for (int y = -most(1); y <= most(1); ++y)
      for (int z = -most(2); z <= most(2); ++z) {
        const Vec3d shift{x * size.x, y * size.y, z * size.z};
        if (a.overlaps({b.low + shift, b.high + shift})) return true;
      }
  return false;
}

}  // namespace

void Scene::add_owned(const Tissue& tissue) {
  const auto& shells = tissue.shells;
  bodies_.clear();
  shapes_.assign(shells.shape.begin(), shells.shape.end());
  owned_shells_ = shells.size();
  owned_spheres_ = tissue.spheres.size();
  std::vector<ContactBody> spheres;
  for (const CellRow& row : tissue.cells.rows) {
    ContactBody body;
    body.id = row.id;
    body.material = row.type;
    if (row.body == BodyKind::kShell) {
      body.shape = BodyShape::kSurface;
      body.point_count = shapes_[bodies_.size()]->topology->node_count();
      bodies_.push_back(body);
    } else {
      body.radius = tissue.spheres.radius[spheres.size()];
      spheres.push_back(body);
    }
  }
  bodies_.insert(bodies_.end(), spheres.begin(), spheres.end());
}

std::vector<Scene::Birth> Scene::sphere_births(const Tissue& tissue) const {
  std::vector<Birth> out;
  for (const CellRow& row : tissue.cells.rows)
    if (row.body == BodyKind::kSphere) out.push_back(birth_of(row));
  out.insert(out.end(), ghost_birth_.begin(), ghost_birth_.end());
  return out;
}

void Scene::find_ghosts(const Tissue& tissue, const Space& space, double reach, ShapeLibrary& library, const Comm& comm) {
  const auto ranks = static_cast<std::size_t>(comm.size());
  send_bodies_.assign(ranks, {});
  receive_bodies_.assign(ranks, {});
  ghost_birth_.clear();
  if (comm.size() == 1) return;
  std::vector<Box> box(bodies_.size());
  Box mine;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (i < owned_shells_)
      for (const Vec3d& p : tissue.shells.nodes(i)) box[i].include(p);
    else
      box[i].include(tissue.spheres.position[i - owned_shells_]);
    box[i] = box[i].inflated(0.5 * reach + bodies_[i].radius);
    mine.include(box[i]);
  }
  const auto all = unpack<Box>(comm.gather_to_all(pack(std::vector<Box>{mine})));
  std::vector<std::uint64_t> order(bodies_.size());
  std::vector<std::uint32_t> row_of(bodies_.size());
  for (const BodyOfRow& owned : bodies_of(tissue.cells)) {
    const std::size_t body = owned.place(owned_shells_);
    order[body] = tissue.cells.rows[owned.row].order;
    row_of[body] = static_cast<std::uint32_t>(owned.row);
  }
  std::vector<std::vector<std::byte>> outgoing(ranks);
  for (std::size_t r = 0; r < ranks; ++r) {
    if (static_cast<int>(r) == comm.rank() || all[r].empty()) continue;
    std::vector<GhostHeader> headers;
    std::vector<std::byte> shapes;
    for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
      if (!overlaps_any_image(box[i], all[r], space)) continue;
      send_bodies_[r].push_back(i);
      const Birth birth = birth_of(tissue.cells.rows[row_of[i]]);
      headers.push_back({bodies_[i].id,
                         order[i],
                         bodies_[i].radius,
                         birth.radius,
                         birth.time,
                         bodies_[i].point_count,
                         bodies_[i].material,
                         bodies_[i].shape,
                         {}});
      if (bodies_[i].shape == BodyShape::kSurface) append_shape(*shapes_[i], shapes);
    }
    outgoing[r] = pack(std::vector<std::uint64_t>{headers.size()});
    const auto bytes = pack(headers);
    outgoing[r].insert(outgoing[r].end(), bytes.begin(), bytes.end());
    outgoing[r].insert(outgoing[r].end(), shapes.begin(), shapes.end());
  }
  const auto incoming = comm.exchange(outgoing);

  struct Arrival {
    GhostHeader header;
    std::size_t rank, at;
    std::shared_ptr<const ReferenceShape> form;  ///< of a shell
  };
  std::vector<Arrival> ghost_shells, ghost_spheres;
  for (std::size_t r = 0; r < ranks; ++r) {
    if (incoming[r].empty()) continue;
    std::span<const std::byte> rest(incoming[r]);
    const auto count = unpack<std::uint64_t>(rest.first(sizeof(std::uint64_t)))[0];
    const auto headers = unpack<GhostHeader>(rest.subspan(sizeof(std::uint64_t), count * sizeof(GhostHeader)));
    rest = rest.subspan(sizeof(std::uint64_t) + count * sizeof(GhostHeader));
    receive_bodies_[r].resize(headers.size());
    for (std::size_t k = 0; k < headers.size(); ++k) {
      if (headers[k].shape == BodyShape::kSurface)
        ghost_shells.push_back({headers[k], r, k, read_shape(rest, library)});
      else
        ghost_spheres.push_back({headers[k], r, k, nullptr});
    }
  }
  const auto body_of = [](const GhostHeader& h) {
    ContactBody body;
    body.id = h.id;
    body.material = h.type;
    body.shape = h.shape;
    body.radius = h.radius;
    body.point_count = h.nodes;
    body.owned = false;
    return body;
  };
  std::vector<ContactBody> shells, spheres;
  for (const Arrival& arrival : ghost_shells) {
    receive_bodies_[arrival.rank][arrival.at] = static_cast<std::uint32_t>(owned_shells_ + shells.size());
    shells.push_back(body_of(arrival.header));
    shapes_.push_back(arrival.form);
  }
  for (const Arrival& arrival : ghost_spheres) {
    receive_bodies_[arrival.rank][arrival.at] = static_cast<std::uint32_t>(owned_shells_ + shells.size() + owned_spheres_ + spheres.size());
    spheres.push_back(body_of(arrival.header));
    ghost_birth_.push_back({arrival.header.birth_radius, arrival.header.birth_time});
  }
  for (auto& list : send_bodies_)
    for (std::uint32_t& body : list)
      if (body >= owned_shells_) body += static_cast<std::uint32_t>(shells.size());
  std::vector<std::uint64_t> orders(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(owned_shells_));
  for (const Arrival& arrival : ghost_shells) orders.push_back(arrival.header.order);
  orders.insert(orders.end(), order.begin() + static_cast<std::ptrdiff_t>(owned_shells_), order.end());
  for (const Arrival& arrival : ghost_spheres) orders.push_back(arrival.header.order);
  bodies_.insert(bodies_.begin() + static_cast<std::ptrdiff_t>(owned_shells_), shells.begin(), shells.end());
  bodies_.insert(bodies_.end(), spheres.begin(), spheres.end());
  place_bodies(orders);
}

void Scene::place_bodies(std::span<const std::uint64_t> order) {
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    return order[a] != order[b] ? order[a] < order[b] : bodies_[a].id < bodies_[b].id;
  };
  std::vector<std::uint32_t> sorted(bodies_.size());
  std::iota(sorted.begin(), sorted.end(), 0u);
  // Shells and spheres of one rank come in canonical order: a few runs to merge.
  for (auto done = sorted.begin(); done != sorted.end();) {
    const auto end = std::is_sorted_until(done, sorted.end(), before);
    std::inplace_merge(sorted.begin(), done, end, before);
    done = end;
  }
  for (std::uint32_t place = 0; place < sorted.size(); ++place) bodies_[sorted[place]].place = place;
}

void Scene::build(const Tissue& tissue, const Space& space, double reach, ShapeLibrary& library, const Comm& comm) {
  comm_ = &comm;
  add_owned(tissue);
  if (comm.size() == 1) {
    std::vector<std::uint64_t> order(bodies_.size());
    for (const BodyOfRow& owned : bodies_of(tissue.cells)) order[owned.place(owned_shells_)] = tissue.cells.rows[owned.row].order;
    send_bodies_.assign(1, {});
    receive_bodies_.assign(1, {});
    place_bodies(order);
  } else {
    find_ghosts(tissue, space, reach, library, comm);
  }
  shells_ = 0;
  while (shells_ < bodies_.size() && bodies_[shells_].shape == BodyShape::kSurface) ++shells_;
  topologies_.clear();
  first_node_.assign(1, 0);
  first_face_.assign(1, 0);
  std::uint32_t point = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    ContactBody& body = bodies_[i];
    body.first_point = point;
    point += body.point_count;
    if (i >= shells_) continue;
    topologies_.push_back(shapes_[i]->topology.get());
    first_node_.push_back(point);
    first_face_.push_back(first_face_.back() + topologies_.back()->face_count());
  }
  face_count_ = first_face_.back();
  owned_nodes_ = first_node_[owned_shells_];
  shell_nodes_ = first_node_.back();
  nucleus_point_ = point;
  for (std::size_t i = 0; i < owned_shells_; ++i) point += tissue.shells.nucleus_of(i) != nullptr;
  nuclear_node_ = point;
  point += tissue.nuclei.shells.node_count();
  mark_.clear();
  position_.assign(point, Vec3d{});
  take_positions(tissue);
  exchange(position_);
}

void Scene::set_moving(std::span<const char> moves) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i].moves = moves.empty() || moves[i] != 0;
  if (moves.empty() || comm_->size() == 1) return;
  std::vector<Vec3d> flag(position_.size());  // ghosts move when their owner says so
  for (const ContactBody& body : bodies_)
    if (body.active()) flag[body.first_point].x = 1.0;
  exchange(std::span(flag));
  for (ContactBody& body : bodies_)
    if (!body.owned) body.moves = flag[body.first_point].x != 0.0;
}

void Scene::take_positions(const Tissue& tissue) {
  std::copy(tissue.shells.position.begin(), tissue.shells.position.end(), position_.begin());
  std::copy(tissue.spheres.position.begin(), tissue.spheres.position.end(), position_.begin() + shell_nodes_);
  std::size_t nucleus = nucleus_point_;
  for (std::size_t i = 0; i < owned_shells_; ++i)
    if (const Vec3d* center = tissue.shells.nucleus_of(i)) position_[nucleus++] = *center;
  std::copy(tissue.nuclei.shells.position.begin(), tissue.nuclei.shells.position.end(), position_.begin() + nuclear_node_);
}

void Scene::take_radii(const Tissue& tissue) {
  for (std::size_t i = 0; i < owned_spheres_; ++i) bodies_[shells_ + i].radius = tissue.spheres.radius[i];
  if (comm_->size() == 1) return;
  std::vector<double> radius(position_.size());
  for (std::size_t i = 0; i < owned_spheres_; ++i) radius[bodies_[shells_ + i].first_point] = tissue.spheres.radius[i];
  exchange_points(std::span(radius));
  for (std::size_t i = shells_ + owned_spheres_; i < bodies_.size(); ++i) bodies_[i].radius = radius[bodies_[i].first_point];
}

void Scene::give_positions(Tissue& tissue) const {
  std::copy_n(position_.begin(), tissue.shells.position.size(), tissue.shells.position.begin());
  std::copy_n(position_.begin() + shell_nodes_, tissue.spheres.position.size(), tissue.spheres.position.begin());
  std::size_t nucleus = nucleus_point_;
  for (std::optional<Vec3d>& center : tissue.shells.nucleus)
    if (center) center = position_[nucleus++];
  std::copy_n(position_.begin() + nuclear_node_, tissue.nuclei.shells.position.size(), tissue.nuclei.shells.position.begin());
}

bool Scene::marks_differ(const Tissue& tissue) const {
  if (mark_.size() != face_count_) return true;
  for (std::size_t s = 0; s < owned_shells_; ++s) {
    const auto& mark = tissue.shells.faces_of(s).mark;
    const auto here = std::span(mark_).subspan(first_face_[s], topologies_[s]->face_count());
    if (mark.empty() ? std::any_of(here.begin(), here.end(), [](std::uint8_t m) { return m != 0; })
                     : !std::equal(here.begin(), here.end(), mark.begin()))
      return true;
  }
  return false;
}

void Scene::take_marks(const Tissue& tissue) {
  mark_.assign(face_count_, 0);
  for (std::size_t s = 0; s < owned_shells_; ++s) {
    const auto& mark = tissue.shells.faces_of(s).mark;
    std::copy(mark.begin(), mark.end(), mark_.begin() + first_face_[s]);
  }
  if (comm_->size() == 1) return;
  const auto marks_of = [&](std::uint32_t body) { return std::span(mark_).subspan(first_face_[body], topologies_[body]->face_count()); };
  std::vector<std::vector<std::byte>> outgoing(send_bodies_.size());
  for (std::size_t r = 0; r < outgoing.size(); ++r)
    for (const std::uint32_t body : send_bodies_[r]) {
      if (body >= shells_) continue;
      const auto bytes = std::as_bytes(marks_of(body));
      outgoing[r].insert(outgoing[r].end(), bytes.begin(), bytes.end());
    }
  const auto incoming = comm_->exchange(outgoing);
  for (std::size_t r = 0; r < incoming.size(); ++r) {
    const std::byte* next = incoming[r].data();
    for (const std::uint32_t body : receive_bodies_[r]) {
      if (body >= shells_) continue;
      const auto marks = marks_of(body);
      std::memcpy(marks.data(), next, marks.size());
      next += marks.size();
    }
  }
}

template <class T, class PartOf>
void Scene::exchange_parts(const PartOf& part_of) const {
  if (comm_->size() == 1) return;
  const auto ranks = send_bodies_.size();
  std::vector<std::vector<T>> out(ranks), in(ranks);
  std::vector<MPI_Request> requests;
  for (std::size_t r = 0; r < ranks; ++r) {
    std::size_t count = 0;
    for (const std::uint32_t body : receive_bodies_[r]) count += part_of(body).size();
    if (count == 0) continue;
    in[r].resize(count);
    MPI_Irecv(in[r].data(), static_cast<int>(count * sizeof(T)), MPI_BYTE, static_cast<int>(r), 72, comm_->raw(), &requests.emplace_back());
  }
  for (std::size_t r = 0; r < ranks; ++r) {
    for (const std::uint32_t body : send_bodies_[r]) {
      const std::span<T> part = part_of(body);
      out[r].insert(out[r].end(), part.begin(), part.end());
    }
    if (out[r].empty()) continue;
    MPI_Isend(out[r].data(), static_cast<int>(out[r].size() * sizeof(T)), MPI_BYTE, static_cast<int>(r), 72, comm_->raw(),
              &requests.emplace_back());
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  for (std::size_t r = 0; r < ranks; ++r) {
    const T* next = in[r].data();
    for (const std::uint32_t body : receive_bodies_[r]) {
      const std::span<T> part = part_of(body);
      std::copy_n(next, part.size(), part.begin());
      next += part.size();
    }
  }
}

template <class T>
void Scene::exchange_points(std::span<T> by_point) const {
  exchange_parts<T>([&](std::uint32_t body) { return by_point.subspan(bodies_[body].first_point, bodies_[body].point_count); });
}

void Scene::exchange_bodies(std::span<std::uint64_t> by_body) const {
  exchange_parts<std::uint64_t>([&](std::uint32_t body) { return by_body.subspan(body, 1); });
}

void Scene::exchange(std::span<Vec3d> by_point) const { exchange_points(by_point); }
void Scene::exchange(std::span<Float4> by_point) const { exchange_points(by_point); }

std::size_t Scene::memory() const {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t total = bytes(bodies_) + bytes(ghost_birth_) + bytes(shapes_) + bytes(topologies_) + bytes(first_node_) + bytes(first_face_) +
                      bytes(position_);
  for (const auto* lists : {&send_bodies_, &receive_bodies_})
    for (const auto& list : *lists) total += bytes(list);
  return total;
}

}  // namespace morula
