#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/contact/body_changes.h"
#include "core/contact/contact_body.h"
#include "core/friction/float4.h"
#include "core/mesh/mark_sets.h"
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
  /// The same where most bodies are those of the present scene: tells which have come and gone since. Nothing where too many have, or where bodies
  /// that stay come in another order. Collective.
  std::optional<BodyChanges> renew(const Tissue& tissue, const Space& space, double reach, ShapeLibrary& shapes, const Comm& comm);

  [[nodiscard]] std::span<const ContactBody> bodies() const { return bodies_; }
  [[nodiscard]] std::size_t owned_shells() const { return count_.owned_shells; }
  [[nodiscard]] std::size_t shells() const { return count_.shells; }  ///< with ghosts
  [[nodiscard]] std::size_t owned_spheres() const { return count_.owned_spheres; }
  [[nodiscard]] std::size_t first_sphere() const { return count_.shells; }  ///< body number
  [[nodiscard]] std::size_t ghost_count() const { return bodies_.size() - count_.owned_shells - count_.owned_spheres; }
  [[nodiscard]] std::uint32_t owned_nodes() const { return count_.owned_nodes; }   ///< of owned shells: points 0 .. owned_nodes−1
  [[nodiscard]] std::uint32_t sphere_point() const { return count_.shell_nodes; }  ///< first point of the owned spheres
  [[nodiscard]] std::size_t point_count() const { return points_.x.size(); }
  [[nodiscard]] std::uint32_t nucleus_point() const {
    return count_.nucleus_point;
  }  ///< first of the nuclei: all points before are of bodies
  [[nodiscard]] std::uint32_t nuclear_node() const { return count_.nuclear_node; }  ///< first of the nodes of nuclei that are shells
  [[nodiscard]] std::size_t face_count() const { return count_.faces; }
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
  /// The same of a few of them, by increasing number.
  [[nodiscard]] std::vector<Birth> sphere_births(const Tissue& tissue, std::span<const std::uint32_t> spheres) const;

  /// Sets of marks by face, ghosts too; empty until take_marks().
  [[nodiscard]] MarkSets marks() const { return {mark_, count_.faces}; }
  /// Whether the marks of owned shells are others than at the last take_marks(), or bodies have changed since.
  [[nodiscard]] bool marks_differ(const Tissue& tissue) const;
  /// Marks of owned shells from the tissue, and of ghosts from their owners; a face has this many bytes. Collective.
  void take_marks(const Tissue& tissue, std::size_t width);

  /// Points within an owned shell that are no body: a rigid nucleus, or the nodes of one that is a shell.
  struct Inner {
    std::uint32_t first_point, point_count, shell;
  };
  /// All of them, by point.
  [[nodiscard]] std::span<const Inner> inner() const { return inner_; }

  [[nodiscard]] const std::vector<Vec3d>& position() const { return points_.x; }
  /// A number that no other positions of this scene had: what was found at some positions holds as long as their number is the same.
  [[nodiscard]] std::uint64_t positions_number() const { return points_.number; }
  /// Other positions of owned points: function(span of all positions).
  template <class F>
  void move_points(F&& function) {
    ++points_.number;
    function(std::span(points_.x));
  }
  /// Positions of ghosts from their owners. Collective.
  void renew_ghost_positions() { exchange(std::span(points_.x)); }

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
  /// Gives the places along the curve, by body.
  std::vector<std::uint64_t> add_owned(const Tissue& tissue);
  [[nodiscard]] static Birth birth_of(const CellRow& row);
  /// Several ranks: bodies and shapes of ghosts come in beside the owned ones. Gives the places along the curve, by body.
  std::vector<std::uint64_t> find_ghosts(const Tissue& tissue, const Space& space, double reach, ShapeLibrary& library, const Comm& comm);
  /// What owned bodies are announced with. `rows`: the cells by owned body.
  [[nodiscard]] std::vector<std::byte> pack_ghosts(std::span<const std::uint32_t> bodies, std::span<const CellRow* const> rows) const;
  /// Tells every rank of the bodies that it may touch; gives what the others tell.
  Mail send_to_neighbours(const Tissue& tissue, const Space& space, double reach, std::span<const CellRow* const> rows, const Comm& comm);
  void place_bodies(std::span<const std::uint64_t> order);
  template <class T>
  void exchange_points(std::span<T> by_point) const;
  /// One value by body.
  template <class T>
  void exchange_values(std::span<T> by_body) const;
  /// part_of(body): what goes from a body to its ghosts. One message to and one from each neighbour.
  template <class PartOf>
  void exchange_parts(const PartOf& part_of) const;

  /// How many there are of what.
  struct Counts {
    std::size_t owned_shells = 0, shells = 0, owned_spheres = 0, faces = 0;
    std::uint32_t owned_nodes = 0, shell_nodes = 0;     ///< of owned shells, and of all
    std::uint32_t nucleus_point = 0, nuclear_node = 0;  ///< first points of the rigid nuclei, and of those that are shells
  };
  /// A rank that has ghosts of this rank's bodies, or whose bodies have ghosts here.
  struct Neighbour {
    std::vector<std::uint32_t> send;     ///< owned bodies that have ghosts there
    std::vector<std::uint32_t> receive;  ///< ghosts here of that rank's bodies, in the order in which it sends them
  };
  /// What goes to other ranks and comes from there.
  struct Ghosts {
    std::vector<Birth> birth;             ///< of ghost spheres
    std::map<int, Neighbour> neighbours;  ///< by rank
  };
  /// Rooms for messages, kept from one exchange to the next.
  struct MessageRooms {
    std::vector<std::byte> sent, received;
    std::vector<Sending> sendings;
    std::vector<Receiving> receivings;
  };
  struct Points {
    std::vector<Vec3d> x;
    std::uint64_t number = 0;  ///< of these positions
  };

  const Comm* comm_ = nullptr;
  std::vector<ContactBody> bodies_;
  std::vector<Inner> inner_;
  Counts count_;
  std::vector<std::shared_ptr<const ReferenceShape>> shapes_;
  std::vector<const Topology*> topologies_;
  std::vector<std::uint32_t> first_node_, first_face_;
  Points points_;
  std::vector<std::uint8_t> mark_;
  Ghosts ghosts_;
  mutable MessageRooms rooms_;  ///< says nothing about the scene
};

}  // namespace morula
