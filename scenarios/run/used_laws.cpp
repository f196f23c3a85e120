#include "scenarios/run/used_laws.h"

#include <algorithm>

#include "cbm/builtin.h"
#include "cbm/sphere_range.h"
#include "coupling/behaviours/builtin.h"
#include "coupling/behaviours/phases.h"
#include "coupling/builtin.h"
#include "dcm/interior_laws.h"
#include "fields/builtin.h"
#include "fields/reaction.h"

namespace morula::scenarios {
namespace {

using Values = std::vector<std::pair<std::string, double>>;

LawInfo law_named(std::vector<LawInfo> laws, const char* name) {
  for (LawInfo& law : laws)
    if (law.name == name) return std::move(law);
  return {};
}

/// The laws of one shell with the coefficients that the model holds.
void add_shell_laws(const Laws& laws, const std::string& whose, const dcm::ShellParameters& p, std::vector<UsedLaw>& out) {
  for (const dcm::ShellLaw& law : laws.shells)
    for (const std::vector<double>& coefficients : coefficients_of(law, p)) {
      Values values;
      for (std::size_t k = 0; k < coefficients.size(); ++k) values.emplace_back(law.info.parameters[k].name, coefficients[k]);
      out.push_back({whose, law.info, std::move(values)});
    }
}

/// Friction of spheres with the medium, by the law that shells have, too.
void add_sphere_friction(const Laws& laws, const CellType& type, std::vector<UsedLaw>& out) {
  for (const dcm::ShellLaw& law : laws.shells)
    if (law.info.name == "medium_friction")
      out.push_back({"spheres of " + type.name, law.info, {{law.info.parameters[0].name, type.medium_friction}}});
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
    const bool of_shells = law.name == "nuclear_shell_contact" || law.name == "cytosol_pressure", of_rigid = law.name == "nucleus_contact";
    if ((of_shells && !p.has_nuclear_shell()) || (of_rigid && !p.has_rigid_nucleus())) continue;
    if (!used) continue;
    Values values = to_nucleus ? links(p.nucleus_links)
                    : across   ? links(p.cortex_links)
                               : Values{{"nucleus_fraction", p.nucleus_fraction}, {"cytoplasm_viscosity", p.cytoplasm_viscosity}};
    if (across && p.cortex_links.count > type.shell_nodes / 2) values[0].second = type.shell_nodes / 2;
    out.push_back({"inside shells of " + type.name, std::move(law), std::move(values)});
  }
}

/// Which bodies the cells of a type may have.
struct Bodies {
  bool shell = false, sphere = false;
};

void add_contacts(const Model& model, std::span<const Bodies> bodies, std::vector<UsedLaw>& out) {
  const bool shells = std::ranges::any_of(bodies, &Bodies::shell);
  const auto name = [&](std::size_t m) {
    return m < model.types.size() ? model.types[m].name : model.obstacles[m - model.types.size()].name;
  };
  for (std::size_t a = 0; a < model.types.size(); ++a)
    for (std::size_t b = a; b < model.material_count(); ++b) {
      const ContactPair& pair = model.pair(a, b);
      const std::string purpose = "contact of " + name(a) + " with " + name(b);
      out.push_back(
          {purpose,
           law_named(surface_contact_terms(), "contact_pair"),
           {{"adhesion", pair.adhesion}, {"normal_friction", pair.normal_friction}, {"tangential_friction", pair.tangential_friction}}});
      for (std::size_t r = 0; shells && r < pair.regions.size(); ++r) {
        const AdhesionRule& rule = pair.regions[r];  // between cells of one type a rule stands both ways round
        const AdhesionRule before = r > 0 ? pair.regions[r - 1] : AdhesionRule{};
        if (a == b && r > 0 && before.mark_a == rule.mark_b && before.mark_b == rule.mark_a && before.mark_a != before.mark_b) continue;
        out.push_back({purpose, law_named(surface_contact_terms(), "regional_adhesion"), {{"adhesion", rule.adhesion}}});
      }
      if (shells && a == b && model.types[a].self_contact > 0.0)
        out.push_back({purpose, law_named(surface_contact_terms(), "self_contact"), {{"self_contact", model.types[a].self_contact}}});
      if (!bodies[a].shell && (b >= model.types.size() || !bodies[b].shell))
        continue;  // spheres have a law of their own, on obstacles, too
      Values values{{"range", pair.range > 0.0 ? pair.range : model.contact.range},
                    {"repulsion", pair.repulsion > 0.0 ? pair.repulsion : model.contact.repulsion}};
      for (const KeySpec& key : pair.law->own) values.emplace_back(key.name, pair.own(key.name));
      out.push_back({purpose, pair.law->info, std::move(values)});
    }
  if (shells && model.contact.objective_friction)
    out.push_back({"contact of surfaces", law_named(surface_contact_terms(), "objective_friction"), {}});
  for (std::size_t t = 0; t < model.types.size(); ++t) {
    const CellType& type = model.types[t];
    if (!bodies[t].sphere) continue;
    const double adhesion = model.pair(t, t).adhesion * type.sphere.adhesion_factor;
    Values values{{"young", type.sphere.young}, {"poisson", type.sphere.poisson}, {"adhesion", adhesion}};
    for (const KeySpec& key : type.sphere.law->own) values.emplace_back(key.name, type.sphere.own(key.name));
    out.push_back({"spheres of " + type.name, type.sphere.law->info, std::move(values)});
    if (type.sphere.law->of_small_contacts && !type.sphere.fitted.has_ends() && adhesion > 0.0) {
      const cbm::RestingContact rest = cbm::resting_contact(type.sphere, type.radius.mean, type.sphere, type.radius.mean, adhesion);
      out.push_back({"spheres of " + type.name,
                     cbm::jkr_range_law(),
                     {{"contact_ratio", rest.radius_ratio}, {"overlap_ratio", rest.overlap_ratio}, {"covered", rest.covered}}});
    }
    if (shells)
      out.push_back({"spheres of " + type.name + " against shells",
                     law_named(surface_contact_terms(), "sphere_foundation"),
                     {{"young", type.sphere.young},
                      {"poisson", type.sphere.poisson},
                      {"stiffness", type.sphere.with_shells.stiffness},
                      {"adhesion_factor", type.sphere.with_shells.adhesion}}});
    if (type.sphere.approach_factor != 1.0 || type.sphere.along_factor != 1.0)
      out.push_back({"contact of spheres of " + type.name + " with cells",
                     law_named(surface_contact_terms(), "contact_pair"),
                     {{"adhesion", adhesion},
                      {"normal_friction", model.pair(t, t).normal_friction * type.sphere.approach_factor},
                      {"tangential_friction", model.pair(t, t).tangential_friction * type.sphere.along_factor}}});
    if (const cbm::CrowdedArea& area = type.sphere.crowded_area; !area.empty())
      out.push_back({"spheres of " + type.name,
                     cbm::crowded_area_law(),
                     {{"pairs_first", area.knots().front().pairs},
                      {"pairs_last", area.knots().back().pairs},
                      {"cells_last", area.knots().back().cells}}});
    if (const cbm::PackingCurve& curve = type.sphere.packing; !curve.empty())
      out.push_back(
          {"spheres of " + type.name,
           cbm::packing_law(),
           {{"packing_onset", curve.onset()}, {"packing_last", curve.last()}, {"packing_last_pressure", curve.knots().back().pressure}}});
  }
}

/// The values of the parameters of a law that has them under these names: numbers, and the lengths of vectors.
Values named_values(const LawInfo& law, const OwnValues& values) {
  Values out;
  for (const LawParameter& parameter : law.parameters)
    if (values.has(parameter.name))
      out.emplace_back(parameter.name, values(parameter.name));
    else if (const Vec3d vector = values.vector(parameter.name); norm2(vector) > 0.0)
      out.emplace_back(parameter.name, norm(vector));
  return out;
}

/// Control of size, phases and what holds them back.
void add_cycle(const CellType& type, std::vector<UsedLaw>& out) {
  const CellCycle& cycle = type.cycle;
  const std::string whose = "life of " + type.name;
  out.push_back({whose, type.axis->info, {}});
  if (cycle.control != SizeControl::kTimer)
    out.push_back({whose,
                   law_named(behaviour_laws(), cycle.control == SizeControl::kSizer ? "sizer" : "adder"),
                   {{"size", cycle.size}, {"size_spread", cycle.size_spread}}});
  for (const CellArrest& one : cycle.arrest)
    out.push_back({"growth of " + type.name, one.what->info, named_values(one.what->info, one.values)});
  if (cycle.phases.empty()) return;
  LawInfo phases = law_named(behaviour_laws(), "cycle_phases");
  Values times;
  for (const CyclePhase& phase : cycle.phases) {
    const bool part = phase.length == CyclePhase::Length::kPart, size = phase.length == CyclePhase::Length::kSize;
    if (!size) times.emplace_back(phase.name, part ? phase.time.mean * type.cycle_duration.mean : phase.time.mean);
    phases.parameters.push_back(given_by_study(phase.name.c_str(), "time", "s", size ? "Ends by size." : "Mean duration."));
  }
  out.push_back({whose, std::move(phases), std::move(times)});
  for (const CyclePhase& phase : cycle.phases)
    for (const CellArrest& one : phase.arrest)
      out.push_back({"phase " + phase.name + " of " + type.name, one.what->info, named_values(one.what->info, one.values)});
  if (cycle.quiescence.phase >= 0)
    out.push_back({whose,
                   law_named(behaviour_laws(), "quiescence"),
                   {{"below", cycle.quiescence.enter_below}, {"above", cycle.quiescence.leave_above}, {"hold", cycle.quiescence.hold}}});
}

/// In what cells of a type differ from each other.
void add_variation(const CellType& type, std::vector<UsedLaw>& out) {
  const auto add = [&](const std::string& what, const Distribution& of) {
    if (of.relative_spread > 0.0)
      out.push_back({what + " of " + type.name,
                     law_named(behaviour_laws(), "variation"),
                     {{"spread", of.relative_spread}, {"correlation", of.correlation}}});
  };
  if (type.cycles && !paced_by_phases(type.cycle)) add("cycle", type.cycle_duration);
  for (const Trait trait : kTraits) add(kTraitNames[number_of(trait)], type.traits.of(trait));
}

void add_behaviours(const CellType& type, const Bodies& bodies, std::vector<UsedLaw>& out) {
  add_variation(type, out);
  if (type.cycles) {
    const CellCycle& cycle = type.cycle;
    Values values{{"cycle_duration", type.cycle_duration.mean}, {"division_ratio", cycle.ratio}};
    for (const KeySpec& key : cycle.growth->own) values.emplace_back(key.name, cycle.growth_values(key.name));
    out.push_back({"life of " + type.name, cycle.growth->info, std::move(values)});
    add_cycle(type, out);
  }
  const Values values{{"inhibit_pressure", type.inhibit_pressure},
                      {"new_surface", type.new_surface},
                      {"apoptosis_time", type.apoptosis_time},
                      {"removal_fraction", type.removal_fraction},
                      {"permeability", type.osmosis.permeability},
                      {"inactive", type.osmosis.inactive},
                      {"inside", type.osmosis.inside},
                      {"outside", type.osmosis.outside}};
  for (LawInfo& law : behaviour_laws()) {
    const bool used = law.name == "growth_under_pressure" ? type.cycles && type.inhibit_pressure < kNever
                      : law.name == "instant_division"    ? type.cycles && bodies.sphere
                      : law.name == "shell_division"      ? type.cycles && bodies.shell && type.shells_divide
                      : law.name == "apoptosis"           ? !type.behaviours.empty()
                      : law.name == "osmosis"             ? type.osmosis.acts()
                                                          : false;
    if (used) out.push_back({"life of " + type.name, std::move(law), values});
  }
  if (type.migration.acts()) {
    OwnValues own = type.migration.own;
    own.set("speed", type.migration.speed);
    out.push_back({"motion of " + type.name, type.migration.law->info, named_values(type.migration.law->info, own)});
  }
  for (const TypePolarityRule& rule : type.polarity.rules)
    out.push_back({"motion of " + type.name, rule.what->info, named_values(rule.what->info, rule.values)});
  for (const CellBehaviour& one : type.behaviours) {
    if (!one.may_act()) continue;
    out.push_back({"life of " + type.name, one.what->info, named_values(one.what->info, one.values)});
  }
}

void add_fields(const Model& model, std::vector<UsedLaw>& out) {
  for (const fields::FieldSpec& spec : model.fields) {
    out.push_back({"field " + spec.name,
                   law_named(fields::field_laws(), "diffusion"),
                   {{"diffusion", spec.diffusion}, {"initial", spec.initial}, {"voxel", spec.voxel}}});
    for (const fields::FieldReaction& one : spec.reactions) {
      const bool of_cells = one.what->where == fields::Reaction::Where::kCells;
      if (of_cells && one.type >= model.types.size()) continue;  // of dying cells: the part of them is told with the others
      Values values;
      for (const LawParameter& parameter : one.what->info.parameters) values.emplace_back(parameter.name, one.values(parameter.name));
      out.push_back({one.what->info.name + " of " + spec.name + (of_cells ? " by " + model.types[one.type].name : ""), one.what->info,
                     std::move(values)});
    }
  }
}

void add_swaps(const Model& model, std::vector<UsedLaw>& out) {
  const Swaps& swaps = model.swaps;
  for (const Region& region : swaps.regions)
    out.push_back({"region " + region.name, region.shape->info, named_values(region.shape->info, region.values)});
  const auto told = [&](const std::string& which, const std::string& title) {
    const LawInfo info{.name = "exchange", .title = title, .equation = "", .source = "choice of this project", .parameters = {}};
    out.push_back({"exchange of bodies " + which, info, {}});
  };
  for (const Trigger& trigger : swaps.triggers)
    if (trigger.compares())
      out.push_back({"exchange of bodies", trigger.value->info, {{"promote", trigger.promote}, {"demote", trigger.demote}}});
    else if (!trigger.phase.empty())
      told("in phase " + trigger.phase, "Cells in a phase of their cycle are shells, others spheres");
    else
      told("of " + model.types[static_cast<std::size_t>(trigger.type)].name, "All cells of a type are shells");
}

void add_loads(const Model& model, std::vector<UsedLaw>& out) {
  for (const CellLoad& load : model.loads)
    out.push_back(
        {"load " + load.name + " on " + model.types[load.type].name, load.what->info, named_values(load.what->info, load.values)});
}

}  // namespace

