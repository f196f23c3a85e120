// Fields in a slab and in balls, by studies that are run.
#include <cmath>
#include <numbers>

#include "core/spiral.h"
#include "report/pictures/field_slice.h"
#include "scenarios/verify/run_study.h"
#include "scenarios/verify/study_numbers.h"

namespace morula::scenarios {
namespace {

/// A slab of half thickness 100 µm with first order loss, Thiele modulus 2, held at 1 mM at both ends.
std::shared_ptr<StudyToRun> slab(int voxel) {
  return study_to_run(
      "slab",
      "time: {end: 40 s, step: 10 s, output: 40 s, checkpoint: 40 s}\ndomain: {size: [200 um, 40 um, 40 um], boundary: open}\n"
      "cell_types: {cell: {radius: 5 um}}\ninitial:\n  - {type: cell, at: [[0 um, 0 um, 0 um]], as: sphere}\n"
      "fields:\n  food: {diffusion: 2e-9 m^2/s, decay: 0.8 1/s, initial: 1 mM, voxel: " +
          std::to_string(voxel) + " um, boundary: {all: no_flux, x_low: 1 mM, x_high: 1 mM}}\n");
}

/// Uptake of zero order in a ball of radius R: what the profile of the field says that the ball takes up, over what the study says. Within the ball the
/// concentration rises by Q r²/(8πDR³), outside as Q/(4πD)(3/(2R) − 1/r); walls far away add what is harmonic and has the symmetry of a cube, which no
/// mean over directions shows. Least squares over the voxels within 1.4 R.
double uptake_from_profile(const FoundInRun& found, double radius, double diffusion, double rate) {
  const Snapshot* end = found.at(100.0);
  if (end == nullptr || end->fields.size() != 1) return std::nan("");
  const Snapshot::Grid& grid = end->fields[0];
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  std::size_t i = 0;
  for (int z = 0; z < grid.voxels[2]; ++z)
    for (int y = 0; y < grid.voxels[1]; ++y)
      for (int x = 0; x < grid.voxels[0]; ++x, ++i) {
        const Vec3d at = grid.low + Vec3d{(x + 0.5) * grid.spacing.x, (y + 0.5) * grid.spacing.y, (z + 0.5) * grid.spacing.z};
        const double r = norm(at);
        if (r > 1.4 * radius) continue;
        const double shape =
            rate / (4.0 * std::numbers::pi * diffusion) * (r < radius ? 0.5 * r * r / (radius * radius * radius) : 1.5 / radius - 1.0 / r);
        const double c = grid.concentration[i];
        n += 1.0, sx += shape, sy += c, sxx += shape * shape, sxy += shape * c;
      }
  return (sxy - sx * sy / n) / (sxx - sx * sx / n);
}

/// Mean over 400 directions, evenly spread along a spiral, at a distance from the origin.
double mean_at(const FoundInRun& found, double time, double distance) {
  const Snapshot* end = found.at(time);
  if (end == nullptr || end->fields.size() != 1) return std::nan("");
  constexpr int kDirections = 400;
  double sum = 0.0;
  for (int i = 0; i < kDirections; ++i) sum += concentration_at(end->fields[0], spiral_direction(i, kDirections) * distance);
  return sum / kDirections;
}

/// A ball of 100 µm that takes up k c per volume, k = φ² D/R² with a Thiele modulus φ of 2: half saturation at 5000 times the concentration around it
/// makes the uptake of first order. The profile within does not depend on how the field comes to the ball: c(r)/c(R) = R sinh(φr/R)/(r sinh φ).
void add_thiele_ball(std::vector<ReferenceNumber>& out) {
  constexpr double kRadius = 100.0, kEnd = 100.0;
  const auto ball = study_to_run("thiele",
                                 "time: {end: 100 s, step: 20 s, output: 100 s, checkpoint: 100 s}\n"
                                 "domain: {size: [360 um, 360 um, 360 um], boundary: open}\ncell_types: {cell: {radius: 100 um}}\n"
                                 "initial:\n  - {type: cell, at: [[0 um, 0 um, 0 um]], as: sphere}\n"
                                 "fields:\n  food: {diffusion: 2e-9 m^2/s, initial: 0.2 mM, voxel: 10 um, boundary: {all: 0.2 mM}, "
                                 "uptake: {cell: {rate: 3351032164 amol/s, half_saturation: 1000 mM}}}\n");
  struct Place {
    const char* where;
    double part, ratio;
  };
  // Second order: linear interpolation errs by (phi h/R)^2/8 of c, voxels by (phi h/R)^2/12, and the rim, whose voxels are filled in part, by (h/R)^2/2: 1.3 %
  // for voxels of R/10 were they to add up.
  for (const Place& p : {Place{"at its centre", 0.0, 0.551441}, Place{"half way", 0.5, 0.648054}})
    out.push_back({"A 4",
                   std::string("study: concentration within a ball that consumes in the first order, Thiele modulus 2, ") + p.where +
                       ", over that on its surface",
                   p.ratio, 0.013 * p.ratio, "R sinh(phi r/R)/(r sinh phi), Thiele 1939, doi:10.1021/ie50355a027; voxels of R/10",
                   [=] { return mean_at(ball->found(), kEnd, p.part * kRadius) / mean_at(ball->found(), kEnd, kRadius); }});
}

/// A ball of radius R that gives s per volume to a field that decays with k, λ = √(D/k) = R: within it c = (s/k)(1 − (1 + R/λ) e^(−R/λ) sinh(r/λ)/(r/λ)), outside
/// (s/k)(R/λ cosh(R/λ) − sinh(R/λ)) e^(−r/λ)/(r/λ). The study's rate makes s/k 1 mM. Walls are six λ away.
void add_secreting_ball(std::vector<ReferenceNumber>& out) {
  const auto ball =
      study_to_run("secretion",
                   "time: {end: 100 s, step: 20 s, output: 100 s, checkpoint: 100 s}\n"
                   "domain: {size: [240 um, 240 um, 240 um], boundary: open}\ncell_types: {cell: {radius: 20 um}}\n"
                   "initial:\n  - {type: cell, at: [[0 um, 0 um, 0 um]], as: sphere}\n"
                   "fields:\n  signal: {diffusion: 1e-10 m^2/s, initial: 0 mM, decay: 0.25 1/s, voxel: 4 um, boundary: {all: 0 mM}, "
                   "secretion: {cell: 8377.5804 amol/s}}\n");
  struct Place {
    const char* where;
    double distance, concentration;
  };
  // Second order, h = λ/5: (h/λ)²/12 of the operator, and (h/R)²/2 of the rim, whose voxels are filled in part.
  for (const Place& p : {Place{"its centre", 0.0, 0.264241}, Place{"a distance of two radii", 40.0, 0.0248935}})
    out.push_back({"A 4",
                   std::string("study: concentration that a secreting ball as wide as a signal reaches makes at ") + p.where + ", mM",
                   p.concentration, 0.023 * p.concentration, "Yukawa's closed form of D∇²c − kc + s = 0 for a ball; voxels of R/5",
                   [=] { return mean_at(ball->found(), 100.0, p.distance); }});
}

}  // namespace

void add_field_study_numbers(std::vector<ReferenceNumber>& out) {
  const auto coarse = slab(20), middle = slab(10), fine = slab(5);
  const auto mean = [](StudyToRun& run) { return run.found().column("mean_food", 40.0); };
  // Voxels err by (phi h/L)^2/12 of the slope at the wall: 5e-3 at 10 um; what is left of the line in h^2 at h = 0 is its square.
  out.push_back({"A 4", "study: part that diffusion lets through to a slab of Thiele modulus 2, voxel to 0", 0.482014, 3e-5,
                 "tanh(phi)/phi, Thiele 1939; six digits, fourth order left", [=] { return (4.0 * mean(*fine) - mean(*middle)) / 3.0; }});
  out.push_back({"A 4", "study: its error with voxels of 20 um over that of 10 um", 4.0, 0.15, "second order; 4 % of the next order",
                 [=] { return (mean(*coarse) - 0.482014) / (mean(*middle) - 0.482014); }});
  const auto ball = study_to_run("ball",
                                 "time: {end: 100 s, step: 20 s, output: 100 s, checkpoint: 100 s}\n"
                                 "domain: {size: [420 um, 420 um, 420 um], boundary: open}\ncell_types: {cell: {radius: 100 um}}\n"
                                 "initial:\n  - {type: cell, at: [[0 um, 0 um, 0 um]], as: sphere}\n"
                                 "fields:\n  food: {diffusion: 2e-9 m^2/s, initial: 0.2 mM, voxel: 20 um, boundary: {all: 0.2 mM}, "
                                 "uptake: {cell: {rate: 185185.12 amol/s, half_saturation: 1e-8 mM}}}\n");
  out.push_back({"A 5", "study: uptake of a ball of 100 um by the profile of the field around and in it, over that of the study", 1.0, 0.02,
                 "closed form q (R^2 - r^2)/(6 D); voxels of R/5 that the rim cuts: (h/R)^2/2",
                 [ball] { return uptake_from_profile(ball->found(), 100.0, 2000.0, 185185.12); }});
  add_thiele_ball(out);
  add_secreting_ball(out);
}

}  // namespace morula::scenarios
