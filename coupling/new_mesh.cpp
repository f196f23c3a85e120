#include "coupling/new_mesh.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <type_traits>

#include "core/mesh/renewal/transfer_marks.h"
#include "coupling/cell_record.h"

namespace morula {
namespace {

/// Where the stretch of a new edge is looked at, as parts of its length.
constexpr std::array<double, 3> kPointsOfEdge = {1.0 / 6.0, 0.5, 5.0 / 6.0};

/// Part of the area that a face at rest has if its edges are shortened alike: no cortex is stretched ten times as much along one direction as across it.
constexpr double kLeastOfArea = 0.3;
constexpr int kMostPasses = 100;

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

/// The rest metric of a face of a shell, by the rest lengths of its edges.
RestMetric rest_metric(const dcm::ShellRecord& shell, std::span<const double> rest_length, std::uint32_t face) {
  const auto& [a, b, c] = shell.shape->topology->faces()[face];
  const auto& edge = shell.shape->topology->face_edges()[face];  // entry k: opposite to corner k
  return {shell.position[b] - shell.position[a],
          shell.position[c] - shell.position[a],
          {rest_length[edge[2]], rest_length[edge[1]], rest_length[edge[0]]}};
}

/// Calls visit(edge, face) for three places along each edge of a mesh, with the face of the surface nearest to it.
template <class Visit>
void for_places_of_edges(const AskedSurface& surface, const Topology& topology, std::span<const Vec3d> position, Visit&& visit) {
  std::uint32_t near = 0;
  for (std::size_t e = 0; e < topology.edges().size(); ++e) {
    const Vec3d from = position[topology.edges()[e].i], along = position[topology.edges()[e].j] - from;
    for (const double part : kPointsOfEdge) {
      near = surface.nearest(from + along * part, near).face;
      visit(e, near);
    }
  }
}

/// Area of a triangle with these sides (Heron); zero where they are none.
double area_of_sides(double a, double b, double c) {
  const double s = 0.5 * (a + b + c);
  return std::sqrt(std::max(0.0, s * (s - a) * (s - b) * (s - c)));
}

double mean_of_face(const std::array<std::uint32_t, 3>& edge, std::span<const double> by_edge) {
  return (by_edge[edge[0]] + by_edge[edge[1]] + by_edge[edge[2]]) / 3.0;
}

/// Whether rest lengths, as parts of lengths, give a face a triangle at rest that is much flatter than it is; of a face that is flat itself, a small
/// difference between its edges is enough, and leaves no triangle at all.
bool is_flattened(const std::array<std::uint32_t, 3>& edge, std::span<const double> length, std::span<const double> shrink) {
  const auto side = [&](int k) { return length[edge[k]] * shrink[edge[k]]; };
  const double mean = mean_of_face(edge, shrink);
  const double alike = mean * mean * area_of_sides(length[edge[0]], length[edge[1]], length[edge[2]]);
  return area_of_sides(side(0), side(1), side(2)) < kLeastOfArea * alike;
}

/// Gives the edges of such faces their mean, until there is none; all edges of the mesh where that does not end.
void even_out(const Topology& topology, std::span<const double> length, std::vector<double>& shrink) {
  for (int pass = 0; pass < kMostPasses; ++pass) {
    bool any = false;
    for (const auto& edge : topology.face_edges()) {
      if (!is_flattened(edge, length, shrink)) continue;
      const double mean = mean_of_face(edge, shrink);
      for (const std::uint32_t e : edge) shrink[e] = mean;
      any = true;
    }
    if (!any) return;
  }
  std::ranges::fill(shrink, std::accumulate(shrink.begin(), shrink.end(), 0.0) / static_cast<double>(shrink.size()));
}

/// Distance between the middles of the two stress-free faces of an edge.
double dual_length(const ReferenceShape& shape, const Edge& edge, double length) {
  return 2.0 / 3.0 * (shape.face_area[edge.left] + shape.face_area[edge.right]) / length;
}

/// Curvature of the stress-free shape, by face: Σ θ0 l / Σ l* l over its edges.
std::vector<double> rest_curvatures(const ReferenceShape& shape) {
  const Topology& topology = *shape.topology;
  std::vector<double> out;
  for (const auto& edges : topology.face_edges()) {
    double bent = 0.0, area = 0.0;
    for (const std::uint32_t e : edges) {
      bent += shape.hinge_angle[e] * shape.edge_length[e];
      area += dual_length(shape, topology.edges()[e], shape.edge_length[e]) * shape.edge_length[e];
    }
    out.push_back(area > 0.0 ? bent / area : 0.0);
  }
  return out;
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

std::vector<double> carried_rest_lengths(const NewMesh& mesh, bool of_triangles) {
  const Topology& topology = *mesh.shape.topology;
  std::vector<double> out(topology.edges().size(), 0.0);
  for_places_of_edges(mesh.surface, topology, mesh.position, [&](std::size_t e, std::uint32_t face) {
    const Vec3d along = mesh.position[topology.edges()[e].j] - mesh.position[topology.edges()[e].i];
    out[e] += face < mesh.source_face.size() ? rest_metric(mesh.old, mesh.old.rest_length, mesh.source_face[face]).shrink(along) : 1.0;
  });
  for (double& shrink : out) shrink /= static_cast<double>(kPointsOfEdge.size());
  std::vector<double> length;
  for (const Edge& edge : topology.edges()) length.push_back(norm(mesh.position[edge.j] - mesh.position[edge.i]));
  if (of_triangles) even_out(topology, length, out);
  for (std::size_t e = 0; e < out.size(); ++e) out[e] *= length[e];
  return out;
}

std::shared_ptr<const ReferenceShape> carried_shape(const dcm::ShellRecord& old, const AskedSurface& surface,
                                                    std::shared_ptr<const Topology> topology, std::span<const Vec3d> position,
                                                    bool is_elastic) {
  auto out = std::make_shared<ReferenceShape>(*make_reference_shape(std::move(topology), {position.begin(), position.end()}));
  const Topology& mesh = *out->topology;
  const std::vector<double> old_curvature = rest_curvatures(*old.shape);
  std::vector<double> shrink(mesh.edges().size(), 0.0), curvature(mesh.edges().size(), 0.0);
  for_places_of_edges(surface, mesh, position, [&](std::size_t e, std::uint32_t face) {
    const Vec3d along = position[mesh.edges()[e].j] - position[mesh.edges()[e].i];
    if (is_elastic) shrink[e] += rest_metric(old, old.shape->edge_length, face).shrink(along);
    curvature[e] += old_curvature[face];
  });
  constexpr double kPart = 1.0 / static_cast<double>(kPointsOfEdge.size());
  auto& length = out->edge_length;
  for (std::size_t e = 0; is_elastic && e < length.size(); ++e)
    length[e] = kPart * shrink[e] * norm(position[mesh.edges()[e].j] - position[mesh.edges()[e].i]);
  double before = 0.0, after = 0.0;
  for (std::size_t f = 0; f < out->face_area.size(); ++f) {
    const auto& edge = mesh.face_edges()[f];
    if (is_elastic) out->face_area[f] = area_of_sides(length[edge[0]], length[edge[1]], length[edge[2]]);
    after += out->face_area[f];
  }
  for (const double area : old.shape->face_area) before += area;
  for (double& area : out->face_area) area *= before / after;
  for (std::size_t e = 0; e < length.size(); ++e)
    out->hinge_angle[e] = kPart * curvature[e] * dual_length(*out, mesh.edges()[e], length[e]);
  return out;
}

void carry_columns(const NewMesh& mesh, double part, dcm::ShellRecord& out) {
  dcm::for_each_shell_column([&](const auto& column) { carry(column, mesh, part, out); });
}

}  // namespace morula
