// Cells that grips draw off each other and off obstacles.
#include <cmath>
#include <numbers>

#include "scenarios/measures/elastic_cap.h"
#include "scenarios/measures/measures.h"
#include "scenarios/measures/pulled_contact.h"
#include "scenarios/measures/theories.h"
#include "scenarios/measures/theory.h"

namespace morula::scenarios {
namespace {

const CellLoad& load_of(const Study& study, const Subject& subject) { return study.model.loads[static_cast<std::size_t>(subject.load)]; }

bool draws(const CellLoad& load) { return load.what == grip_load() && !load.way.empty(); }

Status needs_way(const Study& study, const Subject& subject) {
  return draws(load_of(study, subject)) ? Status{} : Status(Error{ErrorKind::kInput, "needs a grip with a `way`", ""});
}

Measure of_pull(const char* name, const char* title, const char* doc, const char* formula, Quantity quantity) {
  Measure out{name, title, doc, formula, "physics/scenarios.md S5", quantity, MeasureOf::kLoad};
  out.fits = &needs_way;
  out.columns = [](const Study& study, const Subject& subject) { return pulled_contact_columns(study, load_of(study, subject)); };
  return out;
}

/// One value of the whole way back, told when the way ends.
Measure of_whole_pull(const char* name, const char* title, const char* doc, const char* formula, Quantity quantity,
                      Result<double> (*value)(FinishedRun&, const CellLoad&, const PulledContact&)) {
  Measure out = of_pull(name, title, doc, formula, quantity);
  out.take = [value](FinishedRun& run, const Subject& subject, const Moments& moments) -> Result<std::vector<Sample>> {
    const CellLoad& load = load_of(run.study(), subject);
    MORULA_TRY_ASSIGN(const auto pulled, pulled_contact(run, load));
    std::vector<Sample> found;
    if (!pulled || moments.among({pulled->time.back()}).empty()) return found;
    MORULA_TRY_ASSIGN(const double one, value(run, load, *pulled));
    found.push_back({pulled->time.back(), one, ""});
    return found;
  };
  return out;
}

/// What the curve itself tells.
template <double PulledContact::*kValue>
Result<double> of_curve(FinishedRun&, const CellLoad&, const PulledContact& pulled) {
  return pulled.*kValue;
}

/// A value at each output while the grip goes back.
Measure over_way_back(const char* name, const char* title, const char* doc, const char* formula, Quantity quantity,
                      std::vector<double> PulledContact::*values) {
  Measure out = of_pull(name, title, doc, formula, quantity);
  out.take = [values](FinishedRun& run, const Subject& subject, const Moments& moments) -> Result<std::vector<Sample>> {
    MORULA_TRY_ASSIGN(const auto pulled, pulled_contact(run, load_of(run.study(), subject)));
    std::vector<Sample> found;
    if (!pulled) return found;
    for (const std::size_t i : moments.among(pulled->time)) found.push_back({pulled->time[i], ((*pulled).*values)[i], ""});
    return found;
  };
  return out;
}

Measure pairs_measure() {
  Measure out{"pull_off.pairs",
              "pairs that were pulled apart",
              "Number of grips that draw a cell off another one or off an obstacle, as series.csv shows.",
              "",
              "",
              Quantity::kNumber,
              MeasureOf::kRun};
  out.columns = [](const Study& study, const Subject&) {
    std::vector<std::string> columns;
    for (const CellLoad& load : study.model.loads)
      if (draws(load))
        for (std::string& column : pulled_contact_columns(study, load)) columns.push_back(std::move(column));
    return columns;
  };
  out.take = [](FinishedRun& run, const Subject&, const Moments& moments) -> Result<std::vector<Sample>> {
    double count = 0.0, time = 0.0;
    for (const CellLoad& load : run.study().model.loads) {
      if (!draws(load)) continue;
      MORULA_TRY_ASSIGN(const auto pulled, pulled_contact(run, load));
      if (!pulled || moments.among({pulled->time.back()}).empty()) continue;
      time = std::max(time, pulled->time.back());
      count += 1.0;
    }
    return std::vector<Sample>{{time, count, ""}};
  };
  return out;
}

}  // namespace

std::vector<Measure> pull_off_measures() {
  return {
      pairs_measure(),
      over_way_back("pull_off.way", "way of the grip since it turned",
                    "Way of the grip since it began to go back, at each output until it stops.", "", Quantity::kLength,
                    &PulledContact::way),
      over_way_back("pull_off.pull", "pull on the contact",
                    "Pull on the contact while the grip goes back: of two cells the force of the grip that holds the other one, on an "
                    "obstacle that of the grip less the drag of a ball at its speed.",
                    "", Quantity::kForce, &PulledContact::pull),
      of_whole_pull("pull_off.force", "pull-off force", "Largest pull on the contact while the grip goes back.", "F* = max F",
                    Quantity::kForce, &of_curve<&PulledContact::peak>),
      of_whole_pull("pull_off.reduced_force", "pull-off force over W R",
                    "Pull-off force over adhesion times radius of a ball of the cell's volume.", "F*/(W R)", Quantity::kNumber,
                    [](FinishedRun& run, const CellLoad& load, const PulledContact& p) -> Result<double> {
                      MORULA_TRY_ASSIGN(const double radius, radius_at_end(run, load));
                      return p.peak / (p.adhesion * radius);
                    }),
      of_whole_pull("pull_off.left", "force after separation over the pull-off force",
                    "Largest force in the last three outputs of the way back over the pull-off force.", "max |F|/F*", Quantity::kNumber,
                    &of_curve<&PulledContact::left>),
      of_whole_pull("pull_off.contact_radius", "contact radius in the last picture before separation",
                    "Radius of a disc of the contact area in the last snapshot in which the cell touches anything.", "sqrt(A/pi)",
                    Quantity::kLength, &last_contact_radius),
      of_whole_pull("pull_off.speed", "speed of the grip", "Speed of the grip as it goes back.", "", Quantity::kSpeed,
                    &of_curve<&PulledContact::speed>),
      of_whole_pull("pull_off.adhesion", "adhesion", "Adhesion of the cell to what it is pulled off, as the study gives it.", "W",
                    Quantity::kTension, &of_curve<&PulledContact::adhesion>),
      of_whole_pull("pull_off.range", "range of the contact", "Range of the contact that is pulled off, as the study gives it.", "c",
                    Quantity::kLength, &of_curve<&PulledContact::range>),
  };
}

Theory fluid_pull_off() {
  return {"fluid_pull_off",
          "the theory of a fluid cortex",
          "Largest force that the contact of a cell bears whose cortex has a tension T and no elasticity: at a finite radius, for surfaces "
          "that attract at contact only; p is the pressure in the cell then.",
          "F* = pi T^2 sin(angle)^2/p; cos(angle) = 1 - W/(2 T) of two cells, 1 - W/T on an obstacle",
          "physics/dcm.md §8",
          {"pull_off.force"},
          [](const Study& study, const Subject& s, const std::string&) {
            return study.model.types[load_of(study, s).type].shell.tension > 0.0
                       ? Status{}
                       : Status(Error{ErrorKind::kInput, "needs cells with a cortical tension", ""});
          },
          [](FinishedRun& run, const Subject& s, const std::string&, const Sample&) -> Result<double> {
            const CellLoad& load = load_of(run.study(), s);
            MORULA_TRY_ASSIGN(const auto pulled, pulled_contact(run, load));
            if (!pulled) return std::nan("");
            MORULA_TRY_ASSIGN(const double pressure, pressure_at_peak(run, load, *pulled));
            const double tension = tension_at(run.study().model.types[load.type], pulled->peak_time);
            const double angle = theory::cap_of_angle(1.0 - pulled->adhesion / ((pulled->on_obstacle ? 1.0 : 2.0) * tension)).angle;
            return std::numbers::pi * tension * tension * std::pow(std::sin(angle), 2) / pressure;
          }};
}

}  // namespace morula::scenarios
