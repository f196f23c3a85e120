// Cells that rub along each other and along obstacles, held by grips; and cells that slide freely.
#include <algorithm>
#include <cmath>

#include "scenarios/measures/bearing_area.h"
#include "scenarios/measures/elastic_cap.h"
#include "scenarios/measures/measures.h"
#include "scenarios/measures/verdicts.h"
#include "scenarios/measures/ways_of_cells.h"

namespace morula::scenarios {
namespace {

const CellLoad& load_of(const Study& study, const Subject& subject) { return study.model.loads[static_cast<std::size_t>(subject.load)]; }

double rate_of(const TimeCourse& way, double time) {
  for (std::size_t i = 1; i < way.time.size(); ++i)
    if (time > way.time[i - 1] && time <= way.time[i]) return (way.value[i] - way.value[i - 1]) / (way.time[i] - way.time[i - 1]);
  return 0.0;
}

/// A held cell, and what rubs along it: whatever it sticks to most.
struct Rubbing {
  const CellLoad& load;
  std::size_t partner = 0;
  const ObstacleSpec* obstacle = nullptr;  ///< null: another cell
  const TimeCourse& way;                   ///< of the obstacle, or of the cell itself
  double friction = 0.0;                   ///< tangential, of the pair [nN·s/µm³]
  double range = 0.0;                      ///< of the contact [µm]
};

/// Nothing where the load is no grip, its cells stick to nothing, or neither moves.
std::optional<Rubbing> rubbing_of(const Model& model, const CellLoad& load) {
  if (load.what != grip_load()) return std::nullopt;
  std::size_t best = load.type;
  double most = 0.0;
  for (std::size_t other = 0; other < model.material_count(); ++other)
    if (other != load.type && model.pair(load.type, other).adhesion > most) {
      most = model.pair(load.type, other).adhesion;
      best = other;
    }
  if (best == load.type) return std::nullopt;
  const ObstacleSpec* const obstacle = best < model.types.size() ? nullptr : &model.obstacles[best - model.types.size()];
  const TimeCourse& way = obstacle != nullptr ? obstacle->distance : load.way;
  if (way.empty()) return std::nullopt;
  return Rubbing{load, best, obstacle, way, model.pair(load.type, best).tangential_friction, range_of(model, load.type, best)};
}

/// One output of a rubbing cell.
struct RubbingState {
  double force = 0.0;    ///< along the motion, less the drag of the medium on what moves [nN]
  double bearing = 0.0;  ///< area that bears friction [µm²]
  double speed = 0.0;    ///< of one along the other [µm/s]
};

/// The state in a snapshot; `force`: of the grip along x. Nothing where a cell is missing.
std::optional<RubbingState> state_of(const Model& model, const Rubbing& r, const Snapshot& snapshot, double force) {
  const auto cells = shells_of(snapshot, r.load.type), others = r.obstacle ? cells : shells_of(snapshot, r.partner);
  if (cells.empty() || others.empty()) return std::nullopt;
  RubbingState out;
  out.speed = rate_of(r.way, snapshot.time);
  if (r.obstacle != nullptr) {
    double top = -1e300;  // of a plane that looks towards z and moves within itself
    for (const Vec3d& x : r.obstacle->position) top = std::max(top, x.z);
    out.force = -force;
    out.bearing = bearing_area_on_plane(cells[0], top, r.range);
  } else {
    out.force = force - model.types[r.load.type].medium_friction * cells[0].cell->area * out.speed;
    out.bearing = bearing_area_between(cells[0], others[0], r.range);
  }
  return out;
}

Measure of_rubbing(const char* name, const char* title, const char* doc, const char* formula, Quantity quantity,
                   double (*value)(const Rubbing&, const RubbingState&)) {
  Measure out{name, title, doc, formula, "physics/scenarios.md S4.6, S6.5", quantity, MeasureOf::kLoad};
  out.fits = [](const Study& study, const Subject& subject) -> Status {
    if (rubbing_of(study.model, load_of(study, subject))) return {};
    return Error{ErrorKind::kInput, "needs a grip on a cell that sticks to what moves along it, or that moves along it", ""};
  };
  out.columns = [](const Study& study, const Subject& s) { return std::vector<std::string>{"grip_x_" + load_of(study, s).name}; };
  out.take = [value](FinishedRun& run, const Subject& subject, const Moments& moments) -> Result<std::vector<Sample>> {
    const Model& model = run.study().model;
    const auto rubbing = rubbing_of(model, load_of(run.study(), subject));
    std::vector<Sample> found;
    if (!rubbing) return found;
    MORULA_TRY_ASSIGN(const auto forces, by_row(run, {"grip_x_" + rubbing->load.name}, moments,
                                                [](double, const std::vector<double>& row) { return row[0]; }));
    for (const Sample& force : forces) {
      MORULA_TRY_ASSIGN(const auto snapshot, run.snapshot_at(force.time));
      if (snapshot == nullptr) continue;
      const auto state = state_of(model, *rubbing, *snapshot, force.value);
      if (!state) continue;
      const double one = value(*rubbing, *state);
      if (std::isfinite(one)) found.push_back({snapshot->time, one, ""});
    }
    return found;
  };
  return out;
}

Measure count_measure() {
  Measure out{"rubbing.cells",
              "held cells that something rubs along",
              "Number of cells that grips hold and that something rubs along, or that are drawn along something.",
              "",
              "",
              Quantity::kNumber,
              MeasureOf::kRun};
  out.take = [](FinishedRun& run, const Subject&, const Moments& moments) -> Result<std::vector<Sample>> {
    const Model& model = run.study().model;
    const auto count =
        std::count_if(model.loads.begin(), model.loads.end(), [&](const CellLoad& load) { return rubbing_of(model, load).has_value(); });
    return std::vector<Sample>{{moments.until, static_cast<double>(count), ""}};
  };
  return out;
}

/// Speed between the first and the last of the moments, over that of the drag in the medium alone.
Measure slide_measure() {
  Measure out{"slide.speed",
              "speed of a pushed cell over that of its drag in the medium",
              "Mean speed of the first cell of a body force along it, from the first to the last of the moments, over that of the drag of "
              "the medium alone: 1 where nothing else holds it.",
              "v A friction/F",
              "physics/dcm.md §9",
              Quantity::kNumber,
              MeasureOf::kLoad};
  out.of_a_course = true;
  out.fits = [](const Study& study, const Subject& subject) -> Status {
    if (load_of(study, subject).what == body_force_load()) return {};
    return Error{ErrorKind::kInput, "needs a body force", ""};
  };
  out.take = [](FinishedRun& run, const Subject& subject, const Moments& moments) -> Result<std::vector<Sample>> {
    const CellLoad& load = load_of(run.study(), subject);
    MORULA_TRY_ASSIGN(const std::vector<double>* const times, run.snapshot_times());
    const auto asked = moments.among(*times);
    std::vector<Sample> found;
    if (asked.size() < 2) return found;
    MORULA_TRY_ASSIGN(const auto first, run.snapshot(asked.front()));
    MORULA_TRY_ASSIGN(const auto last, run.snapshot(asked.back()));
    const auto pushed = std::ranges::find(last->cells, load.type, &Snapshot::Cell::type);
    if (pushed == last->cells.end()) return found;
    double way = kNothing;  // of a cell that was there at the first
    MORULA_TRY(for_ways_since(run, asked.front(), {asked.back()}, [&](const Snapshot&, const Snapshot::Cell& cell, const Vec3d& of_cell) {
      if (cell.id == pushed->id) way = dot(of_cell, normalized(load.force));
    }));
    const double drag = run.study().model.types[load.type].medium_friction * pushed->area;
    found.push_back({last->time, way / (last->time - first->time) * drag / norm(load.force), ""});
    return found;
  };
  return out;
}

}  // namespace

std::vector<Measure> rubbing_measures() {
  return {
      count_measure(),
      of_rubbing("rubbing.force", "force of rubbing",
                 "Force of the grip along x on a cell that something rubs along, less the drag of the medium where the cell itself moves.",
                 "", Quantity::kForce, [](const Rubbing&, const RubbingState& s) { return s.force; }),
      of_rubbing("rubbing.friction", "friction times area times speed",
                 "Force that the friction of the contact stands for: tangential friction of the pair, times the area that bears it by the "
                 "geometry of the meshes, times the speed of one along the other.",
                 "friction A v, A = integral of the part of the friction that acts at each gap", Quantity::kForce,
                 [](const Rubbing& r, const RubbingState& s) { return r.friction * s.bearing * s.speed; }),
      of_rubbing("rubbing.coefficient", "force of rubbing over area and speed", "Friction per area that the force stands for.", "F/(A v)",
                 Quantity::kFrictionPerArea, [](const Rubbing&, const RubbingState& s) { return s.force / (s.bearing * s.speed); }),
      slide_measure(),
  };
}

}  // namespace morula::scenarios
