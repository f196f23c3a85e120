#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "core/cell_id.h"
#include "core/own_keys.h"
#include "core/random/philox.h"
#include "core/vec3.h"
#include "coupling/own_values.h"

namespace morula {

/// A cell whose polarity turns, at the end of a step.
struct TurningCell {
  CellId id;
  Vec3d velocity{};  ///< of its body; of a shell the sum over its nodes, where the rule looks at it [µm/s]
  Random random;     ///< of the stream of polarity
  std::uint64_t step = 0;
  double dt = 0.0;  ///< length of the step [s]
};

/// What turns the polarity of cells: what there is to say about it, its keys in the section `polarity`, and how it turns. Rules act one after the other, in
/// the order of the registry.
struct PolarityRule {
  LawInfo info;
  std::vector<OwnKey> keys{};  ///< each with a default with which the rule does not act
  bool looks_at_velocity = false;
  bool (*acts)(const OwnValues& values) = nullptr;
  /// The longest step in which cells that go along their polarity still go as far as it says [s]; null: any.
  double (*longest_step)(const OwnValues& values) = nullptr;
  /// A polarity of length 1 after the step; of length 1 again.
  Vec3d (*turn)(const Vec3d& polarity, const TurningCell& cell, const OwnValues& values) = nullptr;
};

/// The rules that Morula brings, in the order in which they act.
std::vector<std::shared_ptr<const PolarityRule>> polarity_rules();

/// A rule as the cells of one type have it.
struct TypePolarityRule {
  std::shared_ptr<const PolarityRule> what;
  OwnValues values;
};

/// The polarity of a cell type (dcm.md §11).
struct Polarity {
  bool set = false;                     ///< cells of the type have one
  Vec3d start{};                        ///< of founders; zero: random
  std::vector<TypePolarityRule> rules;  ///< those that act, in their order

  /// Adds a rule with these values, if it acts with them.
  void add(const std::shared_ptr<const PolarityRule>& rule, const OwnValues& values);
  [[nodiscard]] bool looks_at_velocity() const;
  /// Of all its rules (PolarityRule::longest_step); infinite where none limits it.
  [[nodiscard]] double longest_step() const;
};

}  // namespace morula
