// Two cells that touch each other.
#include <cmath>
#include <numbers>

#include "core/ball.h"
#include "scenarios/measures/elastic_cap.h"
#include "scenarios/measures/measures.h"
#include "scenarios/measures/ways_of_cells.h"

namespace morula::scenarios {
namespace {

/// The two cells of a pair, of whatever body; nothing where there are not exactly these.
std::optional<std::pair<const Snapshot::Cell*, const Snapshot::Cell*>> cells_of_pair(const Snapshot& snapshot, const Subject& pair) {
  std::vector<const Snapshot::Cell*> first, second;
  for (const Snapshot::Cell& cell : snapshot.cells) {
    if (cell.type == pair.type) first.push_back(&cell);
    if (cell.type == pair.partner) second.push_back(&cell);
  }
  if (pair.type == pair.partner) return first.size() == 2 ? std::optional(std::pair(first[0], first[1])) : std::nullopt;
  return first.size() == 1 && second.size() == 1 ? std::optional(std::pair(first[0], second[0])) : std::nullopt;
}

/// Way of the middle of the two centroids since time 0, over R0 of their mean volume.
Result<std::vector<Sample>> take_drift(FinishedRun& run, const Subject& subject, const Moments& moments) {
  MORULA_TRY_ASSIGN(const std::vector<double>* const times, run.snapshot_times());
  std::vector<Sample> out;
  MORULA_TRY_ASSIGN(const auto start, run.start());
  if (start == nullptr || !cells_of_pair(*start, subject)) return out;
  Vec3d way_of_earlier;  // of the two, as cells come in the order of their ids
  MORULA_TRY(for_ways_since(run, 0, moments.among(*times), [&](const Snapshot& snapshot, const Snapshot::Cell& cell, const Vec3d& way) {
    if (cell.type != subject.type && cell.type != subject.partner) return;
    const auto now = cells_of_pair(snapshot, subject);
    if (!now) return;
    const auto& [a, b] = *now;
    if (cell.id == std::min(a->id, b->id))
      way_of_earlier = way;
    else
      out.push_back({snapshot.time, norm((way_of_earlier + way) * 0.5) / ball_radius(0.5 * (a->volume + b->volume)), ""});
  }));
  return out;
}

/// The tenser of two cells has the higher pressure, and their contact bends into the other as Laplace's law says. Measured on both cells,
/// whose surfaces lie on each other.
std::optional<double> bend_over_laplace(const Study& study, const Snapshot& snapshot, const Subject& subject) {
  const auto pair = shells_of_pair(snapshot, subject);
  if (!pair) return std::nullopt;
  const Model& model = study.model;
  const auto a = static_cast<std::size_t>(subject.type), b = static_cast<std::size_t>(subject.partner);
  const double adhesion = model.pair(a, b).adhesion, high = tension_at(model.types[a], snapshot.time),
               low = tension_at(model.types[b], snapshot.time);
  const Snapshot::Cell &tense = *pair->first.cell, &slack = *pair->second.cell;
  const Vec3d axis = normalized(slack.centroid - tense.centroid);
  const double radius = std::sqrt(tense.contact_area / std::numbers::pi);
  const double more = tense.inner_pressure - slack.inner_pressure;
  const auto outwards = curvature_along(pair->first, axis, radius), inwards = curvature_along(pair->second, axis * -1.0, radius);
  const double laplace = more / (2.0 * (high + low - adhesion));
  if (!outwards || !inwards || !(laplace > 0.0)) return std::nullopt;
  return 0.5 * (*outwards - *inwards) / laplace;
}

}  // namespace

Measure pair_distance_measure() {
  Measure out{"pair.distance",
              "distance of the centres",
              "Distance of the centres of two cells; in a periodic domain that of the nearest images.",
              "",
              "",
              Quantity::kLength,
              MeasureOf::kPair};
  out.take = by_snapshot([](const Study& study, const Snapshot& snapshot, const Subject& subject) -> std::optional<double> {
    const auto pair = cells_of_pair(snapshot, subject);
    if (!pair) return std::nullopt;
    return norm(study.model.space.nearest_image(pair->second->centroid - pair->first->centroid));
  });
  return out;
}

Measure pair_drift_measure() {
  Measure out{"pair.drift",
              "drift of the centre of mass over the cell's radius",
              "Way of the middle between two cells since time 0, over the radius R0 of a ball of a cell's volume.",
              "|x - x(0)|/R0",
              "",
              Quantity::kNumber,
              MeasureOf::kPair};
  out.take = &take_drift;
  return out;
}

Measure pair_pressure_ratio_measure() {
  Measure out{"pair.pressure_ratio",
              "inner pressure of the first of two cells over that of the other",
              "Inner pressure of the first of two cells over that of the second.",
              "p1/p2",
              "",
              Quantity::kNumber,
              MeasureOf::kPair};
  out.take = by_snapshot([](const Study&, const Snapshot& snapshot, const Subject& subject) -> std::optional<double> {
    const auto pair = cells_of_pair(snapshot, subject);
    return pair ? std::optional(pair->first->inner_pressure / pair->second->inner_pressure) : std::nullopt;
  });
  return out;
}

Measure pair_bend_measure() {
  Measure out{"pair.bend",
              "bend of the contact into the cell of lower pressure over that of Laplace's law",
              "Mean curvature of the contact of two shells, the tenser first, over that which their pressures and tensions ask for.",
              "(1/R) / ((p1 - p2)/(2 (T1 + T2 - W)))",
              "Laplace 1806; physics/scenarios.md S6.2",
              Quantity::kNumber,
              MeasureOf::kPair};
  out.fits = [](const Study& study, const Subject& s) -> Status {
    const auto& types = study.model.types;
    if (s.partner < static_cast<int>(types.size()) && s.type != s.partner &&
        types[static_cast<std::size_t>(s.type)].shell.tension > types[static_cast<std::size_t>(s.partner)].shell.tension)
      return {};
    return Error{ErrorKind::kInput, "needs two types, the first of which has the higher cortical tension", ""};
  };
  out.take = by_snapshot(&bend_over_laplace);
  return out;
}

}  // namespace morula::scenarios
