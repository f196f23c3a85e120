#include "coupling/mechanics/face_tensions.h"

#include <algorithm>

#include "coupling/mechanics/body_factors.h"

namespace morula {

FaceTensions::FaceTensions(const Model& model) : model_(model) {
  for (const CellType& type : model.types) {
    any_ = any_ || !type.regional_tension.empty();
    vary_ = vary_ || type.regional_tension.varies();
  }
}

void FaceTensions::set(const Tissue& tissue, double time) {
  if (!any_) return;
  extra_.clear();
  const dcm::Shells& shells = tissue.shells;
  const std::vector<double> deviation = deviations_of_shells(model_, tissue.cells, Trait::kTension);
  for (std::size_t s = 0; s < shells.size(); ++s) {
    const CellType& type = model_.types[shells.type[s]];
    const std::size_t faces = shells.topology(s).face_count();
    if (type.regional_tension.empty()) {
      extra_.resize(extra_.size() + faces, 0.0);
      continue;
    }
    const dcm::FaceState& face = shells.faces_of(s);
    const MarkSets marks = shells.marks_of(s);
    const double own = type.shell.tension, factor = deviation.empty() ? 1.0 : 1.0 + deviation[s];
    for (std::size_t f = 0; f < faces; ++f) {
      const double contact = face.contact.empty() ? 0.0 : static_cast<double>(face.contact[f]);
      extra_.push_back((type.regional_tension.of_face(own, marks[f], contact, time) - own) * factor);
    }
  }
}

void FaceTensions::evaluate(const World& world, Forces& out) { add_forces(world.tissue.shells, world.position(), out.force, out.energy); }

void FaceTensions::assemble(const World&, double, Assembly& out) { out.face_energy = on_top_of(out.face_energy); }

void FaceTensions::add_forces(const dcm::Shells& shells, std::span<const Vec3d> x, std::span<Vec3d> force, OrderFreeSum& energy) const {
  if (!any_) return;
  std::size_t face = 0;
  for (std::size_t s = 0; s < shells.size(); ++s) {
    const std::uint32_t first = shells.first_node[s];
    double of_shell = 0.0;
    for (const Triangle& t : shells.topology(s).faces()) {
      const double tension = extra_[face];
      if (tension != 0.0) {
        const Vec3d &x0 = x[first + t[0]], &x1 = x[first + t[1]], &x2 = x[first + t[2]];
        const Vec3d twice_area = cross(x1 - x0, x2 - x0);
        const double length = norm(twice_area);
        of_shell += 0.5 * tension * length;
        const Vec3d n = twice_area * (-0.5 * tension / length);
        const Vec3d f1 = cross(n, x0 - x2), f2 = cross(n, x1 - x0);
        force[first + t[1]] += f1;
        force[first + t[2]] += f2;
        force[first + t[0]] -= f1 + f2;
      }
      ++face;
    }
    energy.add(of_shell);
  }
}

std::span<const double> FaceTensions::on_top_of(std::span<const double> face_energy) {
  if (!any_) return face_energy;
  sum_.assign(face_energy.begin(), face_energy.end());
  for (std::size_t f = 0; f < extra_.size(); ++f) sum_[f] += extra_[f];
  return sum_;
}

}  // namespace morula
