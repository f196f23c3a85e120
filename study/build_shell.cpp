#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "dcm/derived_parameters.h"
#include "study/build.h"
#include "study/read_section.h"

namespace morula::scenarios {
namespace {

bool is_sheet(const std::string& elastic) { return elastic == "neo_hooke" || elastic == "stvk" || elastic == "skalak"; }

/// Laws of one shell that resist changes of its area may add only when the study says so.
void check_area(BuildContext& c, const std::string& type, const draft::ShellKeys& t) {
  if (t.area_on_top.value) return;
  std::vector<std::pair<std::string, Place>> laws;
  if (is_sheet(t.elastic.value) || t.elastic.value == "springs_with_area")
    laws.emplace_back("`cortex.elastic: " + t.elastic.value + "`", t.elastic.place);
  if (t.has_membrane && is_sheet(t.membrane.elastic.value))
    laws.emplace_back("`membrane.elastic: " + t.membrane.elastic.value + "`", t.membrane.elastic.place);
  if (t.local_area.value > 0.0) laws.emplace_back("`area.local`", t.local_area.place);
  if (t.global_area.value > 0.0) laws.emplace_back("`area.global`", t.global_area.place);
  if (laws.size() < 2) return;
  c.diagnostics.error(513, laws.back().second,
                      "shells of '" + type + "' resist changes of area twice: by " + laws.front().first + " and by " + laws.back().first,
                      "leave one away, or write `area: {on_top: true, ...}` if the moduli shall add");
}

/// Keys of a law that is not the chosen one; their default may stand there, as in a resolved study.
void check_effect(BuildContext& c, const draft::ShellKeys& t) {
  const auto without_effect = [&](const Given<double>& key, const char* name, const std::string& needs) {
    const bool is_default = key.value == -1.0 || std::isinf(key.value);  // auto; flat, never
    if (key.given && !is_default)
      c.diagnostics.error(515, key.place, std::string("'") + name + "' has no effect here", "it belongs to " + needs);
  };
  if (t.elastic.value != "skalak") {
    without_effect(t.shear_modulus, "shear_modulus", "`elastic: skalak`; other laws take it from `young`, `thickness` and `poisson`");
    without_effect(t.area_ratio, "area_ratio", "`elastic: skalak`; other laws take it from `poisson`");
  }
  if (t.bending_law.value != "helfrich")
    without_effect(t.spontaneous_radius, "spontaneous_radius", "`law: helfrich`; hinges are at rest in the angles of the sphere");
  if (t.bending_law.value == "none") without_effect(t.bending, "rigidity", "`law: hinge` or `law: helfrich`");
  if (!resists_in_plane(t)) without_effect(t.turnover, "turnover", "a cortex that is elastic in its plane");
}

void set_elasticity(BuildContext& c, const draft::ShellKeys& t, dcm::ShellParameters& p) {
  const double young = t.young.value, thickness = t.thickness.value, poisson = t.poisson.value;
  const std::string& law = t.elastic.value;
  const double shear = dcm::sheet_shear_modulus(young, thickness, poisson);
  p.local_area_modulus = t.local_area.value;
  p.membrane_area_ratio = dcm::sheet_area_ratio(poisson);
  if (law == "springs") p.spring_stiffness = dcm::spring_stiffness(young, thickness);
  if (law == "neo_hooke") p.neo_hooke_shear = shear;
  if (law == "stvk") p.stvk_shear = shear;
  if (law == "skalak") {
    p.skalak_shear = t.shear_modulus.value >= 0.0 ? t.shear_modulus.value : shear;
    if (t.area_ratio.value >= 0.0) p.membrane_area_ratio = t.area_ratio.value;
  }
  if (law != "springs_with_area") return;
  const auto both = dcm::springs_with_area(young, thickness, poisson);
  p.spring_stiffness = both.spring_stiffness;
  p.local_area_modulus += std::max(0.0, both.area_modulus);
  if (poisson < 1.0 / 3.0 - 1e-12)
    c.diagnostics.error(514, t.poisson.place, "a net of springs with an area modulus cannot have a Poisson ratio of " + t.poisson.text,
                        "`poisson` between 0.3334 and 0.5, or `elastic: neo_hooke`, which takes 0 to 0.5");
}

void check_curvature(BuildContext& c, const draft::Layer& layer) {
  if (std::abs(layer.spontaneous_radius.value) < 0.02)
    c.diagnostics.error(302, layer.spontaneous_radius.place,
                        "'spontaneous_radius' is " + layer.spontaneous_radius.text + ", too small a sphere", "at least 0.02 um, or `flat`");
}

void set_bending(BuildContext& c, const draft::ShellKeys& t, dcm::ShellParameters& p) {
  const double rigidity =
      t.bending.value >= 0.0 ? t.bending.value : dcm::bending_modulus(t.young.value, t.thickness.value, t.poisson.value);
  if (t.bending_law.value == "hinge") p.hinge_stiffness = dcm::hinge_stiffness(rigidity);
  if (t.bending_law.value != "helfrich") return;
  p.helfrich_rigidity = rigidity;
  p.spontaneous_curvature = 2.0 / t.spontaneous_radius.value;
  check_curvature(c, t);
}

/// What a second layer must say of itself, and what it must not.
void check_membrane(BuildContext& c, const draft::ShellKeys& t) {
  const draft::Layer& m = t.membrane;
  const auto need = [&](const Given<double>& key, const std::string& name, const Given<std::string>& word, bool needed,
                        const std::string& law) {
    if (needed && !key.given)
      c.diagnostics.error(103, word.place, "the membrane's '" + word.value + "' needs '" + name + "'", "add `" + name + "`");
    if (!needed && key.given) c.diagnostics.error(515, key.place, "'" + name + "' has no effect here", "it belongs to " + law);
  };
  need(m.shear_modulus, "shear_modulus", m.elastic, m.elastic.value != "none", "an `elastic` law");
  need(m.area_ratio, "area_ratio", m.elastic, is_sheet(m.elastic.value), "`elastic: neo_hooke`, `stvk` or `skalak`");
  need(m.bending, "rigidity", m.bending_law, m.bending_law.value != "none", "a law of `bending`");
  if (m.bending_law.value != "helfrich" && !std::isinf(m.spontaneous_radius.value))
    c.diagnostics.error(515, m.spontaneous_radius.place, "'spontaneous_radius' has no effect here", "it belongs to `bending: helfrich`");
  if (m.elastic.value == "none" && m.bending_law.value == "none")
    c.diagnostics.error(515, m.elastic.place, "a membrane without a law has no effect", "give it `elastic` or `bending`, or remove it");
}

/// Adds the laws of the second layer. Sheets of one shell have one area ratio, and Helfrich layers one curvature: the model holds each once.
void add_membrane(BuildContext& c, const draft::ShellKeys& t, dcm::ShellParameters& p) {
  const draft::Layer& m = t.membrane;
  check_membrane(c, t);
  if (m.elastic.value == "springs") p.spring_stiffness += 4.0 / std::numbers::sqrt3 * m.shear_modulus.value;
  if (m.elastic.value == "neo_hooke") p.neo_hooke_shear += m.shear_modulus.value;
  if (m.elastic.value == "stvk") p.stvk_shear += m.shear_modulus.value;
  if (m.elastic.value == "skalak") p.skalak_shear += m.shear_modulus.value;
  if (is_sheet(m.elastic.value)) {
    if (is_sheet(t.elastic.value) && m.area_ratio.given && t.poisson.known() &&
        std::abs(m.area_ratio.value - p.membrane_area_ratio) > 1e-9 * p.membrane_area_ratio)
      c.diagnostics.error(595, m.area_ratio.place,
                          "the area ratio of the membrane (" + m.area_ratio.text + ") is not that of the layer below (" +
                              short_number(p.membrane_area_ratio) + ")",
                          "make them equal and give the rest of the resistance as `area.local`, or let one of the two be `springs`");
    p.membrane_area_ratio = m.area_ratio.value;
  }
  if (m.bending_law.value == "hinge") p.hinge_stiffness += dcm::hinge_stiffness(m.bending.value);
  if (m.bending_law.value != "helfrich") return;
  const double curvature = 2.0 / m.spontaneous_radius.value;
  if (p.helfrich_rigidity > 0.0 && curvature != p.spontaneous_curvature)
    c.diagnostics.error(595, m.spontaneous_radius.place, "the spontaneous curvature of the membrane is not that of the layer below",
                        "make them equal, or let the layer below have `law: hinge`");
  check_curvature(c, m);
  p.helfrich_rigidity += m.bending.value;
  p.spontaneous_curvature = curvature;
}

/// A fluid cortex has no shear modulus but that of the shape term.
void check_shape(BuildContext& c, const std::string& type, const draft::ShellKeys& t) {
  if (resists_in_plane(t) || !t.tension.known() || !(t.tension.value > 0.0) || !t.shape_stiffness.known()) return;
  const double ratio = t.shape_stiffness.value / t.tension.value;
  if (ratio <= dcm::kStiffShape * (1.0 + 1e-9)) return;
  c.diagnostics.warning(640, t.shape_stiffness.place,
                        "a `shape_stiffness` of " + short_number(ratio) + " times the tension holds the fluid cortex of '" + type +
                            "' back like an elastic one: contact radii and angles come out too small (3 times: 3.8 % and 4 deg)",
                        "0.3 times the tension, which is the default, or at most 0.6 times");
}

}  // namespace

bool resists_in_plane(const draft::ShellKeys& t) {
  return t.elastic.value != "none" || (t.has_membrane && t.membrane.elastic.value != "none") ||
         t.local_area.value + t.global_area.value > 0.0;
}

double build_self_contact(BuildContext& c, const draft::CellType& t) {
  if (!t.self_contact.known() || t.self_contact.value == 0.0 || !t.radius.mean.known() || !t.nodes.known()) return 0.0;
  const double faces = 2.0 * static_cast<double>(t.nodes.value) - 4.0;
  const double edge = 4.0 * t.radius.mean.value * std::sqrt(std::numbers::pi / (std::numbers::sqrt3 * faces));
  if (t.self_contact.value <= 0.5 * edge) return t.self_contact.value;
  c.diagnostics.error(582, t.self_contact.place,
                      "a self-contact at " + t.self_contact.text + " reaches the neighbouring faces: edges of " + t.nodes.text +
                          " nodes are " + short_number(std::round(100.0 * edge) / 100.0) + " um long",
                      "at most " + short_number(std::floor(50.0 * edge) / 100.0) + " um, or fewer `nodes`");
  return 0.0;
}

dcm::ShellParameters build_shell(BuildContext& c, const std::string& type_name, const draft::ShellKeys& t, double medium_friction) {
  dcm::ShellParameters p;
  set_elasticity(c, t, p);
  set_bending(c, t, p);
  if (t.has_membrane) add_membrane(c, t, p);
  check_area(c, type_name, t);
  check_effect(c, t);
  p.global_area_modulus = t.global_area.value;
  p.turnover_rate = 1.0 / t.turnover.value;
  p.edge_damping = t.damping.value;
  p.isotropic_damping = t.isotropic_damping.value;
  p.tension = t.tension.value;
  p.bulk_modulus = t.bulk_modulus.value;
  p.bulk_viscosity = t.bulk_viscosity.value;
  const double sheet = t.elastic.value == "none" ? 0.0 : t.young.value * t.thickness.value;
  p.shape_stiffness = t.shape_stiffness.value >= 0.0 ? t.shape_stiffness.value : dcm::shape_stiffness(t.tension.value, sheet);
  check_shape(c, type_name, t);
  p.barrier_stiffness = t.fold_stiffness.value;
  p.barrier_angle = t.fold_angle.value;
  p.medium_friction = medium_friction;
  return p;
}

}  // namespace morula::scenarios
