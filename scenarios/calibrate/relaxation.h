#pragma once
#include <vector>

#include "core/result.h"
#include "scenarios/calibrate/pair_model.h"

namespace morula::calibrate {

/// Two equal cells that come together by themselves, from the moment they touch until they rest.
struct Relaxation {
  double radius = 0.0;                ///< of the free cells [µm]
  double medium_friction = 0.0;       ///< Γ of a cell with the medium, 4πR²γ_med [nN·s/µm]
  double contact_friction = 0.0;      ///< γ_n of the cells per contact area [nN·s/µm³]
  std::vector<double> time, overlap;  ///< δ over time, from 0 [s], [µm]
};

/// Part of its way to rest, and when a pair has it.
struct Passage {
  double part = 0.0, time = 0.0;
};
/// Parts of the way by which pairs are compared: from 20 to 90 %.
std::vector<Passage> passages_of(const Relaxation& pair);

/// When two spheres of a law, attached at δ = 0, have come these parts of their own way to rest: t(δ) = ∫ (Γ + 2γ A)/(−2F) dδ from 0, of the overdamped pair
/// dδ/dt = −2F/(Γ + 2γ A) (physics/cbm.md §2). `friction`: γ [nN·s/µm³]. Empty: they do not attract each other at δ = 0.
std::vector<Passage> passages_of_spheres(const PairModel& law, double radius, double medium_friction, double friction,
                                         const std::vector<double>& parts);

/// Friction of two spheres, per contact area of their law, with which they move as fast as shells do.
struct FittedFriction {
  double friction = 0.0;         ///< γ_n or γ_t [nN·s/µm³]
  double low = 0.0, high = 0.0;  ///< 95 %; infinite of a single run
  double factor = 1.0;           ///< friction over that of the shells
  double misfit = 0.0;           ///< what is left, root mean square: in parts
};

/// Fits the friction of approach to relaxations, by least squares of ln t; the interval comes from what the pairs give one by one (Student's t of their
/// logarithms), `misfit` is that of ln(t of spheres/t of shells) over all passages. Friction is not negative: where spheres are slower than shells with the medium's alone, it is 0.
/// Errors (kInput): no pair; a pair that does not come nearer, has no friction of contact or another one than the first; spheres that do not attract each other.
Result<FittedFriction> fit_approach_friction(const std::vector<Relaxation>& pairs, const PairModel& law);

}  // namespace morula::calibrate
