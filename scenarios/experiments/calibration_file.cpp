#include <algorithm>
#include <cmath>
#include <ranges>
#include <span>
#include <string>

#include "core/numbers/hash128.h"
#include "core/numbers/joined.h"
#include "core/numbers/number_text.h"
#include "results/build_info.h"
#include "scenarios/experiments/calibration.h"
#include "study/fitted_law.h"

namespace morula::scenarios {
namespace {

std::string number(double value) {
  return std::isfinite(value) ? shortest_text(value) : value > 0.0 ? ".inf" : value < 0.0 ? "-.inf" : ".nan";
}
std::string of(double value, const char* unit) { return number(value) + " " + unit; }

/// In quotes, for a YAML value; what stands there has none.
std::string in_quotes(std::string text) {
  std::ranges::replace(text, '"', '\'');
  std::ranges::replace(text, '\n', ' ');
  std::ranges::replace(text, '\\', '/');
  return "\"" + text + "\"";
}

std::string interval(const calibrate::Interval& range, const char* unit) {
  return "[" + of(range.low, unit) + ", " + of(range.high, unit) + "]";
}

std::string knots_text(const std::vector<cbm::PackingKnot>& knots) {
  return "[" +
         joined(knots,
                [](const cbm::PackingKnot& knot) {
                  return "{packing: " + number(100.0 * knot.packing) + " %, pressure: " + of(knot.pressure, "kPa") + "}";
                }) +
         "]";
}

/// Contact areas among many, where they were found.
std::string crowding_text(const calibrate::FittedCrowding& found) {
  if (found.knots.empty()) return "";
  const auto knot = [](const cbm::CrowdedKnot& k) {
    return "{pairs: " + number(100.0 * k.pairs) + " %, cells: " + number(100.0 * k.cells) + " %}";
  };
  return "  contact_area: {knots: [" + joined(found.knots, knot) + "]" +
         (found.packings > 0 ? ", held_out: " + number(found.held_out) + ", pairs_alone: " + number(found.pairs_alone) : "") +
         "}  # over the surface: of a sphere by pairs alone, of a shell in its place\n";
}

/// What the law tells of each random packing that was held out, beside the shells.
std::string packings_text(const calibrate::HeldOutErrors& errors) {
  const auto random = [](const calibrate::HeldOutPacking& p) { return p.arrangement == calibrate::Arrangement::kRandom; };
  return "[" +
         joined(errors.all_packings | std::views::filter(random),
                [](const calibrate::HeldOutPacking& p) {
                  return number_text("\"%.4g: ", p.volume_ratio) + number_text("%.1f ", 1e3 * p.pressure) +
                         number_text("%.1f\"", 1e3 * p.by_law);
                }) +
         "]";
}

/// Where cells come to rest by themselves: how many, distance of neighbours of shells and of spheres [µm].
std::string clusters_text(const std::vector<RestingCluster>& all) {
  return "[" +
         joined(all,
                [](const RestingCluster& c) {
                  return "\"" + std::to_string(c.cells) + number_text(": %.3f", c.shells) + number_text(" %.3f\"", c.spheres);
                }) +
         "]";
}

std::string errors_text(const calibrate::HeldOutErrors& errors, const std::vector<RestingCluster>& clusters) {
  return "{pairs: " + std::to_string(errors.pairs) + ", force_rms: " + number(errors.force_rms) +
         ", force_worst: " + number(errors.force_worst) + ", packings: " + std::to_string(errors.packings) +
         ", pressure_rms: " + number(errors.pressure_rms) + ", pressure_worst: " + number(errors.pressure_worst) +
         ", lattices: " + std::to_string(errors.lattices) + ", lattice_rms: " + number(errors.lattice_rms) +
         ", lattice_worst: " + number(errors.lattice_worst) + ", random: " + packings_text(errors) +
         (clusters.empty() ? "" : ", clusters: " + clusters_text(clusters)) + "}  # random: V/V0: Pa of shells, of spheres" +
         (clusters.empty() ? "" : "; clusters at rest: cells: um between neighbours, shells, spheres");
}

/// Least and largest of what the fitted points have.
struct Ranges {
  double overlap[2] = {1e300, -1e300}, radius[2] = {1e300, -1e300}, room[2] = {1e300, -1e300};
  double rate = 0.0;
};

void include(double (&range)[2], double value) { range[0] = std::min(range[0], value), range[1] = std::max(range[1], value); }

Ranges ranges_of(const calibrate::Data& data) {
  Ranges out;
  for (const calibrate::PairPoint& p : data.pairs) {
    if (p.held_out) continue;
    include(out.overlap, p.overlap / p.smaller_radius());
    include(out.radius, p.radius_a), include(out.radius, p.radius_b);
    out.rate = std::max(out.rate, p.rate);
  }
  for (const calibrate::PackingPoint& p : data.packings)
    if (!p.held_out) include(out.room, p.volume_ratio);
  return out;
}

std::string ranges_text(const calibrate::Data& data) {
  const Ranges r = ranges_of(data);
  const auto ends = [](const double(&range)[2], const std::string& unit) {
    return "{least: " + number(range[0]) + unit + ", most: " + number(range[1]) + unit + "}";
  };
  return "{overlap_over_radius: " + ends(r.overlap, "") + ", radius: " + ends(r.radius, " um") +
         (r.room[0] <= r.room[1] ? ", volume_ratio: " + ends(r.room, "") : "") + ", slowest_rate: " + of(r.rate, "um/s") + "}";
}

/// How fast spheres of a law come together and draw past each other, where it was found.
std::string friction_text(const FrictionOfSpheres& found) {
  std::string out;
  const auto add = [&](const char* key, const auto& one, const char* what) {
    if (!one) return;
    out += std::string("  ") + key + ": {factor: " + number(one->factor) + ", friction: " + of(one->friction, "nN s/um^3") +
           ", interval: [" + of(one->low, "nN s/um^3") + ", " + of(one->high, "nN s/um^3") + "], misfit: " + number(one->misfit) + "}  # " +
           what + " of two spheres, over that of the shells\n";
  };
  add("approach", found.approach, "friction of approach");
  add("along", found.along, "friction along the contact");
  return out;
}

/// Contact of a sphere with a shell, where it was found.
std::string with_shells_text(const std::optional<MixedContact>& found) {
  if (!found) return "";
  const auto range = [](const calibrate::Interval& i) { return "[" + number(i.low) + ", " + number(i.high) + "]"; };
  return "with_shells:  # a sphere with a shell: factors on the stiffness of the sphere's foundation and on W, so that such a pair lies "
         "between those of "
         "one body\n  stiffness: " +
         number(found->fit.stiffness) + "\n  stiffness_interval: " + range(found->fit.stiffness_interval) +
         "\n  adhesion: " + number(found->fit.adhesion) + "\n  adhesion_interval: " + range(found->fit.adhesion_interval) +
         "\n  misfit: " + number(found->misfit) +
         "  # from halfway between both, root mean square in parts of the pull-off force 1.5 pi W R*" +
         "\n  unfitted: " + number(found->unfitted) + "  # the same with both factors 1" + "\n  outside: " + number(found->outside) +
         "  # beyond both, root mean square, and at worst\n  outside_worst: " + number(found->outside_worst) +
         (found->promoted ? "\n  promoted: " + number(*found->promoted) +
                                "  # way of the twelve neighbours of a sphere that becomes a shell, outwards, over R"
                          : "") +
         (found->held_out ? "\n  held_out: " + number(*found->held_out) + "  # misfit where radii are 1 : 1.3 and 1.3 : 1" : "") + "\n";
}

/// What spheres of a law have beside it.
std::string spheres_text(const SpheresOfLaw& found) {
  return "  held_out: " + errors_text(found.held_out, found.clusters) + "\n" + friction_text(found.friction) +
         (found.packing.empty() ? "" : "  packing: " + knots_text(found.packing) + "\n") + crowding_text(found.crowding);
}

std::string table_text(const FittedTable& fitted) {
  std::string out =
      "table:  # F/R* over delta/R* of attached pairs, R* the reduced radius\n  touch: " + number(fitted.table.touch_overlap()) +
      "\n  exponent: " + number(fitted.exponent.value) + "\n  exponent_error: " + number(fitted.exponent.error) + "\n" +
      spheres_text(fitted.spheres) + "  knots:\n";
  for (const cbm::PairTableKnot& knot : fitted.table.knots())
    out += "    - {overlap: " + number(knot.overlap) + ", force: " + of(knot.force, "nN/um") + ", area: " + number(knot.area) + "}\n";
  return out;
}

}  // namespace

std::string hash_of(const CellMaterial& material) {
  const std::string text = material.text();
  return hash128(std::as_bytes(std::span(text))).hex();
}

std::string calibration_text(const Calibration& found) {
  const calibrate::SureFit& sure = found.sure;
  const calibrate::Fit& fit = sure.fit;
  std::string out =
      "# Contact law of spheres, found from shells by `morula calibrate jkr`. Intervals: 95 %, by profiles of the loss, with what the law "
      "cannot take.\n";
  out += "schema: 1\nversion: " + build_info().version + "\ntype: " + found.material.type +
         "\nmaterial: " + in_quotes(found.material.text()) + "  # what the shells are\nhash: " + hash_of(found.material) +
         "  # of the material\nnodes: " + std::to_string(found.material.nodes) + "\nradius: " + of(found.material.radius, "um") +
         "\nadhesion_of_shells: " + of(found.material.adhesion, "nN/um") + "\nbetter: " + (found.table_is_better() ? "table" : "jkr") +
         (found.table_is_better() && found.jkr_is_beyond_range() ? "  # JKR is beyond its range\n" : "  # on what was held out\n");
  out += "jkr:\n  young: " + of(fit.parameters.young, "kPa") + "\n  young_interval: " + interval(sure.young.interval, "kPa") +
         "\n  poisson: " + number(fit.poisson) + "\n  adhesion: " + of(fit.parameters.adhesion, "nN/um") +
         "\n  adhesion_interval: " + interval(sure.adhesion.interval, "nN/um") + "\n  young_error: " + number(sure.covariance.young_error) +
         "\n  adhesion_error: " + number(sure.covariance.adhesion_error) + "\n  correlation: " + number(sure.covariance.correlation) +
         "\n  loss: " + number(fit.loss) + "\n  residuals: " + std::to_string(fit.residuals) + "\n  misfit: " + number(found.misfit) +
         "  # part of the loss of pairs that JKR cannot take\n" + spheres_text(found.jkr);
  if (found.table) out += table_text(*found.table);
  out += with_shells_text(found.with_shells);
  if (const CellFriction& f = found.material.friction; !found.data.relaxations.empty() || !found.data.pressed.empty())
    out += "friction_of_shells: {medium: " + of(f.medium, "nN s/um^3") + ", cell_cell: " + of(f.approach, "nN s/um^3") +
           ", cell_cell_tangential: " + of(f.along, "nN s/um^3") + "}  # with which they came together\n";
  out +=
      "ranges: " + ranges_text(found.data.points) + "\nremarks:" + (found.data.remarks.empty() && fit.remarks.empty() ? " []" : "") + "\n";
  for (const auto* remarks : {&found.data.remarks, &fit.remarks})
    for (const std::string& remark : *remarks) out += "  - " + in_quotes(remark) + "\n";
  return out + "checksum: " + checksum_of_law(out) + "\n";
}

}  // namespace morula::scenarios
