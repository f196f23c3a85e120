#pragma once
#include <memory>
#include <span>
#include <vector>

#include "core/mesh/renewal/surface_view.h"
#include "core/mesh/triangle_mesh.h"
#include "core/mesh/triangle_tree.h"
#include "core/result.h"

namespace morula {

/// The point of a closed surface nearest to p when one walks from face to face, beginning at `start`, as long as that brings one nearer.
/// For a point near the surface and a start near its foot that is the nearest point; among sheets that lie close together it stays on the
/// one it began on.
NearestFace walk_to_nearest(const SurfaceView& surface, const Vec3d& p, std::uint32_t start);

/// A closed surface that does not move and is asked for nearest points and normals.
class AskedSurface {
 public:
  /// Errors: those of Topology::build().
  static Result<AskedSurface> build(const TriangleMesh& mesh);
  explicit AskedSurface(std::shared_ptr<const Topology> topology, std::vector<Vec3d> position);
  /// `surface.topology` must outlive this.
  explicit AskedSurface(const SurfaceView& surface);

  [[nodiscard]] SurfaceView view() const { return {position_, topology_}; }
  [[nodiscard]] const TriangleTree& tree() const { return tree_; }
  [[nodiscard]] std::span<const Triangle> faces() const { return topology_->faces(); }
  /// Unit outward normals by face; zero for a face without area.
  [[nodiscard]] std::span<const Vec3d> normals() const { return normals_; }
  [[nodiscard]] double area() const { return area_; }

  /// The nearest point of all.
  [[nodiscard]] NearestFace nearest(const Vec3d& p) const { return *tree_.nearest(p); }
  /// The nearest point of all, found faster when `near` is a face close to it.
  [[nodiscard]] NearestFace nearest(const Vec3d& p, std::uint32_t near) const;
  [[nodiscard]] NearestFace walk(const Vec3d& p, std::uint32_t start) const { return walk_to_nearest(view(), p, start); }

 private:
  std::shared_ptr<const Topology> owned_;
  const Topology* topology_;
  std::vector<Vec3d> position_;
  TriangleTree tree_;
  std::vector<Vec3d> normals_;
  double area_ = 0.0;
};

/// A closed surface that is to get another mesh, and the surfaces around it that the new one keeps out of.
struct SurfaceAmongWalls {
  /// Topologies must outlive it. Error (kInput): the surface encloses no volume.
  static Result<SurfaceAmongWalls> of(const SurfaceView& surface, std::span<const SurfaceView> walls);

  AskedSurface surface;
  std::vector<AskedSurface> around;
  Vec3d center{};       ///< of volume of the surface [µm]
  double volume = 0.0;  ///< that it encloses [µm³]

  /// Of `around`, as long as this stays where it is.
  [[nodiscard]] std::vector<const AskedSurface*> walls() const;
};

/// A point of a surface that stands for a part of its area.
struct SurfaceSample {
  Vec3d point;             ///< [µm]
  std::uint32_t face = 0;  ///< on which it lies
  double area = 0.0;       ///< for which it stands; zero for nodes and middles of edges [µm²]
};

/// Points evenly spread over the faces of a surface: each face is parted like a triangular grid whose sides are at most `spacing` long, one
/// point in the middle of each part. With `nodes_and_edges` all nodes and the middles of all edges follow.
std::vector<SurfaceSample> sample_surface(const SurfaceView& surface, double spacing, bool nodes_and_edges);

/// How far two surfaces are from each other, by samples of both.
struct SurfaceDistance {
  double from = 0.0;  ///< largest distance of a sample of the first from the second [µm]
  double to = 0.0;    ///< largest distance of a sample of the second from the first [µm]
  double rms = 0.0;   ///< root of the mean of the squared distances over both areas [µm]
  [[nodiscard]] double largest() const { return from > to ? from : to; }
};

/// Distances between a surface and another one in both directions, at samples `spacing` apart on both and all nodes and middles of edges.
SurfaceDistance surface_distance(const AskedSurface& first, const AskedSurface& second, double spacing);

}  // namespace morula
