#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "core/mesh/renewal/asked_surface.h"
#include "core/mesh/renewal/live_mesh.h"

namespace morula {

/// Why a change of a mesh was not made.
enum class ChangeRefusal : std::uint8_t {
  kNone,
  kShape,     ///< a face would be nearly a line
  kFold,      ///< the surface would be bent too sharply, or turned over
  kCrossing,  ///< the surface would cross itself
  kDistance,  ///< it would leave the surface that it stands for
  kOverlap,   ///< it would go deeper into a neighbour
  kArea,      ///< the area would change by more than is left for this pass
};
inline constexpr std::size_t kChangeRefusals = 7;

/// What changes of a mesh may do to it.
struct ChangeLimits {
  double edge = 0.0;           ///< the length that edges are to have [µm]
  double least_quality = 0.3;  ///< of a face that comes, unless one that goes was worse
  double most_bend = 1.2;      ///< between faces, unless those that go were bent more [rad]
  double off_surface = 0.02;   ///< of a node, beyond the chord error, in edges
  double deeper = 1e-3;        ///< into a neighbour, in edges
  double area_change = 1e-4;   ///< of all changes together, of the area, either way
};

/// Judges changes of a mesh against the surface that it stood for at first and the neighbours of that. The chord error, which a mesh with such edges has
/// anyhow where it is bent by θ from face to face, is edge · θ / 8.
class ChangeGuard {
 public:
  /// `surface` and `walls` must outlive this; the order of walls does not matter.
  ChangeGuard(const AskedSurface& surface, std::span<const AskedSurface* const> walls, const ChangeLimits& limits)
      : surface_(surface), walls_(walls), limits_(limits) {}

  /// What is against a change; kNone: nothing is.
  [[nodiscard]] ChangeRefusal judge(const LiveMesh& mesh, const MeshChange& change);
  /// A change that was judged last has been made.
  void made() { area_change_ += change_of_area_; }
  /// The area has been given back but for this [µm²].
  void area_returned(double left) { area_change_ = left; }
  /// Sum over what has been made [µm²].
  [[nodiscard]] double area_change() const { return area_change_; }

 private:
  struct Patch;
  [[nodiscard]] bool crosses(const LiveMesh& mesh, const MeshChange& change, const Patch& patch) const;
  [[nodiscard]] bool leaves_surface(const LiveMesh& mesh, const MeshChange& change, const Patch& patch) const;
  [[nodiscard]] bool goes_deeper(const Patch& patch) const;
  [[nodiscard]] double depth_at(const Vec3d& p, double reach) const;

  const AskedSurface& surface_;
  std::span<const AskedSurface* const> walls_;
  ChangeLimits limits_;
  double area_change_ = 0.0, change_of_area_ = 0.0;
};

}  // namespace morula
