#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/contact/contact_body.h"
#include "core/friction/float4.h"
#include "core/mesh/surface_geometry.h"
#include "core/parallel/comm.h"
#include "coupling/tissue.h"

namespace morula {

/// The bodies that a rank sees during mechanics: its own and read-only ghosts of the neighbours' that may touch them.
///
/// Bodies and points come in this order: owned shells, ghost shells, owned spheres, ghost spheres. After all of them come the nuclei of owned
/// shells, the rigid ones and then the nodes of those that are shells: points that are no bodies, since nothing but their own cell touches them.
/// A workspace: rebuilt from the Tissue.
class Scene {
 public:
  /// Collect owned bodies and exchange ghosts: every body within `reach` of another rank's bodies goes there. Collective.
  void build(const Tissue& tissue, const Space& space, double reach, ShapeLibrary& shapes, const Comm& comm);

  [[nodiscard]] std::span<const ContactBody> bodies() const { return bodies_; }
  [[nodiscard]] std::size_t owned_shells() const { return owned_shells_; }
  [[nodiscard]] std::size_t shells() const { return shells_; }  ///< with ghosts
  [[nodiscard]] std::size_t owned_spheres() const { return owned_spheres_; }
  [[nodiscard]] std::size_t first_sphere() const { return shells_; }  ///< body number
  [[nodiscard]] std::size_t ghost_count() const { return bodies_.size() - owned_shells_ - owned_spheres_; }
  [[nodiscard]] std::uint32_t owned_nodes() const { return owned_nodes_; }   ///< of owned shells: points 0 .. owned_nodes−1
  [[nodiscard]] std::uint32_t sphere_point() const { return shell_nodes_; }  ///< first point of the owned spheres
  [[nodiscard]] std::size_t point_count() const { return position_.size(); }
  [[nodiscard]] std::uint32_t nucleus_point() const { return nucleus_point_; }  ///< first of the nuclei: all points before are of bodies
  [[nodiscard]] std::uint32_t nuclear_node() const { return nuclear_node_; }    ///< first of the nodes of nuclei that are shells
  [[nodiscard]] std::size_t face_count() const { return face_count_; }
  [[nodiscard]] std::span<const std::shared_ptr<const ReferenceShape>> shapes() const { return shapes_; }  ///< of shells, ghosts too
  [[nodiscard]] std::span<const Topology* const> topologies() const { return topologies_; }                ///< of shells, ghosts too
  [[nodiscard]] std::span<const std::uint32_t> first_node() const { return first_node_; }
  [[nodiscard]] std::span<const std::uint32_t> first_face() const { return first_face_; }

  struct Birth {
    double radius = 0.0;  ///< [µm]
    double time = 0.0;    ///< [s]
  };
  /// Births of the spheres, ghosts too: sisters push each other apart slowly.
  [[nodiscard]] std::vector<Birth> sphere_births(const Tissue& tissue) const;

  /// Sets of marks by face, ghosts too; empty until take_marks().
  [[nodiscard]] std::span<const std::uint8_t> marks() const { return mark_; }
  /// Whether the marks of owned shells are others than at the last take_marks(), or bodies have changed since.
  [[nodiscard]] bool marks_differ(const Tissue& tissue) const;
  /// Marks of owned shells from the tissue, and of ghosts from their owners. Collective.
  void take_marks(const Tissue& tissue);

  std::vector<Vec3d>& position() { return position_; }
  [[nodiscard]] const std::vector<Vec3d>& position() const { return position_; }

  /// Refresh ghost entries of a vector over points from their owners. Collective.
  void exchange(std::span<Vec3d> by_point) const;
  void exchange(std::span<Float4> by_point) const;
  /// The same of one number by body.
  void exchange_bodies(std::span<std::uint64_t> by_body) const;

  /// Hold all bodies in place but those with moves[body] != 0 (of owned ones; ghosts follow their owner); an empty list lets all move. Collective.
  void set_moving(std::span<const char> moves);

  /// Copy owned positions from / to the tissue.
  void take_positions(const Tissue& tissue);
  /// Radii of owned spheres from the tissue, and of ghosts from their owners. Collective.
  void take_radii(const Tissue& tissue);
  void give_positions(Tissue& tissue) const;

  /// Bytes of this workspace.
  [[nodiscard]] std::size_t memory() const;

 private:
  void add_owned(const Tissue& tissue);
  void find_ghosts(const Tissue& tissue, const Space& space, double reach, ShapeLibrary& library, const Comm& comm);
  void place_bodies(std::span<const std::uint64_t> order);
  template <class T>
  void exchange_points(std::span<T> by_point) const;
  /// part_of(body): what goes from a body to its ghosts.
  template <class T, class PartOf>
  void exchange_parts(const PartOf& part_of) const;

  const Comm* comm_ = nullptr;
  std::vector<ContactBody> bodies_;
  std::vector<Birth> ghost_birth_;  ///< of ghost spheres
  std::size_t owned_shells_ = 0, shells_ = 0, owned_spheres_ = 0, face_count_ = 0;
  std::uint32_t owned_nodes_ = 0, shell_nodes_ = 0, nucleus_point_ = 0, nuclear_node_ = 0;
  std::vector<std::shared_ptr<const ReferenceShape>> shapes_;
  std::vector<const Topology*> topologies_;
  std::vector<std::uint32_t> first_node_, first_face_;
  std::vector<Vec3d> position_;
  std::vector<std::uint8_t> mark_;
  std::vector<std::vector<std::uint32_t>> send_bodies_;     ///< by rank: owned bodies that go there
  std::vector<std::vector<std::uint32_t>> receive_bodies_;  ///< by rank: ghosts that come from there, in the sender's order
};

}  // namespace morula
