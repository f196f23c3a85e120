#pragma once
#include <span>
#include <vector>

#include "cbm/laws/pair_law.h"
#include "core/law_info.h"

namespace morula::cbm {

/// A contact law of spheres as the law reference and the property tests see it.
struct ContactLawEntry {
  LawInfo info;
  /// Material of two equal bodies from parameter values in the order of info.parameters, in internal units.
  ContactMaterial (*build)(std::span<const double> values);
  /// The law at an overlap [µm]; laws without memory ignore `attached`.
  ContactResponse<double> (*respond)(const PairLaw<double>& law, double overlap, bool attached);
  /// Overlaps at which force and energy of an attached pair jump by design, in internal units, to be avoided by finite differences.
  std::vector<double> (*jumps)(const PairLaw<double>& law);
};

/// All contact laws of spheres: the only place that knows which exist.
std::vector<ContactLawEntry> contact_laws();

/// How far a study is within the range of JKR, as `methods.md` tells it (cbm/sphere_range.h).
LawInfo jkr_range_law();

}  // namespace morula::cbm
