#include "core/mesh/renewal/change_guard.h"

#include <algorithm>
#include <cmath>

#include "core/mesh/pseudonormal.h"
#include "core/mesh/self_intersection.h"

namespace morula {
namespace {

/// Two faces at an edge are never bent by more than a right angle in the estimate of the chord error.
constexpr double kMostBendOfChord = 1.0;

Vec3d unit_normal(const PlacedFace& face) {
  const Vec3d twice = cross(face.corner[1] - face.corner[0], face.corner[2] - face.corner[0]);
  const double length = norm(twice);
  return length > 0.0 ? twice / length : Vec3d{};
}

PlacedFace face_before(const LiveMesh& mesh, const Triangle& face) {
  return {face, {mesh.position(face[0]), mesh.position(face[1]), mesh.position(face[2])}};
}

/// Cosine of the sharpest bend between some faces and between them and what lies around; what goes is not around.
double least_cosine(const LiveMesh& mesh, std::span<const std::uint32_t> gone, std::span<const PlacedFace> faces) {
  double least = 1.0;
  std::vector<Vec3d> normal;
  for (const PlacedFace& face : faces) normal.push_back(unit_normal(face));
  const auto normal_with = [&](std::uint32_t a, std::uint32_t b) {
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (std::size_t c = 0; c < 3; ++c)
        if (faces[f].node[c] == a && faces[f].node[(c + 1) % 3] == b) return normal[f];
    if (a < mesh.next_node() && b < mesh.next_node())
      if (const auto slot = mesh.face_with(a, b); slot && !std::ranges::binary_search(gone, *slot))
        return unit_normal(face_before(mesh, mesh.face(*slot)));
    return Vec3d{};
  };
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t c = 0; c < 3; ++c) least = std::min(least, dot(normal[f], normal_with(faces[f].node[(c + 1) % 3], faces[f].node[c])));
  return least;
}

double quality_of(const PlacedFace& face) { return triangle_quality(face.corner[0], face.corner[1], face.corner[2]); }
double area_of(const PlacedFace& face) { return 0.5 * norm(cross(face.corner[1] - face.corner[0], face.corner[2] - face.corner[0])); }
Box box_of(const PlacedFace& face) {
  Box out;
  for (const Vec3d& x : face.corner) out.include(x);
  return out;
}

/// visit(point) for corners, middle and middles of the edges of faces, those of an edge once.
template <class Visit>
void for_samples(std::span<const PlacedFace> faces, Visit&& visit) {
  std::vector<std::uint32_t> seen;
  for (const PlacedFace& face : faces) {
    const auto& x = face.corner;
    visit((x[0] + x[1] + x[2]) / 3.0);
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t next = (c + 1) % 3;
      if (face.node[c] < face.node[next]) visit((x[c] + x[next]) * 0.5);
      if (std::ranges::find(seen, face.node[c]) != seen.end()) continue;
      seen.push_back(face.node[c]);
      visit(x[c]);
    }
  }
}

}  // namespace

/// The faces of a change before and after it, and how far points may be off.
struct ChangeGuard::Patch {
  std::vector<PlacedFace> before, after;
  Box box;
  double may_be_off = 0.0;  ///< [µm]

  Patch(const LiveMesh& mesh, const MeshChange& change) {
    for (const std::uint32_t slot : change.gone) before.push_back(face_before(mesh, mesh.face(slot)));
    for (const Triangle& face : change.fresh)
      after.push_back({face, {place_after(mesh, change, face[0]), place_after(mesh, change, face[1]), place_after(mesh, change, face[2])}});
    for (const PlacedFace& face : before) box.include(box_of(face));
    for (const PlacedFace& face : after) box.include(box_of(face));
  }
};

