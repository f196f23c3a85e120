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

/// Forces of a load on the nodes of one shell at present positions, at full strength (course 1), added to `force` [nN].
///
/// - traction: s0 cos²θ along the outward normal of every face, θ the angle between the axis and the way from the cell's centroid to the
///   face's (optical stretcher: Guck et al. 2001, doi:10.1016/S0006-3495(01)75740-2);
/// - pull: the force, in equal parts, on the end nodes: along the axis at the high end, against it at the low end;
/// - patch: a force of any direction, in equal parts on the nodes of one end (a single one where `part` is that small), or by area on the
///   faces with its mark; none while no face has it;
/// - pressure: p A_T against the outward normal of every face whose three nodes are chosen (all of the cell, or an end of it) or that has the
///   load's mark and, where the load is `within` a cylinder, whose middle lies in it (suction in a pipette). p at the face's middle, where it
///   has a gradient.
///
/// A body force acts on the whole cell, a grip is a spring (coupling/grips.h): both add nothing here.
/// Directions and areas are those of `position`: a step that is given these forces holds them as dead loads.
/// marks: of the shell's faces (Shells::faces_of()); empty: none.
void add_shell_load(const CellLoad& load, const ReferenceShape& shape, std::span<const Vec3d> position, const MarkSets& marks,
                    double strength, std::span<Vec3d> force);

/// The body forces of the model on one cell of a type at a time [nN]; Mechanics::spread() puts them on its nodes.
Vec3d body_force(const Model& model, std::uint16_t type, double time);

/// The other loads of the model at a time on all shells of the rank, added to `external` (by shell node, as in Mechanics::step) [nN].
void add_surface_loads(const Model& model, const Tissue& tissue, double time, std::span<Vec3d> external);

/// The first corner of the course of any load, obstacle, region of tension or cavity after a time [s]; infinity when none is left.
double next_corner(const Model& model, double time);

}  // namespace morula
