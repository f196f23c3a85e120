#pragma once
#include "scenarios/results/snapshot.h"

namespace morula::scenarios {

/// The members of a snapshot's cell, once: file, CSV and VTK walk this list. `visit(name, units, member)`.
template <class Visit>
void for_each_snapshot_column(Visit&& visit) {
  using Cell = Snapshot::Cell;
  visit("id", "1", &Cell::id);
  visit("parent", "1", &Cell::parent);
  visit("type", "1", &Cell::type);
  visit("body", "1", &Cell::body);
  visit("phase", "1", &Cell::phase);
  visit("centroid", "um", &Cell::centroid);
  visit("volume", "um^3", &Cell::volume);
  visit("area", "um^2", &Cell::area);
  visit("pressure", "kPa", &Cell::pressure);
  visit("contact_area", "um^2", &Cell::contact_area);
  visit("age", "s", &Cell::age);
  visit("concentration", "mM", &Cell::concentration);
  visit("radius", "um", &Cell::radius);
}
static_assert(sizeof(Snapshot::Cell) == 2 * 8 + 8 + sizeof(Vec3d) + 6 * 8 + kMaxFields * 8, "list every member of Snapshot::Cell");

}  // namespace morula::scenarios
