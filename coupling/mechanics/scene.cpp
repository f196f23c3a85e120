#include "coupling/mechanics/scene.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/ball.h"

namespace morula {

Scene::Birth Scene::birth_of(const CellRow& row) { return {ball_radius(row.birth_volume), row.birth_time}; }

std::vector<std::uint64_t> Scene::add_owned(const Tissue& tissue) {
  const auto& shells = tissue.shells;
  shapes_.assign(shells.shape.begin(), shells.shape.end());
  count_.owned_shells = shells.size();
  count_.owned_spheres = tissue.spheres.size();
  bodies_.assign(tissue.cells.size(), {});
  std::vector<std::uint64_t> order(tissue.cells.size());
  for (const BodyOfRow& owned : bodies_of(tissue.cells)) {
    const CellRow& row = tissue.cells.rows[owned.row];
    const std::size_t number = owned.place(count_.owned_shells);
    ContactBody& body = bodies_[number];
    body.id = row.id;
    body.material = row.type;
    order[number] = row.order;
    if (owned.is_shell) {
      body.shape = BodyShape::kSurface;
      body.point_count = shapes_[owned.number]->topology->node_count();
    } else {
      body.radius = tissue.spheres.radius[owned.number];
    }
  }
  return order;
}

std::vector<Scene::Birth> Scene::sphere_births(const Tissue& tissue) const {
  std::vector<Birth> out;
  for (const CellRow& row : tissue.cells.rows)
    if (row.body == BodyKind::kSphere) out.push_back(birth_of(row));
  out.insert(out.end(), ghosts_.birth.begin(), ghosts_.birth.end());
  return out;
}

std::vector<Scene::Birth> Scene::sphere_births(const Tissue& tissue, std::span<const std::uint32_t> spheres) const {
  std::vector<Birth> out;
  auto next = spheres.begin();
  std::uint32_t number = 0;
  for (std::size_t row = tissue.shells.size() == 0 && next != spheres.end() ? *next : 0; row < tissue.cells.size() && next != spheres.end();
       ++row) {
    if (tissue.shells.size() == 0)
      row = number = *next;  // every row is a sphere
    else if (tissue.cells.rows[row].body != BodyKind::kSphere)
      continue;
    if (row >= tissue.cells.size()) break;
    for (; next != spheres.end() && *next == number; ++next) out.push_back(birth_of(tissue.cells.rows[row]));
    ++number;
  }
  for (; next != spheres.end(); ++next) out.push_back(ghosts_.birth[*next - count_.owned_spheres]);
  return out;
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
  const std::vector<std::uint64_t> order = add_owned(tissue);
  if (comm.size() == 1) {
    ghosts_ = {};
    place_bodies(order);
  } else {
    place_bodies(find_ghosts(tissue, space, reach, library, comm));
  }
  count_.shells = 0;
  while (count_.shells < bodies_.size() && bodies_[count_.shells].shape == BodyShape::kSurface) ++count_.shells;
  topologies_.clear();
  first_node_.assign(1, 0);
  first_face_.assign(1, 0);
  std::uint32_t point = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    ContactBody& body = bodies_[i];
    body.first_point = point;
    point += body.point_count;
    if (i >= count_.shells) continue;
    topologies_.push_back(shapes_[i]->topology.get());
    first_node_.push_back(point);
    first_face_.push_back(first_face_.back() + topologies_.back()->face_count());
  }
  count_.faces = first_face_.back();
  count_.owned_nodes = first_node_[count_.owned_shells];
  count_.shell_nodes = first_node_.back();
  count_.nucleus_point = point;
  inner_.clear();
  for (std::uint32_t i = 0; i < count_.owned_shells; ++i)
    if (tissue.shells.nucleus_of(i) != nullptr) inner_.push_back({point++, 1, i});
  count_.nuclear_node = point;
  for (std::size_t n = 0; n < tissue.nuclei.size(); ++n) {
    const std::uint32_t count = tissue.nuclei.shells.first_node[n + 1] - tissue.nuclei.shells.first_node[n];
    inner_.push_back({point, count, tissue.nuclei.owner[n]});
    point += count;
  }
  mark_.clear();
  points_.x.assign(point, Vec3d{});
  take_positions(tissue);
  renew_ghost_positions();
}

void Scene::set_moving(std::span<const char> moves) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i].moves = moves.empty() || moves[i] != 0;
  if (moves.empty() || comm_->size() == 1) return;
  std::vector<std::uint64_t> flag(bodies_.size());  // ghosts move when their owner says so
  for (std::size_t i = 0; i < bodies_.size(); ++i) flag[i] = bodies_[i].active();
  exchange_bodies(flag);
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (!bodies_[i].owned) bodies_[i].moves = flag[i] != 0;
}

void Scene::take_positions(const Tissue& tissue) {
  ++points_.number;
  std::copy(tissue.shells.position.begin(), tissue.shells.position.end(), points_.x.begin());
  std::copy(tissue.spheres.position.begin(), tissue.spheres.position.end(), points_.x.begin() + count_.shell_nodes);
  std::size_t nucleus = count_.nucleus_point;
  for (std::size_t i = 0; i < count_.owned_shells; ++i)
    if (const Vec3d* center = tissue.shells.nucleus_of(i)) points_.x[nucleus++] = *center;
  std::copy(tissue.nuclei.shells.position.begin(), tissue.nuclei.shells.position.end(), points_.x.begin() + count_.nuclear_node);
}

