#pragma once
#include "coupling/observables/measures.h"
#include "coupling/tissue.h"

namespace morula::scenarios {

template <class Visit>
void for_each_clock_field(Visit&& visit) {
  visit("time", "s", &Clock::time);
  visit("next_step", "s", &Clock::next_step);
  visit("steps", "1", &Clock::steps);
  visit("capped", "1", &Clock::capped);
}
static_assert(sizeof(Clock) == 4 * 8, "list every member of Clock in for_each_clock_field");

template <class Visit>
void for_each_interval_field(Visit&& visit) {
  visit("steps", "1", &Interval::steps);
  visit("time", "s", &Interval::time);
  visit("newton", "1", &Interval::newton);
  visit("linear", "1", &Interval::linear);
  visit("retries", "1", &Interval::retries);
  visit("worst_overlap", "um", &Interval::worst_overlap);
}
static_assert(sizeof(Interval) == 6 * 8, "list every member of Interval in for_each_interval_field");

template <class Visit>
void for_each_lumen_field(Visit&& visit) {
  visit("looked_at", "s", &LumenState::looked_at);
  visit("amount", "amol", &LumenState::amount);
  visit("volume", "um^3", &LumenState::volume);
  visit("pressure", "kPa", &LumenState::pressure);
  visit("area", "um^2", &LumenState::area);
  visit("covered", "1", &LumenState::covered);
  visit("before_others", "um^3", &LumenState::before_others);
  visit("other_directions", "1", &LumenState::other_directions);
  visit("wall_x", "um^2", &LumenState::wall_x);
  visit("wall_y", "um^2", &LumenState::wall_y);
  visit("wall_z", "um^2", &LumenState::wall_z);
  visit("hidden", "1", &LumenState::hidden);
}
static_assert(sizeof(LumenState) == 12 * 8, "list every member of LumenState in for_each_lumen_field");

/// visit(name, units, member of Field): what it has beside grid, bricks and concentrations.
template <class Visit>
void for_each_field_number(Visit&& visit) {
  visit("next_step", "s", &fields::Field::next_step);
  visit("time", "s", &fields::Field::time);
  visit("interval", "s", &fields::Field::interval);
  visit("way", "um", &fields::Field::way);
}

/// visit(name, units, member of WatchedNeighbour).
template <class Visit>
void for_each_watched_field(Visit&& visit) {
  visit("exchanged", "1", &WatchedNeighbour::exchanged);
  visit("neighbour", "1", &WatchedNeighbour::neighbour);
  visit("since", "s", &WatchedNeighbour::since);
  visit("is_promotion", "1", &WatchedNeighbour::is_promotion);
  visit("room", "um^3", &WatchedNeighbour::room);
  visit("from", "um", &WatchedNeighbour::from);
  visit("radius", "um", &WatchedNeighbour::radius);
}
static_assert(sizeof(WatchedNeighbour) == 9 * 8, "list every member of WatchedNeighbour in for_each_watched_field");

/// visit(name, units, member of FieldLedger).
template <class Visit>
void for_each_field_ledger_field(Visit&& visit) {
  visit("field_in", "amol", &FieldLedger::in);
  visit("field_taken", "amol", &FieldLedger::taken);
  visit("field_decayed", "amol", &FieldLedger::decayed);
  visit("field_start", "amol", &FieldLedger::start);
}
static_assert(sizeof(FieldLedger) == 4 * 8, "list every member of FieldLedger in for_each_field_ledger_field");

/// visit(name, units, member of Ledger), for what is not by field.
template <class Visit>
void for_each_ledger_field(Visit&& value) {
  value("divisions", "1", &Ledger::divisions);
  value("deaths", "1", &Ledger::deaths);
  value("promotions", "1", &Ledger::promotions);
  value("demotions", "1", &Ledger::demotions);
  value("drift", "um", &Ledger::drift);
  value("rotation", "rad", &Ledger::rotation);
  value("way", "um", &Ledger::way);
}
static_assert(sizeof(Ledger) == sizeof(std::vector<FieldLedger>) + (4 + 7) * 8, "list every member of Ledger in for_each_ledger_field");

}  // namespace morula::scenarios
