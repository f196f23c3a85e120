#include <algorithm>

#include "study/build.h"

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

void build_protrusion(BuildContext& c, const std::string& name, const Place& place, const draft::Activity& a, CellType& type) {
  if (!a.has_protrusion) return;
  type.protrusion.force = a.force.value;
  type.protrusion.angle = a.angle.value;
  type.protrusion.internal = a.reaction.value == "cell";
  type.protrusion.contact_area = a.contact_area.value;
  if (a.substrate.given) type.protrusion.substrate = find_substrate(c, a.substrate);
  if (!a.has_polarity)
    c.diagnostics.error(558, place, "cells of '" + name + "' protrude along their polarity, and have none", "give the type a `polarity`");
  if (a.contact_area.value > 0.0 && !a.substrate.given)
    c.diagnostics.error(515, a.contact_area.place, "'contact_area' has no effect without a substrate", "give `substrate`");
}

}  // namespace

void build_activity(BuildContext& c) {
  for (std::size_t i = 0; i < c.draft.cell_types.size(); ++i) {
    const auto& [name, place, t] = c.draft.cell_types[i];
    CellType& type = c.study.model.types[i];
    const draft::Activity& a = t.activity;
    if (a.has_fluctuations) {
      type.fluctuations = {a.energy.value, a.resolve.value};
      // The rigid motion of a cell is what the linear solver resolves last; with random forces nothing makes up for what it leaves.
      c.study.model.step.first_tolerance = std::min(c.study.model.step.first_tolerance, 1e-4);
      if (a.resolve.value > 0.0) c.study.model.step.max_step = std::min(c.study.model.step.max_step, type.fluctuations.longest_step());
    }
    type.polarity.set = a.has_polarity;
    if (a.has_polarity) {
      type.polarity.diffusion = a.turning.value;
      type.polarity.follow_velocity = a.follow_velocity.value;
      if (a.start.given) {
        type.start_polarity = a.start.value;
        if (norm2(a.start.value) == 0.0)
          c.diagnostics.error(302, a.start.place, "the polarity at the start has no direction", "for example `[1, 0, 0]`");
        else
          type.start_polarity = normalized(a.start.value);
      }
    }
    build_protrusion(c, name, place, a, type);
    if (a.migration_substrate.given) {
      type.migration_substrate = find_substrate(c, a.migration_substrate);
      if (type.migration_speed == 0.0)
        c.diagnostics.error(515, a.migration_substrate.place, "'substrate' has no effect without migration", "give `migration.speed`");
    }
    set_friction(t, type);
  }
}

}  // namespace morula::scenarios
