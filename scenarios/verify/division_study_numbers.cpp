// Shells that divide by cut, by studies that are run.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/ball.h"
#include "scenarios/verify/run_study.h"
#include "scenarios/verify/study_numbers.h"

namespace morula::scenarios {
namespace {

constexpr double kRadius = 6.0, kTension = 0.2, kBulk = 2.5;  // [µm], [nN/µm], [kPa]

/// One shell with default parameters but for its cortex, in a cycle of 2 h. Its divisions are at 2, 4 and 6 h.
std::shared_ptr<StudyToRun> one_to_eight() {
  return study_to_run("one_to_eight",
                      "time: {end: 390 min, output: 10 min, checkpoint: 2 h}\ndomain: {size: [120 um, 120 um, 120 um], boundary: open}\n"
                      "cell_types:\n  egg: {body: shell, radius: 6 um, cycle: {duration: 2 h}, adhesion: {egg: 1e-4 J/m^2}, "
                      "dcm: {nodes: 162, cortex: {elastic: none, tension: 0.2 mN/m}, bulk_modulus: 2.5 kPa}}\n"
                      "initial:\n  - {type: egg, at: [[0 um, 0 um, 0 um]], age: birth}\n");
}

/// Largest difference of the volumes that daughters are born with from that of their mother, relative; none without divisions.
double lost_at_birth(const FoundInRun& found) {
  double worst = found.lives.size() > 1 ? 0.0 : std::nan("");
  for (const CellLife& mother : found.lives) {
    if (mother.how != LifeEnd::kDivided) continue;
    double sum = 0.0;
    for (const CellLife& daughter : found.lives)
      if (daughter.parent == mother.id) sum += daughter.birth_volume;
    worst = std::max(worst, std::abs(sum / mother.division_volume - 1.0));
  }
  return worst;
}

/// Sum of the pressure-free volumes V exp(p/K_V) over that of free cells that have grown by the law, in the middle of a cycle.
double free_volume(const FoundInRun& found, double time) {
  const Snapshot* at = found.at(time);
  if (at == nullptr) return std::nan("");
  double sum = 0.0;
  for (const Snapshot::Cell& cell : at->cells) sum += cell.volume * std::exp(cell.inner_pressure / kBulk);
  const double target = 1.5 * ball_volume(kRadius), radius = kRadius * std::cbrt(1.5);
  const double count = std::exp2(std::floor(time / 7200.0));
  return sum / (count * target * std::exp(2.0 * kTension / radius / kBulk));
}

/// Largest overlap at the outputs, the first ten minutes after a division left out.
double overlap_at_outputs(const FoundInRun& found) {
  const SeriesColumn *overlap = found.series.find("overlap"), *time = found.series.find("time");
  if (overlap == nullptr || time == nullptr) return std::nan("");
  double worst = 0.0;
  for (std::size_t i = 0; i < time->values.size(); ++i)
    if (std::fmod(time->values[i], 7200.0) >= 600.0) worst = std::max(worst, overlap->values[i]);
  return worst;
}

/// Largest rise of the energy of one division over the tension of the mother's surface; divisions of a moment have the same share.
double energy_rise(const FoundInRun& found) {
  double worst = std::nan("");
  for (const EventLine& event : found.events) {
    if (event.kind != "division" || !event.energy_rise) continue;
    const auto together =
        std::ranges::count_if(found.events, [&](const EventLine& e) { return e.kind == event.kind && e.time == event.time; });
    const double radius = std::cbrt(event.volume / ball_volume(1.0));
    const double rise = *event.energy_rise / static_cast<double>(together) / (kTension * 4.0 * std::numbers::pi * radius * radius);
    worst = std::isnan(worst) ? rise : std::max(worst, rise);
  }
  return worst;
}

void add_one_to_eight(std::vector<ReferenceNumber>& out) {
  const auto study = one_to_eight();
  out.push_back({"life division", "study: shells that came of one by three divisions", 8.0, 1e-9, "2^3",
                 [study] { return study->found().column("shell_count", 390.0 * 60.0); }});
  out.push_back({"life division", "study: volume that is lost at a division, over the mother's, the most", 0.0, 1e-10, "volumes are shared",
                 [study] { return lost_at_birth(study->found()); }});
  for (const double minutes : {60.0, 180.0, 300.0})
    out.push_back({"life division",
                   "study: pressure-free volume of all shells over that by the law of growth, after " +
                       std::to_string(static_cast<int>(minutes)) + " min",
                   1.0, 2e-3, "V exp(p/K_V) of free cells; 0.2 % of the volume",
                   [=] { return free_volume(study->found(), 60.0 * minutes); }});
  out.push_back({"life division", "study: deepest overlap at outputs, ten minutes after a division and later [um]", 0.0, 0.09,
                 "5 % of the mean edge", [study] { return overlap_at_outputs(study->found()); }});
  out.push_back({"life division", "study: deepest overlap of any step [um]", 0.0, 0.3, "limit of the overlap",
                 [study] { return study->found().column("worst_overlap", 390.0 * 60.0); }});
  out.push_back({"life division", "study: rise of the energy by a division over the tension of the mother's surface, the most", 0.0, 0.05,
                 "aim 0.01: sisters do not adhere yet along the rim of their interface", [study] { return energy_rise(study->found()); }});
}

/// The corners of an icosahedron around the origin, 12 µm away, as a list of a study.
std::string twelve_places() {
  std::vector<Vec3d> out;
  for (const double y : {-6.309, 6.309})
    for (const double z : {-10.208, 10.208}) out.insert(out.end(), {Vec3d{0.0, y, z}, Vec3d{y, z, 0.0}, Vec3d{z, 0.0, y}});
  return list_of_places(out);
}

/// Twelve resting shells around one that divides after 2 h, or waits.
std::shared_ptr<StudyToRun> among_neighbours(const std::string& name, const std::string& cortex, const char* at_its_end) {
  const std::string body = "body: shell, radius: 6 um, dcm: {nodes: 162, " + cortex + ", bulk_modulus: 2.5 kPa}, ";
  return study_to_run(
      name,
      "time: {end: 121 min, output: 1 min, checkpoint: 1 h}\ndomain: {size: [150 um, 150 um, 150 um], boundary: open}\n"
      "cell_types:\n  mother: {" +
          body +
          "adhesion: {mother: 1e-4 J/m^2, other: 1e-4 J/m^2}, inhibit_growth: {pressure_above: never}, cycle: {duration: 2 h, shells: " +
          at_its_end + "}}\n  other: {" + body +
          "adhesion: {other: 1e-4 J/m^2}, cycle: {model: none}}\ninitial:\n  - {type: mother, at: [[0 um, 0 um, 0 um]], age: birth}\n"
          "  - {type: other, at: [" +
          twelve_places() + "]}\n");
}

/// Distances of the nodes of the neighbours at a time in one run from where they are in the other, over the radius of a cell; sorted.
std::vector<double> ways_of_neighbours(StudyToRun& divides, StudyToRun& waits, double time) {
  const Snapshot *a = divides.found().at(time), *b = waits.found().at(time);
  std::vector<double> out;
  if (a == nullptr || b == nullptr || a->cells.size() != b->cells.size() + 1) return out;
  for (const Snapshot::Shell& one : a->shells)
    for (const Snapshot::Shell& other : b->shells) {
      if (a->cells[one.cell].id != b->cells[other.cell].id) continue;
      for (std::uint32_t i = 0; i < one.node_count; ++i)
        out.push_back(norm(a->nodes[one.first_node + i] - b->nodes[other.first_node + i]) / kRadius);
    }
  std::ranges::sort(out);
  return out;
}

void add_neighbours(std::vector<ReferenceNumber>& out) {
  struct Cortex {
    const char *name, *text;
  };
  for (const auto& [name, text] :
       {Cortex{"fluid", "cortex: {elastic: none, tension: 0.2 mN/m}"},
        Cortex{"elastic",
               "cortex: {young: 1 kPa, thickness: 200 nm, tension: 0.2 mN/m}, fold_barrier: {stiffness: 1 fJ, angle: 1.6 rad}"}}) {
    const auto divides = among_neighbours(std::string(name) + "_divides", text, "cut"),
               waits = among_neighbours(std::string(name) + "_waits", text, "wait");
    const std::string start =
        "study: way of the nodes of neighbours in the minute after a division, beyond a cell that waits, over the radius, ";
    out.push_back(
        {"life neighbours", start + name + ", rms", 0.0, 0.02, "aim of this project: no more than an interface without tension does", [=] {
           const std::vector<double> ways = ways_of_neighbours(*divides, *waits, 121.0 * 60.0);
           double sum = ways.empty() ? std::nan("") : 0.0;
           for (const double way : ways) sum += way * way / static_cast<double>(ways.size());
           return std::sqrt(sum);
         }});
    out.push_back({"life neighbours", start + name + ", 99 % of them", 0.0, 0.08, "aim of this project, as for the rms", [=] {
                     const std::vector<double> ways = ways_of_neighbours(*divides, *waits, 121.0 * 60.0);
                     return ways.empty() ? std::nan("") : ways[ways.size() * 99 / 100];
                   }});
  }
}

}  // namespace

void add_division_study_numbers(std::vector<ReferenceNumber>& out) {
  add_one_to_eight(out);
  add_neighbours(out);
}

}  // namespace morula::scenarios
