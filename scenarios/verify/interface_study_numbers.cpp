// Where spheres and shells touch, by studies that are run: fields_and_coupling.md D, interface tests (a) and (g).
#include <array>
#include <cmath>
#include <numbers>

#include "core/ball.h"
#include "core/close_packing.h"
#include "core/numbers/number_text.h"
#include "scenarios/verify/run_study.h"
#include "scenarios/verify/study_numbers.h"

namespace morula::scenarios {
namespace {

constexpr double kBulk = 2.5;                     // K_V, the default of a type [kPa]
constexpr std::array<int, 3> kBlock = {4, 3, 3};  // cubic cells; the left half are spheres, the right half shells
constexpr std::size_t kLayers = 2 * kBlock[0];    // of cells, across x
constexpr double kAtRest = 3600.0;                // [s]

double lattice_of(double radius, double part) { return std::cbrt(4.0 * part * ball_volume(radius)); }

std::string size_of_block(double lattice) {
  std::string out;
  for (const int n : kBlock) out += (out.empty() ? "" : ", ") + number_text("%.6f", n * lattice) + " um";
  return "[" + out + "]";
}

/// Cells of one type in a cubic close packing that inflate into the block within 20 min: its left half spheres, its right half shells.
std::string both_halves(double lattice) {
  const auto half = [&](int first, const char* body) {
    return "{type: cell, start_volume: 60 %, inflate: 20 min, as: " + std::string(body) + ", at: [" +
           list_of_places(close_packed_block({first, 0, 0}, {first + kBlock[0] / 2, kBlock[1], kBlock[2]}, kBlock, lattice)) + "]}";
  };
  return "[" + half(0, "sphere") + ", " + half(kBlock[0] / 2, "shell") + "]";
}

/// 144 cells of 6 µm with default parameters, but for what `adhesion` says, in a periodic box that leaves them `part` of their volume.
std::shared_ptr<StudyToRun> block_of_defaults(const std::string& name, double part, const std::string& adhesion) {
  const double lattice = lattice_of(6.0, part);
  return study_to_run(name, "time: {end: 1 h, output: 1 h, checkpoint: 1 h}\ndomain: {size: " + size_of_block(lattice) +
                                ", boundary: periodic}\ncell_types: {cell: {radius: 6 um" + adhesion +
                                "}}\ninitial: " + both_halves(lattice) + "\n");
}

/// The same of the library's calibrated cells of 5 µm, which adhere.
std::shared_ptr<StudyToRun> block_of_fitted(const std::string& name, double part) {
  const double lattice = lattice_of(5.0, part);
  return library_study_to_run(name, "hybrid_block", "study.yaml",
                              {"time={end: 1 h, output: 1 h, checkpoint: 1 h}", "coupling={}", "initial=" + both_halves(lattice),
                               "domain={size: " + size_of_block(lattice) + ", boundary: periodic}"});
}

/// Mean pressure by layer of cells [kPa]; empty where a cell is not of the body that it began with.
std::vector<double> pressure_by_layer(const FoundInRun& found, double lattice) {
  const Snapshot* end = found.at(kAtRest);
  if (end == nullptr || end->cells.size() != 4u * kBlock[0] * kBlock[1] * kBlock[2]) return {};
  std::vector<double> sum(kLayers, 0.0), cells(kLayers, 0.0);
  for (const Snapshot::Cell& cell : end->cells) {
    const auto layer = static_cast<std::size_t>(std::floor(2.0 * (cell.centroid.x / lattice + 0.5 * kBlock[0]) + kLayers)) % kLayers;
    if (cell.body != (2 * layer < kLayers ? BodyKind::kSphere : BodyKind::kShell)) return {};
    sum[layer] += cell.pressure;
    cells[layer] += 1.0;
  }
  for (std::size_t l = 0; l < kLayers; ++l) sum[l] /= cells[l];
  return sum;
}

double mean_of(const std::vector<double>& by_layer, std::size_t first, std::size_t last) {
  double sum = 0.0;
  for (std::size_t l = first; l < last; ++l) sum += by_layer[l] / static_cast<double>(last - first);
  return sum;
}

/// Pressure of the shells less that of the spheres, over their mean; without the `without` outermost layers of each half.
double jump(const FoundInRun& found, double lattice, std::size_t without) {
  const std::vector<double> p = pressure_by_layer(found, lattice);
  if (p.empty()) return std::nan("");
  const double spheres = mean_of(p, without, kLayers / 2 - without), shells = mean_of(p, kLayers / 2 + without, kLayers - without);
  return 2.0 * (shells - spheres) / (shells + spheres);
}

void add_pressure_jumps(std::vector<ReferenceNumber>& out) {
  struct Level {
    const char* part;
    double left;
    /// Limits of the jump, over all layers and over the inner ones; above 0.05: what is, rounded up.
    double default_all, fitted_inner, fitted_all;
  };
  const std::string page = "fields_and_coupling.md D (a)";
  constexpr double kAim = 0.05;
  for (const Level& level :
       {Level{"0.95", 0.95, 0.08, kAim, kAim}, Level{"0.90", 0.90, 0.06, kAim, kAim}, Level{"0.85", 0.85, 0.06, kAim, kAim}}) {
    const std::string at = std::string(" at V/V0 ") + level.part, name = std::string("half") + (level.part + 2);
    struct Kind {
      const char* cells;
      std::shared_ptr<StudyToRun> study;
      double radius, inner, all;
    };
    for (const Kind& kind :
         {Kind{"default parameters", block_of_defaults(name, level.left, ""), 6.0, kAim, level.default_all},
          Kind{"a fitted law", block_of_fitted(name + "_fitted", level.left), 5.0, level.fitted_inner, level.fitted_all}}) {
      const double lattice = lattice_of(kind.radius, level.left);
      const auto study = kind.study;
      const std::string what = std::string("study: p of shells less that of spheres over their mean, half/half block, ") + kind.cells;
      const auto add = [&](const char* layers, double limit, std::size_t without) {
        out.push_back({"D (a)", what + layers + at, 0.0, limit, page + ": 10 %; aim of this project 5 %",
                       [=] { return jump(study->found(), lattice, without); }, limit > kAim ? kAim : 0.0});
      };
      add(", inner layers,", kind.inner, 1);
      add(", all layers,", kind.all, 0);
    }
    const double lattice = lattice_of(6.0, level.left), ideal = kBulk * std::log(1.0 / level.left);
    const auto level_of = block_of_defaults(name + "_plain", level.left, ", adhesion: {cell: 0 J/m^2}");
    out.push_back({"D (a)", "study: p of the block over K_V ln(V0/V), default parameters without adhesion," + at, 1.0, 0.05,
                   page + ": the level of cells that fill space", [=] {
                     const std::vector<double> p = pressure_by_layer(level_of->found(), lattice);
                     return p.empty() ? std::nan("") : mean_of(p, 0, kLayers) / ideal;
                   }});
  }
}

constexpr double kPairRadius = 5.0, kJkrLength = 1.509423463, kHeld = 4.0 * 3600.0;  // [µm], (π² W² R*/E*²)^(1/3) [µm], [s]

/// Two cells of the reference pair of JKR whose centres traps bring to the overlap `overlap` within half an hour and hold there.
std::shared_ptr<StudyToRun> held_pair(const std::string& name, const char* left, const char* right, double overlap) {
  const std::string way = number_text("%.6f", 0.5 * overlap) + " um";
  const auto type = [](const char* adhesion) {
    return std::string("{radius: 5 um, cbm: {law: jkr, young: 0.45 kPa, poisson: 0.4}, adhesion: {") + adhesion + "}}\n";
  };
  const auto trap = [&](const char* of, const char* center, const char* direction) {
    return std::string("{type: ") + of + ", trap: {stiffness: 1 N/m, center: [" + center + " um, 0 um, 0 um], direction: [" + direction +
           ", 0, 0], way: [{time: 10 min, distance: 0 um}, {time: 40 min, distance: " + way + "}]}}\n";
  };
  return study_to_run(name,
                      "time: {end: 4 h, output: 4 h, checkpoint: 4 h}\ndomain: {size: [60 um, 60 um, 60 um], boundary: open}\n"
                      "cell_types:\n  left: " +
                          type("left: 1e-4 J/m^2, right: 1e-4 J/m^2") + "  right: " + type("right: 1e-4 J/m^2") +
                          "initial:\n  - {type: left, at: [[-5 um, 0 um, 0 um]], as: " + left +
                          "}\n  - {type: right, at: [[5 um, 0 um, 0 um]], as: " + right + "}\nloads:\n  l: " + trap("left", "-5", "1") +
                          "  r: " + trap("right", "5", "-1"));
}

void add_held_pairs(std::vector<ReferenceNumber>& out) {
  constexpr double kArea = 26.40998;  // πa² of that pair at half of its length, cbm.md 2
  const auto pair = held_pair("held_pair", "sphere", "shell", 0.5 * kJkrLength);
  const auto alone = held_pair("held_spheres", "sphere", "sphere", 0.5 * kJkrLength);
  const auto of = [](StudyToRun& study, auto&& value) {
    const Snapshot* end = study.found().at(kHeld);
    return end != nullptr && end->cells.size() == 2 ? value(end->cells[0], end->cells[1]) : std::nan("");
  };
  const auto overlap = [](const auto& a, const auto& b) { return 2.0 * kPairRadius - norm(a.centroid - b.centroid); };
  const auto area = [](const auto& a, const auto&) { return a.contact_area; };
  // A trap of 1000 nN/um gives way by 0.6 nm under the 0.57 nN of the pair.
  out.push_back({"D (g)", "study: overlap at which traps hold a sphere and a shell [um]", 0.5 * kJkrLength, 0.005,
                 "given by the study: half of JKR's length", [=] { return of(*pair, overlap); }});
  out.push_back({"D (g)", "study: contact area of two spheres that are held so [um^2]", kArea, 0.002 * kArea,
                 "cbm.md 2: JKR, seven digits; the overlap is met within 0.2 %", [=] { return of(*alone, area); }});
  out.push_back({"D (g)", "study: contact area of a sphere and a default shell that are held so [um^2]", kArea, 0.15 * kArea,
                 "fields_and_coupling.md D (g): 15 %", [=] { return of(*pair, area); }});
}

}  // namespace

void add_interface_study_numbers(std::vector<ReferenceNumber>& out) {
  add_pressure_jumps(out);
  add_held_pairs(out);
}

}  // namespace morula::scenarios
