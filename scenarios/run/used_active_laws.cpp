#include "coupling/builtin.h"
#include "scenarios/run/used_laws.h"

namespace morula::scenarios {
namespace {

LawInfo law_named(const char* name) {
  for (LawInfo& law : active_laws())
    if (law.name == name) return std::move(law);
  return {};
}

void add_of_type(const CellType& type, bool shells, std::vector<UsedLaw>& out) {
  const auto add = [&](const char* name, std::vector<std::pair<std::string, double>> values, const std::string& purpose) {
    out.push_back({purpose, law_named(name), std::move(values)});
  };
  if (shells)
    for (const TensionRegion& region : type.regional_tension.regions)
      add("regional_tension",
          {{"tension", region.tension},
           {"amplitude", region.amplitude},
           {"period", region.period},
           {"lateral_easing", type.regional_tension.easing}},
          "shell of " + type.name);
  if (shells && type.medium_normal_extra + type.medium_tangent_extra > 0.0)
    add("directed_medium_friction",
        {{"normal", type.shell.medium_friction + type.medium_normal_extra},
         {"tangential", type.shell.medium_friction + type.medium_tangent_extra}},
        "shell of " + type.name);
  if (type.fluctuations.energy > 0.0)
    add("fluctuations", {{"energy", type.fluctuations.energy}, {"resolve", type.fluctuations.resolve}}, "motion of " + type.name);
  if (type.protrusion.force > 0.0)
    add("protrusion", {{"force", type.protrusion.force}, {"angle", type.protrusion.angle}, {"contact_area", type.protrusion.contact_area}},
        "motion of " + type.name);
}

}  // namespace

void add_active_laws(const Model& model, bool shells, std::vector<UsedLaw>& out) {
  for (const CellType& type : model.types) add_of_type(type, shells, out);
  for (const Lumen& lumen : model.lumens)
    out.push_back({"cavity " + lumen.name, law_named("lumen_pressure"), {{"pressure", lumen.pressure}}});
  for (const ApicalSpring& spring : model.apical_springs)
    out.push_back({"spring " + spring.name, law_named("apical_spring"), {{"stiffness", spring.stiffness}, {"friction", spring.friction}}});
}

}  // namespace morula::scenarios
