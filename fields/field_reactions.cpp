#include "fields/field_reactions.h"

#include <algorithm>
#include <cmath>

namespace morula::fields {

FieldReactions::FieldReactions(const FieldSpec& spec) {
  std::size_t types = 0;
  for (const FieldReaction& one : spec.reactions)
    if (one.what->where == Reaction::Where::kCells) types = std::max<std::size_t>(types, one.type + std::size_t{1});
  types_that_act_.assign(types, false);
  for (const FieldReaction& one : spec.reactions) {
    if (one.what->never_acts != nullptr && one.what->never_acts(one.values)) continue;
    if (one.what->where == Reaction::Where::kCells)
      add_cell_reaction(one, types);
    else if (one.what->first_order)
      first_order_ += one.what->slope(one.what->coefficients(one.values), 0.0);
    else
      in_volume_.push_back({one.what, one.what->coefficients(one.values)});
  }
}

void FieldReactions::add_cell_reaction(const FieldReaction& reaction, std::size_t types) {
  auto law =
      std::ranges::find_if(of_cells_, [&](const OfCells& one) { return one.what == reaction.what && !one.of_type[reaction.type].acts; });
  if (law == of_cells_.end()) law = of_cells_.insert(of_cells_.end(), {reaction.what, std::vector<TypeCoefficients>(types)});
  law->of_type[reaction.type] = {true, reaction.what->coefficients(reaction.values)};
  types_that_act_[reaction.type] = true;
}

double FieldReactions::add_rates(std::span<const Sink> sinks, std::span<const double> c, double voxel_volume, double* rate,
                                 double* taken) const {
  if (taken != nullptr) std::fill_n(taken, sinks.size(), 0.0);
  for (const OfCells& law : of_cells_) law.what->add_rates_of_cells({sinks, law.of_type.data(), c.data(), voxel_volume}, rate, taken);
  double in_volume = 0.0;
  for (const InVolume& law : in_volume_) in_volume += law.what->add_rates(law.coefficients, c, rate);
  return in_volume * voxel_volume;
}

void FieldReactions::add_slopes(std::span<const Sink> sinks, std::span<const double> c, double voxel_volume, double* slope) const {
  for (const OfCells& law : of_cells_) law.what->add_slopes_of_cells({sinks, law.of_type.data(), c.data(), voxel_volume}, slope);
  for (const InVolume& law : in_volume_) law.what->add_slopes(law.coefficients, c, slope);
}

double FieldReactions::steepest_in_volume(double highest) const {
  double out = 0.0;
  for (const InVolume& law : in_volume_) out += law.what->steepest(law.coefficients, highest);
  return out;
}

double FieldReactions::steepest_of_sink(const Sink& sink, double highest) const {
  double out = 0.0;
  for (const OfCells& law : of_cells_)
    if (const TypeCoefficients& of = law.of_type[sink.type]; of.acts) out += law.what->steepest(of.value, highest);
  return sink.cells * out;
}

Status check_reactions(const FieldSpec& spec) {
  for (const FieldReaction& one : spec.reactions) {
    if (one.what->never_acts != nullptr && one.what->never_acts(one.values)) continue;
    const auto wrong = [&](const std::string& key, const std::string& what, const std::string& help) {
      return Error{ErrorKind::kInput, "field '" + spec.name + "': '" + key + "' of " + one.what->info.name + " " + what, help};
    };
    for (const OwnKey& key : one.what->keys) {
      if (key.kind != OwnKey::Kind::kQuantity || (key.spec.fallback != nullptr && !one.values.has(key.spec.name))) continue;
      const KeySpec& k = key.spec;
      const double value = one.values(k.name);
      if (!std::isfinite(value) || !k.holds(value))
        return wrong(k.name, "is out of its range or not a number", "for example " + std::string(k.example));
    }
    if (const auto problem = one.what->judge != nullptr ? one.what->judge(one.values) : std::nullopt)
      return wrong(problem->key, problem->what, problem->help);
  }
  return {};
}

}  // namespace morula::fields
