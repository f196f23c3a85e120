#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/contact/surface_curvature.h"
#include "core/mesh/surface_geometry.h"
#include "core/mesh/topology.h"
#include "core/mesh/triangle_tree.h"
#include "core/space/space.h"

namespace morula {

/// A smooth part of a rigid surface: faces that are joined across edges at which the surface turns by less than kSharpTurn.
struct SmoothPart {
  std::vector<std::uint32_t> face;     ///< of the whole surface, increasing
  std::unique_ptr<TriangleTree> tree;  ///< of these faces; null where the part is the whole surface
};

/// Turn of a surface from which on the two sides of an edge are two parts: a regular octagon has eight walls, a regular decagon is a curve [rad].
inline constexpr double kSharpTurn = 0.7;

/// A rigid triangulated obstacle. Its shape never changes; it may move as a whole.
struct RigidSurface {
  std::shared_ptr<const Topology> topology;
  std::vector<Vec3d> position;
  SurfaceGeometry geometry;
  std::unique_ptr<TriangleTree> tree;
  std::vector<SmoothPart> parts;                           ///< by their lowest face
  std::vector<std::uint32_t> part_of_face;                 ///< by face
  std::vector<std::array<SurfaceCurvature, 3>> curvature;  ///< of the smooth part, at the corners of each face
  std::vector<std::array<Vec3d, 3>> corner_normal;         ///< likewise
  std::uint16_t material = 0;
  bool inside = false;  ///< cells live inside it
};

/// A rigid surface, or one of its images across periodic faces.
struct SurfaceImage {
  std::uint32_t number = 0;  ///< tells the images of a surface apart; they come in the order of these
  Vec3d shift{};             ///< from where the surface itself is [µm]
};

/// Calls function(SurfaceImage) for those images of a surface that has gone `offset` whose bounds meet a box; for the surface itself always. Along a
/// periodic axis it has images where it is shorter than the domain: what is longer goes on beyond the face by itself. A surface that cells live inside has none.
template <class F>
void for_images(const RigidSurface& surface, const Vec3d& offset, const Space& space, const Box& box, F&& function) {
  constexpr std::uint32_t kItself = 512, kMost = 511;
  const Box bounds = surface.tree->bounds();
  const Vec3d period = space.box.size(), size = bounds.size();
  std::array<int, 3> first{}, last{};
  for (int axis = 0; axis < 3; ++axis) {
    if (surface.inside || !space.periodic(axis) || size[axis] >= period[axis]) continue;
    const auto whole = [](double periods) { return static_cast<int>(std::clamp(periods, -double{kMost}, double{kMost})); };
    first[axis] = std::min(0, whole(std::ceil((box.low[axis] - bounds.high[axis] - offset[axis]) / period[axis])));
    last[axis] = std::max(0, whole(std::floor((box.high[axis] - bounds.low[axis] - offset[axis]) / period[axis])));
  }
  std::array<int, 3> n{};
  for (n[0] = first[0]; n[0] <= last[0]; ++n[0])
    for (n[1] = first[1]; n[1] <= last[1]; ++n[1])
      for (n[2] = first[2]; n[2] <= last[2]; ++n[2]) {
        SurfaceImage image;
        for (int axis = 0; axis < 3; ++axis) {
          image.number = image.number << 10 | (static_cast<std::uint32_t>(n[axis] + static_cast<int>(kItself)));
          image.shift[axis] = n[axis] * period[axis];
        }
        function(image);
      }
}

/// Rigid surfaces that several contact layers look at; nobody changes them.
class RigidSurfaces {
 public:
  RigidSurfaces() = default;
  RigidSurfaces(std::vector<RigidSurface> surfaces)  // NOLINT: a list of surfaces is what it says
      : surfaces_(std::make_shared<const std::vector<RigidSurface>>(std::move(surfaces))) {}

  [[nodiscard]] std::span<const RigidSurface> all() const {
    return surfaces_ == nullptr ? std::span<const RigidSurface>() : std::span<const RigidSurface>(*surfaces_);
  }
  [[nodiscard]] std::size_t size() const { return all().size(); }
  [[nodiscard]] bool empty() const { return all().empty(); }
  const RigidSurface& operator[](std::size_t i) const { return (*surfaces_)[i]; }

 private:
  std::shared_ptr<const std::vector<RigidSurface>> surfaces_;
};

/// Finds the smooth parts of a surface that has all else, and their curvature.
void find_smooth_parts(RigidSurface& surface);

/// The parts of a surface that have faces whose bounds come as near to p as `reach` [µm], increasing.
void parts_near(const RigidSurface& surface, const Vec3d& p, double reach, std::vector<std::uint32_t>& parts);

/// Where a ball around p touches a part of a surface.
struct Foot {
  Vec3d point;            ///< the point of the part that is nearest to p
  double distance = 0.0;  ///< from p, < 0 where p lies behind the surface [µm]
  std::uint32_t face = 0;
  SurfaceCurvature curvature;
  Vec3d normal;        ///< where the part is hollow: of the smooth surface that the faces stand for
  double bulge = 0.0;  ///< where the part is hollow: how far that surface lies above the face [µm]
};

/// The foot of p on one part of a surface, if a ball around p rests there: a smooth part bears a ball at its nearest point alone, however many
/// faces it has, and the parts of a corner bear it each for itself (decision 0023). None where the part is farther than `cutoff` [µm]; where
/// a neighbouring part comes nearer from that point on (p is beyond a convex edge; of parts that share the nearest point of an edge the first has
/// it); where p sees the part from behind, unless p lies within the obstacle, whose nearest part then drives it out.
std::optional<Foot> foot_on_part(const RigidSurface& surface, std::uint32_t part, const Vec3d& p, double cutoff);

}  // namespace morula
