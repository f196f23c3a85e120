// What balls under light should do.
#include <cmath>

#include "scenarios/measures/single_cell.h"
#include "scenarios/measures/stretched_cells.h"
#include "scenarios/measures/theories.h"

namespace morula::scenarios {
namespace {

const CellType& type_of(const Study& study, const Subject& s) {
  return study.model.types[study.model.loads[static_cast<std::size_t>(s.load)].type];
}

}  // namespace

Theory stretched_sphere_theory() {
  return {
      "stretched_sphere",
      "the closed form",
      "Small strains of an elastic ball under the outward traction s0 cos^2 of the angle from an axis: Y and nu of its surface, tension "
      "T, bulk modulus K.",
      "e_a = (u0 + u2)/R, e_t = (u0 - u2/2)/R; u2 = (2/3) s0/(4 Y/((5 + nu) R^2) + 4 T/R^2), u0 = (s0/3)/(2 Y/((1 - nu) R^2) - 2 T/R^2 "
      "+ 3 K/R)",
      "Guck et al. 2001, doi:10.1016/S0006-3495(01)75740-2",
      {"stretch.axial", "stretch.transverse"},
      [](const Study& study, const Subject& s, const std::string&) {
        return spring_modulus(type_of(study, s)) > 0.0
                   ? Status{}
                   : Status(Error{ErrorKind::kInput, "needs cells whose cortex is elastic by springs", ""});
      },
      [](FinishedRun& run, const Subject& s, const std::string& measure, const Sample& sample) -> Result<double> {
        MORULA_TRY_ASSIGN(const auto cells,
                          stretched_cells(run, static_cast<std::size_t>(s.load), {Moments::Kind::kBetween, sample.time, sample.time}));
        for (const StretchedCell& one : cells)
          if (one.cell == sample.cell) return measure == "stretch.axial" ? one.linear.axial : one.linear.transverse;
        return std::nan("");
      }};
}

}  // namespace morula::scenarios
