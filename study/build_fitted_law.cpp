#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/numbers/number_text.h"
#include "study/build.h"
#include "study/cell_material.h"
#include "study/declare.h"
#include "study/fitted_law.h"
#include "study/law_keys.h"

namespace morula::scenarios {
namespace {

/// A number of the file goes into the draft, so that the resolved study tells it; E510 where the study says another one.
void take(BuildContext& c, const char* key, double fitted, const char* unit, Given<double>& value) {
  if (value.given && value.known() && value.value != fitted) {
    c.diagnostics.error(510, value.place,
                        std::string("'") + key + "' is " + value.text + ", and the fitted law has " + shortest_text(fitted) + unit,
                        std::string("leave `") + key + "` out: the file says it");
    return;
  }
  value.value = fitted;
  value.text = shortest_text(fitted) + unit;
  value.given = true;  // by the file
}

/// E515 for keys of a fitted law where there is none.
void refuse_keys(BuildContext& c, const draft::CellType& t) {
  const auto refuse = [&](const char* key, const Place& place) {
    c.diagnostics.error(515, place, std::string("'") + key + "' has no effect here", "it belongs to `law: fitted`");
  };
  if (t.sphere_file.given) refuse("file", t.sphere_file.place);
  if (t.sphere_form.given && t.sphere_form.value != "better") refuse("form", t.sphere_form.place);
  if (t.packing_law.value == kFittedLaw) refuse("packing: fitted", t.packing_law.place);
}

/// Packing of the file where it has one, and the study asks for none of its own.
void take_packing(BuildContext& c, const cbm::PackingCurve& packing, draft::CellType& t, cbm::SphereParameters& sphere) {
  if (t.packing_law.given && t.packing_law.value != kFittedLaw) return;
  if (packing.empty()) {
    if (t.packing_law.value == kFittedLaw)
      c.diagnostics.error(516, t.packing_law.place, "the file has no packing for this form of the law",
                          "calibrate without `--pairs-only`, or write `packing: ideal_filled_cell`");
    return;
  }
  sphere.packing = packing;
  t.packing_law.value = t.packing_law.text = kFittedLaw;
  t.packing_law.given = true;
}

/// The file of a type with a fitted law; nothing where it has been told what is wrong with it.
std::optional<FittedLaw> file_of(BuildContext& c, draft::CellType& t) {
  if (!t.sphere_file.known()) {
    c.diagnostics.error(516, t.sphere_law.place, "`law: fitted` needs a file",
                        "write `file: TYPE.jkr.yaml`, which `morula calibrate jkr TYPE STUDY` makes");
    return {};
  }
  const std::string shown = t.sphere_file.value;
  const std::string path = add_input_file(c, t.sphere_file);
  return read_fitted_law(path, c.shown(shown), t.sphere_file.place, *c.options.laws, c.diagnostics);
}

void use_table(const FittedLaw& fitted, draft::CellType& t, BuildContext& c, cbm::SphereParameters& sphere) {
  if (fitted.table)
    sphere.law = cbm::table_law(*fitted.table);
  else
    c.diagnostics.error(516, t.sphere_form.place, "the file has no table", "write `form: jkr`");
}

}  // namespace

void build_fitted_law(BuildContext& c, const std::string& /*type_name*/, draft::CellType& t, cbm::SphereParameters& sphere) {
  if (t.sphere_law.value != kFittedLaw) {
    refuse_keys(c, t);
    return;
  }
  check_law_keys(c, t.sphere_own, choosable_sphere_laws(*c.options.laws), kFittedLaw, "law");
  if (!c.options.fitted_laws) return;  // JKR
  const auto fitted = file_of(c, t);
  if (!fitted) return;
  const bool table = t.sphere_form.value == "table" || (t.sphere_form.value == "better" && fitted->table_is_better);
  sphere.law = cbm::jkr_law();
  if (table) use_table(*fitted, t, c, sphere);
  take(c, "young", fitted->young, " kPa", t.sphere_young);
  take(c, "poisson", fitted->poisson, "", t.sphere_poisson);
  sphere.young = t.sphere_young.value, sphere.poisson = t.sphere_poisson.value;
  if (fitted->adhesion_of_shells > 0.0) sphere.adhesion_factor = fitted->adhesion / fitted->adhesion_of_shells;
  const FittedLaw::Spheres& spheres = table ? fitted->of_table : fitted->of_jkr;
  if (spheres.approach)
    take(c, "friction.approach", *spheres.approach, "", t.sphere_friction.of("approach", &cbm::SphereParameters::approach_factor));
  if (spheres.along) take(c, "friction.along", *spheres.along, "", t.sphere_friction.of("along", &cbm::SphereParameters::along_factor));
  sphere.crowded_area = spheres.area;
  sphere.fitted = fitted->overlap;
  if (fitted->with_shells) {
    take(c, "with_shells.stiffness", fitted->with_shells->stiffness, "", t.with_shells.of("stiffness", &cbm::WithShells::stiffness));
    take(c, "with_shells.adhesion", fitted->with_shells->adhesion, "", t.with_shells.of("adhesion", &cbm::WithShells::adhesion));
  }
  take_packing(c, spheres.packing, t, sphere);
  c.study.fitted.push_back(
      {c.study.model.types.size(), fitted->type, fitted->material, fitted->smallest_radius, fitted->largest_radius, fitted->friction});
}

namespace {

/// E542 where cells are held back by another friction than those whose spheres were fitted.
void check_friction(BuildContext& c, const CellFriction& here, const CellFriction& there, const std::string& name, const Place& place) {
  constexpr double kAlike = 0.05;
  const auto differs = [&](double a, double b) { return std::abs(a - b) > kAlike * std::max(a, b); };
  const char* what = differs(here.medium, there.medium)       ? "medium"
                     : differs(here.approach, there.approach) ? "cell_cell"
                     : differs(here.along, there.along)       ? "cell_cell_tangential"
                                                              : nullptr;
  if (what == nullptr) return;
  c.diagnostics.warning(
      542, place,
      "how fast spheres of '" + name + "' come together and go past each other was fitted with another friction: `" + what + "` differs",
      "forces at rest do not depend on it; for the speed, calibrate with this study's friction");
}

}  // namespace

void check_fitted_laws(BuildContext& c) {
  for (const FittedType& fitted : c.study.fitted) {
    const auto& [name, place, t] = c.draft.cell_types[fitted.type];
    const auto material = material_of(c.study, name);
    if (!material.ok()) {
      c.diagnostics.error(532, t.sphere_file.place, material.error().message, material.error().help);
      continue;
    }
    if (const std::string what = first_difference(material->text(), fitted.material); !what.empty())
      c.diagnostics.error(532, t.sphere_file.place, "the law was fitted to other cells than '" + name + "': " + what,
                          "there: the file, made with `" + fitted.name + "`. Run `morula calibrate jkr " + name + "` with this study");
    if (fitted.friction) check_friction(c, material->friction, *fitted.friction, name, t.sphere_file.place);
    const double spread = 3.0 * t.radius.spread.value, mean = t.radius.mean.value;
    // E*, W and the curve of packing are material: forces go with R, and pairs of 1 to 1.3 are held out (physics/fields_and_coupling.md E).
    constexpr double kSlack = 0.3;
    const CellType& type = c.study.model.types[fitted.type];
    const double grown = type.cycles ? std::cbrt(type.cycle.ratio) : 1.0;
    if (mean * (1.0 - spread) < (1.0 - kSlack) * fitted.smallest_radius ||
        mean * std::max(grown, 1.0 + spread) > (1.0 + kSlack) * fitted.largest_radius)
      c.diagnostics.warning(534, t.sphere_file.place,
                            "the law of '" + name + "' was fitted to radii of " + number_text("%.3g", fitted.smallest_radius) + " to " +
                                number_text("%.3g um", fitted.largest_radius) + ", and its cells are born with " + t.radius.mean.text +
                                " and a spread of " + t.radius.spread.text +
                                (grown > 1.0 + spread ? ", and divide at " + number_text("%.3g um", mean * grown) : "") +
                                ": more than 30 % beyond",
                            "forces of other sizes follow the form of the law, which the fit does not vouch for");
  }
}

}  // namespace morula::scenarios