ChangeRefusal ChangeGuard::judge(const LiveMesh& mesh, const MeshChange& change) {
  Patch patch(mesh, change);
  double worst_before = 1.0, worst_after = 1.0;
  change_of_area_ = 0.0;
  for (const PlacedFace& face : patch.before) worst_before = std::min(worst_before, quality_of(face)), change_of_area_ -= area_of(face);
  for (const PlacedFace& face : patch.after) worst_after = std::min(worst_after, quality_of(face)), change_of_area_ += area_of(face);
  if (!(worst_after >= std::min(limits_.least_quality, worst_before))) return ChangeRefusal::kShape;

  const double total = area_change_ + change_of_area_;
  if (std::abs(total) > limits_.area_change * surface_.area() && std::abs(total) > std::abs(area_change_)) return ChangeRefusal::kArea;

  const double bent_before = least_cosine(mesh, change.gone, patch.before), bent_after = least_cosine(mesh, change.gone, patch.after);
  if (bent_after < std::min(std::cos(limits_.most_bend), bent_before)) return ChangeRefusal::kFold;
  const double bend = std::min(kMostBendOfChord, std::acos(std::clamp(bent_before, -1.0, 1.0)));
  patch.may_be_off = limits_.edge * (limits_.off_surface + bend / 8.0);
  if (leaves_surface(mesh, change, patch)) return ChangeRefusal::kDistance;
  if (goes_deeper(patch)) return ChangeRefusal::kOverlap;
  return crosses(mesh, change, patch) ? ChangeRefusal::kCrossing : ChangeRefusal::kNone;
}

bool ChangeGuard::crosses(const LiveMesh& mesh, const MeshChange& change, const Patch& patch) const {
  std::vector<Box> boxes;
  Box all;
  for (const PlacedFace& face : patch.after) {
    boxes.push_back(box_of(face));
    all.include(boxes.back());
  }
  for (std::size_t f = 0; f < boxes.size(); ++f)
    for (std::size_t g = 0; g < f; ++g)
      if (boxes[f].overlaps(boxes[g]) && faces_meet(patch.after[f], patch.after[g])) return true;
  for (std::uint32_t slot = 0; slot < mesh.slots(); ++slot) {
    if (!mesh.has_face(slot)) continue;
    const PlacedFace other = face_before(mesh, mesh.face(slot));
    const Box box = box_of(other);
    if (!box.overlaps(all) || std::ranges::binary_search(change.gone, slot)) continue;
    for (std::size_t f = 0; f < boxes.size(); ++f)
      if (boxes[f].overlaps(box) && faces_meet(patch.after[f], other)) return true;
  }
  return false;
}

bool ChangeGuard::leaves_surface(const LiveMesh& mesh, const MeshChange& change, const Patch& patch) const {
  bool off = false;
  for_samples(patch.after, [&](const Vec3d& p) { off = off || !surface_.tree().nearest(p, patch.may_be_off); });
  if (off) return true;
  // The other direction: nodes of the old surface that lay on this part of it.
  const double most2 = patch.may_be_off * patch.may_be_off;
  const auto distance2 = [](const Vec3d& p, const PlacedFace& face) {
    return closest_point_on_triangle(p, face.corner[0], face.corner[1], face.corner[2]).distance2;
  };
  for (const Vec3d& p : surface_.view().position) {
    if (!patch.box.contains(p)) continue;
    double nearest = 1e300;
    for (const PlacedFace& face : patch.after) nearest = std::min(nearest, distance2(p, face));
    for (std::uint32_t slot = 0; nearest > most2 && slot < mesh.slots(); ++slot)
      if (mesh.has_face(slot) && !std::ranges::binary_search(change.gone, slot))
        nearest = std::min(nearest, distance2(p, face_before(mesh, mesh.face(slot))));
    if (nearest > most2) return true;
  }
  return false;
}

double ChangeGuard::depth_at(const Vec3d& p, double reach) const {
  double deepest = 0.0;
  for (const AskedSurface* wall : walls_) {
    if (!wall->tree().bounds().contains(p)) continue;
    const auto nearest = wall->tree().nearest(p, reach);
    if (!nearest) continue;
    deepest = std::max(deepest, -signed_distance(*wall->view().topology, wall->view().position, p, nearest->face, nearest->closest));
  }
  return deepest;
}

bool ChangeGuard::goes_deeper(const Patch& patch) const {
  const auto touches = [&](const AskedSurface* wall) { return wall->tree().bounds().overlaps(patch.box); };
  if (std::ranges::none_of(walls_, touches)) return false;
  double before = 0.0, after = 0.0;
  for_samples(patch.before, [&](const Vec3d& p) { before = std::max(before, depth_at(p, limits_.edge)); });
  for_samples(patch.after, [&](const Vec3d& p) { after = std::max(after, depth_at(p, limits_.edge)); });
  return after > before + limits_.deeper * limits_.edge;
}

}  // namespace morula
