#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/mark_sets.h"
#include "core/mesh/topology.h"
#include "coupling/model.h"
#include "coupling/tissue.h"

namespace morula {

/// Nodes of a stress-free shape at an end of an axis: the part of them with the largest coordinate along it, and all that tie with the last
/// of them (to 1e-9 of the cell's size), so that a symmetric mesh has symmetric ends. Increasing. The set follows from the shape alone:
/// it is the same on every rank and after every restart, and nothing of it is stored.
///
/// axis: of length 1, in the frame of the reference shape, which is that of the laboratory for cells placed with `orientation: aligned`.
/// part: of all nodes, 0 to 1; at least one node is taken.
std::vector<std::uint32_t> end_nodes(const ReferenceShape& shape, const Vec3d& axis, double part);

/// Whether a point lies in the cylinder that bounds a pressure.
bool lies_within(const CellLoad& load, const Vec3d& point);

/// Forces of a load on the nodes of one shell at present positions, added to `force` [nN]; nothing where it acts on whole cells or holds nodes.
/// Directions and areas are those of `position`: a step that is given these forces holds them as dead loads.
/// marks: of the shell's faces (Shells::faces_of()); empty: none.
void add_shell_load(const CellLoad& load, const ReferenceShape& shape, std::span<const Vec3d> position, const MarkSets& marks,
                    double strength, std::span<Vec3d> force);

/// The forces of the model on one whole cell of a type at a time [nN]; Mechanics::spread() puts them on its nodes.
Vec3d body_force(const Model& model, std::uint16_t type, double time);

/// Whether a load follows the surface of a cell within a step (Load::energy).
bool follows_surface(const CellLoad& load);

enum class LoadsThat : std::uint8_t { kAll, kDoNotFollow };

/// The loads of the model on surfaces at a time on all shells of the rank, added to `external` (by shell node, as in Mechanics::step) [nN].
void add_surface_loads(const Model& model, const Tissue& tissue, double time, LoadsThat which, std::span<Vec3d> external);

/// The first corner of the course of the box, of any load, obstacle, region of tension or cavity after a time [s]; infinity when none is left.
double next_corner(const Model& model, double time);

/// Longest step [s] in which no force on whole cells changes by more than a fortieth of the larger of its values now and `until` [s], which is no later than the
/// next corner of any course; infinity where none changes. A step has the force of its end, and a free cell goes that much too far in a ramp.
double longest_step_of_forces(const Model& model, double time, double until);

}  // namespace morula
