// Balls that light stretches: traction s0 cos^2 of the angle from an axis.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenarios/measures/measures.h"
#include "scenarios/measures/single_cell.h"
#include "scenarios/measures/stretched_cells.h"
#include "scenarios/measures/theories.h"

namespace morula::scenarios {
namespace {

Measure of_light(const char* name, const char* title, const char* doc, const char* formula, Quantity quantity) {
  Measure out{name, title, doc, formula, "Guck et al. 2001, doi:10.1016/S0006-3495(01)75740-2", quantity, MeasureOf::kLoad};
  out.fits = [](const Study& study, const Subject& subject) -> Status {
    const CellLoad& load = study.model.loads[static_cast<std::size_t>(subject.load)];
    if (load.what == traction_load() && !load.course.empty() && load.course.value.front() == 0.0) return {};
    return Error{ErrorKind::kInput, "needs a traction whose course begins with 0, so that there is an unloaded state", ""};
  };
  return out;
}

Measure of_strain(const char* name, const char* title, const char* doc, const char* formula, Quantity quantity,
                  double (*value)(const StretchedCell&)) {
  Measure out = of_light(name, title, doc, formula, quantity);
  out.take = [value](FinishedRun& run, const Subject& subject, const Moments& moments) -> Result<std::vector<Sample>> {
    MORULA_TRY_ASSIGN(const auto cells, stretched_cells(run, static_cast<std::size_t>(subject.load), moments));
    std::vector<Sample> found;
    for (const StretchedCell& cell : cells)
      if (const double one = value(cell); !std::isnan(one)) found.push_back({cell.time, one, cell.cell});
    return found;
  };
  return out;
}

/// How the first cell of a load went back after the light was off.
struct Recovery {
  double time = 0.0;  ///< until the strain was 1/e of that at the release [s]
  double left = 0.0;  ///< strain after eight such times, over that at the release
};

/// Nothing where the run does not show it in steps shorter than the time.
Result<std::optional<Recovery>> recovery_of(FinishedRun& run, std::size_t number) {
  const TimeCourse& course = run.study().model.loads[number].course;
  if (course.empty() || course.value.back() != 0.0) return std::optional<Recovery>();
  const double released = course.time.back() * (1.0 - 1e-12);
  MORULA_TRY_ASSIGN(const auto states, stretched_cells(run, number, {Moments::Kind::kBetween, released, kNever}, StretchedFrom::kStart));
  if (states.empty()) return std::optional<Recovery>();
  const double start = states.front().time, first = states.front().measured.axial;
  double time = 0.0;
  for (std::size_t i = 1; i < states.size(); ++i) {
    if (states[i].cell != states.front().cell) continue;
    const double strain = states[i].measured.axial, last = states[i - 1].measured.axial;
    if (time == 0.0 && strain < first / std::numbers::e) {
      if (last == first) return std::optional<Recovery>();  // not resolved
      // Straight in the logarithm between the two outputs.
      const double part = std::log(last * std::numbers::e / first) / std::log(last / std::max(strain, 1e-6 * first));
      time = states[i - 1].time + part * (states[i].time - states[i - 1].time) - start;
    }
    if (time > 0.0 && states[i].time - start >= 8.0 * time) return std::optional(Recovery{time, std::abs(strain / first)});
  }
  return std::optional<Recovery>();
}

Measure of_recovery(const char* name, const char* title, const char* doc, Quantity quantity, double Recovery::*value) {
  Measure out = of_light(name, title, doc, "", quantity);
  out.take = [value](FinishedRun& run, const Subject& subject, const Moments&) -> Result<std::vector<Sample>> {
    MORULA_TRY_ASSIGN(const auto found, recovery_of(run, static_cast<std::size_t>(subject.load)));
    return found ? std::vector<Sample>{{run.study().time.end, (*found).*value, ""}} : std::vector<Sample>{};
  };
  return out;
}

}  // namespace

std::vector<Measure> stretch_measures() {
  const char* fit = "u(angle) = u0 + u2 P2(cos(angle)), by least squares";
  return {
      of_strain("stretch.stress", "peak stress", "Largest traction of the light on a cell.", "s0", Quantity::kPressure,
                [](const StretchedCell& c) { return c.stress; }),
      of_strain("stretch.axial", "strain along the axis",
                "Strain of a cell along the axis of the light, of its zeroth and second mode, from the last output before the light.", fit,
                Quantity::kFraction, [](const StretchedCell& c) { return c.measured.axial; }),
      of_strain("stretch.transverse", "strain across the axis", "Strain of a cell across the axis of the light, likewise.", fit,
                Quantity::kFraction, [](const StretchedCell& c) { return c.measured.transverse; }),
      of_strain("stretch.ratio", "axial over minus transverse strain", "Strain along the axis over minus that across it.", "-e_a/e_t",
                Quantity::kNumber, [](const StretchedCell& c) { return -c.measured.axial / c.measured.transverse; }),
      of_strain("stretch.residual", "what the second mode leaves over, relative to the axial strain",
                "Root mean square displacement that the two modes leave over, over the radius and the axial strain: large where a shell "
                "wrinkles.",
                "rms(u - u0 - u2 P2)/(R e_a)", Quantity::kNumber,
                [](const StretchedCell& c) { return c.measured.residual / c.measured.axial; }),
      of_strain("stretch.over_linear", "axial strain over the closed form", "Strain along the axis over that of the closed form.",
                "e_a/e_linear", Quantity::kNumber, [](const StretchedCell& c) { return c.measured.axial / c.linear.axial; }),
      of_recovery("stretch.recovery_time", "time constant of the recovery",
                  "Time after the light is off until the strain is 1/e of that at the release.", Quantity::kTime, &Recovery::time),
      of_recovery("stretch.recovery_left", "strain left eight time constants after the release, relative",
                  "Strain at the first output eight time constants after the release, over that at the release.", Quantity::kNumber,
                  &Recovery::left),
  };
}

}  // namespace morula::scenarios
