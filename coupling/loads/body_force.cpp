#include "coupling/loads/load_keys.h"

namespace morula {

std::shared_ptr<const Load> body_force_load() {
  using keys::Kind;
  static const auto load =
      std::make_shared<const Load>(Load{.info = {.name = "body_force",
                                                 .title = "Force on whole cells",
                                                 .equation = "F_i = F a_i/A, a_i the area of node i",
                                                 .source = "choice of this project",
                                                 .parameters = {given_by_study("body_force", "force", "nN", "Size of F on each cell.")}},
                                        .section = {.name = "body_force"},
                                        .keys = {{Kind::kVector,
                                                  {.name = "body_force",
                                                   .doc = "A force on the whole cell; on a shell spread over its surface, along which a "
                                                          "fluid cortex gives way: until it has, up to half an hour, the "
                                                          "medium bears a part of it.",
                                                   .quantity = Quantity::kForce,
                                                   .example = "[0 nN, 0 nN, -1 nN]"}}},
                                        .bare = true,
                                        .build = [](const OwnValues& values, CellLoad& out) { out.force = values.vector("body_force"); },
                                        .push_cell = [](const CellLoad& one, double strength) { return one.force * strength; }});
  return load;
}

std::vector<std::shared_ptr<const Load>> builtin_loads() {
  return {traction_load(), pull_load(), patch_load(), pressure_load(), grip_load(), trap_load(), body_force_load()};
}

}  // namespace morula
