#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "cbm/laws/jkr.h"
#include "core/numbers/number_text.h"
#include "report/pictures/curves.h"
#include "report/report.h"
#include "results/build_info.h"
#include "scenarios/experiments/calibration.h"

namespace morula::scenarios {
namespace {

using calibrate::PairPoint;

std::string three(double value) { return number_text("%.3g", value); }

Curve curve(std::string name, CurveStyle style = CurveStyle::kLine) {
  Curve out;
  out.name = std::move(name);
  out.style = style;
  return out;
}

CurveAxis axis(const char* label, const char* unit, bool logarithmic = false) {
  CurveAxis out;
  out.label = label, out.unit = unit, out.logarithmic = logarithmic;
  return out;
}

CurvePlot plot_of(std::string title, CurveAxis x, CurveAxis y) {
  CurvePlot out;
  out.title = std::move(title), out.x = std::move(x), out.y = std::move(y);
  return out;
}

std::string between(const calibrate::Interval& interval) {
  const bool open = !std::isfinite(interval.high) || interval.low <= 0.0;
  return three(interval.low) + " to " + three(interval.high) + (open ? ", not bounded by the data" : "");
}

/// Force of the attached branch over overlaps of these radii.
Curve jkr_curve(std::string name, const calibrate::Fit& fit, double young, double adhesion, double reduced, double low, double high) {
  Curve out = curve(std::move(name));
  const auto law = cbm::make_pair_law(cbm::ContactMaterial::elastic(young, fit.poisson, young, fit.poisson, adhesion), reduced);
  for (int i = 0; i <= 200; ++i) {
    const double overlap = low + (high - low) * i / 200.0;
    out.x.push_back(overlap);
    out.y.push_back(cbm::contact_response(law, overlap, true).force);
  }
  return out;
}

struct Range {
  double low = 1e300, high = -1e300;
  void include(double x) { low = std::min(low, x), high = std::max(high, x); }
};

Curve table_curve(const FittedTable& law, double reduced, const Range& range) {
  Curve out = curve("table");
  for (int i = 0; i <= 200; ++i) {
    const double overlap = range.low + (range.high - range.low) * i / 200.0;
    out.x.push_back(overlap);
    out.y.push_back(law.table.respond(reduced, overlap, true).force);
  }
  return out;
}

/// Points of pairs that are fitted, or held out, with the law and that of the study's own numbers.
CurvePlot pair_plot(const Calibration& found, bool held_out) {
  CurvePlot plot = plot_of(held_out ? "Held out: cells of unequal radii" : "Two cells: force over overlap", axis("overlap δ", "µm"),
                           axis("force", "nN"));
  Curve in = curve("shells, pressed", CurveStyle::kPoints), out = curve("shells, pulled", CurveStyle::kPoints);
  Range range;
  double reduced = 0.0;
  for (const PairPoint& p : found.data.points.pairs) {
    if (p.held_out != held_out) continue;
    Curve& branch = p.experiment % 2 == found.data.points.pairs.front().experiment % 2 ? in : out;
    branch.x.push_back(p.overlap), branch.y.push_back(p.force);
    range.include(p.overlap);
    reduced = p.reduced_radius();
  }
  if (reduced > 0.0) {
    const calibrate::Fit& fit = found.sure.fit;
    plot.curves.push_back(jkr_curve("fitted JKR", fit, fit.parameters.young, fit.parameters.adhesion, reduced, range.low, range.high));
    plot.curves.push_back(
        jkr_curve("JKR with the W of the study", fit, fit.parameters.young, found.material.adhesion, reduced, range.low, range.high));
  }
  if (reduced > 0.0 && found.table) plot.curves.push_back(table_curve(*found.table, reduced, range));
  plot.curves.push_back(std::move(in));
  plot.curves.push_back(std::move(out));
  return plot;
}

CurvePlot area_plot(const Calibration& found) {
  CurvePlot plot = plot_of("Two cells: contact area over overlap", axis("overlap δ", "µm"), axis("area", "µm²"));
  Curve shells = curve("shells", CurveStyle::kPoints), law = curve("fitted JKR");
  const calibrate::Fit& fit = found.sure.fit;
  Range range;
  double reduced = 0.0;
  for (const PairPoint& p : found.data.points.pairs) {
    if (p.held_out) continue;
    shells.x.push_back(p.overlap), shells.y.push_back(p.area);
    range.include(p.overlap), reduced = p.reduced_radius();
  }
  const double young = fit.parameters.young;
  const auto pair =
      cbm::make_pair_law(cbm::ContactMaterial::elastic(young, fit.poisson, young, fit.poisson, fit.parameters.adhesion), reduced);
  for (int i = 0; i <= 200 && reduced > 0.0; ++i) {
    const double overlap = range.low + (range.high - range.low) * i / 200.0;
    law.x.push_back(overlap);
    law.y.push_back(cbm::contact_response(pair, overlap, true).area);
  }
  plot.curves = {std::move(law), std::move(shells)};
  return plot;
}

/// Pairs that come together by themselves: shells, and spheres of the law to take with the friction that was fitted.
CurvePlot relaxation_plot(const Calibration& found) {
  CurvePlot plot = plot_of("Two cells that come together by themselves", axis("time", "s", true), axis("part of the way to rest", ""));
  for (const calibrate::Relaxation& pair : found.data.relaxations) {
    Curve shells = curve("shells, pair " + std::to_string(plot.curves.size() + 1));
    for (std::size_t i = 1; i < pair.time.size(); ++i)
      if (pair.overlap[i] > 0.0) shells.x.push_back(pair.time[i]), shells.y.push_back(pair.overlap[i] / pair.overlap.back());
    plot.curves.push_back(std::move(shells));
  }
  const calibrate::Relaxation& first = found.data.relaxations.front();
  const calibrate::PairModel law = found.law_to_take();
  std::vector<double> parts;
  for (int i = 2; i < 100; ++i) parts.push_back(0.01 * i);
  const auto add = [&](const char* name, double friction) {
    Curve spheres = curve(name);
    for (const auto& one : calibrate::passages_of_spheres(law, first.radius, first.medium_friction, friction, parts))
      spheres.x.push_back(one.time), spheres.y.push_back(one.part);
    if (!spheres.x.empty()) plot.curves.push_back(std::move(spheres));
  };
  if (const auto& fitted = found.spheres_to_take().friction.approach) add("spheres, fitted", fitted->friction);
  add("spheres with the friction of the study", first.contact_friction);
  return plot;
}

/// Balls of cells that plates press flat, the mean over all.
CurvePlot pressed_plot(const calibrate::FittedAlong& found) {
  CurvePlot plot =
      plot_of("Balls of cells pressed flat: work of the plates", axis("part of the way", ""), axis("work over that on the shells", ""));
  for (const auto& [name, work] : {std::pair{"shells", &found.shells},
                                   {"spheres, fitted", &found.fitted},
                                   {"spheres with the friction of the study", &found.unfitted}}) {
    Curve one = curve(name);
    one.x = found.part, one.y = *work;
    plot.curves.push_back(std::move(one));
  }
  return plot;
}

/// A sphere with a shell between two shells and two spheres.
CurvePlot mixed_plot(const MixedContact& mixed) {
  CurvePlot plot = plot_of("A sphere and a shell: force over overlap", axis("overlap δ", "µm"), axis("force", "nN"));
  Curve shells = curve("two shells"), spheres = curve("two spheres"), both = curve("a sphere and a shell, fitted");
  for (const MixedComparison& one : mixed.comparisons) {
    for (Curve* c : {&shells, &spheres, &both}) c->x.push_back(one.overlap);
    shells.y.push_back(one.shells), spheres.y.push_back(one.spheres), both.y.push_back(one.mixed);
  }
  plot.curves = {std::move(shells), std::move(spheres), std::move(both)};
  return plot;
}

CurvePlot profile_plot(const calibrate::Profile& profile, const char* name, const char* unit, const calibrate::Fit& fit) {
  CurvePlot plot = plot_of(std::string("Profile of ") + name, axis(name, unit, true), axis("loss above the least", ""));
  Curve line = curve("all others at their best");
  for (const auto& p : profile.points) line.x.push_back(p.value), line.y.push_back(p.loss - fit.loss);
  plot.curves.push_back(std::move(line));
  plot.limits.push_back({calibrate::profile_rise(fit), "95 %"});
  return plot;
}

/// Of the law to take: what pairs say of a sphere among many, and what shells in its place have.
CurvePlot crowding_plot(const Calibration& found) {
  CurvePlot plot = plot_of("Contact area of a cell among many", axis("pairs of a sphere, over its surface", ""),
                           axis("contact area over the surface", ""));
  for (const bool held_out : {false, true}) {
    Curve shells = curve(held_out ? "shells, random, held out" : "shells, random, fitted", CurveStyle::kPoints);
    for (const calibrate::CrowdedPoint& p : found.spheres_to_take().crowding.points)
      if (p.held_out == held_out) shells.x.push_back(p.pairs), shells.y.push_back(p.cells);
    if (!shells.x.empty()) plot.curves.push_back(std::move(shells));
  }
  Curve fitted = curve("as it is told"), pairs = curve("pairs alone");
  for (const cbm::CrowdedKnot& knot : found.spheres_to_take().crowding.knots) {
    fitted.x.push_back(knot.pairs), fitted.y.push_back(knot.cells);
    pairs.x.push_back(knot.pairs), pairs.y.push_back(knot.pairs);
  }
  plot.curves.push_back(std::move(fitted)), plot.curves.push_back(std::move(pairs));
  return plot;
}

/// Of the law to take, beside those shells that it was not fitted to, and all others.
CurvePlot packing_plot(const Calibration& found) {
  using calibrate::Arrangement;
  CurvePlot plot = plot_of("Packings: pressure over room", axis("V/V0", ""), axis("pressure", "kPa"));
  const auto add = [&](Curve one) {
    if (!one.x.empty()) plot.curves.push_back(std::move(one));
  };
  Curve fitted = curve("shells, random, fitted", CurveStyle::kPoints);
  for (const auto& p : found.data.points.packings)
    if (!p.held_out) fitted.x.push_back(p.volume_ratio), fitted.y.push_back(p.pressure);
  add(std::move(fitted));
  const auto& held_out = found.spheres_to_take().held_out.all_packings;
  for (const auto& [arrangement, name] : {std::pair<Arrangement, std::string>{Arrangement::kRandom, "random"},
                                          {Arrangement::kFaceCentred, "face-centred"},
                                          {Arrangement::kBodyCentred, "body-centred"}}) {
    Curve shells = curve("shells, " + name + ", held out", CurveStyle::kPoints), law = curve("spheres, " + name);
    for (const auto& p : held_out) {
      if (p.arrangement != arrangement) continue;
      shells.x.push_back(p.volume_ratio), shells.y.push_back(p.pressure);
      law.x.push_back(p.volume_ratio), law.y.push_back(p.by_law);
    }
    add(std::move(shells));
    add(std::move(law));
  }
  return plot;
}

/// How far spheres are from shells in clusters of as many cells, on average over these, the worst, over R.
double worst_cluster(const std::vector<RestingCluster>& clusters) {
  std::map<std::size_t, std::pair<double, int>> errors;  // sum and number by cells
  for (const RestingCluster& one : clusters) errors[one.cells].first += one.error(), ++errors[one.cells].second;
  double out = 0.0;
  for (const auto& [cells, sum] : errors) out = std::max(out, std::abs(sum.first / sum.second));
  return out;
}

/// Distances of neighbours where cells come to rest by themselves.
CurvePlot cluster_plot(const std::vector<RestingCluster>& clusters) {
  CurvePlot plot =
      plot_of("Cells that have come together by themselves: distance of neighbours", axis("cells", "", true), axis("distance", "µm"));
  Curve shells = curve("shells", CurveStyle::kPoints), held_out = curve("shells, held out", CurveStyle::kPoints),
        spheres = curve("spheres", CurveStyle::kPoints);
  for (const RestingCluster& one : clusters) {
    Curve& to = one.held_out ? held_out : shells;
    to.x.push_back(static_cast<double>(one.cells)), to.y.push_back(one.shells);
    spheres.x.push_back(static_cast<double>(one.cells)), spheres.y.push_back(one.spheres);
  }
  plot.curves = {std::move(shells), std::move(held_out), std::move(spheres)};
  return plot;
}

/// How far a law is off on pairs that were held out; where none were, nothing judges it.
ReportNumber error_of_pairs(const std::string& law, const calibrate::HeldOutErrors& held_out) {
  if (held_out.pairs == 0) return {law + " on what was held out", "not judged", "no pair was held out"};
  return {law + " on what was held out, root mean square", three(100.0 * held_out.force_rms), "% of the pull-off force"};
}

ReportContent content_of(const Calibration& found, const std::string& command) {
  const calibrate::SureFit& sure = found.sure;
  const calibrate::Fit& fit = sure.fit;
  ReportContent out;
  out.title = "Contact law of '" + found.material.type + "' from deformable cells";
  out.study = found.material.type;
  out.state = "done";
  out.summary = (fit.parameters.knots.empty() ? "JKR, fitted to " : "JKR and a curve of packing, fitted to ") +
                std::to_string(found.experiments.size()) + " virtual experiments with shells of " + std::to_string(found.material.nodes) +
                " nodes.";
  out.key_numbers = {
      {"E", three(fit.parameters.young), "kPa (95 %: " + between(sure.young.interval) + ")"},
      {"W", three(fit.parameters.adhesion), "nN/um (95 %: " + between(sure.adhesion.interval) + ")"},
      {"W of the study", three(found.material.adhesion), "nN/um"},
      {"pull-off force", three(fit.pull_off(0.5 * found.material.radius)), "nN"},
      {"1.5 π W R* with the W of the study", three(0.75 * std::numbers::pi * found.material.adhesion * found.material.radius), "nN"},
      {"correlation of ln E and ln W", three(sure.covariance.correlation), ""},
      {"loss over its terms", three(fit.loss / static_cast<double>(std::max<std::size_t>(fit.residuals, 1))), ""},
      {"part of the loss of pairs that JKR cannot take", three(100.0 * found.misfit), "%"},
      error_of_pairs("JKR", found.jkr.held_out)};
  if (found.table) {
    out.key_numbers.push_back(error_of_pairs("a table", found.table->spheres.held_out));
    out.key_numbers.push_back({"n of F ∝ (δ − δ_0)ⁿ where cells push (Hertz: 1.5)", three(found.table->exponent.value),
                               "± " + three(found.table->exponent.error)});
    const calibrate::HeldOutErrors& taken = found.spheres_to_take().held_out;
    if (taken.packings > 0)
      out.key_numbers.push_back(
          {"pressure of a random packing that was held out, root mean square", three(100.0 * taken.pressure_rms), "%"});
    if (const calibrate::FittedCrowding& area = found.spheres_to_take().crowding; area.packings > 0)
      out.key_numbers.push_back({"contact area in a random packing that was held out, root mean square", three(100.0 * area.held_out),
                                 "% (by pairs alone " + three(100.0 * area.pairs_alone) + " %)"});
    if (const auto& clusters = found.spheres_to_take().clusters; !clusters.empty())
      out.key_numbers.push_back({"distance of spheres that have come together by themselves, mean of as many cells, off by at most",
                                 three(100.0 * worst_cluster(clusters)), "% of R"});
    const auto add_friction = [&](const char* what, const auto& one) {
      if (one)
        out.key_numbers.push_back(
            {what, three(100.0 * one->factor),
             "% of that of the study (" + three(one->friction) + " nN s/um^3, 95 %: " + three(one->low) + " to " + three(one->high) + ")"});
    };
    add_friction("friction of approach of two spheres", found.spheres_to_take().friction.approach);
    add_friction("friction along the contact of two spheres", found.spheres_to_take().friction.along);
    out.key_numbers.push_back({"the law to take", found.table_is_better() ? "the table" : "JKR", ""});
  }
  if (const auto& mixed = found.with_shells) {
    const auto both = [](double value, const calibrate::Interval& interval) { return three(value) + " (95 %: " + between(interval) + ")"; };
    out.key_numbers.push_back({"a sphere against shells, stiffness and W over what its modulus and W say",
                               both(mixed->fit.stiffness, mixed->fit.stiffness_interval),
                               "and " + both(mixed->fit.adhesion, mixed->fit.adhesion_interval)});
    out.key_numbers.push_back({"force of such a pair from halfway between two shells and two spheres, root mean square",
                               three(100.0 * mixed->misfit),
                               "% of the pull-off force (without both factors " + three(100.0 * mixed->unfitted) + " %)"});
    if (mixed->promoted)
      out.key_numbers.push_back({"neighbours of a sphere that becomes a shell go outwards by", three(100.0 * *mixed->promoted), "% of R"});
  }
  const auto add = [&](const CurvePlot& plot) { out.plots.push_back({"", curves_svg(plot, SvgUse::kInline)}); };
  add(pair_plot(found, false));
  add(area_plot(found));
  if (!found.data.points.packings.empty()) add(packing_plot(found));
  if (!found.spheres_to_take().crowding.knots.empty()) add(crowding_plot(found));
  add(pair_plot(found, true));
  if (const auto& clusters = found.spheres_to_take().clusters; !clusters.empty()) add(cluster_plot(clusters));
  if (found.with_shells) add(mixed_plot(*found.with_shells));
  if (!found.data.relaxations.empty()) add(relaxation_plot(found));
  if (const auto& along = found.spheres_to_take().friction.along) add(pressed_plot(*along));
  add(profile_plot(sure.young, "E", "kPa", fit));
  add(profile_plot(sure.adhesion, "W", "nN/um", fit));
  for (const auto* remarks : {&found.data.remarks, &fit.remarks})
    for (const std::string& remark : *remarks) out.warnings.emplace_back(0.0, remark);
  out.provenance = {{"version", build_info().version}, {"command", command}, {"material", hash_of(found.material)}};
  for (const Experiment& e : found.experiments) out.parameters_text += "# " + e.purpose + "\n" + e.text + "\n";
  return out;
}

}  // namespace

Status write_calibration_report(const Calibration& found, const std::string& command, const std::filesystem::path& path) {
  return write_report(content_of(found, command), path);
}

}  // namespace morula::scenarios
