#pragma once
#include <span>
#include <vector>

#include "core/mesh/renewal/asked_surface.h"
#include "core/mesh/renewal/disk_map.h"

namespace morula {

/// Move the nodes of a mesh along a surface until its faces are even: node by node, downhill in Σ f² over the faces around the node with
///
/// f = (1/q) (1 − θ + θ (A/A0 + A0/A) / 2),  1/q = Σl² / (4√3 A),
///
/// where A0 is the mean face area and A the area of the face as seen along the surface's normals at its nodes, replaced by ½ (A + √(A² +
/// (0.03 A0)²)), so that faces that are turned over cost much but not infinitely much. A step lies in the tangent plane, is put back to the
/// surface by the nearest point, and is halved until the sum goes down. At most `sweeps` rounds; ends when no node moves by more than 10⁻³
/// mean edges.
///
/// θ weighs equal areas against equal angles: with a small one the nodes leave the tips of long shapes. A function of its arguments alone;
/// the order of nodes is the order of their numbers.
void even_out(const AskedSurface& surface, const Topology& topology, double theta, int sweeps, std::vector<SurfacePlace>& place);

}  // namespace morula
