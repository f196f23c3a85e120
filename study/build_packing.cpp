#include "study/build.h"
#include "study/declare.h"

namespace morula::scenarios {

double packing_modulus(const draft::CellType& type) {
  return type.packing_bulk_modulus.value >= 0.0 ? type.packing_bulk_modulus.value : type.bulk_modulus.value;
}

cbm::PackingCurve build_packing(BuildContext& c, const std::string& type_name, const draft::CellType& t) {
  const std::string& law = t.packing_law.value;
  const bool own_modulus = t.packing_bulk_modulus.value >= 0.0;
  if (law != "ideal_filled_cell" && t.packing_bulk_modulus.given && own_modulus)
    c.diagnostics.error(515, t.packing_bulk_modulus.place, "'bulk_modulus' has no effect here", "it belongs to `law: ideal_filled_cell`");
  if (law != "knots" && !t.packing_knots.empty())
    c.diagnostics.error(515, t.packing_knots.front().place, "'knots' have no effect here", "they belong to `law: knots`");
  if (law == "none" || law == kFittedLaw) return {};  // the fitted one is there already
  std::vector<cbm::PackingKnot> knots;
  if (law == "knots") {
    for (const auto& [name, place, knot] : t.packing_knots) {
      if (!knot.packing.known() || !knot.pressure.known()) return {};  // the error has been told
      knots.push_back({knot.packing.value, knot.pressure.value});
    }
  } else {
    const double bulk = packing_modulus(t);
    if (!(bulk > 0.0) || !(t.sphere_young.value > 0.0)) return {};
    auto made = cbm::ideal_filled_cell(bulk, t.sphere_young.value, t.sphere_poisson.value);
    if (!made) {  // such spheres resist as much as the shell does: nothing is missing, but where a modulus was asked for
      if (own_modulus)
        c.diagnostics.error(531, t.packing_bulk_modulus.place, "packing of '" + type_name + "': " + made.error().message,
                            made.error().help);
      return {};
    }
    knots = std::move(made).value();
  }
  auto curve = cbm::PackingCurve::through(knots);
  if (curve) return std::move(curve).value();
  c.diagnostics.error(530, t.packing_knots.empty() ? t.packing_law.place : t.packing_knots.front().place,
                      "packing of '" + type_name + "': " + curve.error().message, curve.error().help);
  return {};
}

}  // namespace morula::scenarios
