#include "scenarios/verify/study_numbers.h"

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>

#include "core/numbers/number_text.h"
#include "scenarios/library/single_cell.h"
#include "scenarios/report/series_reader.h"
#include "scenarios/run/driver.h"
#include "scenarios/study/study.h"

namespace morula::scenarios {
namespace {

namespace fs = std::filesystem;

/// What a run left in its folder.
struct Found {
  std::vector<Snapshot> moments;
  SeriesTable series;

  [[nodiscard]] const Snapshot* at(double time) const {
    for (const Snapshot& moment : moments)
      if (std::abs(moment.time - time) < 1e-6) return &moment;
    return nullptr;
  }
  /// A column at a time; not a number where there is none.
  [[nodiscard]] double column(const char* name, double time) const {
    const SeriesColumn *values = series.find(name), *times = series.find("time");
    for (std::size_t i = 0; values != nullptr && times != nullptr && i < times->values.size(); ++i)
      if (std::abs(times->values[i] - time) < 1e-6) return values->values[i];
    return std::nan("");
  }
};

Found run_text(const std::string& name, const std::string& text) {
  const fs::path folder = fs::temp_directory_path() / ("morula-verify-" + std::to_string(getpid()) + "-" + name);
  Found out;
  const auto study = read_study_text(name, text, folder);
  if (study.ok()) {
    RunRequest request;
    request.out = folder / "run";
    std::error_code ignored;
    fs::create_directories(folder, ignored);
    if (const auto done = run(*study, request, Comm()); done.ok()) {
      auto moments = all_snapshots(done->path);
      auto series = read_series(done->path / "series.csv");
      if (moments.ok() && series.ok()) out = {std::move(*moments), std::move(*series)};
    }
    fs::remove_all(folder, ignored);
  }
  return out;
}

/// A study that is run when the first of its numbers is asked for.
class Lazy {
 public:
  Lazy(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text)) {}
  const Found& found() {
    if (!found_) found_ = std::make_unique<Found>(run_text(name_, text_));
    return *found_;
  }

