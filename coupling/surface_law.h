#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/contact/surface_traction.h"
#include "core/law_info.h"
#include "core/law_values.h"

namespace morula {

/// A law of contact of two surfaces: what there is to say about it and how a study makes its traction.
///
/// The values are `adhesion` [nN/µm], `range` [µm], `repulsion` [kPa/µm], `curvature`, the sum of 1/R of both cells (obstacles are flat) [1/µm], and
/// the law's own keys.
struct SurfaceLaw {
  LawInfo info;                ///< its parameters have the names of such values
  std::string word;            ///< of `law` of a pair in `contact.pairs`
  std::string doc;             ///< what it is, after the word and a colon
  std::vector<KeySpec> own{};  ///< keys of its own; one without a default must be given
  bool has_repulsion = true;   ///< takes `repulsion`
  SurfaceTraction (*build)(const LawValues& values) = nullptr;
  /// What a person should know of the values, which have `pressure` of the stronger cell [kPa] and `overlap` that the study allows [µm] as well: a
  /// warning. Null: nothing.
  std::optional<LawProblem> (*judge)(const LawValues& values) = nullptr;
};

/// The laws that Morula brings, the default first.
std::vector<std::shared_ptr<const SurfaceLaw>> surface_laws();
std::shared_ptr<const SurfaceLaw> tent_law();
std::shared_ptr<const SurfaceLaw> maugis_dugdale_law();
std::shared_ptr<const SurfaceLaw> falling_law();

}  // namespace morula
