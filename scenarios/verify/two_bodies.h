#pragma once
#include <memory>
#include <vector>

#include "core/contact/contact_layer.h"
#include "core/mesh/surface_geometry.h"
#include "core/mesh/triangle_mesh.h"

namespace morula::scenarios {

/// Two bodies of one mesh with flat ends, the second above the first, in a contact layer of their own.
class TwoBodies {
 public:
  /// `height`: of the mesh along z; `aside`: how far the upper one is moved. The range of the contact ends before the points on the sides of the mesh.
  TwoBodies(const TriangleMesh& mesh, double height, double gap, const ContactMaterial& material, bool objective = false,
            const Vec3d& aside = {});
  TwoBodies(const TwoBodies&) = delete;
  TwoBodies& operator=(const TwoBodies&) = delete;

  /// Force on the upper body [nN].
  [[nodiscard]] Vec3d force() const;
  /// Area in contact, mean of both bodies [µm²].
  [[nodiscard]] double area() const { return area_; }
  /// Γ d for a way d of all nodes, and dᵀΓ d.
  struct Drag {
    std::vector<Vec3d> force;
    double dissipation = 0.0;
  };
  [[nodiscard]] Drag drag(const std::vector<Vec3d>& way);
  /// The same way for all nodes of the lower or of the upper body, none for the other.
  [[nodiscard]] std::vector<Vec3d> slide(bool upper, const Vec3d& way) const;
  [[nodiscard]] const std::vector<Vec3d>& position() const { return position_; }

 private:
  [[nodiscard]] ContactScene scene(const std::vector<Vec3d>& position) const;

  std::shared_ptr<const Topology> topology_;
  const Topology* topologies_[2] = {};
  std::uint32_t first_face_[3] = {};
  std::vector<ContactBody> bodies_;
  std::vector<Vec3d> position_;
  SurfaceGeometry geometry_;
  ContactLayer layer_;
  ContactGradient gradient_;
  double area_ = 0.0;
};

}  // namespace morula::scenarios