std::vector<UsedLaw> used_laws(const Study& study) {
  const Model& model = study.model;
  std::vector<Bodies> bodies(model.types.size());
  const auto may_be = [&](std::size_t type, BodyKind body) {
    (body == BodyKind::kShell ? bodies[type].shell : bodies[type].sphere) = true;
  };
  for (std::size_t t = 0; t < model.types.size(); ++t) {
    if (!model.swaps.triggers.empty() || model.swaps.by_fate) bodies[t] = {true, true};
    for (const Region& region : model.swaps.regions) may_be(t, region.body);
    for (const InitialCells& block : study.initial)
      for (const BodyKind body : {BodyKind::kSphere, BodyKind::kShell})
        if (block.may_begin_as(t, body, model.types[t].initial_body)) may_be(t, body);
    if (!bodies[t].shell && !bodies[t].sphere) may_be(t, model.types[t].initial_body);  // of daughters
  }
  std::vector<UsedLaw> out;
  for (std::size_t t = 0; t < model.types.size(); ++t) {
    const CellType& type = model.types[t];
    if (bodies[t].sphere && !bodies[t].shell) add_sphere_friction(*study.laws, type, out);
    if (!bodies[t].shell) continue;
    add_shell_laws(*study.laws, "shell of " + type.name, type.shell, out);
    if (type.interior.has_nuclear_shell()) add_shell_laws(*study.laws, "nucleus of " + type.name, type.interior.nucleus_shell, out);
    add_interior_laws(type, out);
  }
  add_contacts(model, bodies, out);
  for (std::size_t t = 0; t < model.types.size(); ++t) add_behaviours(model.types[t], bodies[t], out);
  add_fields(model, out);
  add_loads(model, out);
  add_swaps(model, out);
  add_active_laws(model, std::ranges::any_of(bodies, &Bodies::shell), out);
  return out;
}

}  // namespace morula::scenarios