void Scene::take_radii(const Tissue& tissue) {
  for (std::size_t i = 0; i < count_.owned_spheres; ++i) bodies_[count_.shells + i].radius = tissue.spheres.radius[i];
  if (comm_->size() == 1) return;
  std::vector<double> radius(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) radius[i] = bodies_[i].radius;
  exchange_values(std::span(radius));
  for (std::size_t i = count_.shells + count_.owned_spheres; i < bodies_.size(); ++i) bodies_[i].radius = radius[i];
}

void Scene::give_positions(Tissue& tissue) const {
  std::copy_n(points_.x.begin(), tissue.shells.position.size(), tissue.shells.position.begin());
  std::copy_n(points_.x.begin() + count_.shell_nodes, tissue.spheres.position.size(), tissue.spheres.position.begin());
  std::size_t nucleus = count_.nucleus_point;
  for (std::optional<Vec3d>& center : tissue.shells.nucleus)
    if (center) center = points_.x[nucleus++];
  std::copy_n(points_.x.begin() + count_.nuclear_node, tissue.nuclei.shells.position.size(), tissue.nuclei.shells.position.begin());
}

bool Scene::marks_differ(const Tissue& tissue) const {
  if (mark_.empty() != (count_.faces == 0)) return true;
  const std::size_t width = marks().width();
  for (std::size_t s = 0; s < count_.owned_shells; ++s) {
    const auto& mark = tissue.shells.faces_of(s).mark;
    const auto here = std::span(mark_).subspan(first_face_[s] * width, topologies_[s]->face_count() * width);
    if (mark.empty() ? std::any_of(here.begin(), here.end(), [](std::uint8_t m) { return m != 0; })
                     : !std::equal(here.begin(), here.end(), mark.begin()))
      return true;
  }
  return false;
}

void Scene::take_marks(const Tissue& tissue, std::size_t width) {
  mark_.assign(count_.faces * width, 0);
  for (std::size_t s = 0; s < count_.owned_shells; ++s) {
    const auto& mark = tissue.shells.faces_of(s).mark;
    std::copy(mark.begin(), mark.end(), mark_.begin() + static_cast<std::ptrdiff_t>(first_face_[s] * width));
  }
  exchange_parts([&](std::uint32_t body) {
    return body < count_.shells ? std::span(mark_).subspan(first_face_[body] * width, topologies_[body]->face_count() * width)
                                : std::span<std::uint8_t>();
  });
}

template <class PartOf>
void Scene::exchange_parts(const PartOf& part_of) const {
  if (ghosts_.neighbours.empty()) return;
  const auto bytes_of = [&](std::span<const std::uint32_t> list) {
    std::size_t bytes = 0;
    for (const std::uint32_t body : list) bytes += part_of(body).size_bytes();
    return bytes;
  };
  std::size_t sent = 0, received = 0;
  for (const auto& [rank, neighbour] : ghosts_.neighbours) {
    sent += bytes_of(neighbour.send);
    received += bytes_of(neighbour.receive);
  }
  rooms_.sent.resize(std::max(sent, rooms_.sent.size()));
  rooms_.received.resize(std::max(received, rooms_.received.size()));
  rooms_.sendings.clear();
  rooms_.receivings.clear();
  std::byte *next_sent = rooms_.sent.data(), *next_received = rooms_.received.data();
  for (const auto& [rank, neighbour] : ghosts_.neighbours) {
    std::byte* const first = next_sent;
    for (const std::uint32_t body : neighbour.send) {
      const auto part = std::as_bytes(part_of(body));
      next_sent = std::copy(part.begin(), part.end(), next_sent);
    }
    rooms_.sendings.push_back({rank, {first, next_sent}});
    rooms_.receivings.push_back({rank, {next_received, bytes_of(neighbour.receive)}});
    next_received += rooms_.receivings.back().bytes.size();
  }
  comm_->exchange(rooms_.sendings, rooms_.receivings);
  const std::byte* next = rooms_.received.data();
  for (const auto& [rank, neighbour] : ghosts_.neighbours)
    for (const std::uint32_t body : neighbour.receive) {
      const auto part = std::as_writable_bytes(part_of(body));
      std::copy_n(next, part.size(), part.begin());
      next += part.size();
    }
}

template <class T>
void Scene::exchange_points(std::span<T> by_point) const {
  exchange_parts([&](std::uint32_t body) { return by_point.subspan(bodies_[body].first_point, bodies_[body].point_count); });
}

template <class T>
void Scene::exchange_values(std::span<T> by_body) const {
  exchange_parts([&](std::uint32_t body) { return by_body.subspan(body, 1); });
}

void Scene::exchange_bodies(std::span<std::uint64_t> by_body) const { exchange_values(by_body); }
void Scene::exchange(std::span<Vec3d> by_point) const { exchange_points(by_point); }
void Scene::exchange(std::span<Float4> by_point) const { exchange_points(by_point); }

std::size_t Scene::memory() const {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t total = bytes(bodies_) + bytes(ghosts_.birth) + bytes(shapes_) + bytes(topologies_) + bytes(first_node_) +
                      bytes(first_face_) + bytes(points_.x) + bytes(rooms_.sent) + bytes(rooms_.received);
  for (const auto& [rank, neighbour] : ghosts_.neighbours) total += bytes(neighbour.send) + bytes(neighbour.receive);
  return total;
}

}  // namespace morula
