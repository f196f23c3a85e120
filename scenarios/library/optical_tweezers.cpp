// S2: cells pulled at two opposite poles.
#include <algorithm>
#include <cmath>

#include "scenarios/library/pulled_cell.h"
#include "scenarios/library/single_cell_studies.h"
#include "scenarios/measures/shape_measures.h"
#include "scenarios/measures/single_cell.h"
#include "scenarios/measures/verdicts.h"

namespace morula::scenarios {
namespace {

constexpr double kLinear = 0.05;  // strain up to which the response of a sphere is to be linear (S2.6)

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

Result<std::vector<PulledCell>> pulled_cells(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto snapshots, all_snapshots(run));
  std::vector<PulledCell> out;
  for (const CellLoad& load : study.model.loads) {
    if (load.what != pull_load()) continue;
    PulledCell cell;
    cell.type = load.type;
    cell.nodes = study.model.types[load.type].shell_nodes;
    cell.hookean = study.model.types[load.type].shell.spring_stiffness > 0.0;
    for (const InitialCells& block : study.initial)
      if (block.type == load.type) cell.red_cell = block.shape == CellShape::kBiconcave;
    const Vec3d away = std::abs(load.axis.z) < 0.9 ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0};
    const Vec3d side = normalized(cross(away, load.axis));
    double area = 0.0, volume = 0.0;
    const auto state = [&](std::size_t snapshot, double factor) {
      const auto cells = shells_of(snapshots[snapshot], load.type);
      if (cells.empty()) return Pulled{};
      if (area == 0.0) {
        area = cells[0].cell->area;
        volume = cells[0].cell->volume;
      }
      return Pulled{snapshots[snapshot].time,          load.size * factor,
                    extent(cells[0].nodes, load.axis), extent(cells[0].nodes, side),
                    cells[0].cell->area / area - 1.0,  cells[0].cell->volume / volume - 1.0};
    };
    for (const Hold& hold : holds_of(load.course, snapshots)) cell.at_rest.push_back(state(hold.snapshot, hold.value));
    if (!load.course.empty() && load.course.value.back() == 0.0)
      for (std::size_t i = 0; i < snapshots.size(); ++i)
        if (snapshots[i].time >= load.course.time.back() * (1.0 - 1e-12)) cell.recovery.push_back(state(i, 0.0));
    if (!cell.at_rest.empty()) out.push_back(std::move(cell));
  }
  return out;
}

namespace {

void judge_pulled(const PulledCell& cell, const std::string& who, std::vector<Verdict>& out) {
  const std::vector<Pulled>& all = cell.at_rest;
  std::vector<double> force, strain;
  bool longer = true, thinner = true;
  Largest volume, most;
  double left = kNothing, largest = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Pulled& p = all[i];
    const double s = p.axial / all[0].axial - 1.0;
    volume.add(std::abs(p.volume_change));
    most.add(s);
    if (i > 0 && p.force > largest) {
      longer = longer && p.axial > all[i - 1].axial;
      thinner = thinner && p.transverse < all[i - 1].transverse;
    }
    if (i > 0 && p.force == 0.0) left = std::abs(s);  // the last state without force, after the release
    if (s <= kLinear && p.force >= largest) {
      force.push_back(p.force);
      strain.push_back(s);
    }
    largest = std::max(largest, p.force);
  }
  out.push_back(at_least("S2.1", ("axial diameter rises with the force (1: yes)" + who).c_str(), longer && all.size() > 2, 1.0));
  out.push_back(at_least("S2.1", ("transverse diameter falls with the force (1: yes)" + who).c_str(), thinner && all.size() > 2, 1.0));
  out.push_back(at_most("S2.4", ("change of volume, relative" + who).c_str(), volume.value(), 0.01));
  if (!cell.red_cell && force.size() > 2)
    out.push_back(at_least("S2.6", ("R^2 of a straight line, strains up to 5 %" + who).c_str(), straightness(force, strain), 0.999));
  if (!cell.red_cell)
    out.push_back(at_most("S2.5", ("strain left after the release, relative to the largest" + who).c_str(), left / most.value(), 0.02));
}

}  // namespace

Result<std::vector<Verdict>> judge_optical_tweezers(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto cells, pulled_cells(study, run));
  std::vector<Verdict> out;
  const PulledCell* springs = nullptr;
  for (const PulledCell& cell : cells) {
    judge_pulled(cell, ", " + study.model.types[cell.type].name, out);
    if (!cell.red_cell) continue;
    if (cell.hookean) springs = &cell;
    judge_red_cell(cell, springs, out);
  }
  return out;
}

Result<std::vector<NamedPlot>> plot_optical_tweezers(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto cells, pulled_cells(study, run));
  std::vector<NamedPlot> out = plot_red_cells(cells);
  CurvePlot plot;
  plot.title = "Optical tweezers: diameters of a sphere against force";
  plot.x = {"force at each end", "pN", false, {}, {}};
  plot.y = {"diameter", "um", false, {}, {}};
  for (const PulledCell& cell : cells) {
    if (cell.red_cell) continue;
    Curve axial{"axial", {}, {}, CurveStyle::kPoints}, transverse{"transverse", {}, {}, CurveStyle::kPoints};
    for (const Pulled& p : cell.at_rest) {
      axial.x.push_back(1000.0 * p.force);
      transverse.x.push_back(1000.0 * p.force);
      axial.y.push_back(p.axial);
      transverse.y.push_back(p.transverse);
    }
    plot.curves = {std::move(axial), std::move(transverse)};
  }
  if (!plot.curves.empty()) out.push_back({"diameters", std::move(plot)});
  return out;
}

}  // namespace morula::scenarios
