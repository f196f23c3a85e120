#include "core/contact/crossing.h"

#include <algorithm>

namespace morula {
namespace {

/// The element of a point; elements are sorted by point.
const ContactElement* find(std::span<const ContactElement> elements, std::uint32_t source) {
  const auto at = std::lower_bound(elements.begin(), elements.end(), source,
                                   [](const ContactElement& e, std::uint32_t point) { return e.place() < point; });
  return at != elements.end() && at->place() == source ? &*at : nullptr;
}

}  // namespace

CrossingWatch::CrossingWatch(const SurfacePair& pair, const PointsEvaluation& evaluation)
    : on_(evaluation.target.topology != nullptr),
      own_(evaluation.with_itself),
      was_deep_(pair.step_overlap > 0.5 * evaluation.material.law.range),
      deep_(0.5 * evaluation.material.law.range) {}

void CrossingWatch::look(std::span<const ContactElement> step, std::span<const ContactElement> present,
                         std::span<const SuspectPoint> suspects, SurfacePair& pair) const {
  for (const SuspectPoint& point : suspects) {
    const ContactElement* before = find(step, point.source);
    if (own_ && before == nullptr) continue;                                // out of range of its own surface, on whatever side
    if (point.inside == (before != nullptr && before->inside())) continue;  // what was out of range was outside
    if (own_)
      pair.crossed_at = std::min(pair.crossed_at, point.distance);
    else
      ++pair.crossed;
  }
  if (!on_ || own_ || !was_deep_) return;
  for (const ContactElement& e : step) pair.crossed += e.inside() && find(present, e.place()) == nullptr;  // out of range in one step
}

}  // namespace morula
