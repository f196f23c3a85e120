#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/own_keys.h"
#include "coupling/own_values.h"

namespace morula {

class CellView;

/// A factor between 0 and 1 that holds a cell back, of what it is and sees at the start of a step. Called by several threads at once.
using ArrestOf = std::function<double(const CellView&)>;

/// A factor of the rate of growth or of the rate at which a phase passes: what there is to say about it, its section within an `arrest` of the study,
/// and what makes it. Several multiply.
struct ArrestFactor {
  LawInfo info;     ///< its parameters have the names of keys
  KeySpec section;  ///< within `arrest`
  std::vector<OwnKey> keys{};
  bool looks_at_body = false;  ///< needs volume, areas and pressure of the body as they are at the start of each step
  ArrestOf (*build)(const OwnValues& values) = nullptr;
  /// What is wrong with the values; null: nothing can be.
  std::optional<LawProblem> (*judge)(const OwnValues& values) = nullptr;
  /// Least pressure at which the factor is 0 [kPa]; null: pressure has no part in it.
  double (*full_pressure)(const OwnValues& values) = nullptr;
};

/// A factor as the cells of one type have it.
struct CellArrest {
  CellArrest(std::shared_ptr<const ArrestFactor> factor, OwnValues given)
      : what(std::move(factor)), values(std::move(given)), of(what->build(values)) {}

  std::shared_ptr<const ArrestFactor> what;
  OwnValues values;
  ArrestOf of;
};

/// The factors that Morula brings.
std::vector<std::shared_ptr<const ArrestFactor>> builtin_arrest_factors();

/// 1 up to `from`, 0 from `to` on, straight between; `from` may be the larger one.
[[nodiscard]] double ramp(double value, double from, double to);
/// xⁿ/(1 + xⁿ) of x = value/half; 0 where the value is not positive.
[[nodiscard]] double hill(double value, double half, double power);

}  // namespace morula
