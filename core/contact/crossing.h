#pragma once
#include <cstdint>
#include <span>

#include "core/contact/surface_pair.h"

namespace morula {

/// Which of its points a pair has to look at again, points of body d against the other.
///
/// The distance of a point from a closed surface is continuous, so that its sign can only change through zero. A change at |g| > c/2 comes of a
/// surface that is folded through itself, or of motion that no contact has seen: the step is not to be trusted (time_stepping.md §9.1).
/// A surface against itself has no inside that its other parts may not enter: there a part may have passed through another wherever a side
/// has changed at a distance that motion explains (self_contact.h). Farther away the nearest face has become one on the other side of the point.
class CrossingWatch {
 public:
  CrossingWatch(const SurfacePair& pair, const PointsEvaluation& evaluation);

  /// `gap`: signed, of a point in range [µm].
  [[nodiscard]] bool suspects(double gap) const {
    if (!on_) return false;
    return own_ || gap < -deep_ || (was_deep_ && gap > deep_);
  }
  /// Note in the pair which of the suspects are on another side than at the start of the step; `present`: all points in range now.
  void look(std::span<const ContactElement> step, std::span<const ContactElement> present, std::span<const SuspectPoint> suspects,
            SurfacePair& pair) const;

 private:
  bool on_;        ///< spheres have but one side
  bool own_;       ///< a surface against itself
  bool was_deep_;  ///< some point was deep inside at the start of the step
  double deep_;    ///< c/2 [µm]
};

}  // namespace morula
