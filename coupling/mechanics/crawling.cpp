#include <numbers>

#include "coupling/mechanics/mechanics.h"
#include "coupling/mechanics/workspace.h"

namespace morula {
namespace {

/// What is left of v along a surface.
Vec3d along(const Vec3d& v, const Vec3d& normal) { return v - normal * dot(normal, v); }

}  // namespace

void Mechanics::add_crawling(const Tissue& tissue, std::span<const Vec3d> velocity, std::span<Vec3d> external) {
  (void)prepare_step(*work_, tissue);
  const std::vector<SymMat3<double>> blocks = work_->terms.node_friction->at(tissue, work_->geometry.now());
  const std::size_t shells = work_->scene.owned_shells();
  for (std::size_t k = 0; k < shells; ++k) {
    const Vec3d& v = velocity[k];
    if (norm2(v) == 0.0) continue;
    const double medium = shell_materials().of(tissue.shells, k).medium_friction;
    const ContactBody& body = work_->scene.bodies()[k];
    for (std::uint32_t i = body.first_point; i < body.first_point + body.point_count; ++i) {
      external[i] += v * (medium * work_->geometry.now().node_area[i]);
      if (!blocks.empty()) external[i] += blocks[i] * v;
    }
  }
  const FaceQuadrature& quadrature = FaceQuadrature::with_points(contacts().settings().points_per_face);
  for (const SurfacePair& pair : contacts().pairs()) {
    const ContactBody& body = work_->scene.bodies()[pair.a];
    if (!pair.rigid || pair.a >= shells || norm2(velocity[pair.a]) == 0.0) continue;
    const double friction = contacts().friction_of(work_->scene.bodies(), pair).tangential;
    for (const ContactElement& e : pair.present(0)) {
      const Vec3d f = along(velocity[pair.a], e.normal<double>()) * (static_cast<double>(e.area()) * friction);
      const Triangle& face = work_->scene.topologies()[pair.a]->faces()[e.source_face()];
      for (std::size_t c = 0; c < 3; ++c) external[body.first_point + face[c]] += f * quadrature.weight[e.point()][c];
    }
  }
  const std::span<Vec3d> on_spheres = external.subspan(work_->scene.owned_nodes());
  for (std::size_t i = 0; i < work_->scene.owned_spheres(); ++i) {
    const double r = tissue.spheres.radius[i];
    on_spheres[i] +=
        velocity[shells + i] * (work_->setting.model.types[tissue.spheres.type[i]].medium_friction * 4.0 * std::numbers::pi * r * r);
  }
  for (const RigidPairElement& e : work_->terms.spheres->pairs().rigid)
    on_spheres[e.sphere] += along(velocity[shells + e.sphere], {e.n[0], e.n[1], e.n[2]}) * static_cast<double>(e.isotropic);
}

}  // namespace morula
