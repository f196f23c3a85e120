// S2: cells pulled at two opposite poles.
#include <algorithm>
#include <cmath>

#include "scenarios/library/shape_measures.h"
#include "scenarios/library/single_cell.h"
#include "scenarios/library/verdicts.h"

namespace morula::scenarios {
namespace {

constexpr double kLinear = 0.05;  // strain up to which the response of a sphere is to be linear (S2.6)

struct Pulled {
  double force = 0.0;                    ///< at each end [nN]
  double axial = 0.0, transverse = 0.0;  ///< diameters [µm]
  double area_change = 0.0, volume_change = 0.0;
};

/// The cell of the first load that pulls, at the holds of its course; the first is the unloaded one.
Result<std::vector<Pulled>> pulled(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto snapshots, all_snapshots(run));
  std::vector<Pulled> out;
  for (const CellLoad& load : study.model.loads) {
    if (load.kind != LoadKind::kPull) continue;
    const Vec3d away = std::abs(load.axis.z) < 0.9 ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0};
    const Vec3d side = normalized(cross(away, load.axis));
    double area = 0.0, volume = 0.0;
    for (const Hold& hold : holds_of(load.course, snapshots)) {
      const auto cells = shells_of(snapshots[hold.snapshot], load.type);
      if (cells.empty()) continue;
      if (out.empty()) {
        area = cells[0].cell->area;
        volume = cells[0].cell->volume;
      }
      out.push_back({load.size * hold.value, extent(cells[0].nodes, load.axis), extent(cells[0].nodes, side),
                     cells[0].cell->area / area - 1.0, cells[0].cell->volume / volume - 1.0});
    }
    break;
  }
  return out;
}

/// R² of a straight line through the points.
double straightness(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = static_cast<double>(x.size());
  double sx = 0, sy = 0, sxx = 0, syy = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sx += x[i];
    sy += y[i];
    sxx += x[i] * x[i];
    syy += y[i] * y[i];
    sxy += x[i] * y[i];
  }
  const double c = sxy - sx * sy / n;
  return c * c / ((sxx - sx * sx / n) * (syy - sy * sy / n));
}

}  // namespace

Result<std::vector<Verdict>> judge_optical_tweezers(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto all, pulled(study, run));
  std::vector<Verdict> out;
  std::vector<double> force, strain;
  bool longer = true, thinner = true;
  double area = 0.0, volume = 0.0, left = 0.0, most = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Pulled& p = all[i];
    const double s = p.axial / all[0].axial - 1.0;
    area = std::max(area, std::abs(p.area_change));
    volume = std::max(volume, std::abs(p.volume_change));
    most = std::max(most, s);
    if (i > 0 && p.force > largest) {
      longer = longer && p.axial > all[i - 1].axial;
      thinner = thinner && p.transverse < all[i - 1].transverse;
    }
    if (i > 0 && p.force == 0.0) left = std::abs(s);
    if (s <= kLinear && p.force >= largest) {
      force.push_back(p.force);
      strain.push_back(s);
    }
    largest = std::max(largest, p.force);
  }
  out.push_back(at_least("S2.1", "axial diameter rises with the force (1: yes)", longer && all.size() > 2, 1.0));
  out.push_back(at_least("S2.1", "transverse diameter falls with the force (1: yes)", thinner && all.size() > 2, 1.0));
  out.push_back(at_most("S2.4", "change of volume, relative", volume, 0.01));
  if (force.size() > 2) out.push_back(at_least("S2.6", "R^2 of a straight line, strains up to 5 %", straightness(force, strain), 0.999));
  if (most > 0.0) out.push_back(at_most("S2.5", "strain left after the release, relative to the largest", left / most, 0.02));
  return out;
}

Result<std::vector<NamedPlot>> plot_optical_tweezers(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto all, pulled(study, run));
  CurvePlot plot;
  plot.title = "Optical tweezers: diameters against force";
  plot.x = {"force at each end", "pN", false, {}, {}};
  plot.y = {"diameter", "um", false, {}, {}};
  Curve axial{"axial", {}, {}, CurveStyle::kPoints}, transverse{"transverse", {}, {}, CurveStyle::kPoints};
  for (const Pulled& p : all) {
    axial.x.push_back(1000.0 * p.force);
    transverse.x.push_back(1000.0 * p.force);
    axial.y.push_back(p.axial);
    transverse.y.push_back(p.transverse);
  }
  plot.curves = {std::move(axial), std::move(transverse)};
  return std::vector<NamedPlot>{{"diameters", std::move(plot)}};
}

}  // namespace morula::scenarios
