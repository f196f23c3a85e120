#include <algorithm>

#include "coupling/behaviours/migration_law.h"
#include "study/build.h"
#include "study/own_section.h"

namespace morula::scenarios {
namespace {

void set_friction(const draft::CellType& t, CellType& type) {
  const double normal = t.friction_medium.value, tangential = t.tangential_medium.value;
  if (tangential < 0.0) return;  // same
  type.medium_friction = (normal + 2.0 * tangential) / 3.0;
  type.shell.medium_friction = std::min(normal, tangential);
  type.medium_normal_extra = std::max(0.0, normal - tangential);
  type.medium_tangent_extra = std::max(0.0, tangential - normal);
}

/// Material of the obstacle that a key names, or −1 and an error.
int find_substrate(BuildContext& c, const Given<std::string>& name) {
  const int material = find_cell_or_obstacle(c, name.value, name.place);
  if (material < 0 || static_cast<std::size_t>(material) >= c.study.model.types.size()) return material;
  c.diagnostics.error(558, name.place, "'" + name.value + "' is a cell type, and cells move along obstacles", "name one of `geometry`");
  return -1;
}

void build_protrusion(BuildContext& c, std::size_t number, const Place& place, const draft::Activity& a, CellType& type) {
  if (!a.has_protrusion) return;
  const std::string& name = c.draft.cell_types[number].name;
  a.protrusion.write_to(type.protrusion);
  type.protrusion.internal = a.reaction.value == "cell";
  type.protrusion.contact_area = a.contact_area.value;
  if (a.substrate.given) type.protrusion.substrate = find_substrate(c, a.substrate);
  if (!a.has_polarity)
    c.diagnostics.error(558, place, "cells of '" + name + "' protrude along their polarity, and have none", "give the type a `polarity`");
  if (type.protrusion.internal && !may_be_shell(c, number))
    c.diagnostics.error(515, a.reaction.place, "a protrusion of '" + name + "' with `reaction: cell` has no effect",
                        "a sphere bears both forces in one point: `reaction: substrate`, or `body: shell`");
  if (a.contact_area.value > 0.0 && !a.substrate.given)
    c.diagnostics.error(515, a.contact_area.place, "'contact_area' has no effect without a substrate", "give `substrate`");
}

void build_polarity(BuildContext& c, const draft::CellType& t, CellType& type) {
  const draft::Activity& a = t.activity;
  type.polarity.set = a.has_polarity;
  if (!a.has_polarity) return;
  for (const auto& rule : c.options.laws->polarity)
    if (const auto values = own_values(c, rule->keys, t.polarity)) type.polarity.add(rule, *values);
  if (!a.start.given) return;
  if (norm2(a.start.value) == 0.0)
    c.diagnostics.error(302, a.start.place, "the polarity at the start has no direction", "for example `[1, 0, 0]`");
  else
    type.polarity.start = normalized(a.start.value);
}

/// The law of migration with the values of its own keys: E103, E515.
void build_migration(BuildContext& c, const draft::CellType& t, CellType& type) {
  Migration& migration = type.migration;
  migration.speed = t.migration_speed.value;
  std::vector<const std::vector<OwnKey>*> all;
  for (const auto& law : c.options.laws->migration) {
    if (law->info.name == t.migration_law.value) migration.law = law;
    all.push_back(&law->keys);
  }
  if (check_choice(c, migration.law->keys, all, t.migration, t.migration_law))
    if (auto values = own_values(c, migration.law->keys, t.migration)) migration.own = std::move(*values);
  if (t.migration_law.given && !t.migration_speed.given)
    c.diagnostics.error(515, t.migration_law.place, "'law' has no effect without a speed", "give `migration.speed`");
  if (!t.migration_substrate.given) return;
  migration.substrate = find_substrate(c, t.migration_substrate);
  if (migration.speed == 0.0)
    c.diagnostics.error(515, t.migration_substrate.place, "'substrate' has no effect without migration", "give `migration.speed`");
}

}  // namespace

void build_activity(BuildContext& c) {
  for (std::size_t i = 0; i < c.draft.cell_types.size(); ++i) {
    const auto& [name, place, t] = c.draft.cell_types[i];
    CellType& type = c.study.model.types[i];
    const draft::Activity& a = t.activity;
    if (a.has_fluctuations) {
      type.fluctuations = {a.energy.value, a.resolve.value};
      if (a.resolve.value > 0.0) c.study.model.step.max_step = std::min(c.study.model.step.max_step, type.fluctuations.longest_step());
    }
    build_polarity(c, t, type);
    build_protrusion(c, i, place, a, type);
    if (type.protrusion.force > 0.0) c.study.model.step.max_step = std::min(c.study.model.step.max_step, type.polarity.longest_step());
    build_migration(c, t, type);
    set_friction(t, type);
  }
}

}  // namespace morula::scenarios
