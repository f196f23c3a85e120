#include "coupling/new_mesh.h"

#include <array>
#include <cassert>
#include <cmath>
#include <type_traits>

#include "core/mesh/renewal/transfer_marks.h"
#include "coupling/cell_record.h"

namespace morula {
namespace {

/// Where the stretch of a new edge is looked at, as parts of its length.
constexpr std::array<double, 3> kPointsOfEdge = {1.0 / 6.0, 0.5, 5.0 / 6.0};

/// Lengths that vectors in the plane of a face had before they were stretched.
class RestMetric {
 public:
  /// Two sides from one corner as they are, and what the squares of the rest lengths of both and of the third side say of them.
  RestMetric(const Vec3d& first, const Vec3d& second, const std::array<double, 3>& rest)
      : first_(first), second_(second), g11_(rest[0] * rest[0]), g22_(rest[1] * rest[1]), g12_(0.5 * (g11_ + g22_ - rest[2] * rest[2])) {}

  /// Rest length over length of the part of a vector that lies in the plane.
  [[nodiscard]] double shrink(const Vec3d& vector) const {
    const double a11 = norm2(first_), a22 = norm2(second_), a12 = dot(first_, second_), det = a11 * a22 - a12 * a12;
    const double v1 = dot(vector, first_), v2 = dot(vector, second_);
    const double p = (a22 * v1 - a12 * v2) / det, q = (a11 * v2 - a12 * v1) / det;
    const double present = p * p * a11 + 2.0 * p * q * a12 + q * q * a22, before = p * p * g11_ + 2.0 * p * q * g12_ + q * q * g22_;
    return present > 0.0 && before > 0.0 ? std::sqrt(before / present) : 1.0;
  }

 private:
  Vec3d first_, second_;
  double g11_, g22_, g12_;
};

/// The rest metric of a face of a shell.
RestMetric rest_metric(const dcm::ShellRecord& shell, std::uint32_t face) {
  const auto& [a, b, c] = shell.shape->topology->faces()[face];
  const auto& edge = shell.shape->topology->face_edges()[face];  // entry k: opposite to corner k
  return {shell.position[b] - shell.position[a],
          shell.position[c] - shell.position[a],
          {shell.rest_length[edge[2]], shell.rest_length[edge[1]], shell.rest_length[edge[0]]}};
}

/// The old marks, each by itself.
std::vector<std::uint8_t> carried_marks(const NewMesh& mesh, std::span<const std::uint8_t> marks) {
  const std::size_t old_faces = mesh.old.shape->topology->face_count(), faces = mesh.shape.topology->face_count();
  const MarkSets before(marks, old_faces);
  std::vector<std::uint8_t> out(faces * before.width(), 0);
  for (int mark = 0; mark < static_cast<int>(8 * before.width()); ++mark) {
    if (!before.any_has(mark)) continue;
    std::vector<char> marked(old_faces);
    for (std::size_t f = 0; f < old_faces; ++f) marked[f] = before.has(f, mark);
    std::vector<char> on_surface(mesh.surface.faces().size(), 0);
    for (std::size_t f = 0; f < mesh.source_face.size(); ++f) on_surface[f] = marked[mesh.source_face[f]];
    const auto carried = transfer_marks(mesh.surface, on_surface, {mesh.position, mesh.shape.topology.get()});
    for (std::size_t f = 0; f < faces; ++f) set_mark(out, before.width(), f, mark, carried[f] != 0 && !mesh.face_is_new(f));
  }
  return out;
}

/// What the nearest old face has, and new faces `of_new_face`.
template <class T>
std::vector<T> carried_by_place(const NewMesh& mesh, std::span<const T> before, const T& of_new_face) {
  std::vector<T> out;
  const auto& x = mesh.position;
  std::uint32_t near = 0;
  for (const auto& [a, b, c] : mesh.shape.topology->faces()) {
    near = mesh.surface.nearest((x[a] + x[b] + x[c]) / 3.0, near).face;
    out.push_back(near < mesh.source_face.size() ? before[mesh.source_face[near]] : of_new_face);
  }
  return out;
}

/// The values of a column as its rule gives them to a mesh with this part of the volume.
template <class Column>
void carry(const Column& column, const NewMesh& mesh, double part, dcm::ShellRecord& out) {
  using T = typename Column::Value;
  const std::span<const T> before = column.values(mesh.old);
  if (before.empty()) return;
  switch (column.rules.on_new_mesh) {
    case OnNewMesh::kMade:
      return;
    case OnNewMesh::kKept:
      assert(Column::kDomain == Domain::kBody);
      return column.give(out, before);
    case OnNewMesh::kByVolume:
      if constexpr (std::is_same_v<T, double> && Column::kDomain == Domain::kBody) return column.give(out, std::array{part * before[0]});
      break;
    case OnNewMesh::kMean:
      if constexpr (Column::kDomain == Domain::kNode) return column.give(out, std::vector<T>(mesh.position.size(), mean_of(before)));
      break;
    case OnNewMesh::kByPlace:
      if constexpr (Column::kDomain == Domain::kFace) return column.give(out, carried_by_place(mesh, before, column.of_new_face));
      break;
    case OnNewMesh::kByCoverage:
      if constexpr (Column::kDomain == Domain::kFace && std::is_same_v<T, std::uint8_t>)
        return column.give(out, carried_marks(mesh, before));
      break;
  }
  assert(!"a column of this kind cannot follow this rule");
}

}  // namespace

std::vector<double> carried_rest_lengths(const NewMesh& mesh) {
  std::vector<double> out;
  const auto& x = mesh.position;
  std::uint32_t near = 0;
  for (const Edge& edge : mesh.shape.topology->edges()) {
    const Vec3d along = x[edge.j] - x[edge.i];
    double shrink = 0.0;
    for (const double part : kPointsOfEdge) {
      near = mesh.surface.nearest(x[edge.i] + along * part, near).face;
      shrink += near < mesh.source_face.size() ? rest_metric(mesh.old, mesh.source_face[near]).shrink(along) : 1.0;
    }
    out.push_back(norm(along) * shrink / static_cast<double>(kPointsOfEdge.size()));
  }
  return out;
}

void carry_columns(const NewMesh& mesh, double part, dcm::ShellRecord& out) {
  dcm::for_each_shell_column([&](const auto& column) { carry(column, mesh, part, out); });
}

}  // namespace morula
