// What loads and obstacles do.
#include <algorithm>
#include <cmath>

#include "core/mesh/triangle_tree.h"
#include "core/space/images.h"
#include "scenarios/measures/measures.h"

namespace morula::scenarios {
namespace {

constexpr double kFar2 = 1e300;  // [µm²]

const CellLoad& load_of(const Study& study, const Subject& subject) { return study.model.loads[static_cast<std::size_t>(subject.load)]; }

std::vector<std::string> force_columns(const Study& study, const Subject& subject) {
  const CellLoad& load = load_of(study, subject);
  if (load.what != grip_load()) return {};
  return {"grip_x_" + load.name, "grip_y_" + load.name, "grip_z_" + load.name};
}

/// Of a patch of marked faces: none while no face has the mark.
Result<std::vector<Sample>> force_on_marked(FinishedRun& run, const CellLoad& load, const Moments& moments) {
  MORULA_TRY_ASSIGN(const std::vector<double>* const times, run.snapshot_times());
  std::vector<Sample> out;
  for (const std::size_t at : moments.among(*times)) {
    MORULA_TRY_ASSIGN(const auto snapshot, run.snapshot(at));
    const bool borne = !snapshot->face_marks.empty() && snapshot->marks().any_has(load.mark);
    out.push_back({snapshot->time, borne ? norm(load.force) * load.course.at(snapshot->time) : 0.0, ""});
  }
  return out;
}

}  // namespace

Measure load_way_measure() {
  Measure out{"way", "way", "Way that a grip has gone along its direction.", "", "", Quantity::kLength, MeasureOf::kLoad};
  out.fits = [](const Study& study, const Subject& subject) -> Status {
    const CellLoad& load = load_of(study, subject);
    if (load.what == grip_load() && !load.way.empty()) return {};
    return Error{ErrorKind::kInput, "needs a grip with a `way`", ""};
  };
  out.take = [](FinishedRun& run, const Subject& subject, const Moments& moments) {
    const CellLoad& load = load_of(run.study(), subject);
    return by_row(run, {}, moments, [&load](double time, const std::vector<double>&) { return load.way.at(time); });
  };
  return out;
}

Measure load_force_measure() {
  Measure out{"force",
              "force",
              "Force of a load on its cells: of a grip along its direction, of a pull at each end, of a patch or body force its size; of a "
              "patch of marked faces 0 while no face has the mark.",
              "",
              "",
              Quantity::kForce,
              MeasureOf::kLoad};
  out.fits = [](const Study& study, const Subject& subject) -> Status {
    const std::shared_ptr<const Load>& what = load_of(study, subject).what;
    if (what == grip_load() || what == pull_load() || what == patch_load() || what == body_force_load()) return {};
    return Error{ErrorKind::kInput, "needs a grip, a pull, a patch or a body force", ""};
  };
  out.columns = &force_columns;
  out.take = [](FinishedRun& run, const Subject& subject, const Moments& moments) -> Result<std::vector<Sample>> {
    const CellLoad& load = load_of(run.study(), subject);
    if (load.what == patch_load() && load.mark >= 0) return force_on_marked(run, load, moments);
    return by_row(run, force_columns(run.study(), subject), moments, [&load](double time, const std::vector<double>& row) {
      if (load.what == grip_load()) return dot(Vec3d{row[0], row[1], row[2]}, load.direction);
      return (load.what == pull_load() ? load.size : norm(load.force)) * load.course.at(time);
    });
  };
  return out;
}

Measure obstacle_way_measure() {
  Measure out{"obstacle.way",    "way of the obstacle", "Distance of an obstacle from where it was at time 0.", "", "",
              Quantity::kLength, MeasureOf::kObstacle};
  out.take = [](FinishedRun& run, const Subject& subject, const Moments& moments) {
    const ObstacleSpec& obstacle = run.study().model.obstacles[static_cast<std::size_t>(subject.obstacle)];
    return by_row(run, {}, moments, [&obstacle](double time, const std::vector<double>&) { return norm(obstacle.way(0.0, time)); });
  };
  return out;
}

Measure nearest_sphere_measure() {
  Measure out{
      "obstacle.nearest_sphere",
      "distance of the nearest sphere from the obstacle",
      "Distance of the surface of an obstacle from the nearest centre of a cell that is a sphere; nothing where all cells are shells.",
      "",
      "",
      Quantity::kLength,
      MeasureOf::kObstacle};
  out.take = by_snapshot([](const Study& study, const Snapshot& snapshot, const Subject& subject) -> std::optional<double> {
    const ObstacleSpec& obstacle = study.model.obstacles[static_cast<std::size_t>(subject.obstacle)];
    const TriangleTree surface(obstacle.position, obstacle.faces);
    const Vec3d way = obstacle.way(0.0, snapshot.time);
    double nearest2 = kFar2;
    const Space& space = study.model.space;
    for (const Snapshot::Cell& cell : snapshot.cells) {
      if (cell.body != BodyKind::kSphere) continue;
      const Vec3d place = space.wrapped(cell.centroid - way);  // the obstacle may have gone round the domain
      for_boxes_around(space, [&](const Vec3d& shift) {
        if (const auto found = surface.nearest(place + shift, std::sqrt(nearest2))) nearest2 = std::min(nearest2, found->closest.distance2);
      });
    }
    return nearest2 < kFar2 ? std::optional(std::sqrt(nearest2)) : std::nullopt;
  });
  return out;
}

}  // namespace morula::scenarios
