// Spheres that push each other, a chain of them, a walk, growth, an exchange of bodies.
#include "scenarios/verify/study_numbers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/numbers/number_text.h"
#include "scenarios/measures/single_cell.h"
#include "scenarios/verify/run_study.h"

namespace morula::scenarios {
namespace {

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

std::shared_ptr<StudyToRun> pushed_pair(double step) {
  return study_to_run("push", spheres_of_hertz("4 min", "6 s", step) + "cell_types:\n" +
                                  sphere_type("left", "left: 0 J/m^2, right: 0 J/m^2") + sphere_type("right", "right: 0 J/m^2") +
                                  "initial:\n  - {type: left, at: [[-15 um, 0 um, 0 um]], as: sphere}\n"
                                  "  - {type: right, at: [[15 um, 0 um, 0 um]], as: sphere}\n"
                                  "loads:\n  a: {type: left, body_force: [5.2359878 nN, 0 nN, 0 nN]}\n"
                                  "  b: {type: right, body_force: [-5.2359878 nN, 0 nN, 0 nN]}\n");
}

std::shared_ptr<StudyToRun> chain(double step) {
  std::vector<Vec3d> places;
  for (int i = -5; i <= 5; ++i) places.push_back({5.0 * i, 0.0, 0.0});
  return study_to_run("chain", spheres_of_hertz("2 min", "20 s", step) + "cell_types:\n" + sphere_type("cell", "cell: 0 J/m^2") +
                                   "initial:\n  - {type: cell, at: [" + list_of_places(places) + "], as: sphere}\n");
}

/// Distance of the first and the last cell along x [µm].
double width(const FoundInRun& found, double time) {
  const Snapshot* moment = found.at(time);
  return moment != nullptr && !moment->cells.empty() ? moment->cells.back().centroid.x - moment->cells.front().centroid.x : std::nan("");
}

/// Backward Euler errs in the first order of the step: the line through two steps at step 0 errs in the second.
double width_without_step(StudyToRun& coarse, StudyToRun& fine, double time) {
  return 2.0 * width(fine.found(), time) - width(coarse.found(), time);
}

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
  std::vector<Vec3d> places;
  const auto place = [](int k) { return 60.0 * k - 270.0; };
  for (int i = 0; i < kSide * kSide * kSide; ++i) places.push_back({place(i % kSide), place(i / kSide % kSide), place(i / kSide / kSide)});
  const auto walk =
      study_to_run("walk",
                   "time: {end: 3 h, output: 1 h, checkpoint: 3 h}\ndomain: {size: [900 um, 900 um, 900 um], boundary: open}\n"
                   "cell_types: {cell: {radius: 5 um, adhesion: {cell: 0 J/m^2}, migration: {speed: 20 um/h, persistence: 30 min}}}\n"
                   "initial:\n  - {type: cell, at: [" +
                       list_of_places(places) + "], as: sphere}\n");
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
  const auto growth =
      study_to_run("growth",
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
  const auto swap = study_to_run(
      "exchange",
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

}  // namespace

void add_study_numbers(std::vector<ReferenceNumber>& out) {
  add_motion(out);
  add_walk(out);
  add_growth_and_exchange(out);
  add_contact_study_numbers(out);
  add_field_study_numbers(out);
}

}  // namespace morula::scenarios
