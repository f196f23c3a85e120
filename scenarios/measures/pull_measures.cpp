// Cells pulled at two poles.
#include <cmath>

#include "scenarios/measures/measures.h"
#include "scenarios/measures/pulled_cell.h"

namespace morula::scenarios {
namespace {

const CellLoad& load_of(const Study& study, const Subject& subject) { return study.model.loads[static_cast<std::size_t>(subject.load)]; }

Measure of_pull(const char* name, const char* title, const char* doc, const char* formula, Quantity quantity,
                double (*value)(const PulledCell&)) {
  Measure out{name, title, doc, formula, "physics/scenarios.md S2", quantity, MeasureOf::kLoad};
  out.fits = [](const Study& study, const Subject& subject) -> Status {
    return load_of(study, subject).what == pull_load() ? Status{} : Status(Error{ErrorKind::kInput, "needs a pull at two poles", ""});
  };
  out.take = [value](FinishedRun& run, const Subject& subject, const Moments& moments) -> Result<std::vector<Sample>> {
    MORULA_TRY_ASSIGN(const auto states, pulled_cell(run, load_of(run.study(), subject), moments));
    std::vector<Sample> found;
    for (const PulledCell& one : states) found.push_back({one.time, value(one), ""});
    return found;
  };
  return out;
}

Measure recovery_measure() {
  Measure out = of_pull("pull.recovery_difference", "length over width in recovery against four measured cells, one viscosity fitted",
                        "Largest difference of length over width, after the pull ends, from four red blood cells that were measured as "
                        "they went back. One viscosity, a factor on the time, is fitted to the first of them; half of what was measured "
                        "of each must be in reach.",
                        "max |L/W - (L/W)_measured|", Quantity::kNumber, nullptr);
  out.source = "Hochmuth, Worthy & Evans 1979, Biophys. J. 26:101; scenarios/library/optical_tweezers/rbc_shape_recovery.csv";
  out.take = [](FinishedRun& run, const Subject& subject, const Moments&) -> Result<std::vector<Sample>> {
    const CellLoad& load = load_of(run.study(), subject);
    std::vector<Sample> found;
    if (load.course.empty() || load.course.value.back() != 0.0) return found;
    const Moments after{Moments::Kind::kBetween, load.course.time.back() * (1.0 - 1e-12), run.study().time.end * 2.0};
    MORULA_TRY_ASSIGN(const auto states, pulled_cell(run, load, after));
    if (states.size() > 3) found.push_back({states.back().time, fit_recovery(states).largest, ""});
    return found;
  };
  return out;
}

}  // namespace

Result<std::vector<PulledCell>> pulled_cell(FinishedRun& run, const CellLoad& load, const Moments& moments) {
  const Vec3d away = std::abs(load.axis.z) < 0.9 ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0};
  const Vec3d side = normalized(cross(away, load.axis));
  MORULA_TRY_ASSIGN(const std::vector<double>* const times, run.snapshot_times());
  std::vector<PulledCell> out;
  for (const std::size_t index : moments.among(*times)) {
    MORULA_TRY_ASSIGN(const auto snapshot, run.snapshot(index));
    const auto cells = shells_of(*snapshot, load.type);
    if (!cells.empty()) out.push_back({snapshot->time, extent(cells[0].nodes, load.axis), extent(cells[0].nodes, side)});
  }
  return out;
}

std::vector<Measure> pull_measures() {
  return {
      of_pull("pull.length", "axial diameter", "Extent of the first cell of a pull along its axis.", "", Quantity::kLength,
              [](const PulledCell& c) { return c.length; }),
      of_pull("pull.width", "transverse diameter", "Extent of the first cell of a pull across its axis.", "", Quantity::kLength,
              [](const PulledCell& c) { return c.width; }),
      of_pull("pull.aspect", "length over width", "Extent of the first cell of a pull along its axis over that across it.", "L/W",
              Quantity::kNumber, [](const PulledCell& c) { return c.length / c.width; }),
      recovery_measure(),
  };
}

}  // namespace morula::scenarios
