#pragma once
#include <memory>
#include <vector>

#include "cbm/sphere_law.h"

namespace morula::cbm {

/// The laws of contact of spheres that Morula brings, the default first.
std::vector<std::shared_ptr<const SphereLaw>> sphere_laws();

/// How far a study is within the range of JKR, as `methods.md` tells it (cbm/sphere_range.h).
LawInfo jkr_range_law();

}  // namespace morula::cbm
