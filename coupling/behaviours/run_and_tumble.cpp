#include <cmath>

#include "coupling/behaviours/migration_law.h"

namespace morula {
namespace {

Vec3d at_birth(const MigratingCell& cell, const OwnValues&) { return cell.speed * cell.direction(); }

/// In a step the cell tumbles with the probability 1 − e^(−dt/τ), once or several times: its direction is then one of the whole sphere, whatever it was. A
/// cell that its behaviours had stopped has none to keep.
Vec3d after(const MigratingCell& cell, const OwnValues& own) {
  const double now = norm(cell.velocity);
  const bool tumbles = cell.uniform() < -std::expm1(-cell.dt / own("run_time"));
  return tumbles || now == 0.0 ? cell.speed * cell.direction() : cell.velocity * (cell.speed / now);
}

}  // namespace

std::shared_ptr<const MigrationLaw> run_and_tumble() {
  static const auto law = std::make_shared<const MigrationLaw>(
      MigrationLaw{.info = {.name = "run_and_tumble",
                            .title = "Straight runs between tumbles",
                            .equation = "F = Γ w as persistent_walk; |u| = S; a new direction, uniform on the sphere, at the events of a "
                                        "Poisson process of rate 1/τ; "
                                        "⟨u(0)·u(t)⟩ = S² e^(−t/τ), MSD = 2S²τ[t − τ(1 − e^(−t/τ))] in the open",
                            .source = "Berg & Brown 1972, doi:10.1038/239500a0; Berg 1993, Random Walks in Biology",
                            .parameters = {given_by_study("speed", "velocity", "µm/s", "S: speed of a run in the open."),
                                           given_by_study("run_time", "time", "s", "τ: mean duration of a run.")}},
                   .doc = "straight runs at `speed` of exponential times, then any direction",
                   .keys = {{.spec = {.name = "run_time",
                                      .doc = "Mean duration of a straight run.",
                                      .quantity = Quantity::kTime,
                                      .fallback = "30 min",
                                      .low = 0.0,
                                      .low_open = true,
                                      .example = "10 min",
                                      .source = "chosen"}}},
                   .at_birth = &at_birth,
                   .after = &after});
  return law;
}

}  // namespace morula
