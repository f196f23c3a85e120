#include "coupling/behaviours/shell_division.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <type_traits>

#include "core/mesh/renewal/divide_surface.h"
#include "core/mesh/renewal/transfer_marks.h"

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

bool has_elastic_surface(const dcm::ShellParameters& shell) { return shell.spring_stiffness > 0.0 || !shell.sheets.empty(); }

/// A daughter as it comes out of the cut, with what it is made of.
struct Made {
  const dcm::ShellRecord& mother;
  const ClosedHalf& half;
  const AskedSurface& surface;  ///< of the half
  const Daughter& daughter;
  const ReferenceShape& shape;
};

/// Rest lengths of the mother's metric where the nearest point is of her surface; those of the cap are the present ones.
std::vector<double> carried_rest_lengths(const Made& made) {
  std::vector<double> out;
  const auto& x = made.daughter.position;
  std::uint32_t near = 0;
  for (const Edge& edge : made.shape.topology->edges()) {
    const Vec3d along = x[edge.j] - x[edge.i];
    double shrink = 0.0;
    for (const double part : kPointsOfEdge) {
      near = made.surface.nearest(x[edge.i] + along * part, near).face;
      shrink += near < made.half.source_face.size() ? rest_metric(made.mother, made.half.source_face[near]).shrink(along) : 1.0;
    }
    out.push_back(norm(along) * shrink / static_cast<double>(kPointsOfEdge.size()));
  }
  return out;
}

/// The mother's marks, each by itself.
std::vector<std::uint8_t> carried_marks(const Made& made, std::span<const std::uint8_t> marks) {
  const std::size_t old_faces = made.mother.shape->topology->face_count(), faces = made.shape.topology->face_count();
  const MarkSets before(marks, old_faces);
  std::vector<std::uint8_t> out(faces * before.width(), 0);
  for (int mark = 0; mark < static_cast<int>(8 * before.width()); ++mark) {
    if (!before.any_has(mark)) continue;
    std::vector<char> marked(old_faces);
    for (std::size_t f = 0; f < old_faces; ++f) marked[f] = before.has(f, mark);
    const auto carried =
        transfer_marks(made.surface, marks_of_half(made.half, marked), {made.daughter.position, made.shape.topology.get()});
    for (std::size_t f = 0; f < faces; ++f) set_mark(out, before.width(), f, mark, carried[f] != 0 && made.daughter.is_cap[f] == 0);
  }
  return out;
}

/// What the nearest face of the mother has, and faces of the cap `of_new_face`.
template <class T>
std::vector<T> carried_by_place(const Made& made, std::span<const T> before, const T& of_new_face) {
  std::vector<T> out;
  const auto& x = made.daughter.position;
  std::uint32_t near = 0;
  for (const auto& [a, b, c] : made.shape.topology->faces()) {
    near = made.surface.nearest((x[a] + x[b] + x[c]) / 3.0, near).face;
    out.push_back(near < made.half.source_face.size() ? before[made.half.source_face[near]] : of_new_face);
  }
  return out;
}

/// The mother's values of a column as its rule gives them to a daughter with this part of the volume.
template <class Column>
void carry(const Column& column, const Made& made, double part, dcm::ShellRecord& out) {
  using T = typename Column::Value;
  const std::span<const T> before = column.values(made.mother);
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
      if constexpr (Column::kDomain == Domain::kNode)
        return column.give(out, std::vector<T>(made.daughter.position.size(), mean_of(before)));
      break;
    case OnNewMesh::kByPlace:
      if constexpr (Column::kDomain == Domain::kFace) return column.give(out, carried_by_place(made, before, column.of_new_face));
      break;
    case OnNewMesh::kByCoverage:
      if constexpr (Column::kDomain == Domain::kFace && std::is_same_v<T, std::uint8_t>)
        return column.give(out, carried_marks(made, before));
      break;
  }
  assert(!"a column of this kind cannot follow this rule");
}

dcm::ShellRecord make_shell(const Made& made, const CellType& type, std::shared_ptr<const ReferenceShape> shape, double part,
                            double target) {
  dcm::ShellRecord out;
  dcm::for_each_shell_column([&](const auto& column) { carry(column, made, part, out); });
  out.position = made.daughter.position;
  out.rest_volume = target;
  const bool eases = type.new_surface > 0.0 || type.shell.turnover_rate > 0.0;
  out.rest_length = eases && has_elastic_surface(type.shell) ? carried_rest_lengths(made) : free_rest_lengths(*shape, target);
  out.shape = std::move(shape);
  return out;
}

}  // namespace

Result<std::array<dcm::ShellRecord, 2>> divide_shell(const ShellToDivide& what, const Vec3d& axis, double share,
                                                     const std::array<double, 2>& target) {
  const dcm::ShellRecord& mother = *what.shell;
  DivisionPlan plan;
  plan.normal = axis;
  plan.share = share;
  plan.shape = what.shape.get();
  plan.neighbours = what.neighbours;
  MORULA_TRY_ASSIGN(const Division division, divide_surface({mother.position, mother.shape->topology.get()}, plan));
  std::array<dcm::ShellRecord, 2> out;
  for (std::size_t k = 0; k < 2; ++k) {
    const Made made{mother, division.cut.half[k], division.asked[k], division.daughter[k], *what.shape};
    out[k] = make_shell(made, *what.type, what.shape, k == 0 ? share : 1.0 - share, target[k]);
  }
  return out;
}

double newness_of_surface(const CellRow& row, const CellType& type, double time) {
  if (!row.parent.valid() || !(type.new_surface > 0.0)) return 0.0;
  return std::clamp(1.0 - (time - row.birth_time) / type.new_surface, 0.0, 1.0);
}

void renew_surfaces(std::span<const CellType> types, const Cells& cells, dcm::Shells& shells, double time, double dt) {
  const auto renews = [](const CellType& type) {
    return type.new_surface > 0.0 && !(type.shell.turnover_rate > 0.0) && has_elastic_surface(type.shell);
  };
  if (shells.size() == 0 || std::ranges::none_of(types, renews)) return;
  for (const BodyOfRow& body : bodies_of(cells)) {
    const CellRow& row = cells.rows[body.row];
    const CellType& type = types[row.type];
    if (!body.is_shell || !renews(type)) continue;
    const double before = newness_of_surface(row, type, time - dt);
    if (!(before > 0.0)) continue;
    const double keep = newness_of_surface(row, type, time) / before;
    const std::vector<double> free = free_rest_lengths(*shells.shape[body.number], shells.rest_volume[body.number]);
    double* rest = shells.rest_length.data() + shells.first_edge[body.number];
    for (std::size_t k = 0; k < free.size(); ++k) rest[k] = free[k] + (rest[k] - free[k]) * keep;
  }
}

}  // namespace morula
