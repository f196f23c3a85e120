#include <algorithm>

#include "coupling/mechanics/mechanics.h"
#include "coupling/mechanics/workspace.h"

namespace morula {

namespace {

/// Normal of a face times twice its area.
Vec3d twice_area(const dcm::Shells& shells, std::size_t shell, std::uint32_t face) {
  const Triangle& t = shells.topology(shell).faces()[face];
  const auto x = shells.nodes(shell);
  return cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]);
}

}  // namespace

std::vector<float> Mechanics::contact_of_faces(const Tissue& tissue, std::span<const char> with_material) {
  (void)prepare(*work_, tissue);
  const auto bodies = work_->scene.bodies();
  std::vector<float> out(work_->scene.first_face()[work_->scene.owned_shells()], 0.0f);
  for (const SurfacePair& pair : contacts().pairs()) {
    if (pair.with_itself()) continue;
    for (int d = 0; d < 2; ++d) {
      if (d == 1 && pair.rigid) break;
      const std::uint32_t number = d == 0 ? pair.a : pair.b;
      const ContactBody& source = bodies[number];
      if (!source.owned || source.shape == BodyShape::kSphere) continue;
      const bool both = !pair.rigid && bodies[d == 0 ? pair.b : pair.a].shape ==
                                           BodyShape::kSurface;  // both bodies are sources, with half of the area each
      const std::uint16_t partner = pair.rigid ? contacts().obstacles()[pair.b].material : bodies[d == 0 ? pair.b : pair.a].material;
      if (partner >= with_material.size() || !with_material[partner]) continue;
      for (const ContactElement& element : pair.present(static_cast<std::size_t>(d)))
        out[work_->scene.first_face()[number] + element.source_face()] += element.area() * (both ? 2.0f : 1.0f);
    }
  }
  for (std::size_t s = 0; s < work_->scene.owned_shells(); ++s)
    for (std::uint32_t f = work_->scene.first_face()[s]; f < work_->scene.first_face()[s + 1]; ++f)
      if (out[f] > 0.0f)
        out[f] = std::min(out[f] / static_cast<float>(0.5 * norm(twice_area(tissue.shells, s, f - work_->scene.first_face()[s]))), 1.0f);
  return out;
}

std::vector<Touch> Mechanics::touch_of_bodies(const Tissue& tissue, std::span<const char> with_material) {
  const std::vector<float> part = contact_of_faces(tissue, with_material);
  std::vector<Touch> out(work_->scene.owned_shells() + work_->scene.owned_spheres());
  for (std::size_t s = 0; s < work_->scene.owned_shells(); ++s)
    for (std::uint32_t f = work_->scene.first_face()[s]; f < work_->scene.first_face()[s + 1]; ++f) {
      const Vec3d touched = twice_area(tissue.shells, s, f - work_->scene.first_face()[s]) * (0.5 * static_cast<double>(part[f]));
      out[s].area += norm(touched);
      out[s].normal += touched;
    }
  work_->terms.spheres->for_touched_obstacles([&](std::uint32_t sphere, std::uint32_t obstacle, const Vec3d& normal, double area) {
    const std::uint16_t material = contacts().obstacles()[obstacle].material;
    if (material >= with_material.size() || !with_material[material]) return;
    Touch& touch = out[work_->scene.owned_shells() + sphere];
    touch.area += area;
    touch.normal += normal * area;
  });
  for (Touch& touch : out)
    if (norm2(touch.normal) > 0.0)
      touch.normal = normalized(touch.normal);
    else
      touch.area = 0.0;
  return out;
}

}  // namespace morula
