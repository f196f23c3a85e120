#include "scenarios/run/used_laws.h"

#include <algorithm>

#include "cbm/builtin.h"
#include "coupling/behaviours/builtin.h"
#include "dcm/builtin.h"
#include "dcm/interior_laws.h"

namespace morula::scenarios {
namespace {

constexpr const char* kProject = "choice of this project";

using Values = std::vector<std::pair<std::string, double>>;

LawParameter parameter(const char* name, const char* quantity, const char* unit, const char* doc) {
  LawParameter out;
  out.name = name;
  out.quantity = quantity;
  out.unit = unit;
  out.source = "the study";
  out.doc = doc;
  return out;
}

/// What stands for the moduli of a law that the model holds as one stiffness.
std::vector<LawParameter> held_parameters(const std::string& law) {
  const LawParameter ratio = parameter("membrane_area_ratio", "number", "1", "ν/(1 − ν), from the Poisson ratio ν.");
  const char* shear = "Shear modulus G of the sheet, from Young's modulus, thickness and Poisson ratio.";
  if (law == "edge_spring")
    return {parameter("spring_stiffness", "tension", "nN/µm", "Stiffness k of every edge, from Young's modulus and thickness.")};
  if (law == "neo_hooke") return {parameter("neo_hooke_shear", "tension", "nN/µm", shear), ratio};
  if (law == "st_venant_kirchhoff") return {parameter("stvk_shear", "tension", "nN/µm", shear), ratio};
  if (law == "skalak") return {parameter("skalak_shear", "tension", "nN/µm", shear), ratio};
  if (law == "hinge_bending")
    return {parameter("hinge_stiffness", "energy", "nN·µm",
                      "Stiffness k_h of every hinge, from Young's modulus, thickness and Poisson ratio.")};
  return {};
}

/// The values of one type by parameter name, where the model holds them.
void add_shell_laws(const CellType& type, std::vector<UsedLaw>& out) {
  const dcm::ShellParameters& p = type.shell;
  const Values values{{"edge_damping", p.edge_damping},
                      {"isotropic_damping", p.isotropic_damping},
                      {"tension", p.tension},
                      {"bulk_modulus", p.bulk_modulus},
                      {"bulk_viscosity", p.bulk_viscosity},
                      {"shape_stiffness", p.shape_stiffness},
                      {"barrier_stiffness", p.barrier_stiffness},
                      {"barrier_angle", p.barrier_angle},
                      {"medium_friction", p.medium_friction},
                      {"spring_stiffness", p.spring_stiffness},
                      {"neo_hooke_shear", p.neo_hooke_shear},
                      {"stvk_shear", p.stvk_shear},
                      {"skalak_shear", p.skalak_shear},
                      {"membrane_area_ratio", p.membrane_area_ratio},
                      {"local_area_modulus", p.local_area_modulus},
                      {"global_area_modulus", p.global_area_modulus},
                      {"turnover_time", 1.0 / p.turnover_rate},
                      {"hinge_stiffness", p.hinge_stiffness},
                      {"helfrich_rigidity", p.helfrich_rigidity},
                      {"spontaneous_curvature", p.spontaneous_curvature}};
  for (const dcm::ShellLaw& law : dcm::shell_laws()) {
    if (p.*law.strength == 0.0) continue;
    LawInfo info = law.info;
    if (auto held = held_parameters(info.name); !held.empty()) info.parameters = std::move(held);
    out.push_back({"shell of " + type.name, std::move(info), values});
  }
}

/// Nucleus and links of one type.
void add_interior_laws(const CellType& type, std::vector<UsedLaw>& out) {
  const dcm::InteriorParameters& p = type.interior;
  const auto links = [&](const dcm::LinkParameters& l) {
    return Values{{"number", std::min(l.count, type.shell_nodes)}, {"stiffness", l.stiffness}, {"damping", l.damping}};
  };
  for (LawInfo& law : dcm::interior_laws()) {
    const bool to_nucleus = law.name == "nucleus_links", across = law.name == "cortex_links";
    const bool used = across ? p.cortex_links.act() : p.has_nucleus() && (!to_nucleus || p.nucleus_links.act());
    if (!used) continue;
    Values values = to_nucleus ? links(p.nucleus_links)
                    : across   ? links(p.cortex_links)
                               : Values{{"nucleus_fraction", p.nucleus_fraction}, {"cytoplasm_viscosity", p.cytoplasm_viscosity}};
    if (across && p.cortex_links.count > type.shell_nodes / 2) values[0].second = type.shell_nodes / 2;
    out.push_back({"inside shells of " + type.name, std::move(law), std::move(values)});
  }
}

LawInfo traction_info() {
  return {.name = "surface_traction",
          .title = "Traction between surfaces",
          .equation = "U(g) per area: −W (g ≤ 0), −W + ½ω g² (g < c/2), −½ω (c − g)² (g < c), ω = 4W/c²; repulsion ½ k_r g² (g < 0)",
          .source = "choice of this project: the work of separation is exactly W; integrated over each face",
          .parameters = {parameter("range", "length", "µm", "Range c of the attraction."),
                         parameter("repulsion", "pressure per length", "kPa/µm", "Stiffness k_r of the repulsion.")}};
}

LawInfo pair_info() {
  return {.name = "contact_pair",
          .title = "Adhesion and friction of a pair",
          .equation = "F_friction = −(γ_n n nᵀ + γ_t (1 − n nᵀ)) A (v_i − v_j)",
          .source = "Van Liedekerke et al. 2020, doi:10.1007/s10237-019-01204-7",
          .parameters = {parameter("adhesion", "tension", "nN/µm", "Adhesion energy W per contact area of the pair."),
                         parameter("normal_friction", "friction per area", "nN·s/µm³", "γ_n per contact area."),
                         parameter("tangential_friction", "friction per area", "nN·s/µm³", "γ_t per contact area.")}};
}

void add_contacts(const Model& model, bool shells, bool spheres, std::vector<UsedLaw>& out) {
  if (shells || !model.obstacles.empty())
    out.push_back({"contact of surfaces", traction_info(), {{"range", model.contact.range}, {"repulsion", model.contact.repulsion}}});
  const auto name = [&](std::size_t m) {
    return m < model.types.size() ? model.types[m].name : model.obstacles[m - model.types.size()].name;
  };
  for (std::size_t a = 0; a < model.types.size(); ++a)
    for (std::size_t b = a; b < model.material_count(); ++b) {
      const ContactPair& pair = model.pair(a, b);
      out.push_back(
          {"contact of " + name(a) + " with " + name(b),
           pair_info(),
           {{"adhesion", pair.adhesion}, {"normal_friction", pair.normal_friction}, {"tangential_friction", pair.tangential_friction}}});
    }
  if (!spheres) return;
  for (std::size_t t = 0; t < model.types.size(); ++t) {
    const CellType& type = model.types[t];
    for (const cbm::ContactLawEntry& law : cbm::contact_laws())
      if (law.info.name == (type.sphere.adhesive ? "jkr" : "hertz"))
        out.push_back({"spheres of " + type.name,
                       law.info,
                       {{"young", type.sphere.young}, {"poisson", type.sphere.poisson}, {"adhesion", model.pair(t, t).adhesion}}});
  }
}

void add_behaviours(const CellType& type, std::vector<UsedLaw>& out) {
  const Values values{{"cycle_duration", type.cycle_duration.mean},
                      {"inhibit_pressure", type.inhibit_pressure},
                      {"death_below", type.death_below},
                      {"death_rate", type.death_rate},
                      {"apoptosis_time", type.apoptosis_time},
                      {"removal_fraction", type.removal_fraction},
                      {"migration_speed", type.migration_speed},
                      {"migration_persistence", type.migration_persistence},
                      {"permeability", type.osmosis.permeability},
                      {"inactive", type.osmosis.inactive},
                      {"inside", type.osmosis.inside},
                      {"outside", type.osmosis.outside}};
  for (LawInfo& law : behaviour_laws()) {
    const bool used = law.name == "linear_growth"        ? type.cycles && !type.exponential_growth
                      : law.name == "exponential_growth" ? type.cycles && type.exponential_growth
                      : law.name == "instant_division"   ? type.cycles
                      : law.name == "starvation"         ? type.death_field >= 0 && type.death_rate > 0.0
                      : law.name == "persistent_walk"    ? type.migration_speed > 0.0
                      : law.name == "osmosis"            ? type.osmosis.acts()
                                                         : false;
    if (used) out.push_back({"life of " + type.name, std::move(law), values});
  }
}

void add_fields(const Model& model, std::vector<UsedLaw>& out) {
  for (const fields::FieldSpec& spec : model.fields) {
    LawInfo info{.name = "diffusion",
                 .title = "Diffusion, decay and uptake by cells",
                 .equation = "∂c/∂t = D ∇²c − λ c − Σ_i w_i V_max c/(K_m + c)",
                 .source = "Michaelis & Menten 1913; integrated by ARKODE (Reynolds et al. 2023, doi:10.1145/3594632)",
                 .parameters = {parameter("diffusion", "diffusion", "µm²/s", "D."), parameter("decay", "rate", "1/s", "λ."),
                                parameter("initial", "concentration", "mM", "At time 0."),
                                parameter("voxel", "length", "µm", "Wanted voxel size.")}};
    out.push_back({"field " + spec.name,
                   std::move(info),
                   {{"diffusion", spec.diffusion}, {"decay", spec.decay}, {"initial", spec.initial}, {"voxel", spec.voxel}}});
    LawInfo uptake{
        .name = "uptake",
        .title = "Uptake by one cell",
        .equation = "V_max c/(K_m + c)",
        .source = kProject,
        .parameters = {parameter("rate", "amount rate", "amol/s", "V_max."), parameter("half_saturation", "concentration", "mM", "K_m.")}};
    for (std::size_t t = 0; t < spec.uptake.size(); ++t)
      if (spec.uptake[t].rate > 0.0)
        out.push_back({"uptake of " + spec.name + " by " + model.types[t].name,
                       uptake,
                       {{"rate", spec.uptake[t].rate}, {"half_saturation", spec.uptake[t].half_saturation}}});
  }
}

}  // namespace

std::vector<UsedLaw> used_laws(const Study& study) {
  const Model& model = study.model;
  bool shells = !model.swaps.triggers.empty(), spheres = false;
  for (const Region& region : model.swaps.regions) (region.body == BodyKind::kShell ? shells : spheres) = true;
  std::vector<bool> given(model.types.size(), false);
  for (const InitialCells& block : study.initial)
    if (block.body_given)
      (block.body == BodyKind::kShell ? shells : spheres) = true;
    else if (block.source != InitialCells::Source::kCsv)
      given[block.type] = true;
    else
      std::fill(given.begin(), given.end(), true);
  for (std::size_t t = 0; t < model.types.size(); ++t)
    if (given[t]) (model.types[t].initial_body == BodyKind::kShell ? shells : spheres) = true;
  std::vector<UsedLaw> out;
  for (const CellType& type : model.types) {
    if (!shells) break;
    add_shell_laws(type, out);
    add_interior_laws(type, out);
  }
  add_contacts(model, shells, spheres, out);
  for (const CellType& type : model.types) add_behaviours(type, out);
  add_fields(model, out);
  return out;
}

}  // namespace morula::scenarios
