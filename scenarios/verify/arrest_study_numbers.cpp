// What holds cells back in their growth, by studies that are run.
#include <cmath>
#include <tuple>

#include "scenarios/verify/run_study.h"
#include "scenarios/verify/study_numbers.h"

namespace morula::scenarios {
namespace {

/// Two shells with a bulk modulus of 2.5 kPa under a load, which is their pressure.
std::shared_ptr<StudyToRun> pressed(const std::string& name, const std::string& cycle, const std::string& load,
                                    const std::string& end = "2 h") {
  return study_to_run(name.c_str(), "time: {end: " + end +
                                        ", output: 10 min, checkpoint: 1 h}\ndomain: {size: [150 um, 150 um, 150 um], boundary: open}\n"
                                        "cell_types:\n  a: {radius: 6 um, body: shell, dcm: {nodes: 42, cortex: {elastic: none, tension: "
                                        "0.1 mN/m}, bulk_modulus: 2.5 kPa}, "
                                        "inhibit_growth: {pressure_above: never}, cycle: {" +
                                        cycle +
                                        "}}\ninitial:\n  - {type: a, at: [[0 um, 0 um, 20 um], [0 um, 0 um, -20 um]], age: birth}\n"
                                        "loads:\n  press: {type: a, " +
                                        load + "}\n");
}

/// The factor g of linear growth V = V_b (1 + g t/10 h) between 30 min and 2 h: the load takes the same part of the volume all the time.
double factor_of_growth(const FoundInRun& found) {
  const double ratio = found.column("total_volume", 7200.0) / found.column("total_volume", 1800.0);
  return (ratio - 1.0) / (0.2 - 0.05 * ratio);
}

void add_pressure(std::vector<ReferenceNumber>& out) {
  for (const auto& [load, factor] : {std::pair("202", 0.0), {"198", 0.02}, {"150", 0.5}, {"90", 1.0}}) {
    const auto study = pressed(std::string("pressed_") + load, "duration: 10 h, arrest: {pressure: {from: 100 Pa, to: 200 Pa}}",
                               std::string("pressure: {value: ") + load + " Pa}");
    out.push_back({"life arrest",
                   std::string("study: rate of growth under ") + load + " Pa over that of a free cell, arrest from 100 to 200 Pa", factor,
                   0.01, "the ramp of the study", [study] { return factor_of_growth(study->found()); }});
  }
  const auto hill = pressed("hill", "duration: 10 h, arrest: {pressure_hill: {half: 300 Pa, power: 4}}", "pressure: {value: 150 Pa}");
  out.push_back({"life arrest", "study: the same under 150 Pa, Hill function of 300 Pa and power 4", 0.941176, 0.01, "1/(1 + 2^-4)",
                 [hill] { return factor_of_growth(hill->found()); }});
}

void add_volume(std::vector<ReferenceNumber>& out) {
  // 125 Pa and a bulk modulus of 2.5 kPa leave v = V/V_t of the volume: -K ln v = p + 2 T/R (v^(-1/3) - 1) with 2 T/R = 33 Pa.
  const auto study = pressed("squeezed", "duration: 10 h, arrest: {volume: {from: 100 %, to: 90 %}}", "pressure: {value: 125 Pa}");
  out.push_back({"life arrest", "study: the same at 95.1 % of the target volume, arrest from 100 to 90 %", 0.51016, 0.01, "(v - 0.9)/0.1",
                 [study] { return factor_of_growth(study->found()); }});
}

/// Spheres in a field that is the same everywhere and all the time.
void add_field(std::vector<ReferenceNumber>& out) {
  for (const auto& [name, arrest, factor] : {std::tuple("fed", "{field: food, half: 0.05 mM, power: 2}", 0.8),
                                             {"poisoned", "{field: food, half: 0.05 mM, power: 2, inhibits: true}", 0.2}}) {
    const auto study = study_to_run(
        name, std::string("time: {end: 2 h, output: 10 min, checkpoint: 1 h}\ndomain: {size: [100 um, 100 um, 100 um], boundary: open}\n"
                          "cell_types:\n  a: {radius: 6 um, cycle: {duration: 10 h, arrest: {field: ") +
                  arrest +
                  "}}}\ninitial:\n  - {type: a, at: [[0 um, 0 um, 20 um], [0 um, 0 um, -20 um]], age: birth}\n"
                  "fields:\n  food: {diffusion: 2e-9 m^2/s, initial: 0.1 mM, voxel: 20 um, boundary: {all: 0.1 mM}}\n");
    out.push_back({"life arrest",
                   std::string("study: rate of growth of a ") + name + " cell over that of a free one, Hill function of the field", factor,
                   0.001, "x^2/(1 + x^2), x = 2", [study] { return factor_of_growth(study->found()); }});
  }
}

/// A load from 1 h to 4 h that stops a phase: cells leave for G0 after 1 h of it and come back 1 h after its end; three hours are lost.
void add_quiescence(std::vector<ReferenceNumber>& out) {
  const auto study = pressed(
      "quiet",
      "model: phases, phases: {G1: {duration: 5 h, arrest: {pressure: {from: 100 Pa, to: 200 Pa}}}, M: 1 h}, quiescence: {phase: G1}",
      "pressure: {value: 400 Pa}, course: [{time: 59 min, factor: 0}, {time: 60 min, factor: 1}, {time: 240 min, factor: 1}, "
      "{time: 241 min, factor: 0}]",
      "12 h");
  const auto first = [study](const char* kind) {
    for (const EventLine& event : study->found().events)
      if (event.kind == kind) return event.time / 60.0;
    return std::nan("");
  };
  out.push_back({"life rest", "study: time at which pressed cells leave for G0, default hold [min]", 120.0, 2.0,
                 "1 h after the pressure, which is averaged over a minute", [=] { return first("quiescence"); }});
  out.push_back({"life rest", "study: time at which they come back [min]", 301.0, 3.0, "1 h after the end of the load",
                 [=] { return first("return"); }});
  // Held from 60 min to 241 min and until the return at 301 min; then what was left of 6 h.
  out.push_back({"life rest", "study: time at which they divide [min]", 601.0, 3.0, "6 h of phases, of which 60 min had passed",
                 [=] { return first("division"); }});
}

}  // namespace

void add_arrest_study_numbers(std::vector<ReferenceNumber>& out) {
  add_pressure(out);
  add_volume(out);
  add_field(out);
  add_quiescence(out);
}

}  // namespace morula::scenarios
