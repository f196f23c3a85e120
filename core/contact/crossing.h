#pragma once
#include <cstdint>
#include <span>

#include "core/contact/surface_pair.h"

namespace morula {

/// Which of its points a pair has to look at again, points of body d against the other.
///
/// The distance of a point from a closed surface is continuous, so that its sign can only change through zero. A change at |g| > c/2 comes of a
/// surface that is folded through itself, or of motion that no contact has seen: the step is not to be trusted (time_stepping.md §9.1).
/// A surface against itself has no inside that its other parts may not enter: there every change of sign that motion can explain is a
/// part that passed through another (self_contact.h).
class CrossingWatch {
 public:
  CrossingWatch(const SurfacePair& pair, const PointsEvaluation& evaluation);

  /// `gap`: signed, of a point in range [µm].
  [[nodiscard]] bool suspects(double gap) const {
    if (!on_) return false;
    if (own_) return gap < reach_ && gap > -reach_;
    return gap < -reach_ || (was_deep_ && gap > reach_);
  }
  /// How many of the suspects are on another side than at the start of the step; `present`: all points in range now.
  [[nodiscard]] std::uint32_t count(std::span<const ContactElement> step, std::span<const ContactElement> present,
                                    std::span<const SuspectPoint> suspects) const;

 private:
  bool on_;        ///< spheres have but one side
  bool own_;       ///< a surface against itself
  bool was_deep_;  ///< some point was deep inside at the start of the step
  double reach_;   ///< c/2; of a surface against itself: the motion since the start of the step
};

}  // namespace morula
