#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "coupling/model.h"
#include "coupling/tissue.h"

namespace morula {

/// Faces of one shell that a rule of place marks, at these positions: by face, 1 or 0. The contact of kTouched is not looked at: nothing is marked.
///
/// polarity: of the cell, any length; without one a cone about it is empty.
std::vector<char> faces_by_place(const FaceMark& rule, const Space& space, const Topology& topology, std::span<const Vec3d> position,
                                 const Vec3d& polarity);

/// Give every shell of a type with marks its first marks, unless it has marks already: at time 0, after a cell became a shell. Rules of place
/// are applied to the present shape; faces that are marked by touch or by sight follow at the end of the next step.
void mark_new_shells(const Model& model, Tissue& tissue);

/// Whether any mark must be looked after from step to step (rules that always hold, by touch).
bool has_marks_that_follow(const Model& model);

/// Renew the marks that follow their cells. `touched`: by rule of the model (empty unless kTouched), by face of the rank in the order of
/// the shells: whether the face is in contact with the rule's material.
void renew_marks(const Model& model, Tissue& tissue, std::span<const std::vector<char>> touched);

/// Ease the contact of the faces of types with a lateral tension towards the present one: φ ← φ + (1 − e^(−Δt/τ)) (φ_now − φ), exact for a
/// constant one whatever the steps. `now`: part of every face in contact with other cells, by face of the rank.
void ease_contact(const Model& model, Tissue& tissue, std::span<const float> now, double dt);

/// Total area of the faces of a shell with a mark [µm²].
double marked_area(const Topology& topology, std::span<const Vec3d> position, const MarkSets& marks, int mark);

/// A third of the areas of the faces with a mark around every node [µm²].
std::vector<double> marked_node_areas(const dcm::Shells& shells, int mark);

}  // namespace morula
