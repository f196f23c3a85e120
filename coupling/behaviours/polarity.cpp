#include "coupling/behaviours/polarity.h"

#include <algorithm>
#include <limits>

#include "core/random/philox.h"

namespace morula {

// What only the list below names is declared here, so that one more rule is its own file and two lines of this one.
std::shared_ptr<const PolarityRule> rotational_diffusion();
std::shared_ptr<const PolarityRule> follow_velocity();

std::vector<std::shared_ptr<const PolarityRule>> polarity_rules() { return {rotational_diffusion(), follow_velocity()}; }

void Polarity::add(const std::shared_ptr<const PolarityRule>& rule, const OwnValues& values) {
  if (rule->acts(values)) rules.push_back({rule, values});
}

bool Polarity::looks_at_velocity() const {
  return std::ranges::any_of(rules, [](const TypePolarityRule& rule) { return rule.what->looks_at_velocity; });
}

double Polarity::longest_step() const {
  double out = std::numeric_limits<double>::infinity();
  for (const TypePolarityRule& rule : rules)
    if (rule.what->longest_step != nullptr) out = std::min(out, rule.what->longest_step(rule.values));
  return out;
}

Vec3d initial_polarity(CellId cell, const CellType& type, std::uint32_t seed) {
  if (!type.polarity.set) return {};
  if (norm2(type.polarity.start) > 0.0) return type.polarity.start;
  return Random(seed, RandomStream::kPolarity).direction(cell, std::numeric_limits<std::uint64_t>::max());  // no step has this number
}

Vec3d next_polarity(const Vec3d& polarity, const TurningCell& cell, const CellType& type) {
  if (!type.polarity.set || norm2(polarity) == 0.0) return polarity;
  Vec3d p = polarity;
  for (const TypePolarityRule& rule : type.polarity.rules) p = rule.what->turn(p, cell, rule.values);
  return p;
}

}  // namespace morula
