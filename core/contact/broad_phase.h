#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/space/space.h"
#include "core/vec3.h"

namespace morula {

/// What the broad phase needs of a body: a box and a ball that both contain it, already inflated by half the reach of its contacts.
struct Extent {
  Box box;
  Vec3d center;
  double radius = 0.0;
};

/// Two bodies that may touch: place(a) < place(b). Body b is meant at its image b + shift.
struct BodyPair {
  std::uint32_t a, b;
  Vec3d shift{};
};

/// Calls found(pair) for all pairs whose boxes and balls overlap, at least one of the two owned, in canonical order (place of a, place of b).
///
/// `place` is the canonical place of each body, a permutation. Bodies are binned by their centres into a grid as wide as the largest
/// body, so that the cost grows with the number of bodies. On periodic axes the nearest image counts. `threads` look for them; found() is called by
/// one thread alone.
void find_body_pairs(std::span<const Extent> extents, std::span<const std::uint32_t> place, std::span<const char> owned, const Space& space,
                     int threads, const std::function<void(const BodyPair&)>& found);

/// The same for the pairs with at least one of `some` (numbers, increasing), at the cost of what lies near these.
void find_body_pairs_of(std::span<const std::uint32_t> some, std::span<const Extent> extents, std::span<const std::uint32_t> place,
                        const Space& space, int threads, const std::function<void(const BodyPair&)>& found);

/// A ball around a body, already inflated by half the reach of its contacts.
struct Ball {
  Vec3d center;
  double radius = 0.0;
};

/// The same for all pairs of balls that overlap, in the order of their numbers, by one thread; here the balls are the bodies.
void find_ball_pairs(std::span<const Ball> balls, const Space& space, const std::function<void(const BodyPair&)>& found);

/// Numbers of the bodies that lie near one of `some`, increasing: all that may touch one of them, themselves and a few more. Goes over all bodies twice,
/// with no more memory than bytes for bins. `ball_of` gives the ball of a body.
std::vector<std::uint32_t> bodies_near(std::span<const std::uint32_t> some, std::size_t count,
                                       const std::function<Ball(std::uint32_t)>& ball_of, const Space& space);

}  // namespace morula