 private:
  std::string name_, text_;
  std::unique_ptr<Found> found_;
};

std::shared_ptr<Lazy> study(const char* name, const std::string& text) {
  return std::make_shared<Lazy>(name, "schema: 1\nstudy: " + std::string(name) + "\n" + text + "output: {report: false}\n");
}

/// Inert spheres of 5 µm whose drag is that of 10 µm/min under 5.236 nN, by Hertz alone; steps of `step` seconds, solved until nothing is left.
std::string spheres_of_hertz(const char* end, const char* output, double step) {
  const std::string dt = number_text("%g", step) + " s";
  return std::string("time: {end: ") + end + ", step: " + dt + ", output: " + output + ", checkpoint: " + end + "}\n" +
         "numerics: {initial_step: " + dt + ", newton: 20, newton_stop: 1e-6, tolerance: 1e-8, later_tolerance: 1e-8}\n" +
         "domain: {size: [300 um, 60 um, 60 um], boundary: open}\n";
}

std::string sphere_type(const std::string& name, const std::string& adhesion) {
  return "  " + name + ": {radius: 5 um, cbm: {law: hertz, young: 450 Pa, poisson: 0.4, packing: none}, adhesion: {" + adhesion +
         "}, friction: {cell_cell: 0 N s/m^3, medium: 1e8 N s/m^3}}\n";
}

std::shared_ptr<Lazy> pushed_pair(double step) {
  return study("push", spheres_of_hertz("4 min", "6 s", step) + "cell_types:\n" + sphere_type("left", "left: 0 J/m^2, right: 0 J/m^2") +
                           sphere_type("right", "right: 0 J/m^2") +
                           "initial:\n  - {type: left, at: [[-15 um, 0 um, 0 um]], as: sphere}\n"
                           "  - {type: right, at: [[15 um, 0 um, 0 um]], as: sphere}\n"
                           "loads:\n  a: {type: left, body_force: [5.2359878 nN, 0 nN, 0 nN]}\n"
                           "  b: {type: right, body_force: [-5.2359878 nN, 0 nN, 0 nN]}\n");
}

std::shared_ptr<Lazy> chain(double step) {
  std::string at;
  for (int i = -5; i <= 5; ++i) at += (i > -5 ? ", [" : "[") + std::to_string(5 * i) + " um, 0 um, 0 um]";
  return study("chain", spheres_of_hertz("2 min", "20 s", step) + "cell_types:\n" + sphere_type("cell", "cell: 0 J/m^2") +
                            "initial:\n  - {type: cell, at: [" + at + "], as: sphere}\n");
}

/// Distance of the first and the last cell along x [µm].
double width(const Found& found, double time) {
  const Snapshot* moment = found.at(time);
  return moment != nullptr && !moment->cells.empty() ? moment->cells.back().centroid.x - moment->cells.front().centroid.x : std::nan("");
}

/// Backward Euler errs in the first order of the step: the line through two steps at step 0 errs in the second.
double width_without_step(Lazy& coarse, Lazy& fine, double time) { return 2.0 * width(fine.found(), time) - width(coarse.found(), time); }

void add_motion(std::vector<ReferenceNumber>& out) {
  constexpr const char* kPush = "cbm.md 7.2, Hertz 1882: radial integration of the two cells' equation";
  const auto coarse = pushed_pair(0.4), fine = pushed_pair(0.2);
  out.push_back({"cbm 7.2", "study: distance at which two spheres rest that push each other by 5.236 nN [um]", 5.586419, 2e-6,
                 "cbm.md 7.2: Hertz 1882; seven digits, after 10 relaxation times 1e-6", [fine] { return width(fine->found(), 240.0); }});
  struct Moment {
    double time, overlap;
  };
  // A step of 0.2 s moves a cell by 0.033 um: what the extrapolation leaves is (0.2 s/8 s)^2/2 of the overlap, 8 s being the relaxation time.
  for (const Moment& m : {Moment{66.0, 1.781208}, Moment{72.0, 2.962568}, Moment{90.0, 4.209660}})
    out.push_back({"cbm 7.2", "study: their overlap " + number_text("%g", m.time - 60.0) + " s after they met, step to 0 [um]", m.overlap,
                   m.overlap * 1e-3, kPush, [=] { return 10.0 - width_without_step(*coarse, *fine, m.time); }});
  out.push_back({"cbm 7.2", "study: motion of their centre of mass [um]", 0.0, 1e-12, "cbm.md 7.2: 1e-12", [fine] {
                   const Snapshot* end = fine->found().at(240.0);
                   return end != nullptr ? end->cells.front().centroid.x + end->cells.back().centroid.x : std::nan("");
                 }});
  const auto long_chain = chain(0.4), short_chain = chain(0.2);
  // The steepest change is at the ends: (0.2 s/5 s)^2/2 of the 5.5 um of the first 20 s, and less later.
  for (const Moment& m : {Moment{20.0, 55.4842396}, Moment{60.0, 61.7476905}, Moment{120.0, 68.0758232}})
    out.push_back({"cbm 7.1",
                   "study: width of a chain of 11 spheres of Hertz, half a diameter apart at first, after " + number_text("%g", m.time) +
                       " s, step to 0 [um]",
                   m.overlap, 5e-3, "Runge-Kutta of fourth order of the same equations, written apart (steps 0.1 and 0.05 s agree to 1e-7)",
                   [=] { return width_without_step(*long_chain, *short_chain, m.time); }});
}

void add_walk(std::vector<ReferenceNumber>& out) {
  constexpr int kSide = 10;
  std::string at;
  for (int i = 0; i < kSide * kSide * kSide; ++i) {
    const auto place = [](int k) { return std::to_string(60 * k - 270) + " um"; };
    at += (i > 0 ? ", [" : "[") + place(i % kSide) + ", " + place(i / kSide % kSide) + ", " + place(i / kSide / kSide) + "]";
  }
  const auto walk =
      study("walk",
            "time: {end: 3 h, output: 1 h, checkpoint: 3 h}\ndomain: {size: [900 um, 900 um, 900 um], boundary: open}\n"
            "cell_types: {cell: {radius: 5 um, adhesion: {cell: 0 J/m^2}, migration: {speed: 20 um/h, persistence: 30 min}}}\n"
            "initial:\n  - {type: cell, at: [" +
                at + "], as: sphere}\n");
  const double three_errors = 3.0 * std::sqrt(2.0 / (3.0 * kSide * kSide * kSide));
  for (const double hours : {1.0, 3.0}) {
    const double speed = 20.0, persistence = 0.5;  // [µm/h], [h]
    const double expected = 2.0 * speed * speed * persistence * (hours - persistence * (1.0 - std::exp(-hours / persistence)));
    out.push_back({"cbm 4", "study: mean square way of 1000 walking cells after " + number_text("%g", hours) + " h [um^2]", expected,
                   three_errors * expected, "closed form 2 S^2 P (t - P (1 - exp(-t/P))); three standard errors", [walk, hours] {
                     const Snapshot *then = walk->found().at(0.0), *now = walk->found().at(3600.0 * hours);
                     if (then == nullptr || now == nullptr || then->cells.size() != now->cells.size()) return std::nan("");
                     double sum = 0.0;
                     for (std::size_t i = 0; i < now->cells.size(); ++i) sum += norm2(now->cells[i].centroid - then->cells[i].centroid);
                     return sum / static_cast<double>(now->cells.size());
                   }});
  }
}

void add_growth_and_exchange(std::vector<ReferenceNumber>& out) {
  const auto growth = study("growth",
                            "time: {end: 48 h, output: 6 h, checkpoint: 48 h}\ndomain: {size: [200 um, 200 um, 200 um], boundary: open}\n"
                            "cell_types: {cell: {radius: 5 um, cycle: {duration: 18 h}}}\n"
                            "initial:\n  - {type: cell, at: [[0 um, 0 um, 0 um]], age: birth, as: sphere}\n");
  const double birth = 500.0 / 3.0 * std::numbers::pi;
  struct Moment {
    double hours, cells, volume;
  };
  for (const Moment& m : {Moment{12.0, 1.0, 1.666667}, Moment{24.0, 2.0, 2.666667}, Moment{48.0, 4.0, 6.666667}}) {
    const std::string when = " after " + number_text("%g", m.hours) + " h of a cycle of 18 h";
    out.push_back({"cbm 5", "study: cells" + when, m.cells, 1e-12, "cbm.md 5: counts are whole",
                   [=] { return growth->found().column("cell_count", 3600.0 * m.hours); }});
    out.push_back({"cbm 5", "study: volume of all over that at birth" + when, m.volume, 1e-6, "cbm.md 5: linear growth, seven digits",
                   [=] { return growth->found().column("total_volume", 3600.0 * m.hours) / birth; }});
  }
  // The exchange comes at the end of the step that lands on an output time, whose snapshot shows the new body before anything moved.
  const auto swap =
      study("exchange",
            "time: {end: 10 min, output: 10 min, checkpoint: 10 min}\ndomain: {size: [100 um, 100 um, 100 um], boundary: open}\n"
            "cell_types: {cell: {radius: 6 um}}\ninitial:\n  - {type: cell, at: [[1 um, 2 um, 3 um]], as: sphere}\n"
            "coupling: {regions: [{name: all, shape: sphere, center: [0 um, 0 um, 0 um], radius: 20 um, as: shell, from: 10 min}]}\n");
  const auto exchanged = [swap](auto&& value) {
    const Snapshot *then = swap->found().at(0.0), *now = swap->found().at(600.0);
    const bool whole = then != nullptr && now != nullptr && then->cells.size() == 1 && now->cells.size() == 1 && now->shells.size() == 1 &&
                       then->cells[0].id == now->cells[0].id;
    return whole ? value(then->cells[0], now->cells[0]) : std::nan("");
  };
  out.push_back({"D", "study: volume of a cell just promoted, under its id, over that before", 1.0, 1e-10,
                 "fields_and_coupling.md D: 1e-10",
                 [=] { return exchanged([](const auto& then, const auto& now) { return now.volume / then.volume; }); }});
  out.push_back({"D", "study: way of its centroid by the promotion [um]", 0.0, 1e-9,
                 "fields_and_coupling.md D: the body is exchanged in place",
                 [=] { return exchanged([](const auto& then, const auto& now) { return norm(now.centroid - then.centroid); }); }});
}

/// A slab of half thickness 100 µm with first order loss, Thiele modulus 2, held at 1 mM at both ends.
std::shared_ptr<Lazy> slab(int voxel) {
  return study("slab",
               "time: {end: 40 s, step: 10 s, output: 40 s, checkpoint: 40 s}\ndomain: {size: [200 um, 40 um, 40 um], boundary: open}\n"
               "cell_types: {cell: {radius: 5 um}}\ninitial:\n  - {type: cell, at: [[0 um, 0 um, 0 um]], as: sphere}\n"
               "fields:\n  food: {diffusion: 2e-9 m^2/s, decay: 0.8 1/s, initial: 1 mM, voxel: " +
                   std::to_string(voxel) + " um, boundary: {all: no_flux, x_low: 1 mM, x_high: 1 mM}}\n");
}

/// Uptake of zero order in a ball of radius R: what the profile of the field says that the ball takes up, over what the study says. Within the ball the
/// concentration rises by Q r²/(8πDR³), outside as Q/(4πD)(3/(2R) − 1/r); walls far away add what is harmonic and has the symmetry of a cube, which no
/// mean over directions shows. Least squares over the voxels within 1.4 R.
double uptake_from_profile(const Found& found, double radius, double diffusion, double rate) {
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

void add_fields(std::vector<ReferenceNumber>& out) {
  const auto coarse = slab(20), middle = slab(10), fine = slab(5);
  const auto mean = [](Lazy& run) { return run.found().column("mean_food", 40.0); };
  // Voxels err by (phi h/L)^2/12 of the slope at the wall: 5e-3 at 10 um; what is left of the line in h^2 at h = 0 is its square.
  out.push_back({"A 4", "study: part that diffusion lets through to a slab of Thiele modulus 2, voxel to 0", 0.482014, 3e-5,
                 "tanh(phi)/phi, Thiele 1939; six digits, fourth order left", [=] { return (4.0 * mean(*fine) - mean(*middle)) / 3.0; }});
  out.push_back({"A 4", "study: its error with voxels of 20 um over that of 10 um", 4.0, 0.15, "second order; 4 % of the next order",
                 [=] { return (mean(*coarse) - 0.482014) / (mean(*middle) - 0.482014); }});
  const auto ball = study("ball",
                          "time: {end: 100 s, step: 20 s, output: 100 s, checkpoint: 100 s}\n"
                          "domain: {size: [420 um, 420 um, 420 um], boundary: open}\ncell_types: {cell: {radius: 100 um}}\n"
                          "initial:\n  - {type: cell, at: [[0 um, 0 um, 0 um]], as: sphere}\n"
                          "fields:\n  food: {diffusion: 2e-9 m^2/s, initial: 0.2 mM, voxel: 20 um, boundary: {all: 0.2 mM}, "
                          "uptake: {cell: {rate: 185185.12 amol/s, half_saturation: 1e-9 mM}}}\n");
  out.push_back({"A 5", "study: uptake of a ball of 100 um by the profile of the field around and in it, over that of the study", 1.0, 0.02,
                 "closed form q (R^2 - r^2)/(6 D); voxels of R/5 that the rim cuts: (h/R)^2/2",
                 [ball] { return uptake_from_profile(ball->found(), 100.0, 2000.0, 185185.12); }});
}

}  // namespace

void add_study_numbers(std::vector<ReferenceNumber>& out) {
  add_motion(out);
  add_walk(out);
  add_growth_and_exchange(out);
  add_fields(out);
}

}  // namespace morula::scenarios
