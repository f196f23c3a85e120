#include "coupling/behaviours/shell_division.h"

#include <algorithm>
#include <cmath>

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
  AskedSurface surface;  ///< of the half
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

std::vector<double> free_rest_lengths(const ReferenceShape& shape, double rest_volume) {
  std::vector<double> out(shape.edge_length);
  const double scale = std::cbrt(rest_volume);
  for (double& length : out) length *= scale;
  return out;
}

/// The mother's marks, each by itself.
std::vector<std::uint8_t> carried_marks(const Made& made) {
  const std::size_t old_faces = made.mother.shape->topology->face_count(), faces = made.shape.topology->face_count();
  const MarkSets before(made.mother.face.mark, old_faces);
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

/// The eased contact of the nearest face; faces of the cap touch the sister.
std::vector<float> carried_contact(const Made& made) {
  std::vector<float> out;
  const auto& x = made.daughter.position;
  std::uint32_t near = 0;
  for (const auto& [a, b, c] : made.shape.topology->faces()) {
    near = made.surface.nearest((x[a] + x[b] + x[c]) / 3.0, near).face;
    out.push_back(near < made.half.source_face.size() ? made.mother.face.contact[made.half.source_face[near]] : 1.0f);
  }
  return out;
}

dcm::ShellRecord make_shell(const Made& made, const CellType& type, std::shared_ptr<const ReferenceShape> shape, double part,
                            double target) {
  const dcm::ShellRecord& mother = made.mother;
  dcm::ShellRecord out;
  out.type = mother.type;
  out.position = made.daughter.position;
  Vec3f mean;
  for (const Vec3f& v : mother.velocity) mean += v;
  out.velocity.assign(out.position.size(), mean * (1.0f / static_cast<float>(mother.velocity.size())));
  out.reference_volume = part * mother.reference_volume;
  out.rest_volume = target;
  const bool eases = type.new_surface > 0.0 || type.shell.turnover_rate > 0.0;
  out.rest_length = eases && has_elastic_surface(type.shell) ? carried_rest_lengths(made) : free_rest_lengths(*shape, target);
  if (!mother.face.mark.empty()) out.face.mark = carried_marks(made);
  if (!mother.face.contact.empty()) out.face.contact = carried_contact(made);
  out.shape = std::move(shape);
  return out;
}

}  // namespace

Result<ShellDaughters> divide_shell(const ShellToDivide& what, const Vec3d& axis, double share, const std::array<double, 2>& target) {
  const dcm::ShellRecord& mother = *what.shell;
  DivisionPlan plan;
  plan.normal = axis;
  plan.share = share;
  plan.shape = what.shape.get();
  plan.neighbours = what.neighbours;
  MORULA_TRY_ASSIGN(const Division division, divide_surface({mother.position, mother.shape->topology.get()}, plan));
  ShellDaughters out;
  for (std::size_t k = 0; k < 2; ++k) {
    const ClosedHalf& half = division.cut.half[k];
    MORULA_TRY_ASSIGN(AskedSurface surface, AskedSurface::build(half.mesh));
    const Made made{mother, half, std::move(surface), division.daughter[k], *what.shape};
    out.shell[k] = make_shell(made, *what.type, what.shape, k == 0 ? share : 1.0 - share, target[k]);
  }
  return out;
}

double newness_of_surface(const CellRow& row, const CellType& type, double time) {
  if (!row.parent.valid() || !(type.new_surface > 0.0)) return 0.0;
  return std::clamp(1.0 - (time - row.birth_time) / type.new_surface, 0.0, 1.0);
}

void renew_surfaces(std::span<const CellType> types, const Cells& cells, dcm::Shells& shells, double time, double dt) {
  for (const BodyOfRow& body : bodies_of(cells)) {
    const CellRow& row = cells.rows[body.row];
    const CellType& type = types[row.type];
    if (!body.is_shell || type.shell.turnover_rate > 0.0 || !has_elastic_surface(type.shell)) continue;
    const double before = newness_of_surface(row, type, time - dt);
    if (!(before > 0.0)) continue;
    const double keep = newness_of_surface(row, type, time) / before;
    const std::vector<double> free = free_rest_lengths(*shells.shape[body.number], shells.rest_volume[body.number]);
    double* rest = shells.rest_length.data() + shells.first_edge[body.number];
    for (std::size_t k = 0; k < free.size(); ++k) rest[k] = free[k] + (rest[k] - free[k]) * keep;
  }
}

}  // namespace morula
