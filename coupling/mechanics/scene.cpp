#include "coupling/mechanics/scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>

namespace morula {

Scene::Birth Scene::birth_of(const CellRow& row) { return {std::cbrt(3.0 * row.birth_volume / (4.0 * std::numbers::pi)), row.birth_time}; }

void Scene::add_owned(const Tissue& tissue) {
  const auto& shells = tissue.shells;
  bodies_.clear();
  shapes_.assign(shells.shape.begin(), shells.shape.end());
  count_.owned_shells = shells.size();
  count_.owned_spheres = tissue.spheres.size();
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
  out.insert(out.end(), ghosts_.birth.begin(), ghosts_.birth.end());
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
  add_owned(tissue);
  if (comm.size() == 1) {
    std::vector<std::uint64_t> order(bodies_.size());
    for (const BodyOfRow& owned : bodies_of(tissue.cells)) order[owned.place(count_.owned_shells)] = tissue.cells.rows[owned.row].order;
    ghosts_.send.assign(1, {});
    ghosts_.receive.assign(1, {});
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
  std::vector<Vec3d> flag(points_.x.size());  // ghosts move when their owner says so
  for (const ContactBody& body : bodies_)
    if (body.active()) flag[body.first_point].x = 1.0;
  exchange(std::span(flag));
  for (ContactBody& body : bodies_)
    if (!body.owned) body.moves = flag[body.first_point].x != 0.0;
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
  std::vector<double> radius(points_.x.size());
  for (std::size_t i = 0; i < count_.owned_spheres; ++i) radius[bodies_[count_.shells + i].first_point] = tissue.spheres.radius[i];
  exchange_points(std::span(radius));
  for (std::size_t i = count_.shells + count_.owned_spheres; i < bodies_.size(); ++i) bodies_[i].radius = radius[bodies_[i].first_point];
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
  if (comm_->size() == 1) return;
  const auto marks_of = [&](std::uint32_t body) {
    return std::span(mark_).subspan(first_face_[body] * width, topologies_[body]->face_count() * width);
  };
  std::vector<std::vector<std::byte>> outgoing(ghosts_.send.size());
  for (std::size_t r = 0; r < outgoing.size(); ++r)
    for (const std::uint32_t body : ghosts_.send[r]) {
      if (body >= count_.shells) continue;
      const auto bytes = std::as_bytes(marks_of(body));
      outgoing[r].insert(outgoing[r].end(), bytes.begin(), bytes.end());
    }
  const auto incoming = comm_->exchange(outgoing);
  for (std::size_t r = 0; r < incoming.size(); ++r) {
    const std::byte* next = incoming[r].data();
    for (const std::uint32_t body : ghosts_.receive[r]) {
      if (body >= count_.shells) continue;
      const auto marks = marks_of(body);
      std::memcpy(marks.data(), next, marks.size());
      next += marks.size();
    }
  }
}

template <class T, class PartOf>
void Scene::exchange_parts(const PartOf& part_of) const {
  if (comm_->size() == 1) return;
  const auto ranks = ghosts_.send.size();
  std::vector<std::vector<T>> out(ranks), in(ranks);
  std::vector<MPI_Request> requests;
  for (std::size_t r = 0; r < ranks; ++r) {
    std::size_t count = 0;
    for (const std::uint32_t body : ghosts_.receive[r]) count += part_of(body).size();
    if (count == 0) continue;
    in[r].resize(count);
    MPI_Irecv(in[r].data(), static_cast<int>(count * sizeof(T)), MPI_BYTE, static_cast<int>(r), 72, comm_->raw(), &requests.emplace_back());
  }
  for (std::size_t r = 0; r < ranks; ++r) {
    for (const std::uint32_t body : ghosts_.send[r]) {
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
    for (const std::uint32_t body : ghosts_.receive[r]) {
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
  std::size_t total = bytes(bodies_) + bytes(ghosts_.birth) + bytes(shapes_) + bytes(topologies_) + bytes(first_node_) +
                      bytes(first_face_) + bytes(points_.x);
  for (const auto* lists : {&ghosts_.send, &ghosts_.receive})
    for (const auto& list : *lists) total += bytes(list);
  return total;
}

}  // namespace morula
