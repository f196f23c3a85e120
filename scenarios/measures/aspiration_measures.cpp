// Cells sucked into pipettes.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/ball.h"
#include "coupling/loads/loads.h"
#include "scenarios/measures/elastic_cap.h"
#include "scenarios/measures/holds.h"
#include "scenarios/measures/measures.h"
#include "scenarios/measures/theories.h"
#include "scenarios/measures/theory.h"

namespace morula::scenarios {
namespace {

const CellLoad& load_of(const Study& study, const Subject& subject) { return study.model.loads[static_cast<std::size_t>(subject.load)]; }
const CellType& type_of(const Study& study, const CellLoad& load) { return study.model.types[load.type]; }
bool sucks(const CellLoad& load) { return load.what == pressure_load() && load.within; }
double suction_at(const CellLoad& load, double time) { return -load.size * load.course.at(time); }

/// Where a point lies from the axis of the cylinder under suction.
struct FromAxis {
  double along = 0.0, radius = 0.0;  ///< from the plane of the mouth [µm]; from the axis [µm]
};
FromAxis from_axis(const CellLoad& load, const Vec3d& x) {
  const Vec3d axis = normalized(load.high_end - load.low_end), from = x - load.low_end;
  const double along = dot(from, axis);
  return {along, norm(from - axis * along)};
}

struct Mouth {
  double radius = 0.0, throat = 0.0;  ///< of the narrowest place [µm]; its distance from the plane of the mouth [µm]
  double lip = 0.0, edge = 0.0;  ///< radius of the circle that the glass begins with [µm]; its distance from the plane of the mouth [µm]
};

/// The obstacle around the axis of a load: the one whose nodes come nearest to it without lying on it.
Mouth mouth_of(const Model& model, const CellLoad& load) {
  Mouth best;
  for (const ObstacleSpec& obstacle : model.obstacles) {
    Mouth here{1e300, 1e300, 0.0, 1e300};
    for (const Vec3d& x : obstacle.position) {
      const auto [along, radius] = from_axis(load, x);
      if (radius < here.radius - 1e-9) here.radius = radius, here.throat = along;
      if (radius < here.radius + 1e-9) here.throat = std::min(here.throat, along);
      if (along > here.edge + 1e-9) continue;
      here.lip = along < here.edge - 1e-9 ? radius : std::min(here.lip, radius);
      here.edge = std::min(here.edge, along);
    }
    if (best.radius == 0.0 || here.radius < best.radius) best = here;
  }
  return best;
}

/// How far the cell reaches beyond the narrowest place [µm].
double tongue(const ShellView& shell, const CellLoad& load, const Mouth& mouth) {
  double tip = 0.0;
  for (const Vec3d& x : shell.nodes)
    if (lies_within(load, x)) tip = std::max(tip, from_axis(load, x).along);
  return std::max(0.0, tip - mouth.throat);
}

/// Area of the faces that bear the suction; `outside`: of those that lie before the glass or beside its first circle [µm²].
double sucked_area(const ShellView& shell, const CellLoad& load, const Mouth& mouth, bool outside) {
  double out = 0.0;
  for (const Triangle& t : shell.faces) {
    const Vec3d &a = shell.nodes[t[0]], &b = shell.nodes[t[1]], &c = shell.nodes[t[2]], at = (a + b + c) * (1.0 / 3.0);
    if (!lies_within(load, at)) continue;
    const auto [along, radius] = from_axis(load, at);
    if (!outside || along < mouth.edge || radius > mouth.lip) out += 0.5 * norm(cross(b - a, c - a));
  }
  return out;
}

/// The first cell of a load at an output, and what it is compared with.
struct Aspirated {
  const CellLoad& load;
  const Mouth& mouth;
  ShellView now, start, before;   ///< at the output, at time 0, at the output before
  double time = 0.0, last = 0.0;  ///< of the output and the one before [s]
};

Measure of_suction(const char* name, const char* title, const char* doc, const char* formula, Quantity quantity) {
  Measure out{name, title, doc, formula, "physics/scenarios.md S3", quantity, MeasureOf::kLoad};
  out.fits = [](const Study& study, const Subject& subject) -> Status {
    if (sucks(load_of(study, subject)) && !study.model.obstacles.empty()) return {};
    return Error{ErrorKind::kInput, "needs a pressure `within` a cylinder, and the glass as an obstacle", ""};
  };
  return out;
}

/// A value of the cell at each output after time 0.
Measure at_outputs(const char* name, const char* title, const char* doc, const char* formula, Quantity quantity,
                   double (*value)(const Aspirated&)) {
  Measure out = of_suction(name, title, doc, formula, quantity);
  out.take = [value](FinishedRun& run, const Subject& subject, const Moments& moments) -> Result<std::vector<Sample>> {
    const CellLoad& load = load_of(run.study(), subject);
    const Mouth mouth = mouth_of(run.study().model, load);
    MORULA_TRY_ASSIGN(const std::vector<double>* const times, run.snapshot_times());
    std::vector<Sample> found;
    MORULA_TRY_ASSIGN(const auto first, run.start());
    if (first == nullptr) return found;
    const auto start = shells_of(*first, load.type);
    for (const std::size_t index : moments.among(*times)) {
      if (index == 0) continue;
      MORULA_TRY_ASSIGN(const auto last, run.snapshot(index - 1));
      MORULA_TRY_ASSIGN(const auto snapshot, run.snapshot(index));
      const auto now = shells_of(*snapshot, load.type), before = shells_of(*last, load.type);
      if (now.empty() || start.empty() || before.empty()) continue;
      found.push_back({snapshot->time, value({load, mouth, now[0], start[0], before[0], snapshot->time, last->time}), ""});
    }
    return found;
  };
  return out;
}

/// Suction above which the theory says that the cell flows in [kPa].
Result<double> theory_of(FinishedRun& run, const CellLoad& load) {
  MORULA_TRY_ASSIGN(const auto first, run.start());
  if (first == nullptr) return std::nan("");
  const auto start = shells_of(*first, load.type);
  if (start.empty()) return std::nan("");
  return theory::critical_aspiration(tension_at(type_of(run.study(), load), 0.0), mouth_of(run.study().model, load).radius,
                                     ball_radius(start[0].cell->volume));
}

/// Half way between the largest suction with a tongue shorter than the pipette's radius and the smallest with a longer one, where these are
/// within a sixth of the theory's of each other.
Result<std::optional<double>> critical_suction_of(FinishedRun& run, const Subject& subject, const Moments& moments) {
  const CellLoad& load = load_of(run.study(), subject);
  Moments holds = moments;
  holds.kind = Moments::Kind::kHolds;
  holds.course = load.course;
  if (moments.kind != Moments::Kind::kHolds && moments.kind != Moments::Kind::kBetween) holds.until = kNever;
  MORULA_TRY_ASSIGN(const auto lengths, find_measure(run.study(), "aspiration.length")->take(run, subject, holds));
  double low = std::nan(""), high = std::nan("");
  for (const Sample& one : lengths) {
    const double suction = suction_at(load, one.time);
    if (!(suction > 0.0)) continue;
    if (one.value < 1.0) low = std::fmax(low, suction);
    if (one.value >= 1.0) high = std::fmin(high, suction);
  }
  MORULA_TRY_ASSIGN(const double expected, theory_of(run, load));
  return high - low <= expected / 6.0 ? std::optional(0.5 * (low + high)) : std::nullopt;
}

Measure critical_measure(const char* name, const char* title, const char* doc, const char* formula, Quantity quantity, bool over_tension) {
  Measure out = of_suction(name, title, doc, formula, quantity);
  out.take = [over_tension](FinishedRun& run, const Subject& subject, const Moments& moments) -> Result<std::vector<Sample>> {
    MORULA_TRY_ASSIGN(const auto critical, critical_suction_of(run, subject, moments));
    const CellLoad& load = load_of(run.study(), subject);
    const double unit = over_tension ? tension_at(type_of(run.study(), load), 0.0) / mouth_of(run.study().model, load).radius : 1.0;
    return critical ? std::vector<Sample>{{run.study().time.end, *critical / unit, ""}} : std::vector<Sample>{};
  };
  return out;
}

Measure states_measure() {
  Measure out{"aspiration.states",
              "states under suction",
              "Number of the times of rest, of all loads that suck, of which the run has an output.",
              "",
              "",
              Quantity::kNumber,
              MeasureOf::kRun};
  out.take = [](FinishedRun& run, const Subject&, const Moments& moments) -> Result<std::vector<Sample>> {
    MORULA_TRY_ASSIGN(const std::vector<double>* const times, run.snapshot_times());
    std::size_t count = 0;
    for (const CellLoad& load : run.study().model.loads)
      if (sucks(load)) count += holds_of(load.course, *times).size();
    return std::vector<Sample>{{moments.until, static_cast<double>(count), ""}};
  };
  return out;
}

}  // namespace

std::vector<Measure> aspiration_measures() {
  return {
      states_measure(),
      at_outputs("aspiration.suction", "suction", "Suction in the pipette.", "", Quantity::kPressure,
                 [](const Aspirated& a) { return suction_at(a.load, a.time); }),
      at_outputs("aspiration.length", "tongue over the pipette's radius",
                 "Length of the tongue of a cell (the first that the load is on) beyond the narrowest place of the pipette, over the "
                 "radius there.",
                 "L/Rp", Quantity::kNumber, [](const Aspirated& a) { return tongue(a.now, a.load, a.mouth) / a.mouth.radius; }),
      at_outputs("aspiration.rate", "growth of the tongue in a second over the pipette's radius",
                 "Growth of the tongue since the output before, per time and over the pipette's radius.", "dL/dt/Rp", Quantity::kRate,
                 [](const Aspirated& a) {
                   return (tongue(a.now, a.load, a.mouth) - tongue(a.before, a.load, a.mouth)) / (a.time - a.last) / a.mouth.radius;
                 }),
      at_outputs("aspiration.drawn", "length that is drawn in", "Length of the tongue less that at time 0.", "L - L(0)", Quantity::kLength,
                 [](const Aspirated& a) { return tongue(a.now, a.load, a.mouth) - tongue(a.start, a.load, a.mouth); }),
      at_outputs("aspiration.sucked", "area under suction over the cross section of the pipette",
                 "Area of the faces that bear the suction over the narrowest cross section of the pipette.", "A/(pi Rp^2)",
                 Quantity::kNumber,
                 [](const Aspirated& a) {
                   return sucked_area(a.now, a.load, a.mouth, false) / (std::numbers::pi * a.mouth.radius * a.mouth.radius);
                 }),
      at_outputs("aspiration.outside", "area under suction that is not inside the glass",
                 "Area of the faces that bear the suction and lie before the glass or beside its first circle.", "", Quantity::kArea,
                 [](const Aspirated& a) { return sucked_area(a.now, a.load, a.mouth, true); }),
      critical_measure("aspiration.critical", "critical suction",
                       "Half way between the largest suction at rest with a tongue shorter than the pipette's radius and the smallest with "
                       "a longer one, where these are within a sixth of the theory's of each other.",
                       "", Quantity::kPressure, false),
      critical_measure("aspiration.scaled_critical", "critical suction over tension over the pipette's radius",
                       "Critical suction as a number that only the shapes of cell and pipette fix.", "p* Rp/T", Quantity::kNumber, true),
  };
}

Theory critical_suction() {
  return {"critical_suction",
          "2 T (1/Rp - 1/Rc)",
          "Suction above which a cell with a cortical tension T alone has no rest in a pipette: the part within is a half ball. Rc, the "
          "radius of the part outside, follows from the volume.",
          "p* = 2 T (1/Rp - 1/Rc)",
          "physics/scenarios.md S3",
          {"aspiration.critical", "aspiration.suction"},
          [](const Study& study, const Subject& s, const std::string&) {
            return type_of(study, load_of(study, s)).shell.tension > 0.0
                       ? Status{}
                       : Status(Error{ErrorKind::kInput, "needs cells with a cortical tension", ""});
          },
          [](FinishedRun& run, const Subject& s, const std::string&, const Sample&) { return theory_of(run, load_of(run.study(), s)); }};
}

}  // namespace morula::scenarios
