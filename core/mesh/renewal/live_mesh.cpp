#include "core/mesh/renewal/live_mesh.h"

#include <algorithm>

namespace morula {

LiveMesh::LiveMesh(const SurfaceView& surface)
    : position_(surface.position.begin(), surface.position.end()),
      faces_(surface.topology->faces().begin(), surface.topology->faces().end()),
      alive_(faces_.size(), 1),
      around_(position_.size()),
      nodes_(static_cast<std::uint32_t>(position_.size())) {
  for (std::uint32_t slot = 0; slot < slots(); ++slot)
    for (const std::uint32_t node : faces_[slot]) around_[node].push_back(slot);
}

std::vector<std::uint32_t> LiveMesh::neighbours_of(std::uint32_t node) const {
  std::vector<std::uint32_t> out;
  for (const std::uint32_t slot : around_[node])
    for (const std::uint32_t other : faces_[slot])
      if (other != node) out.push_back(other);
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::optional<std::uint32_t> LiveMesh::face_with(std::uint32_t a, std::uint32_t b) const {
  for (const std::uint32_t slot : around_[a]) {
    const Triangle& face = faces_[slot];
    for (std::size_t c = 0; c < 3; ++c)
      if (face[c] == a && face[(c + 1) % 3] == b) return slot;
  }
  return std::nullopt;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> LiveMesh::edges() const {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> out;
  for (std::uint32_t slot = 0; slot < slots(); ++slot)
    for (std::size_t c = 0; alive_[slot] && c < 3; ++c) {
      const std::uint32_t a = faces_[slot][c], b = faces_[slot][(c + 1) % 3];
      if (a < b) out.emplace_back(a, b);
    }
  std::ranges::sort(out);
  return out;
}

void LiveMesh::take_face(std::uint32_t slot) {
  for (const std::uint32_t node : faces_[slot]) std::erase(around_[node], slot);
  alive_[slot] = 0;
}

void LiveMesh::put_face(std::uint32_t slot, const Triangle& face) {
  if (slot == slots()) {
    faces_.push_back(face);
    alive_.push_back(1);
  }
  faces_[slot] = face;
  alive_[slot] = 1;
  for (const std::uint32_t node : face) around_[node].insert(std::ranges::upper_bound(around_[node], slot), slot);
}

void LiveMesh::apply(const MeshChange& change) {
  for (const PlacedNode& one : change.placed) {
    if (one.node == position_.size()) {
      position_.push_back(one.place);
      around_.emplace_back();
      ++nodes_;
    } else {
      position_[one.node] = one.place;
    }
  }
  for (const std::uint32_t slot : change.gone) take_face(slot);
  for (std::size_t k = 0; k < change.fresh.size(); ++k) put_face(k < change.gone.size() ? change.gone[k] : slots(), change.fresh[k]);
  if (change.removed) --nodes_;
}

void LiveMesh::place_all(std::span<const Vec3d> places) {
  std::size_t next = 0;
  for (std::uint32_t node = 0; node < position_.size(); ++node)
    if (has_node(node)) position_[node] = places[next++];
}

TriangleMesh LiveMesh::mesh() const {
  TriangleMesh out;
  std::vector<std::uint32_t> number(position_.size());
  for (std::uint32_t node = 0; node < position_.size(); ++node) {
    number[node] = static_cast<std::uint32_t>(out.position.size());
    if (has_node(node)) out.position.push_back(position_[node]);
  }
  for (std::uint32_t slot = 0; slot < slots(); ++slot)
    if (alive_[slot]) out.faces.push_back({number[faces_[slot][0]], number[faces_[slot][1]], number[faces_[slot][2]]});
  return out;
}

}  // namespace morula
