#pragma once
#include "coupling/tissue.h"

namespace morula::scenarios {

/// The members of a row and of its sides, once: checkpoint, reading back and state hash all walk this list. `visit(name, units, member)`.
template <class Visit>
void for_each_row_field(Visit&& visit) {
  visit("id", "1", &FullRow::id);
  visit("parent", "1", &FullRow::parent);
  visit("order", "1", &FullRow::order);
  visit("birth_time", "s", &FullRow::birth_time);
  visit("birth_volume", "um^3", &FullRow::birth_volume);
  visit("target_volume", "um^3", &FullRow::target_volume);
  visit("division_volume", "um^3", &FullRow::division_volume);
  visit("cycle_duration", "s", &FullRow::cycle_duration);
  visit("pressure", "kPa", &FullRow::pressure);
  visit("death_time", "s", &FullRow::death_time);
  visit("last_swap_time", "s", &FullRow::last_swap_time);
  visit("reference_excess", "1", &FullRow::reference_excess);
  visit("inflation_left", "um^3", &FullRow::inflation_left);
  visit("inflation_rate", "um^3/s", &FullRow::inflation_rate);
  visit("polarity", "1", &FullRow::polarity);
  visit("migration_velocity", "um/s", &FullRow::migration_velocity);
  visit("amount", "amol", &FullRow::amount);
  visit("concentration", "mM", &FullRow::concentration);
  visit("draws", "1", &FullRow::draws);
  visit("type", "1", &FullRow::type);
  visit("phase", "1", &FullRow::phase);
  visit("body", "1", &FullRow::body);
  visit("own_body", "1", &FullRow::own_body);
}

/// The size of a row that the list above covers, to notice a member that was added to one and not to the other.
inline constexpr std::size_t kListedRowBytes = 3 * 8 + 11 * 8 + 2 * sizeof(Vec3d) + 2 * kMaxFields * 8 + 8 + 2 + 1 + 1 + 1;
static_assert(sizeof(FullRow) == kListedRowBytes + sizeof(CellRow::unused_), "list every member of FullRow in for_each_row_field");

template <class Visit>
void for_each_clock_field(Visit&& visit) {
  visit("time", "s", &Clock::time);
  visit("next_step", "s", &Clock::next_step);
  visit("steps", "1", &Clock::steps);
  visit("capped", "1", &Clock::capped);
}
static_assert(sizeof(Clock) == 4 * 8, "list every member of Clock in for_each_clock_field");

template <class Visit>
void for_each_lumen_field(Visit&& visit) {
  visit("looked_at", "s", &LumenState::looked_at);
  visit("amount", "amol", &LumenState::amount);
  visit("volume", "um^3", &LumenState::volume);
  visit("pressure", "kPa", &LumenState::pressure);
  visit("area", "um^2", &LumenState::area);
  visit("covered", "1", &LumenState::covered);
  visit("before_spheres", "um^3", &LumenState::before_spheres);
  visit("sphere_directions", "1", &LumenState::sphere_directions);
}
static_assert(sizeof(LumenState) == 8 * 8, "list every member of LumenState in for_each_lumen_field");

/// `array(name, units, member)` for the values by field, `value(name, units, member)` for the others.
template <class Array, class Value>
void for_each_ledger_field(Array&& array, Value&& value) {
  array("field_in", "amol", &Ledger::field_in);
  array("field_taken", "amol", &Ledger::field_taken);
  array("field_decayed", "amol", &Ledger::field_decayed);
  array("field_start", "amol", &Ledger::field_start);
  value("divisions", "1", &Ledger::divisions);
  value("deaths", "1", &Ledger::deaths);
  value("promotions", "1", &Ledger::promotions);
  value("demotions", "1", &Ledger::demotions);
  value("drift", "um", &Ledger::drift);
  value("rotation", "rad", &Ledger::rotation);
  value("way", "um", &Ledger::way);
}
static_assert(sizeof(Ledger) == (4 * kMaxFields + 4 + 7) * 8, "list every member of Ledger in for_each_ledger_field");

}  // namespace morula::scenarios
