// A cell of cortical tension alone between two plates, against the drop that does not wet them.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/ball.h"
#include "scenarios/measures/elastic_cap.h"
#include "scenarios/measures/holds.h"
#include "scenarios/measures/measures.h"
#include "scenarios/measures/shape_measures.h"
#include "scenarios/measures/single_cell.h"
#include "scenarios/measures/theories.h"
#include "scenarios/measures/theory.h"

namespace morula::scenarios {
namespace {

/// A cell at rest between the plates.
struct Pressing {
  double time = 0.0;         ///< [s]
  double height = 0.0;       ///< of the cell over R0
  double force = 0.0;        ///< on the moving plate over γ R0
  double force_error = 0.0;  ///< against the drop, over the larger of it and γ R0
  double balance = 0.0;      ///< sum of the forces on both plates, over the larger of one and γ R0
  double tension = 0.0;      ///< from force, pressure and equator, over γ
};

/// The plate that moves, and the other.
struct Plates {
  const ObstacleSpec *moving = nullptr, *other = nullptr;
};

Plates plates_of(const Model& model) {
  if (model.obstacles.size() != 2) return {};
  for (std::size_t i = 0; i < 2; ++i)
    if (!model.obstacles[i].distance.empty()) return {&model.obstacles[i], &model.obstacles[1 - i]};
  return {};
}

std::vector<std::string> plate_columns(const Study& study, const Subject&) {
  const Plates plates = plates_of(study.model);
  if (plates.moving == nullptr) return {};
  return {"force_z_" + plates.moving->name, "force_z_" + plates.other->name};
}

/// The states in which the moving plate rests and touches the cells of the first type.
Result<std::vector<Pressing>> pressings(FinishedRun& run, const Moments& moments) {
  const Model& model = run.study().model;
  const Plates plates = plates_of(model);
  std::vector<Pressing> out;
  if (plates.moving == nullptr) return out;
  MORULA_TRY_ASSIGN(const std::vector<double>* const times, run.snapshot_times());
  const std::vector<std::size_t> wanted = moments.among(*times);
  for (const Hold& hold : holds_of(plates.moving->distance, *times)) {
    if (std::find(wanted.begin(), wanted.end(), hold.output) == wanted.end()) continue;
    const Moments here{Moments::Kind::kBetween, hold.time, hold.time};
    const auto columns = plate_columns(run.study(), {});
    MORULA_TRY_ASSIGN(const auto forces, by_row(run, columns, here, [](double, const std::vector<double>& row) { return row[0]; }));
    MORULA_TRY_ASSIGN(const auto opposite, by_row(run, columns, here, [](double, const std::vector<double>& row) { return row[1]; }));
    if (forces.empty() || opposite.empty() || !(std::abs(forces[0].value) > 1e-6)) continue;  // not yet touched, or no such column
    MORULA_TRY_ASSIGN(const auto snapshot, run.snapshot(hold.output));
    for (const ShellView& shell : shells_of(*snapshot, 0)) {
      const double force = forces[0].value, r0 = ball_radius(shell.cell->volume), gamma = tension_at(model.types[0], hold.time);
      Pressing p;
      p.time = hold.time;
      p.height = extent(shell.nodes, {0, 0, 1}) / r0;
      p.force = std::abs(force) / (gamma * r0);
      p.balance = std::abs(force + opposite[0].value) / std::max(std::abs(force), gamma * r0);
      const double expected = theory::pressed_drop(p.height).force;
      p.force_error = std::abs(p.force - expected) / std::max(1.0, expected);
      const double b = 0.25 * (extent(shell.nodes, {1, 0, 0}) + extent(shell.nodes, {0, 1, 0}));
      const double pressure = shell.cell->inner_pressure, contact = std::abs(force) / (std::numbers::pi * pressure);  // a²
      p.tension = pressure * (b * b - contact) / (2.0 * b) / gamma;
      out.push_back(p);
    }
  }
  return out;
}

Measure plate_measure(const char* name, const char* title, const char* doc, const char* formula, double Pressing::*value) {
  Measure out{name, title, doc, formula, "Fischer-Friedrich et al. 2014, doi:10.1038/srep06213", Quantity::kNumber, MeasureOf::kRun};
  out.fits = [](const Study& study, const Subject&) -> Status {
    if (plates_of(study.model).moving != nullptr && study.model.types[0].shell.tension > 0.0) return {};
    return Error{ErrorKind::kInput,
                 "needs two obstacles, one of which has a `motion` with a `course`, and a first cell type with a tension", ""};
  };
  out.columns = &plate_columns;
  out.take = [value](FinishedRun& run, const Subject&, const Moments& moments) -> Result<std::vector<Sample>> {
    MORULA_TRY_ASSIGN(const auto all, pressings(run, moments));
    std::vector<Sample> found;
    for (const Pressing& p : all) found.push_back({p.time, p.*value, ""});
    return found;
  };
  return out;
}

}  // namespace

std::vector<Measure> plate_measures() {
  Measure states = plate_measure("plates.states", "states at rest between the plates",
                                 "Number of the holds of the moving plate in which it touches the cell.", "", &Pressing::time);
  states.take = [](FinishedRun& run, const Subject&, const Moments& moments) -> Result<std::vector<Sample>> {
    MORULA_TRY_ASSIGN(const auto all, pressings(run, moments));
    return std::vector<Sample>{{moments.until, static_cast<double>(all.size()), ""}};
  };
  return {
      states,
      plate_measure("plates.height", "height over R0", "Height of a cell at rest between two plates, over R0 of its volume.", "h/R0",
                    &Pressing::height),
      plate_measure("plates.force", "force over tension times R0", "Force on the moving plate at rest, over tension times R0.",
                    "|F|/(T R0)", &Pressing::force),
      plate_measure("plates.force_error", "force on the plate against the pressed drop, over the larger of it and tension times R0",
                    "Difference of that force from that of the pressed drop, over the larger of the drop's and tension times R0.",
                    "|F - F_drop|/max(F_drop, T R0)", &Pressing::force_error),
      plate_measure("plates.tension", "tension found from force, pressure and equator, over the cell's",
                    "Tension that force, pressure p and radius b of the equator ask for, over that of the cortex.",
                    "p (b^2 - a^2)/(2 b)/T, F = pi a^2 p", &Pressing::tension),
      plate_measure("plates.balance", "sum of the forces on both plates, over the larger of one and tension times R0",
                    "Sum of the forces on both plates, over the larger of one of them and tension times R0.", "|F1 + F2|/max(|F1|, T R0)",
                    &Pressing::balance),
  };
}

Theory pressed_drop_theory() {
  return {"pressed_drop",
          "pressed drop",
          "A drop with a surface tension T between two plates that it does not wet, its volume held, by its height.",
          "r sin(psi) = (p/(2 T)) (r^2 - a^2), p = 2 T b/(b^2 - a^2), F = pi a^2 p",
          "Fischer-Friedrich et al. 2014, doi:10.1038/srep06213",
          {"plates.force"},
          [](const Study&, const Subject&, const std::string&) { return Status{}; },
          [](FinishedRun& run, const Subject&, const std::string&, const Sample& sample) -> Result<double> {
            MORULA_TRY_ASSIGN(const auto found, pressings(run, {Moments::Kind::kBetween, sample.time, sample.time}));
            return found.empty() ? std::nan("") : theory::pressed_drop(found.front().height).force;
          }};
}

}  // namespace morula::scenarios
