// What caps of cells on each other and on obstacles should be.
#include <algorithm>
#include <cmath>

#include "core/numbers/number_text.h"
#include "scenarios/measures/caps.h"
#include "scenarios/measures/elastic_cap.h"
#include "scenarios/measures/single_cell.h"
#include "scenarios/measures/theories.h"
#include "scenarios/measures/theory.h"

namespace morula::scenarios {
namespace {

const CellType& type_of(const Study& study, const Subject& s) { return study.model.types[static_cast<std::size_t>(s.type)]; }

/// Adhesion to the partner; of an aggregate of one type, to its own.
double adhesion_of(const Study& study, const Subject& s) {
  return study.model.pair(static_cast<std::size_t>(s.type), static_cast<std::size_t>(s.partner < 0 ? s.type : s.partner)).adhesion;
}

bool on_obstacle(const Study& study, const Subject& s) { return s.partner >= static_cast<int>(study.model.types.size()); }

Status wrong(const std::string& needs) { return Error{ErrorKind::kInput, needs, ""}; }

Status youngs_law_fits(const Study& study, const Subject& s, const std::string& measure) {
  if (s.type < 0) return wrong("needs cells of one type");
  const CellType& type = type_of(study, s);
  if (!(type.shell.tension > 0.0)) return wrong("needs cells with a cortical tension");
  const bool plane = on_obstacle(study, s);
  if (!plane && s.partner >= 0 && study.model.types[static_cast<std::size_t>(s.partner)].shell.tension != type.shell.tension)
    return wrong("needs two cells of one tension");
  if (plane && measure == "cap.contact_part") return wrong("knows the part of the surface near the other of two cells only");
  if (adhesion_of(study, s) > 2.0 * type.shell.tension)
    return wrong("knows no angle where the adhesion is more than twice the tension: surfaces spread on each other without end");
  return {};
}

/// Beside a modulus in the plane of this part of the tension angles and radii are those of a fluid within some percent.
constexpr double kHardlyElastic = 0.05;

std::string elastic_beside_tension(const Study& study, const Subject& s) {
  const CellType& type = type_of(study, s);
  const double part = spring_modulus(type) / tension_at(type, 0.0);
  if (!(part > kHardlyElastic) || type.shell.turnover_rate > 0.0) return "";
  return "knows a surface tension alone, and the cortex is elastic, too: its modulus in the plane is " + number_text("%.2g", part) +
         " times the tension";
}

theory::Cap young(const Study& study, const Subject& s, double time) {
  const CellType& type = type_of(study, s);
  const double adhesion = adhesion_of(study, s), tension = tension_at(type, time);
  if (on_obstacle(study, s)) return theory::on_plane(adhesion, tension);
  return theory::doublet(std::max(0.0, adhesion + 2.0 * type.regional_tension.drop_in_contact(type.shell.tension, time)), tension);
}

double of_cap(const theory::Cap& cap, const std::string& measure) {
  if (measure == "cap.angle" || measure == "aggregate.angle") return cap.angle;
  if (measure == "cap.radius") return cap.radius;
  if (measure == "cap.contact_radius") return cap.contact_radius;
  if (measure == "cap.height") return cap.height;
  return measure == "cap.pressure" ? cap.pressure : std::nan("");
}

/// R0 of the cap of a sample.
Result<double> radius_at(FinishedRun& run, const Subject& s, const Sample& sample) {
  MORULA_TRY_ASSIGN(const auto snapshot, run.snapshot_at(sample.time));
  if (snapshot == nullptr) return std::nan("");
  for (const MeasuredCap& cap : caps_of(run.study(), *snapshot, s))
    if (sample.cell.empty() || cap.cell == sample.cell) return cap.r0;
  return std::nan("");
}

Result<double> youngs_law_value(FinishedRun& run, const Subject& s, const std::string& measure, const Sample& sample) {
  const Study& study = run.study();
  const theory::Cap cap = young(study, s, sample.time);
  if (measure == "cap.length") return on_obstacle(study, s) ? cap.height : 2.0 * cap.height;
  if (measure != "cap.contact_part") return of_cap(cap, measure);
  MORULA_TRY_ASSIGN(const double r0, radius_at(run, s, sample));
  const double range = range_of(study.model, static_cast<std::size_t>(s.type), static_cast<std::size_t>(s.partner));
  return theory::part_nearer_than(cap, 0.5 * range / r0);
}

/// W/γ of a cell on a plane, of which a doublet is the mirror image with twice the adhesion; Y/γ.
const ElasticCap* reference_of(const Study& study, const Subject& s, double time) {
  const CellType& type = type_of(study, s);
  if (type.shell.turnover_rate > 0.0 || type.shell.helfrich_rigidity > 0.0) return nullptr;
  const double tension = tension_at(type, time), half = on_obstacle(study, s) ? 1.0 : 0.5;
  return elastic_cap(half * (adhesion_of(study, s) / tension), spring_modulus(type) / tension, type.shell_nodes);
}

}  // namespace

Theory youngs_law() {
  return {
      "youngs_law",
      "Young's law",
      "Cells with a surface tension T alone, their volume held, are spherical caps; W is the adhesion of the pair. The part of the surface "
      "nearer than half the range of contact is that of two such caps.",
      "cos(angle) = 1 - W/(2 T) of two cells, 1 - W/T on an obstacle; R/R0 = (4/(2 + 3 c - c^3))^(1/3), c = cos(angle); p = 2 T/R",
      "Young 1805; physics/dcm.md §8",
      {"cap.angle", "cap.radius", "cap.contact_radius", "cap.height", "cap.length", "cap.pressure", "cap.contact_part", "aggregate.angle"},
      &youngs_law_fits,
      &youngs_law_value,
      &elastic_beside_tension};
}

Theory elastic_cap_theory() {
  return {"elastic_cap",
          "static minimisation",
          "An elastic cell of 642 nodes or more on a plane (E = 1 kPa, h = 200 nm, T = 0.1 mN/m, W/T = 0.5 or 1), or two of them with "
          "twice the "
          "adhesion.",
          "least of elastic, surface and adhesion energy on the mesh",
          "scenarios/library/spreading/spreading_static_reference.csv",
          {"cap.contact_radius", "cap.height", "cap.length"},
          [](const Study& study, const Subject& s, const std::string&) {
            return reference_of(study, s, study.time.end) != nullptr
                       ? Status{}
                       : wrong(
                             "knows cells of 642 nodes and more whose E h is twice the "
                             "tension, without turnover or a bending rigidity of their own, and W/T = 0.5 or 1 on a plane or "
                             "twice that between two cells");
          },
          [](FinishedRun& run, const Subject& s, const std::string& measure, const Sample& sample) -> Result<double> {
            const ElasticCap* cap = reference_of(run.study(), s, sample.time);
            if (cap == nullptr) return std::nan("");
            if (measure == "cap.contact_radius") return cap->contact_radius;
            return measure == "cap.length" && !on_obstacle(run.study(), s) ? 2.0 * cap->height : cap->height;
          }};
}

}  // namespace morula::scenarios
