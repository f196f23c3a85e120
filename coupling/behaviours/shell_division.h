#pragma once
#include <array>
#include <memory>
#include <span>

#include "core/mesh/renewal/surface_view.h"
#include "coupling/behaviours/division.h"
#include "coupling/cell_record.h"

namespace morula {

/// A shell that is to divide by cut, and what is around it.
struct ShellToDivide {
  const dcm::ShellRecord* shell = nullptr;
  std::array<const CellType*, 2> type{};         ///< of the daughters
  std::shared_ptr<const ReferenceShape> shape;   ///< of both
  std::span<const SurfaceView> neighbours = {};  ///< surfaces that daughters stay out of; their order does not matter
};

/// Division by cut (decision 0039): the surface is cut by the plane across `axis` (any length) above which lies `share` of its volume, both
/// halves are closed by the same cap and mapped onto the daughters' connectivity (divide_surface()). The first daughter lies on the side to which
/// the axis points. They have the mother's mean velocity, and
/// no nucleus yet.
///
/// - V0 is shared like the volume, so that both have the mother's inner pressure. `target`: their target volumes, which become rest volumes.
/// - Rest lengths of the old part are those of the mother's metric: of a face with rest lengths l1, l2, l3 it is the form that gives its
///   three sides these lengths; the cap comes in without stress. renew_surfaces() leads them to those of a free cell.
/// - Marks go with their faces; faces of the cap have none and are in contact with the sister.
///
/// Errors: those of divide_surface().
Result<std::array<dcm::ShellRecord, 2>> divide_shell(const ShellToDivide& what, const Vec3d& axis, double share,
                                                     const std::array<double, 2>& target);

/// How new the surface is that the division of its mother has made (newness_of_interface()). Of a cell that was there from the beginning 0.
///
/// An interface of sisters of newness n adheres with W + n (2γ − W), so that at first it has no tension of its own, 2γ − W = 0, as it was not
/// there before (decision 0039).
double newness_of_surface(const CellRow& row, const CellType& type, double time);

/// What becomes of the rest lengths of shells in a step of dt [s] that ends at `time`: with the newness n of their surface they go to those of a
/// free cell of the same rest volume, l ← l_free + (l − l_free) n'/n, where the cortex does not turn over by itself.
void renew_surfaces(std::span<const CellType> types, const Cells& cells, dcm::Shells& shells, double time, double dt);

}  // namespace morula
