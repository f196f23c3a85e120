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
  visit("inner_pressure", "kPa", &Cell::inner_pressure);
  visit("stress_xx", "kPa", &Cell::stress_xx);
  visit("stress_xy", "kPa", &Cell::stress_xy);
  visit("stress_xz", "kPa", &Cell::stress_xz);
  visit("stress_yy", "kPa", &Cell::stress_yy);
  visit("stress_yz", "kPa", &Cell::stress_yz);
  visit("stress_zz", "kPa", &Cell::stress_zz);
  visit("contact_area", "um^2", &Cell::contact_area);
  visit("age", "s", &Cell::age);
  visit("concentration", "mM", &Cell::concentration);
  visit("radius", "um", &Cell::radius);
}
static_assert(sizeof(Snapshot::Cell) == 2 * 8 + 8 + sizeof(Vec3d) + 13 * 8 + kMaxFields * 8, "list every member of Snapshot::Cell");

}  // namespace morula::scenarios
