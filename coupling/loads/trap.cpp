#include "coupling/loads/load_keys.h"
#include "coupling/model.h"

namespace morula {
namespace {

Anchor hold_center(const CellLoad& load, double time) {
  return {.stiffness = load.size * load.course.at(time),
          .target = load.center + (load.way.empty() ? Vec3d{} : load.direction * load.way.at(time))};
}

void build(const OwnValues& values, CellLoad& out) {
  out.size = values("stiffness");
  out.center = values.vector("center");
  out.direction = values.vector("direction");
  out.way = values.course("way");
}

}  // namespace

std::shared_ptr<const Load> trap_load() {
  static const auto load = std::make_shared<const Load>(Load{
      .info = {.name = "trap",
               .title = "A spring that holds or moves the centre of a cell",
               .equation = "E = ½ K |x̄ − X(t)|², x̄ the centre of volume of a shell, or of a sphere",
               .source = "choice of this project",
               .parameters = {given_by_study("stiffness", "tension", "nN/µm", "K.")}},
      .section =
          {.name = "trap",
           .doc = "A spring on the centre of a cell of either body, whose surface stays free: cells pressed together or pulled apart at a "
                  "distance that is known. `course` is a factor of the stiffness.",
           .example = "{stiffness: 10 mN/m, center: [0 um, 0 um, 5 um]}"},
      .keys = {keys::hold_stiffness("Stiffness of the spring."),
               keys::required(keys::Kind::kVector, "center", "Where the centre of the cell is held, before the trap moves.",
                              Quantity::kLength, "[0 um, 0 um, 5 um]"),
               keys::way_direction(), keys::way()},
      .build = &build,
      .judge = &keys::judge_places,
      .hold_center = &hold_center});
  return load;
}

}  // namespace morula
