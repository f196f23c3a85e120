// Tissues: what lies outside, how far cells are from where they were measured, and what exchanges of bodies do.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>

#include "core/mesh/convex_hull.h"
#include "scenarios/measures/measures.h"
#include "scenarios/measures/outer_surface.h"
#include "scenarios/measures/point_statistics.h"
#include "scenarios/measures/theories.h"
#include "study/csv.h"
#include "study/initial/cells_from_meshes.h"

namespace morula::scenarios {
namespace {

using Cell = Snapshot::Cell;
constexpr double kExposed = 0.10;   // part of the surface from which a cell counts as exposed
constexpr double kWindow = 1200.0;  // [s]

/// The one CSV file that the study's cells come from; null where they do not.
const InitialCells* csv_of(const Study& study) {
  return study.initial.size() == 1 && study.initial.front().source == InitialCells::Source::kCsv ? &study.initial.front() : nullptr;
}

Status needs_csv(const Study& study, const Subject&) {
  return csv_of(study) != nullptr ? Status{} : Status(Error{ErrorKind::kInput, "needs all cells from one CSV file", ""});
}

Result<std::vector<CsvCell>> rows_of(const Study& study) {
  std::vector<std::string> names;
  for (const CellType& type : study.model.types) names.push_back(type.name);
  Diagnostics diagnostics;
  const InitialCells& initial = *csv_of(study);
  auto csv = read_cells_csv(initial.csv_path, initial.csv_path, names, {}, UnitSystem(), diagnostics, initial.csv_unit);
  if (!csv) return diagnostics.as_error();
  return std::move(csv->cells);
}

Measure of_cells(const char* name, const char* title, const char* doc, const char* formula, Quantity quantity) {
  return {name, title, doc, formula, "physics/scenarios.md S18", quantity, MeasureOf::kCells};
}

/// Groups of rows at one place, counted by comparing all, that no line of the log names.
Measure unnamed_groups_measure() {
  Measure out{"places.unnamed_groups",
              "groups of coincident cells in the CSV file that the log does not name",
              "Number of groups of rows of the CSV file at one place, less those that the log names.",
              "",
              "physics/scenarios.md S18",
              Quantity::kNumber,
              MeasureOf::kRun};
  out.fits = &needs_csv;
  out.take = [](FinishedRun& run, const Subject&, const Moments&) -> Result<std::vector<Sample>> {
    MORULA_TRY_ASSIGN(const auto rows, rows_of(run.study()));
    double groups = 0.0, named = 0.0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      bool first = true, more = false;
      for (std::size_t j = 0; j < rows.size(); ++j) {
        if (j == i || !(rows[j].position == rows[i].position)) continue;
        if (j < i) first = false;
        if (j > i) more = true;
      }
      groups += first && more;
    }
    for (const std::string& note : run.study().notes) named += note.find("lie at the same place") != std::string::npos;
    return std::vector<Sample>{{0.0, groups - named, ""}};
  };
  return out;
}

/// Centres of the founders that are still there, and where the file has them.
Measure places_measure() {
  Measure out{
      "places.rms",
      "root mean square way of the cells from the places of the file",
      "Distance of the cells' centres from where the CSV file has them, root mean square, after the rigid motion that makes it least.",
      "min over t, R of rms(R x + t - x_file)",
      "Horn 1987, doi:10.1364/JOSAA.4.000629",
      Quantity::kLength,
      MeasureOf::kRun};
  out.fits = &needs_csv;
  out.take = [](FinishedRun& run, const Subject& subject, const Moments& moments) -> Result<std::vector<Sample>> {
    MORULA_TRY_ASSIGN(const auto rows, rows_of(run.study()));
    return by_snapshot([&](const Study&, const Snapshot& snapshot, const Subject&) -> std::optional<double> {
      std::vector<Vec3d> measured, now;
      for (const Cell& cell : snapshot.cells) {
        const std::uint64_t number = cell.id.founder_number();
        if (number == 0 || number > rows.size()) continue;
        measured.push_back(rows[number - 1].position);
        now.push_back(cell.centroid);
      }
      return now.empty() ? std::nullopt : std::optional(rms_after_rigid_motion(measured, now));
    })(run, subject, moments);
  };
  return out;
}

Measure order_measure() {
  Measure out = of_cells("outer.order", "cells lie outside the others (depth below the hull, Mann-Whitney p)",
                         "One-sided p of the test that the cells of a type lie less deep below the convex hull of all centres than the "
                         "others.",
                         "", Quantity::kNumber);
  out.source = "Mann & Whitney 1947, doi:10.1214/aoms/1177730491";
  out.take = by_snapshot([](const Study&, const Snapshot& snapshot, const Subject& subject) -> std::optional<double> {
    std::vector<Vec3d> centres;
    std::vector<double> outer, inner;
    for (const Cell& cell : snapshot.cells) centres.push_back(cell.centroid);
    const auto hull = convex_hull(centres);
    if (!hull) return std::nullopt;
    for (const Cell& cell : snapshot.cells) (is_meant(cell, subject) ? outer : inner).push_back(hull->depth(cell.centroid));
    return outer.empty() || inner.empty() ? std::nullopt : std::optional(mann_whitney_p(outer, inner));
  });
  return out;
}

/// A value of each cell made of the part of its surface that a ball can touch from outside.
Measure of_outside(const char* name, const char* title, const char* doc, Quantity quantity, double (*value)(double part)) {
  Measure out = of_cells(name, title, doc, "", quantity);
  out.source = "Richards 1977, doi:10.1146/annurev.bb.06.060177.001055";
  out.take = [value](FinishedRun& run, const Subject& subject, const Moments& moments) -> Result<std::vector<Sample>> {
    MORULA_TRY_ASSIGN(const std::vector<double>* const times, run.snapshot_times());
    const InitialCells& start = run.study().initial.front();
    std::vector<Sample> found;
    for (const std::size_t index : moments.among(*times)) {
      MORULA_TRY_ASSIGN(const auto snapshot, run.snapshot(index));
      double volume = 0.0;
      for (const Cell& cell : snapshot->cells) volume += cell.volume;
      const double radius = std::cbrt(0.75 / std::numbers::pi * volume / static_cast<double>(snapshot->cells.size()));
      const auto parts = outer_surface_fractions(*snapshot, radius, {start.cavity_center, start.cavity_radius});
      for (std::size_t i = 0; i < parts.size(); ++i)
        if (is_meant(snapshot->cells[i], subject)) found.push_back({snapshot->time, value(parts[i]), snapshot->cells[i].id.text()});
    }
    return found;
  };
  return out;
}

Measure ids_measure() {
  Measure out{
      "ids_changed",     "ids that came or went", "Number of cells that are there and were not at time 0, or the other way round.", "", "",
      Quantity::kNumber, MeasureOf::kRun};
  out.take = [](FinishedRun& run, const Subject& subject, const Moments& moments) -> Result<std::vector<Sample>> {
    MORULA_TRY_ASSIGN(const auto first, run.start());
    if (first == nullptr) return std::vector<Sample>();
    std::set<CellId> start;
    for (const Cell& cell : first->cells) start.insert(cell.id);
    return by_snapshot([&](const Study&, const Snapshot& snapshot, const Subject&) -> std::optional<double> {
      std::size_t kept = 0;
      for (const Cell& cell : snapshot.cells) kept += start.contains(cell.id);
      return static_cast<double>(start.size() - kept + snapshot.cells.size() - kept);
    })(run, subject, moments);
  };
  return out;
}

/// Volume that a cell has when nothing presses it: the ball of a sphere, that of V0 = V exp(p_in/K_V) of a shell [µm³].
double free_volume(const Cell& cell, const CellType& type) {
  if (cell.body == BodyKind::kSphere || type.osmosis.acts()) return cell.volume;
  return target_volume_of(cell.volume, cell.inner_pressure, type.shell.tension, type.shell.bulk_modulus);
}

/// Of each cell that has another body than at the output before.
Measure exchange_measure() {
  Measure out = of_cells(
      "exchange.volume_change", "free volume of the cells just exchanged, relative change",
      "Change since the output before of the volume that a cell has when nothing presses it, of the cells that have got another body "
      "since: of a sphere its ball, of a shell that of its V0 = V exp(p_in/K_V) at the tension of its type; where cells follow their "
      "water, the volume of the body. What a new shell among shells takes little by little (`room_later_um3` in events.jsonl) counts as "
      "its own.",
      "|(V_free + V_later)/V_free,before - 1|", Quantity::kFraction);
  out.take = [](FinishedRun& run, const Subject& subject, const Moments& moments) -> Result<std::vector<Sample>> {
    MORULA_TRY_ASSIGN(const std::vector<double>* const times, run.snapshot_times());
    MORULA_TRY_ASSIGN(const std::vector<EventLine>* const events, run.events());
    std::vector<Sample> found;
    for (const std::size_t index : moments.among(*times)) {
      if (index == 0) continue;
      std::map<std::string, double> later;
      for (const EventLine& event : *events)
        if (event.exchange && event.time > (*times)[index - 1] && event.time <= (*times)[index]) later[event.cell] += event.exchange->later;
      MORULA_TRY_ASSIGN(const auto before, run.snapshot(index - 1));
      MORULA_TRY_ASSIGN(const auto now, run.snapshot(index));
      std::map<CellId, const Cell*> then;
      for (const Cell& cell : before->cells) then.emplace(cell.id, &cell);
      for (const Cell& cell : now->cells)
        if (const auto same = then.find(cell.id); same != then.end() && is_meant(cell, subject) && cell.body != same->second->body) {
          const CellType& type = run.study().model.types[cell.type];
          const double change = (free_volume(cell, type) + later[cell.id.text()]) / free_volume(*same->second, type) - 1.0;
          found.push_back({now->time, std::abs(change), cell.id.text()});
        }
    }
    return found;
  };
  return out;
}

/// The output at a time.
std::optional<std::size_t> output_at(const std::vector<double>& times, double time) {
  const auto at = std::ranges::find_if(times, [time](double t) { return std::abs(t - time) < 1e-6 * kWindow; });
  return at == times.end() ? std::nullopt : std::optional(static_cast<std::size_t>(at - times.begin()));
}

/// What a cell goes on beyond its drift. At an output of an exchange the cell has its new body, and nobody has moved yet.
Measure jump_measure() {
  Measure out = of_cells(
      "motion.beyond_drift", "way of a cell in 20 min, beyond its drift",
      "Way of a cell's centre in the 20 min after an output, less what it would go on as in the 20 min before; of outputs that have "
      "another one 20 min before and after.",
      "|x(t + w) - x(t) - (x(t) - x(t - w))|, w = 20 min", Quantity::kLength);
  out.take = [](FinishedRun& run, const Subject& subject, const Moments& moments) -> Result<std::vector<Sample>> {
    MORULA_TRY_ASSIGN(const std::vector<double>* const times, run.snapshot_times());
    const Space& space = run.study().model.space;
    std::vector<Sample> found;
    for (const std::size_t at : moments.among(*times)) {
      const double time = (*times)[at];
      const std::optional<std::size_t> before = output_at(*times, time - kWindow), after = output_at(*times, time + kWindow);
      if (!before || !after) continue;
      MORULA_TRY_ASSIGN(const auto past, run.snapshot(*before));
      MORULA_TRY_ASSIGN(const auto now, run.snapshot(at));
      MORULA_TRY_ASSIGN(const auto later, run.snapshot(*after));
      std::map<CellId, Vec3d> start, earlier;
      for (const Cell& cell : now->cells) start[cell.id] = cell.centroid;
      for (const Cell& cell : past->cells) earlier[cell.id] = cell.centroid;
      for (const Cell& cell : later->cells) {
        if (!is_meant(cell, subject) || !start.contains(cell.id) || !earlier.contains(cell.id)) continue;
        const Vec3d drift = space.nearest_image(start[cell.id] - earlier[cell.id]);
        found.push_back({time, norm(space.nearest_image(cell.centroid - start[cell.id]) - drift), cell.id.text()});
      }
    }
    return found;
  };
  out.fits = [](const Study& study, const Subject&) -> Status {
    const double outputs = kWindow / study.time.output;
    if (std::abs(outputs - std::round(outputs)) < 1e-6 && study.time.end > 2.0 * kWindow * (1.0 - 1e-6)) return {};
    return Error{ErrorKind::kInput, "needs outputs 20 min before and after one",
                 "`time.output` of 20 min or a part of it, and `time.end` of 40 min at least"};
  };
  return out;
}

}  // namespace

