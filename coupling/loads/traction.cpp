#include "coupling/loads/load_keys.h"
#include "coupling/loads/surface.h"

namespace morula {
namespace {

void push(const CellLoad& load, const LoadedShell& shell, std::span<Vec3d> force) {
  const Topology& topology = *shell.shape.topology;
  const std::span<const Vec3d> x = shell.position;
  const double peak = load.size * shell.strength;
  const Vec3d center = volume_centroid(topology.faces(), x);
  for_faces(topology, x, [&](const Triangle& t, const Vec3d& area) {
    const Vec3d from = face_middle(t, x) - center;
    const double along = dot(from, load.axis);
    add_to_corners(t, area * (peak * along * along / norm2(from)), force);
  });
}

}  // namespace

std::shared_ptr<const Load> traction_load() {
  using keys::Kind;
  static const auto load =
      std::make_shared<const Load>(Load{
          .info = {.name = "traction",
                   .title = "Stress of two opposed beams (optical stretcher)",
                   .equation = "F_T = s0 cos²θ A_T n_T, θ between the axis and the way from the cell's centroid to the face's",
                   .source = "Guck et al. 2001, doi:10.1016/S0006-3495(01)75740-2",
                   .parameters = {given_by_study("peak", "pressure", "kPa", "Peak stress s0, on the axis.")}},
          .section = {.name = "traction",
                      .doc = "Traction s0 cos^2(theta) along the outward normal, theta from the axis through the cell's centre: an optical "
                             "stretcher.",
                      .example = "{peak: 1 Pa, axis: [1, 0, 0]}"},
          .keys = {keys::required(Kind::kQuantity, "peak", "s0, the traction on the axis.", Quantity::kPressure, "1 Pa"),
                   keys::load_axis("Axis of the beams.")},
          .build =
              [](const OwnValues& values, CellLoad& out) {
                out.size = values("peak");
                out.axis = values.vector("axis");
              },
          .push = &push});
  return load;
}

}  // namespace morula
