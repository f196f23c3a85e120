#include "coupling/face_marks.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace morula {
namespace {

Vec3d face_center(const Triangle& t, std::span<const Vec3d> x) { return (x[t[0]] + x[t[1]] + x[t[2]]) * (1.0 / 3.0); }

/// The axis of a cone or band for one cell; zero where there is none.
Vec3d axis_of(const FaceMark& rule, const Space& space, const Vec3d& centroid, const Vec3d& polarity) {
  Vec3d axis = rule.axis;
  if (rule.axis_from == FaceMark::Axis::kPolarity) axis = polarity;
  if (rule.axis_from == FaceMark::Axis::kTowardPoint) axis = space.nearest_image(rule.center - centroid);
  const double length = norm(axis);
  return length > 0.0 ? axis * (1.0 / length) : Vec3d{};
}

/// Gives the mark of a rule to these faces and, unless what is marked stays so, takes it from all others.
void give_mark(std::vector<std::uint8_t>& marks, int mark, const std::vector<char>& faces, bool keep) {
  const std::size_t width = marks.size() / faces.size();
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (faces[f] != 0 || !keep) set_mark(marks, width, f, mark, faces[f] != 0);
}

/// function(type, shell number, row number) for the rows with a shell.
template <class F>
void for_shells(const Tissue& tissue, F&& function) {
  for (const BodyOfRow& body : bodies_of(tissue.cells))
    if (body.is_shell) function(tissue.cells.rows[body.row].type, body.number, body.row);
}

bool type_has_marks(const Model& model, std::uint16_t type) {
  if (!model.lumens.empty()) return true;
  return std::any_of(model.marks.begin(), model.marks.end(), [type](const FaceMark& rule) { return rule.type == type; });
}

}  // namespace

std::vector<char> faces_by_place(const FaceMark& rule, const Space& space, const Topology& topology, std::span<const Vec3d> x,
                                 const Vec3d& polarity) {
  std::vector<char> out(topology.face_count(), 0);
  const Vec3d centroid = volume_centroid(topology.faces(), x);
  const Vec3d axis = axis_of(rule, space, centroid, polarity);
  const double cosine = std::cos(rule.angle);
  for (std::size_t f = 0; f < out.size(); ++f) {
    const Vec3d at = face_center(topology.faces()[f], x), from = at - centroid;
    switch (rule.rule) {
      case FaceMark::Rule::kCone:
        out[f] = norm2(axis) > 0.0 && dot(from, axis) > cosine * norm(from);
        break;
      case FaceMark::Rule::kBand:
        out[f] = norm2(axis) > 0.0 && std::abs(dot(from, axis)) < rule.half_width;
        break;
      case FaceMark::Rule::kBall:
        out[f] = norm2(space.nearest_image(at - rule.center)) < rule.radius * rule.radius;
        break;
      case FaceMark::Rule::kBox: {
        const Vec3d off = space.nearest_image(at - rule.center);
        out[f] = std::abs(off.x) < 0.5 * rule.size.x && std::abs(off.y) < 0.5 * rule.size.y && std::abs(off.z) < 0.5 * rule.size.z;
        break;
      }
      case FaceMark::Rule::kTouched:
        break;
    }
  }
  return out;
}

void mark_new_shells(const Model& model, Tissue& tissue) {
  if (model.marks.empty() && model.lumens.empty()) return;
  for_shells(tissue, [&](std::uint16_t type, std::size_t shell, std::size_t i) {
    if (!type_has_marks(model, type) || !tissue.shells.faces_of(shell).mark.empty()) return;
    const Topology& topology = tissue.shells.topology(shell);
    std::vector<std::uint8_t>& mark = tissue.shells.faces_of(shell).mark;
    mark.assign(topology.face_count() * mark_bytes(model.mark_names.size()), 0);
    for (const FaceMark& rule : model.marks) {
      if (rule.type != type) continue;
      const auto faces =
          faces_by_place(rule, model.space, topology, std::as_const(tissue.shells).nodes(shell), tissue.cells.optional.polarity[i]);
      give_mark(mark, rule.mark, faces, true);
    }
  });
}

bool has_marks_that_follow(const Model& model) {
  return std::any_of(model.marks.begin(), model.marks.end(), [](const FaceMark& rule) { return rule.always; });
}

void renew_marks(const Model& model, Tissue& tissue, std::span<const std::vector<char>> touched) {
  std::size_t first_face = 0;
  for_shells(tissue, [&](std::uint16_t type, std::size_t shell, std::size_t i) {
    const Topology& topology = tissue.shells.topology(shell);
    const std::size_t begin = first_face;
    first_face += topology.face_count();
    if (!type_has_marks(model, type)) return;
    std::vector<std::uint8_t>& mark = tissue.shells.faces_of(shell).mark;
    std::set<int> cleared;  // of several rules for one mark the first clears, and all add
    for (std::size_t r = 0; r < model.marks.size(); ++r) {
      const FaceMark& rule = model.marks[r];
      if (rule.type != type || !rule.always) continue;
      std::vector<char> faces;
      if (rule.rule == FaceMark::Rule::kTouched)
        faces.assign(touched[r].begin() + static_cast<std::ptrdiff_t>(begin),
                     touched[r].begin() + static_cast<std::ptrdiff_t>(begin + topology.face_count()));
      else
        faces = faces_by_place(rule, model.space, topology, std::as_const(tissue.shells).nodes(shell), tissue.cells.optional.polarity[i]);
      give_mark(mark, rule.mark, faces, !cleared.insert(rule.mark).second || rule.keep);
    }
  });
}

void ease_contact(const Model& model, Tissue& tissue, std::span<const float> now, double dt) {
  std::size_t first_face = 0;
  for_shells(tissue, [&](std::uint16_t type, std::size_t shell, std::size_t) {
    const std::size_t count = tissue.shells.topology(shell).face_count(), begin = first_face;
    first_face += count;
    const RegionalTension& tension = model.types[type].regional_tension;
    if (!tension.eases_contact()) return;
    std::vector<float>& contact = tissue.shells.faces_of(shell).contact;
    contact.resize(count, 0.0f);
    const auto gain = static_cast<float>(-std::expm1(-dt / tension.easing));
    for (std::size_t f = 0; f < count; ++f) contact[f] += gain * (now[begin + f] - contact[f]);
  });
}

double marked_area(const Topology& topology, std::span<const Vec3d> x, const MarkSets& marks, int mark) {
  double out = 0.0;
  for (std::size_t f = 0; f < marks.size(); ++f) {
    const Triangle& t = topology.faces()[f];
    if (marks.has(f, mark)) out += 0.5 * norm(cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]));
  }
  return out;
}

std::vector<double> marked_node_areas(const dcm::Shells& shells, int mark) {
  std::vector<double> out(shells.node_count(), 0.0);
  for (std::size_t s = 0; s < shells.size(); ++s) {
    const MarkSets marks = shells.marks_of(s);
    if (marks.empty()) continue;
    const auto x = shells.nodes(s);
    const auto faces = shells.topology(s).faces();
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (!marks.has(f, mark)) continue;
      const Triangle& t = faces[f];
      const double third = norm(cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]])) / 6.0;
      for (const std::uint32_t node : t) out[shells.first_node[s] + node] += third;
    }
  }
  return out;
}

}  // namespace morula
