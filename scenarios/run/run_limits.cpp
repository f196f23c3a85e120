#include "core/numbers/number_text.h"
#include "scenarios/run/run_loop.h"

namespace morula::scenarios {
namespace {

constexpr double kWarnAt = 0.8;  // of a limit

}  // namespace

/// A capped start ends in its time. What is capped later, by cells that have become shells, is no start: such a cell has been exchanged.
Status RunLoop::check_capped_start() const {
  const Tissue& tissue = simulation_->tissue();
  const bool late = study_.model.step.start_cap > 0.0 && tissue.clock.capped && tissue.clock.time >= study_.time.capped_start;
  if (!late) return {};
  const double never = OptionalValues().last_swap_time;
  bool exchanged = false;
  for (std::size_t i = 0; i < tissue.cells.size(); ++i) exchanged = exchanged || tissue.cells.optional.last_swap_time[i] != never;
  if (comm_.any(exchanged)) return {};
  return Error{
      ErrorKind::kPhysics,
      "the capped start has not ended by " + time_text(tissue.clock.time) + ": cells still lie deeper in each other than 0.1 um [E662]",
      "place them further apart, or start them smaller (`start_volume`, `inflate`); `numerics.start_cap_within` is the time it has"};
}

Status RunLoop::check_limits(const Measures& m) {
  const Limits& limits = study_.model.limits;
  const auto crossed = [&](const std::string& what, const Extreme& extreme) {
    return Error{ErrorKind::kPhysics, what + (extreme.cell.valid() ? " in cell " + extreme.cell.text() : "") + " at " + time_text(m.time),
                 "the limit is in the study: `limits`; the last checkpoint and snapshot show the state"};
  };
  const std::string volume = "volume error " + number_text("%.2g %%", 100.0 * m.volume_error.value) + " (limit " +
                             number_text("%.2g %%)", 100.0 * limits.volume_error);
  if (!(m.volume_error.value <= limits.volume_error)) return crossed(volume, m.volume_error);
  if (m.volume_error.value > kWarnAt * limits.volume_error) warn_near_limit(kVolume, volume + " in cell " + m.volume_error.cell.text());
  if (!simulation_->tissue().clock.capped) {  // a capped start may overlap until it has come apart
    const std::string overlap = "overlap " + number_text("%.2g um", m.overlap.value) + " (limit " + number_text("%.2g um)", limits.overlap);
    if (!(m.overlap.value <= limits.overlap)) {
      Error error = crossed(overlap, m.overlap);
      if (m.time == 0.0)
        error.help =
            "cells lie in each other at the start: let them come apart first (`numerics: start_cap: 0.2 um`), place fewer, or start "
            "them smaller (`start_volume`, `inflate`)";
      return error;
    }
    if (m.overlap.value > kWarnAt * limits.overlap) warn_near_limit(kOverlap, overlap + " at cell " + m.overlap.cell.text());
  }
  MORULA_TRY(check_packing(m));
  tell_contacts_beyond(m);
  tell_shells_beyond_budget(m);
  constexpr double kMostEdge = 5.0;  // reached after 90 min in a block that ends after 3.9 h (decision 0073)
  if (m.drawn_out.value > kMostEdge)
    warn_near_limit(
        kDrawnOut,
        "cell " + m.drawn_out.cell.text() + " is drawn out: its longest edge is " + number_text("%.2g", m.drawn_out.value) +
            " times the mean one at " + time_text(m.time) +
            ". A shell without elasticity flows into the gaps between spheres where it is pressed with more than some 13 tensions "
            "over the radius, and its run may end: an elastic cortex (`elastic: springs`), more tension, or one body for cells that "
            "are pressed");
  for (std::size_t f = 0; f < study_.model.fields.size(); ++f) {
    const std::string balance = "balance of " + study_.model.fields[f].name + " off by " + number_text("%.2g", m.field_balance[f]) +
                                " (limit " + number_text("%.2g)", limits.field_balance);
    if (!(m.field_balance[f] <= limits.field_balance)) return crossed(balance, {});
    if (m.field_balance[f] > kWarnAt * limits.field_balance) warn_near_limit(kBalance, balance);
  }
  tell_cavities(m);
  if (m.outside_fields > 0)
    warn_near_limit(kOutsideFields, std::to_string(m.outside_fields) + (m.outside_fields == 1 ? " cell is" : " cells are") +
                                        " beyond the domain at " + time_text(m.time) +
                                        ", where no field is: they see and take what is in its outermost voxels; make the domain larger");
  return {};
}

/// The pressure of packing holds within the range it was calibrated in (cbm.md §3).
Status RunLoop::check_packing(const Measures& m) {
  constexpr double kMost = 1.5, kPartBeyond = 0.01;
  if (m.packing > kMost && !simulation_->tissue().clock.capped) {
    const Model& model = study_.model;
    const bool grow = std::ranges::any_of(model.types, [](const CellType& type) { return type.cycles; });
    return Error{ErrorKind::kPhysics,
                 "cell " + m.packing_cell.text() + " is packed " + number_text("%.3g", m.packing) +
                     " times as tightly as the end of its packing curve at " + time_text(m.time),
                 std::string("shells where the law of spheres ends (`coupling: {triggers: [{outside_law: 1}]}`), ") +
                     (grow ? "growth that stops at a lower pressure (`inhibit_growth: {pressure_above: 500 Pa}`), " : "") +
                     (model.loads.empty() ? "" : "less load, ") + "or knots of `cbm.packing` for such compressions"};
  }
  if (static_cast<double>(m.packed_beyond) > kPartBeyond * static_cast<double>(m.spheres))
    warn_near_limit(kPacking, std::to_string(m.packed_beyond) + " of " + std::to_string(m.spheres) +
                                  " spheres are packed more tightly than their packing curve is calibrated for");
  return {};
}

}  // namespace morula::scenarios
