// A packing under pressure and a sphere pushed onto a shell, by studies that are run.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/close_packing.h"
#include "core/numbers/number_text.h"
#include "scenarios/verify/run_study.h"
#include "scenarios/verify/study_numbers.h"

namespace morula::scenarios {
namespace {

constexpr double kBulk = 2.5;  // K_V, the default of a type [kPa]

/// 108 spheres of 6 µm with default parameters but no adhesion, in cubic close packing in a periodic box that leaves them `part` of their volume.
std::shared_ptr<StudyToRun> packed_block(const char* name, double part) {
  constexpr std::array kBlock{3, 3, 3};
  const double lattice = std::cbrt(4.0 * part * 4.0 / 3.0 * std::numbers::pi * 216.0), size = kBlock[0] * lattice;
  const std::string length = number_text("%.6f", size) + " um";
  return study_to_run(name, "time: {end: 30 min, output: 30 min, checkpoint: 30 min}\ndomain: {size: [" + length + ", " + length + ", " +
                                length + "], boundary: periodic}\ncell_types: {cell: {radius: 6 um, adhesion: {cell: 0 J/m^2}}}\n" +
                                "initial:\n  - {type: cell, start_volume: 50 %, inflate: 15 min, as: sphere, at: [" +
                                list_of_places(close_packed_block({0, 0, 0}, kBlock, kBlock, lattice)) + "]}\n");
}

/// Largest pressure of a cell less the smallest, over their mean.
double scatter_of_pressure(const FoundInRun& found) {
  const Snapshot* end = found.at(1800.0);
  if (end == nullptr || end->cells.empty()) return std::nan("");
  double low = end->cells[0].pressure, high = low, sum = 0.0;
  for (const auto& cell : end->cells) low = std::min(low, cell.pressure), high = std::max(high, cell.pressure), sum += cell.pressure;
  return (high - low) * static_cast<double>(end->cells.size()) / sum;
}

void add_packed_blocks(std::vector<ReferenceNumber>& out) {
  struct Level {
    const char *name, *part;
    double left;
  };
  for (const Level& level : {Level{"block90", "0.90", 0.9}, Level{"block80", "0.80", 0.8}}) {
    const auto block = packed_block(level.name, level.left);
    const double pressure = kBulk * std::log(1.0 / level.left);
    out.push_back({"cbm 3", std::string("study: pressure of spheres of default material at V/V0 ") + level.part + " [kPa]", pressure,
                   0.012 * pressure, "closed form K_V ln(V0/V); cbm.md 3: eight knots of the curve leave 1.2 %",
                   [block] { return block->found().column("mean_pressure", 1800.0); }});
    out.push_back({"cbm 3", std::string("study: its largest difference between cells, relative, at V/V0 ") + level.part, 0.0, 1e-5,
                   "closed form: all sites of the lattice are alike; places are given to 1e-6 um",
                   [block] { return scatter_of_pressure(block->found()); }});
  }
}

/// A sphere and a shell of 6 µm with a fluid cortex, without adhesion, pressed onto each other by ±2 nN on the whole of either.
std::shared_ptr<StudyToRun> pushed_onto_shell() {
  return study_to_run(
      "onto_shell",
      "time: {end: 90 s, output: 90 s, checkpoint: 90 s}\nnumerics: {newton: 20, newton_stop: 1e-3, tolerance: 1e-6}\n"
      "domain: {size: [60 um, 60 um, 60 um], boundary: open}\ncell_types:\n"
      "  ball: {radius: 6 um, adhesion: {ball: 0 J/m^2, skin: 0 J/m^2}, friction: {medium: 1e7 N s/m^3, cell_cell: 0 N s/m^3}}\n"
      "  skin: {radius: 6 um, adhesion: {skin: 0 J/m^2}, friction: {medium: 1e7 N s/m^3, cell_cell: 0 N s/m^3}, "
      "dcm: {nodes: 162, cortex: {elastic: none, tension: 0.5 mN/m}}}\n"
      "initial:\n  - {type: ball, at: [[0 um, 0 um, 6 um]], as: sphere}\n"
      "  - {type: skin, at: [[0 um, 0 um, -6 um]], as: shell, orientation: aligned}\n"
      "loads:\n  down: {type: ball, body_force: [0 nN, 0 nN, -2 nN]}\n  up: {type: skin, body_force: [0 nN, 0 nN, 2 nN]}\n");
}

void add_sphere_on_shell(std::vector<ReferenceNumber>& out) {
  const auto pushed = pushed_onto_shell();
  const auto of_both = [pushed](auto&& value) {
    const Snapshot* end = pushed->found().at(90.0);
    const bool whole =
        end != nullptr && end->cells.size() == 2 && end->cells[0].body == BodyKind::kSphere && end->cells[1].body == BodyKind::kShell;
    return whole ? value(end->cells[0], end->cells[1]) : std::nan("");
  };
  // 3pV is arm times force of a single contact. V of a sphere under pressure is V0 exp(-p/K_V) (decision 0023).
  const auto moment_of_sphere = [](const Snapshot::Cell& c) { return 3.0 * c.pressure * c.volume * std::exp(-c.pressure / kBulk); };
  const auto moment_of_shell = [](const Snapshot::Cell& c) { return 3.0 * c.pressure * c.volume; };
  out.push_back({"D", "study: contact area that a sphere tells of a shell it is pushed onto, over that which the shell tells", 1.0, 1e-6,
                 "fields_and_coupling.md D: one contact, one area; of faces in single precision",
                 [=] { return of_both([](const auto& ball, const auto& skin) { return ball.contact_area / skin.contact_area; }); }});
  // The force on the sphere acts in the middle of the contact, that on the shell on its nodes: within the sagitta of a contact of a = 2.6 um, which is at most
  // a^2/2R = 0.5 um and half of it in the mean, hence 2 % of the distance of 10.6 um. The creep that is left at 90 s is below 0.1 %.
  out.push_back(
      {"D", "study: arms of the force on both, by their pressures 3 p V/F and a force of 2 nN, over the distance of their centres", 1.0,
       0.02, "closed form: at rest the contact bears the load of 2 nN, whose arms add up to the distance; place of the contact", [=] {
         return of_both([&](const auto& ball, const auto& skin) {
           return (moment_of_sphere(ball) + moment_of_shell(skin)) / (2.0 * norm(ball.centroid - skin.centroid));
         });
       }});
}

}  // namespace

void add_contact_study_numbers(std::vector<ReferenceNumber>& out) {
  add_packed_blocks(out);
  add_sphere_on_shell(out);
}

}  // namespace morula::scenarios
