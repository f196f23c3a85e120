#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/law_info.h"
#include "core/law_values.h"

namespace morula {

/// How fast a cell grows: freely it would come from one volume to another in this time.
struct GrowthPace {
  double from = 0.0;      ///< [µm³]
  double to = 0.0;        ///< [µm³]
  double duration = 0.0;  ///< [s]
};

/// A law by which the target volume of a cell grows: what there is to say about it, and its solution of dV/dt, exact whatever the steps. The values
/// are those of its own keys.
struct GrowthLaw {
  LawInfo info;
  std::string word;            ///< of `cycle.growth` in a study
  std::string doc;             ///< what it is, after the word and a colon
  std::vector<KeySpec> own{};  ///< keys of its own, beside those of `cycle`; each has a default
  bool grows = true;           ///< volumes become larger
  /// Volume at a point of the pace, 0 at `from` and 1 at `to` [µm³].
  double (*at)(const GrowthPace& pace, const LawValues& values, double point) = nullptr;
  /// Volume after a time dt [s] of one that is `volume` now [µm³].
  double (*after)(const GrowthPace& pace, const LawValues& values, double volume, double dt) = nullptr;
  /// Time that growth takes from `volume` to `wanted` [s]; infinite where it never comes there, negative or 0 where it is there already.
  double (*time_to)(const GrowthPace& pace, const LawValues& values, double volume, double wanted) = nullptr;
};

/// The laws that Morula brings, the default first.
std::vector<std::shared_ptr<const GrowthLaw>> growth_laws();
std::shared_ptr<const GrowthLaw> linear_growth();

}  // namespace morula
