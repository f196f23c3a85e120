#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupling/behaviours/persistence.h"

namespace morula {
namespace {

/// What a cell tells apart between its two ends, as a part: the difference of concentration over the concentration, or that of the receptors that are
/// bound, 2R|∇c| K/(K + c)².
double signal(const MigratingCell& cell, const OwnValues& own) {
  const double difference = 2.0 * cell.radius * norm(cell.sensed.gradient), c = std::max(cell.sensed.concentration, 0.0);
  const double binding = own("dissociation");
  if (binding > 0.0) return difference * binding / ((binding + c) * (binding + c));
  return c > 0.0 ? difference / c : 0.0;  // below 0 there is but the error of the field's integration
}

/// Part of the speed that goes up the gradient: b = b_∞ s/(s + s_½).
Vec3d drift(const MigratingCell& cell, const OwnValues& own) {
  const double steepness = norm(cell.sensed.gradient);
  if (!(steepness > 0.0)) return {};
  const double s = signal(cell, own), half = own("half_response");
  return cell.sensed.gradient * (own("index") / (1.0 + half / s) / steepness);
}

Vec3d at_birth(const MigratingCell& cell, const OwnValues&) { return cell.speed / std::numbers::sqrt3 * cell.normal(); }

/// w = S b ∇c/|∇c|, σ = S√((1 − b²)/3).
Walk step(const MigratingCell& cell, const OwnValues& own) {
  const Vec3d part = drift(cell, own);
  return walk_about(cell.speed * part, cell.speed * std::sqrt(std::max(0.0, 1.0 - norm2(part)) / 3.0), own("persistence"), cell);
}

std::vector<OwnKey> keys() {
  using Q = Quantity;
  return {
      persistence_key(),
      {.kind = OwnKey::Kind::kField,
       .spec = {.name = "field", .doc = "The field along whose gradient cells go.", .required = true, .example = "chemokine"}},
      {.spec = {.name = "index",
                .doc = "Chemotactic index in a steep gradient and in the open: mean velocity up the gradient over `speed`; negative: down. "
                       "Along an obstacle it is up to 1.22 times that, since ways in space are stretched onto the surface.",
                .quantity = Q::kFraction,
                .fallback = "80 %",
                .low = -1.0,
                .high = 1.0,
                .example = "80 %",
                .source = "chosen"}},
      {.spec = {.name = "half_response",
                .doc = "Difference across the cell, as a part, at which the index is half of that.",
                .quantity = Q::kFraction,
                .fallback = "5 %",
                .low = 0.0,
                .high = 10.0,
                .example = "5 %",
                .source = "chosen: cells tell differences of some per cent apart"}},
      {.spec = {.name = "dissociation",
                .doc = "Concentration at which half of the receptors are bound: cells compare the parts bound at their two ends, and "
                       "far above and far below it they sense little. `none`: they compare concentrations, relative to their mean.",
                .quantity = Q::kConcentration,
                .fallback = "none",
                .low = 0.0,
                .low_open = true,
                .specials = {{"none", 0.0}},
                .example = "10 nM",
                .source = "chosen: relative differences"}}};
}

}  // namespace

/// Persistent walk with a bias: the root mean square of the velocity is S whatever the gradient.
std::shared_ptr<const MigrationLaw> chemotaxis() {
  static const auto law = std::make_shared<const MigrationLaw>(MigrationLaw{
      .info = {.name = "chemotaxis",
               .title = "Persistent walk along the gradient of a field",
               .equation = "F = Γ w as persistent_walk; du = −(u − S b ∇c/|∇c|) dt/P + S√((1 − b²)/3) √(2/P) dB; b = b_∞ s/(s + s_½), "
                           "s = 2R|∇c|/c, or 2R|∇c| K/(K + c)² with receptors; ⟨u⟩ = S b ∇c/|∇c|, ⟨|u|²⟩ = S²",
               .source = "Tranquillo, Lauffenburger & Zigmond 1988, doi:10.1083/jcb.106.2.303; form of b: choice of this project",
               .parameters = {given_by_study("speed", "velocity", "µm/s",
                                             "S: root mean square of the wanted velocity in three dimensions."),
                              given_by_study("persistence", "time", "s", "P: time over which direction is kept."),
                              given_by_study("index", "fraction", "1", "b_∞."), given_by_study("half_response", "fraction", "1", "s_½."),
                              given_by_study("dissociation", "concentration", "mM", "K; 0: relative differences.")}},
      .doc = "a persistent walk that goes up the gradient of `field`",
      .keys = keys(),
      .senses_field = true,
      .at_birth = &at_birth,
      .step = &step});
  return law;
}

}  // namespace morula
