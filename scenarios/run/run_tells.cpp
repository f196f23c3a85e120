/// What a run tells its user beside its numbers: notes and warnings in the log, events in events.jsonl.
#include <algorithm>
#include <map>
#include <utility>

#include "core/numbers/joined.h"
#include "core/numbers/number_text.h"
#include "coupling/lumens.h"
#include "results/file_io.h"
#include "results/series_reader.h"
#include "results/snapshot_file.h"
#include "scenarios/run/run_loop.h"

namespace morula::scenarios {

void RunLoop::note(Note::Kind kind, const std::string& text) {
  if (!comm_.is_root()) return;
  const double time = simulation_->tissue().clock.time;
  const Status written = folder_.add_to_log((kind == Note::Kind::kNote ? "note  " : "warn  ") + time_text(time) + "  " + text);
  if (!written.ok() && text_status_.ok()) text_status_ = written;
  if (request_.on_note) request_.on_note({kind, time, text});
}

void RunLoop::warn(const std::string& text) {
  note(Note::Kind::kWarning, text);
  warnings_.push_back({{simulation_->tissue().clock.time, EventKind::kWarning, {}, {}, {}, {}}, text});
}

void RunLoop::keep_events(std::span<const Event> events) {
  if (!comm_.is_root()) return;  // the root writes them, and makes their words
  for (const Event& event : events) events_.push_back(told(event, study_.model));
}

Status RunLoop::write_events() {
  std::vector<ToldEvent> all = std::exchange(warnings_, {});
  all.insert(all.end(), events_.begin(), events_.end());
  events_.clear();
  std::ranges::stable_sort(all, {}, [](const ToldEvent& one) { return one.event.time; });
  return folder_.add_events(all);
}

void RunLoop::warn_near_limit(Warned what, const std::string& text) {
  if ((warned_ & what) == 0) warn(text);
  warned_ |= what;
}

/// Loads on marked faces that no face bears yet.
void RunLoop::tell_idle_loads() {
  const Model& model = study_.model;
  const dcm::Shells& shells = simulation_->tissue().shells;
  for (const CellLoad& load : model.loads) {
    if (load.mark < 0) continue;
    bool borne = false;
    for (std::size_t i = 0; i < shells.size(); ++i)
      if (shells.type[i] == load.type) borne = borne || shells.marks_of(i).any_has(load.mark);
    if (!comm_.any(borne))
      note(Note::Kind::kWarning, "load '" + load.name + "' acts nowhere: no face of '" + model.types[load.type].name + "' has the mark '" +
                                     model.mark_names[static_cast<std::size_t>(load.mark)] + "' at the start");
  }
}

Status RunLoop::tell_what_is_lost(std::size_t snapshots) {
  std::size_t rows = 0;
  const auto count = [&]() -> Status {
    MORULA_TRY_ASSIGN(const SeriesTable series, read_series(folder_.series()));
    rows = series.rows();
    return {};
  };
  MORULA_TRY(agree(comm_.is_root() ? count() : Status{}, comm_));
  if (comm_.any(rows != snapshots))
    warn("up to here series.csv has " + std::to_string(comm_.sum(static_cast<std::int64_t>(rows))) + " rows, results.h5 " +
         std::to_string(comm_.sum(static_cast<std::int64_t>(snapshots))) +
         " snapshots: some were lost, and criteria, pictures and lineage know of those alone that are left");
  return {};
}

/// What happened since the last output, counted: `14 promotions (region core)`.
void RunLoop::tell_events() {
  constexpr double kAll = 0.99, kNothing = 0.01;  // of the room
  struct Exchanges {
    std::size_t count = 0;
    double room = 0.0, later = 0.0, volume = 0.0;  // [µm³]
  };
  std::map<std::pair<EventKind, std::string>, Exchanges> exchanges;
  for (const auto& [event, text, types] : events_) {
    if (event.kind != EventKind::kPromotion && event.kind != EventKind::kDemotion) continue;
    tell_to_and_fro(event, text);
    Exchanges& one = exchanges[{event.kind, text}];
    ++one.count;
    if (event.exchange) one.room += event.exchange->room, one.later += event.exchange->later, one.volume += event.exchange->volume;
  }
  for (const auto& [what, all] : exchanges) {
    const bool up = what.first == EventKind::kPromotion, one = all.count == 1;
    const char* became =
        up ? (one ? " cell became a shell (" : " cells became shells (") : (one ? " cell became a sphere (" : " cells became spheres (");
    const std::string room = number_text("%.3g um^3", std::abs(all.room)) + " (" +
                             number_text("%.2g %%", 100.0 * std::abs(all.room) / all.volume) + " of " + (one ? "its" : "their") +
                             " volume) " + (up ? "more" : "less") + " room than before" +
                             (all.later > kAll * all.room       ? ", little by little"
                              : all.later > kNothing * all.room ? ", " + number_text("%.3g um^3", all.later) + " of it little by little"
                                                                : "");
    note(Note::Kind::kNote, std::to_string(all.count) + became + what.second + ")" +
                                (all.room != 0.0 && all.volume > 0.0 ? (one ? "; it takes " : "; they take ") + room : ""));
  }
  for (const auto& [event, text, types] : events_)
    if (event.kind == EventKind::kWarning) note(Note::Kind::kWarning, "cell " + event.cell.text() + ": " + text);
}

/// What a cavity held is gone once it is open, and all checks may pass.
void RunLoop::tell_cavities(const Measures& m) {
  constexpr double kLeaks = 0.05;  // of all directions
  const Tissue& tissue = simulation_->tissue();
  std::vector<std::string> open, leaking, hidden;
  for (std::size_t k = 0; k < tissue.lumens.size(); ++k) {
    const Lumen& lumen = study_.model.lumens[k];
    const LumenState& state = tissue.lumens[k];
    if (state.hidden != 0.0) hidden.push_back(lumen.name);
    if (state.looked_at < lumen.from) continue;
    if (state.covered < kBurst)
      open.push_back(lumen.name);
    else if (state.covered < 1.0 - kLeaks)
      leaking.push_back(lumen.name);
  }
  const auto names = [](const std::vector<std::string>& all) {
    return joined(all, [](const std::string& name) { return "'" + name + "'"; });
  };
  const auto columns = [](const std::vector<std::string>& all) {
    return listed(all, [](const std::string& name) { return "open_" + name; }) + " in series.csv";
  };
  if (!open.empty())
    warn_near_limit(kCavityOpen, "open at " + time_text(m.time) + ", and no cavity any more: " + names(open) +
                                     ". More than half of the directions from the centre meet no wall, and the fluid presses nothing (" +
                                     columns(open) + ")");
  if (!leaking.empty())
    warn_near_limit(
        kCavityLeaks,
        "at " + time_text(m.time) +
            " more than a twentieth of the directions from the centre meet no wall of the cavity: " + names(leaking) +
            ". Its fluid presses as if the holes were closed; water would leave through one of some micrometres within seconds (" +
            columns(leaking) + ")");
  if (!hidden.empty())
    warn_near_limit(kCavityHidden, "at " + time_text(m.time) + " a cell lies over the `center` from which a cavity is looked at: " +
                                       names(hidden) + ", and is left out of its walls. If it is one of them, choose another `center`");
}

void RunLoop::tell_creeping(const StepOutcome& outcome) {
  constexpr double kShort = 1e-4;  // of the first step
  constexpr int kMany = 500;
  if (outcome.mechanics.step >= kShort * study_.model.step.initial_step || simulation_->tissue().clock.capped) {
    short_steps_ = 0;
    return;
  }
  if (++short_steps_ != kMany || (warned_ & kCreeping) != 0) return;
  const double left = end_ - simulation_->tissue().clock.time;
  // to the log alone: steps in a row are not counted over a restart
  note(Note::Kind::kWarning, "the last " + std::to_string(kMany) + " steps had " + number_text("%.1g s", outcome.mechanics.step) +
                                 " each, and there are " + time_text(left) +
                                 " to go: something folds or shakes where no longer step is found (see the last snapshot: noise, very "
                                 "strong adhesion or loads, meshes that have lost their shape)");
  warned_ |= kCreeping;
}

void RunLoop::tell_to_and_fro(const Event& event, const std::string& reason) {
  constexpr int kTooOften = 4;
  if (event.kind != EventKind::kPromotion || event.reason.cause != EventReason::Cause::kTrigger) return;
  if (++promotions_[event.cell] != kTooOften) return;
  warn_near_limit(kToAndFro, "cell " + event.cell.text() + " became a shell for the " + std::to_string(kTooOften) +
                                 "th time: what the rule (" + reason +
                                 ") compares is another number for a shell than for a sphere in its place. Put its thresholds farther "
                                 "apart, or give spheres the law of "
                                 "these shells (`morula calibrate`)");
}

/// Elastic spheres are spheres as long as their contacts are small (cbm.md §2), and a fit holds where it was made.
void RunLoop::tell_contacts_beyond(const Measures& m) {
  constexpr double kMostBeyond = 0.1;
  if ((warned_ & kBeyondRange) != 0) return;
  std::string what;
  if (static_cast<double>(m.contacts_beyond) > kMostBeyond * static_cast<double>(m.sphere_contacts))
    what = std::to_string(m.contacts_beyond) + " of " + std::to_string(m.sphere_contacts) +
           " contacts of spheres are outside the range of their law (`contacts_beyond_range` in series.csv): the overlaps it "
           "was fitted to, or else a contact radius of 0.45 R";
  else if (static_cast<double>(m.spheres_outside) > kMostBeyond * static_cast<double>(m.spheres))
    what = std::to_string(m.spheres_outside) + " of " + std::to_string(m.spheres) +
           " spheres are outside the range of their law (`spheres_outside_law` in series.csv), by what they touch, also shells and "
           "obstacles, or by "
           "how tightly they are packed: as shells (`coupling: {triggers: [{outside_law: 1}]}`) they would not be";
  if (what.empty()) return;
  note(Note::Kind::kNote, what);
  warned_ |= kBeyondRange;
}

/// The budget of shells holds for spheres that are to become shells; what a study costs beyond it its user should know.
void RunLoop::tell_shells_beyond_budget(const Measures& m) {
  const std::uint64_t most = study_.model.swaps.max_shells;
  if ((warned_ & kMoreShells) != 0 || static_cast<std::uint64_t>(m.shells) <= most) return;
  const bool founders = m.time == 0.0;
  note(Note::Kind::kNote, std::to_string(m.shells) + " cells are shells, more than `coupling.max_shells` (" + std::to_string(most) +
                              "): " + (founders ? "cells that begin as shells" : "daughters of shells") + " are shells whatever it says");
  warned_ |= kMoreShells;
}

}  // namespace morula::scenarios