std::vector<Measure> tissue_measures() {
  return {
      unnamed_groups_measure(),
      places_measure(),
      of_outside("outer.touched", "part of a cell's surface that a ball touches from outside",
                 "Part of the surface of a cell that a ball of a cell's mean size touches as it rolls over the tissue, outside of the "
                 "cavity that the study names.",
                 Quantity::kFraction, [](double part) { return part; }),
      of_outside("outer.hidden", "cells that a ball of a cell's size, rolling outside, does not touch",
                 "1 for a cell that such a ball touches nowhere, else 0.", Quantity::kNumber,
                 [](double part) { return part == 0.0 ? 1.0 : 0.0; }),
      of_outside("outer.exposed", "cells that a ball of a cell's size, rolling outside, touches on more than 10 % of their surface",
                 "1 for a cell that such a ball touches on more than a tenth of its surface, else 0.", Quantity::kNumber,
                 [](double part) { return part > kExposed ? 1.0 : 0.0; }),
      order_measure(),
      ids_measure(),
      cell_measure("is_shell", "cells that are shells", "1 for a cell that is a shell, 0 for a sphere.", Quantity::kNumber,
                   [](const Snapshot&, const Cell& cell, const ShellView*) { return cell.body == BodyKind::kShell ? 1.0 : 0.0; }),
      exchange_measure(),
      jump_measure(),
  };
}

Theory hull_volume() {
  return {"hull_volume",
          "the volume of the hull",
          "Cells that share the volume within the hull of the places of a CSV file: what `volume_from_hull` gives each of them.",
          "N V_hull/N(0)",
          "physics/scenarios.md S18",
          {"total_volume"},
          [](const Study& study, const Subject&, const std::string&) {
            return csv_of(study) != nullptr && !csv_of(study)->room.empty()
                       ? Status{}
                       : Status(Error{ErrorKind::kInput, "needs all cells from one CSV file, with `volume_from_hull`", ""});
          },
          [](FinishedRun& run, const Subject&, const std::string&, const Sample& sample) -> Result<double> {
            MORULA_TRY_ASSIGN(const auto snapshot, run.snapshot_at(sample.time));
            if (snapshot == nullptr) return std::nan("");
            const std::vector<double>& room = csv_of(run.study())->room;
            return std::accumulate(room.begin(), room.end(), 0.0) * static_cast<double>(snapshot->cells.size()) /
                   static_cast<double>(room.size());
          }};
}

}  // namespace morula::scenarios
