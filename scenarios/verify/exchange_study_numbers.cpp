// Cells that exchange their bodies, by studies that are run: fields_and_coupling.md D, interface tests (b), (c) and (d).
#include <algorithm>
#include <cmath>
#include <map>

#include "core/ball.h"
#include "core/close_packing.h"
#include "core/numbers/number_text.h"
#include "results/exchanges.h"
#include "scenarios/verify/lone_shell.h"
#include "scenarios/verify/run_study.h"
#include "scenarios/verify/study_numbers.h"
#include "study/initial/cells_from_meshes.h"

namespace morula::scenarios {
namespace {

const Snapshot::Cell* cell_of(const Snapshot& moment, const std::string& id) {
  const auto at = std::ranges::find_if(moment.cells, [&](const Snapshot::Cell& cell) { return cell.id.text() == id; });
  return at != moment.cells.end() ? &*at : nullptr;
}

/// Of the ball, or of the shell's V0 = V exp(p_in/K_V) at the default tension and bulk modulus [µm³].
double free_volume(const Snapshot::Cell& cell) {
  constexpr double kTension = 0.1, kBulk = 2.5;  // [nN/µm], [kPa]
  return cell.body == BodyKind::kSphere ? cell.volume : target_volume_of(cell.volume, cell.inner_pressure, kTension, kBulk);
}

/// 100 cells of different size and age, out of each other's reach, that become shells one after the other and spheres again, one in a step; every second step
/// lands on an output, whose snapshot shows the new body before anything has moved.
std::shared_ptr<StudyToRun> round_trip() {
  std::vector<Vec3d> places;
  for (int i = 0; i < 100; ++i) places.push_back({30.0 * (i % 5 - 2) + 1.0, 30.0 * (i / 5 % 5 - 2) + 2.0, 30.0 * (i / 25 - 2) + 3.0});
  return study_to_run("round_trip",
                      "time: {end: 1 h, output: 30 s, checkpoint: 1 h}\ndomain: {size: [200 um, 200 um, 200 um], boundary: open}\n"
                      "cell_types: {cell: {radius: {mean: 6 um, spread: 10 %}}}\n"
                      "fields: {oxygen: {diffusion: 2e-9 m^2/s, initial: 0.1 mM, voxel: 20 um, boundary: {all: 0.1 mM}, "
                      "uptake: {cell: {rate: 20 amol/s, half_saturation: 0.005 mM}}}}\n"
                      "initial:\n  - {type: cell, as: sphere, age: random, at: [" +
                          list_of_places(places) +
                          "]}\ncoupling: {hold: 5 min, regions: [{name: all, shape: everything, from: 1 min, until: 30 min}]}\n");
}

/// The most of value(cell before, cell after, event) over the exchanges that land on an output; not a number unless these are many.
template <class Value>
double most_of_exchanges(const FoundInRun& found, Value value) {
  double most = 0.0;
  std::size_t count = 0;
  for (const EventLine& event : exchanges_of(found.events)) {
    const Snapshot *after = found.at(event.time), *before = found.at(event.time - 30.0);
    if (after == nullptr) continue;
    const auto *now = cell_of(*after, event.cell), *then = before != nullptr ? cell_of(*before, event.cell) : nullptr;
    if (now == nullptr || then == nullptr || now->body == then->body || !event.exchange) return std::nan("");
    most = larger(most, value(*then, *now, event));
    ++count;
  }
  return count >= 90 ? most : std::nan("");
}

void add_round_trip(std::vector<ReferenceNumber>& out) {
  const auto study = round_trip();
  const char* const page = "fields_and_coupling.md D (b): 1e-10";
  using Cell = Snapshot::Cell;
  out.push_back(
      {"D (b)", "study: cells that became shells and spheres again, each once, of 100", 100.0, 1e-9, "the study's region", [study] {
         std::map<std::string, int> ups, downs;
         for (const EventLine& event : exchanges_of(study->found().events)) ++(event.kind == "promotion" ? ups : downs)[event.cell];
         double whole = 0.0;
         for (const auto& [id, count] : ups) whole += count == 1 && downs[id] == 1;
         return study->found().moments.empty() ? std::nan("") : whole;
       }});
  out.push_back({"D (b)", "study: change of the volume that a cell has when nothing presses it, by an exchange, relative, the most of 100",
                 0.0, 1e-10, page, [study] {
                   return most_of_exchanges(study->found(), [](const Cell& then, const Cell& now, const EventLine&) {
                     return std::abs(free_volume(now) / free_volume(then) - 1.0);
                   });
                 }});
  out.push_back({"D (b)", "study: way of its centroid, over its radius, the most", 0.0, 1e-10, page, [study] {
                   return most_of_exchanges(study->found(), [](const Cell& then, const Cell& now, const EventLine&) {
                     return norm(now.centroid - then.centroid) / now.radius;
                   });
                 }});
  out.push_back({"D (b)", "study: its age beside that of a step of 30 s more, the most [s]", 0.0, 1e-6, "clocks go on", [study] {
                   return most_of_exchanges(study->found(), [](const Cell& then, const Cell& now, const EventLine&) {
                     return now.phase == then.phase && now.parent == then.parent ? std::abs(now.age - then.age - 30.0) : std::nan("");
                   });
                 }});
  out.push_back({"D (b)", "study: error of the balance of what cells took from a field meanwhile, relative", 0.0, 1e-9,
                 "scenarios.md S16.3: field totals across exchanges, 1e-9",
                 [study] { return study->found().column("field_balance", 3600.0); }});
}

/// A cluster of `count` cells at about the distance at which they rest, of which the one in the middle becomes a shell when it has come to rest.
struct Cluster {
  std::size_t count;
  bool fitted;   ///< the library's calibrated cells of 5 µm, else cells of 6 µm with default parameters
  double limit;  ///< of the largest way of another cell, over the radius
  const char* reason;
};

void add_neighbours_of_a_promotion(std::vector<ReferenceNumber>& out) {
  constexpr double kAim = 0.02, kHour = 3600.0;
  const char* const page = "fields_and_coupling.md D (c)";
  // With the default adhesion and tension two spheres rest further apart than two shells, and a shell among spheres draws them nearer (E651). A free cluster of
  // 13 has no neighbours that hold its outer cells. Limits above the aim are what is, rounded up: a change that moves neighbours further is to be seen here.
  for (const Cluster& cluster : {Cluster{64, false, 0.05, "default parameters"}, Cluster{13, false, 0.06, "default parameters"},
                                 Cluster{64, true, kAim, "a fitted law"}, Cluster{13, true, 0.06, "a fitted law"}}) {
    const double distance = cluster.fitted ? 8.9 : 11.35, rest = cluster.fitted ? 20.0 : 1.0, radius = cluster.fitted ? 5.0 : 6.0;
    const std::vector<Vec3d> all = close_packed_places(4, distance);
    const std::string type = cluster.fitted ? "tumour" : "cell", name = "neighbours_" + std::to_string(cluster.count);
    const std::string initial = "[{type: " + type + ", as: sphere, at: [" + list_of_places(std::span(all).first(cluster.count)) + "]}]";
    const std::string coupling =
        "{regions: [{name: middle, shape: sphere, center: [0 um, 0 um, 0 um], radius: 1 um, margin: 20 um, as: shell, from: " +
        number_text("%g", kHour * rest + 60.0) + " s}]}";
    const std::string end = number_text("%g h", rest + 4.0), time = "{end: " + end + ", output: 1 h, checkpoint: " + end + "}";
    const auto study =
        cluster.fitted
            ? library_study_to_run(name + "_fitted", "hybrid_spheroid", "study.yaml",
                                   {"time=" + time, "initial=" + initial, "coupling=" + coupling, "fields={}",
                                    "cell_types.tumour.radius.spread=0 %", "cell_types.tumour.cycle={model: none}"})
            : study_to_run(name, "time: " + time +
                                     "\ndomain: {size: [200 um, 200 um, 200 um]}\ncell_types: {cell: {radius: 6 um}}\ninitial: " + initial +
                                     "\ncoupling: " + coupling + "\n");
    out.push_back({"D (c)",
                   "study: largest way of another cell of " + std::to_string(cluster.count) + " when the middle one is promoted, " +
                       cluster.reason + " [R]",
                   0.0, cluster.limit, std::string(page) + (cluster.limit > kAim ? "; limit: what is today, rounded up" : ""),
                   [=] {
                     const Snapshot *before = study->found().at(kHour * rest), *after = study->found().at(kHour * (rest + 4.0));
                     if (before == nullptr || after == nullptr || !before->shells.empty() || after->shells.size() != 1) return std::nan("");
                     double most = 0.0;
                     for (std::size_t i = 0; i < after->cells.size(); ++i)
                       most = std::max(most, norm(after->cells[i].centroid - before->cells[i].centroid) / radius);
                     return most;
                   },
                   cluster.limit > kAim ? kAim : 0.0});
  }
}

/// 32 cells that fill a periodic box whose volume goes to and fro, so that their pressure does between two values [Pa] every 20 steps of half a
/// minute. Above 200 Pa they become shells, below 140 Pa spheres: a shell alone among balls of a lattice grows into the corners that these leave, and bears a fifth
/// less than they do. Where many exchange their bodies while the box shrinks, some are left as deep in a neighbour as a new shell may be, 0.5 µm.
std::shared_ptr<StudyToRun> at_the_threshold(const std::string& name, double low, double high, double steps) {
  constexpr double kBulk = 2500.0, kStep = 30.0, kBegin = 1800.0;  // K_V [Pa], [s], [s]
  const double size = 2.0 * std::cbrt(4.0 * ball_volume(6.0));
  const auto volume = [&](double pressure) { return number_text("%.8f", std::exp(-pressure / kBulk)); };
  std::string course = "{time: 0 s, volume: 1}";
  bool up = true;
  for (double t = kBegin; t <= kBegin + steps * kStep; t += 10.0 * kStep, up = !up)
    course += ", {time: " + number_text("%g", t) + " s, volume: " + volume(up ? high : low) + "}";
  const std::string end = number_text("%g", kBegin + steps * kStep) + " s", edge = number_text("%.6f", size) + " um";
  return study_to_run(
      name, "time: {end: " + end + ", step: 30 s, output: 10 min, checkpoint: " + end + "}\ndomain:\n  size: [" + edge + ", " + edge +
                ", " + edge + "]\n  boundary: periodic\n  course: [" + course +
                "]\ncell_types: {cell: {radius: 6 um, adhesion: {cell: 0 J/m^2}}}\ninitial:\n  - {type: cell, as: sphere, at: [" +
                list_of_places(close_packed_block({0, 0, 0}, {2, 2, 2}, {2, 2, 2}, 0.5 * size)) +
                "]}\ncoupling: {triggers: [{promote: pressure > 200 Pa, demote: pressure < 140 Pa}]}\nlimits: {overlap: 0.5 um}\n");
}

/// Exchanges of the cell that has the most; not a number where not all 32 are there to the end.
double most_exchanges(const FoundInRun& found) {
  if (found.moments.empty() || found.moments.back().cells.size() != 32) return std::nan("");
  std::map<std::string, double> count;
  for (const EventLine& event : exchanges_of(found.events)) count[event.cell] += 1.0;
  double most = 0.0;
  for (const auto& [cell, number] : count) most = std::max(most, number);
  return most;
}

void add_thresholds(std::vector<ReferenceNumber>& out) {
  const char* const page = "fields_and_coupling.md D (d)";
  const auto at = at_the_threshold("at_threshold", 198.0, 202.0, 1000.0),
             between = at_the_threshold("between_thresholds", 178.0, 182.0, 1000.0),
             across = at_the_threshold("across_thresholds", 80.0, 260.0, 250.0);
  out.push_back({"D (d)", "study: exchanges of a cell whose pressure swings by 1 % about the threshold, 1,000 steps, the most", 1.0, 1e-9,
                 std::string(page) + ": it is promoted, and not again", [at] { return most_exchanges(at->found()); }});
  out.push_back({"D (d)", "study: exchanges of cells whose pressure swings between both thresholds, 1,000 steps", 0.0, 1e-9, page,
                 [between] { return most_exchanges(between->found()); }});
  out.push_back({"D (d)",
                 "study: least time between two exchanges of a cell whose pressure crosses both thresholds every 5 min, over the hold of "
                 "30 min, at least 1",
                 1.0, 0.02, std::string(page) + ", S7.8: it is asked again at the first step after the hold", [across] {
                   const std::vector<double> kept = times_between_exchanges(exchanges_of(across->found().events));
                   return kept.empty() ? std::nan("") : std::ranges::min(kept) / 1800.0;
                 }});
}

}  // namespace

void add_exchange_study_numbers(std::vector<ReferenceNumber>& out) {
  add_round_trip(out);
  add_neighbours_of_a_promotion(out);
  add_thresholds(out);
}

}  // namespace morula::scenarios
