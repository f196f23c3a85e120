#pragma once
#include <span>
#include <vector>

#include "core/law_info.h"
#include "core/result.h"

namespace morula::cbm {

/// A point of a curve of contact areas, both over the surface of the ball.
struct CrowdedKnot {
  double pairs = 0.0;  ///< the contacts of a sphere with spheres, each by the law of two
  double cells = 0.0;  ///< of deformable cells in their place
};

/// Contact area of a cell with all its neighbours by what pairs alone say of them.
///
/// A deformable cell among many is pressed flat by all of them: between its contacts it has less room than a cell with one neighbour, and its contacts are
/// larger at the same distances. Areas are told by this; forces are those of pairs and of packing, which were fitted as they are.
/// Straight between the knots; below the first and beyond the last the ratio of cells to pairs is that of the knot.
class CrowdedArea {
 public:
  /// Areas are those of pairs.
  CrowdedArea() = default;
  /// Errors (kInput): no knot; `pairs` not positive and increasing; `cells` that are negative; numbers that are not finite.
  static Result<CrowdedArea> through(std::span<const CrowdedKnot> knots);

  [[nodiscard]] bool empty() const { return knots_.empty(); }
  [[nodiscard]] std::span<const CrowdedKnot> knots() const { return knots_; }
  /// Contacts of a cell over the surface of its ball, where its pairs say so much.
  [[nodiscard]] double at(double pairs) const noexcept;

 private:
  std::vector<CrowdedKnot> knots_;
};

/// What there is to say about it.
LawInfo crowded_area_law();

}  // namespace morula::cbm
