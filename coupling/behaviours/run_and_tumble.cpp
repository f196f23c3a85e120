#include <cmath>
#include <cstdint>

#include "coupling/behaviours/migration_law.h"

namespace morula {
namespace {

Vec3d at_birth(const MigratingCell& cell, const OwnValues&) { return cell.speed * cell.direction(); }

/// The way of runs that begin and end within a time in which there are too many to be drawn one by one: a normal number, of the variance (2/3)S²τt per component.
Vec3d way_of_many_runs(const MigratingCell& cell, double run_time, double time) {
  return cell.speed * std::sqrt(2.0 / 3.0 * run_time * time) * cell.other_normal();
}

/// Runs of exponential times; after each the direction is one of the whole sphere, whatever it was. The last goes on in the next step. A cell that its
/// behaviours had stopped has none to keep.
Walk step(const MigratingCell& cell, const OwnValues& own) {
  const double now = norm(cell.velocity), run_time = own("run_time");
  double time = now == 0.0 ? 0.0 : -run_time * std::log1p(-cell.uniform());
  const Vec3d kept = now == 0.0 ? Vec3d{} : cell.velocity * (cell.speed / now);
  if (time >= cell.dt) return {kept, kept};
  const Vec3d last = cell.speed * cell.direction();
  Vec3d way = kept * time;
  if (cell.dt - time > 0.5 * static_cast<double>(MigratingCell::kPieces) * run_time)
    return {last, (way + way_of_many_runs(cell, run_time, cell.dt - time)) * (1.0 / cell.dt)};
  for (std::uint64_t k = 0;; ++k) {
    const double end = time - run_time * std::log(cell.uniform(k));
    if (end >= cell.dt) break;
    way += (cell.speed * (end - time)) * cell.direction(k);
    time = end;
  }
  return {last, (way + last * (cell.dt - time)) * (1.0 / cell.dt)};
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
                   .step = &step});
  return law;
}

}  // namespace morula
