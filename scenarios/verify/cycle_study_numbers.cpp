// Growth and cycles of whole populations, by studies that are run: physics/cbm.md §5.
#include <cmath>
#include <utility>

#include "scenarios/verify/run_study.h"
#include "scenarios/verify/study_numbers.h"

namespace morula::scenarios {
namespace {

constexpr const char* kBalanced = "root of E[2 exp(-lambda T)] = 1: Powell 1956, doi:10.1099/00221287-15-3-492";

/// Soft spheres far apart, so that nothing holds them back. Cycles are those of the physics page at ten times the speed.
std::shared_ptr<StudyToRun> far_apart(const char* name, int count, const std::string& cycle, const std::string& end) {
  return study_to_run(
      name, "time: {end: " + end +
                ", output: 36 min, checkpoint: 36 min}\n"
                "numerics: {max_displacement: 2, newton: 1, tolerance: 0.1, initial_step: 1 min}\n"
                "domain: {size: [1500 um, 1500 um, 1500 um], boundary: open}\ncontact: {range: 1 um}\n"
                "cell_types:\n  a:\n    radius: 5 um\n    cycle: {" +
                cycle +
                "}\n    inhibit_growth: {pressure_above: never}\n    adhesion: {a: 0 J/m^2}\n    cbm: {law: hertz, young: 100 Pa}\n"
                "initial:\n  - {type: a, count: " +
                std::to_string(count) + ", fill: random, size: [1400 um, 1400 um, 1400 um], age: random}\nlimits: {volume_error: 10 %}\n");
}

/// ln(N2/N1)/(t2 − t1) with times in hours of a cycle of 18 h.
double rate(const FoundInRun& found, double from, double to) {
  return std::log(found.column("cell_count", 360.0 * to) / found.column("cell_count", 360.0 * from)) / (to - from);
}

/// Mean over the outputs of two cycles of the part of the cells that is in a phase.
double part_in(const FoundInRun& found, const std::string& phase) {
  double sum = 0.0;
  for (int k = 15; k <= 20; ++k) sum += found.column(("cells_in_" + phase).c_str(), 2160.0 * k) / found.column("cell_count", 2160.0 * k);
  return sum / 6.0;
}

/// Slope of the division volume against the birth volume of all cells that have both; none where these are fewer than 250.
double slope(const FoundInRun& found) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const CellLife& life : found.lives) {
    const double a = life.birth_volume, b = life.division_volume;
    if (!(a > 0.0 && b > 0.0)) continue;
    n += 1.0, x += a, y += b, xx += a * a, xy += a * b;
  }
  return n < 250.0 ? std::nan("") : (n * xy - x * y) / (n * xx - x * x);
}

void add_rates(std::vector<ReferenceNumber>& out) {
  const auto fixed = far_apart("fixed", 400, "model: phases, phases: {G1: 42 min, S: 36 min, G2: 18 min, M: 12 min}", "216 min");
  std::string phases;
  for (const char* phase : {"G1: {duration: 42", "S: {duration: 36", "G2: {duration: 18", "M: {duration: 12"})
    phases += std::string(phase) + " min, law: erlang, stages: 10}, ";
  const auto erlang = far_apart("erlang", 100, "model: phases, phases: {" + phases.substr(0, phases.size() - 2) + "}", "720 min");
  out.push_back({"cbm 5", "study: growth rate of a population, phases of 18 h in all, fixed [1/h]", 0.0385082, 0.01 * 0.0385082, kBalanced,
                 [fixed] { return rate(fixed->found(), 0.0, 36.0); }});
  out.push_back({"life founders", "study: part of its founders in G1 at time 0", 0.47257, 0.075,
                 "2 - 2^(1 - 7/18); three standard errors of 400 cells",
                 [fixed] { return fixed->found().column("cells_in_G1", 0.0) / fixed->found().column("cell_count", 0.0); }});
  // What chance did to the first cells takes four cycles to be forgotten.
  out.push_back({"cbm 5", "study: the same, each phase of ten stages (Erlang), last two of six and a half cycles [1/h]", 0.0389140,
                 0.01 * 0.0389140, kBalanced, [erlang] { return rate(erlang->found(), 84.0, 120.0); }});
  for (const auto& [phase, part] : {std::pair("G1", 0.471338), {"S", 0.315060}, {"G2", 0.132991}, {"M", 0.080611}})
    out.push_back({"life phases", std::string("study: part of that population in ") + phase, part, 0.01,
                   "renewal theory, computed independently (physics/cbm.md §5)",
                   [erlang, phase = std::string(phase)] { return part_in(erlang->found(), phase); }});
}

void add_size_control(std::vector<ReferenceNumber>& out) {
  const std::string start = "model: phases, phases: {G1: {until: size}, M: {duration: 12 min, grows: false}}, size: {control: ";
  const std::string rest = ", spread: 5 %}, growth: exponential, duration: {mean: 108 min, spread: 5 %}, share: {mean: 50 %, spread: 15 %}";
  for (const auto& [name, expected] : {std::pair("adder", 1.0), {"sizer", 0.0}}) {
    const auto study = far_apart(name, 60, start + name + rest, "432 min");
    out.push_back({"life size", std::string("study: slope of division volume against birth volume, ") + name, expected, 0.05,
                   "Amir 2014, doi:10.1103/PhysRevLett.112.208102; three standard errors of 250 cells",
                   [study] { return slope(study->found()); }});
  }
}

/// One sphere and one shell that are alone, over half of a cycle of 10 h.
void add_growth_laws(std::vector<ReferenceNumber>& out) {
  // Closed forms at T/2 with V_d = 2 V_b and V_inf = 1.25 V_d: V_inf/(1 + sqrt((V_inf/V_b - 1)(V_inf/V_d - 1))), V_inf - sqrt((V_inf - V_b)(V_inf - V_d)).
  for (const auto& [law, more, expected] : {std::tuple("linear", "", 1.5),
                                            {"exponential", "", 1.414214},
                                            {"logistic", ", limit: 1.25", 1.550510},
                                            {"relaxing", ", limit: 1.25", 1.633975}}) {
    const auto study = study_to_run(
        law, std::string("time: {end: 5 h, output: 5 h, checkpoint: 5 h}\ndomain: {size: [200 um, 200 um, 200 um], boundary: open}\n"
                         "cell_types:\n  a: {radius: 6 um, cycle: {duration: 10 h, growth: ") +
                 law + more +
                 "}, dcm: {nodes: 42, cortex: {elastic: none, tension: 0.1 mN/m}}}\ninitial:\n"
                 "  - {type: a, at: [[-50 um, 0 um, 0 um]], as: sphere, age: birth}\n  - {type: a, at: [[50 um, 0 um, 0 um]], as: shell, "
                 "age: birth}\n");
    for (const std::size_t cell : {0, 1})
      out.push_back(
          {"life growth",
           std::string("study: volume of a ") + (cell == 0 ? "sphere" : "shell") + " after half a cycle over that at birth, " + law,
           expected, 0.002, "closed form; a shell gives way by 2e-3 to its tension", [study, cell] {
             const Snapshot* end = study->found().at(18000.0);
             if (end == nullptr || end->cells.size() != 2) return std::nan("");
             return end->cells[cell].volume / (4.0 / 3.0 * 3.141592653589793 * 216.0);
           }});
  }
}

}  // namespace

void add_cycle_study_numbers(std::vector<ReferenceNumber>& out) {
  add_rates(out);
  add_size_control(out);
  add_growth_laws(out);
}

}  // namespace morula::scenarios
