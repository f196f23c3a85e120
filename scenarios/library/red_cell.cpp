// S2: the disc of a red blood cell pulled at two poles, against published points.
#include <algorithm>
#include <cmath>

#include "scenarios/library/pulled_cell.h"
#include "scenarios/library/reference_table.h"
#include "scenarios/measures/interpolated.h"
#include "scenarios/measures/verdicts.h"

namespace morula::scenarios {
namespace {

constexpr const char* kStudy = "optical_tweezers";
constexpr int kMeasuredCells = 4;
constexpr double kTop = 0.1929;  // the largest force of the published points [nN], less what a course rounds

ReferenceTable measured_stretch() { return {kStudy, "rbc_stretch.csv"}; }

struct Curves {
  std::vector<double> force, axial, transverse;  ///< [pN], [µm]
};

/// The states under rising force.
Curves rising(const PulledCell& cell) {
  Curves out;
  for (const Pulled& p : cell.at_rest) {
    if (!out.force.empty() && 1000.0 * p.force <= out.force.back()) break;
    out.force.push_back(1000.0 * p.force);
    out.axial.push_back(p.axial);
    out.transverse.push_back(p.transverse);
  }
  return out;
}

/// Root mean square of (ours − measured) over the measured forces from `low` on that lie between the simulated ones.
double deviation(const std::vector<double>& force, const std::vector<double>& ours, const char* column, double low) {
  const ReferenceTable data = measured_stretch();
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < data.rows(); ++i) {
    const double here = interpolated(force, ours, data.column("force_pN")[i]);
    if (!std::isfinite(here) || data.column("force_pN")[i] < low) continue;
    sum += std::pow(here - data.column(column)[i], 2);
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : std::nan("");
}

/// Largest relative difference of the axial diameter from the static solution with springs on the same mesh.
double from_static(const PulledCell& cell, const Curves& c) {
  const ReferenceTable table(kStudy, "rbc_stretch_static_reference.csv");
  double worst = std::nan("");
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (table.column("points")[i] != static_cast<double>(cell.nodes)) continue;
    for (std::size_t k = 0; k < c.force.size(); ++k)
      if (std::abs(c.force[k] - table.column("force_pN")[i]) < 0.1)
        worst = std::fmax(worst, std::abs(c.axial[k] / table.column("axial_um")[i] - 1.0));
  }
  return worst;
}

struct Measured {
  std::vector<double> time, ratio;
};

Measured measured_recovery(int cell) {
  const ReferenceTable table(kStudy, "rbc_shape_recovery.csv");
  Measured out;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (table.column("cell")[i] != cell) continue;
    out.time.push_back(table.column("time_s")[i]);
    out.ratio.push_back(table.column("length_over_width")[i]);
  }
  return out;
}

/// Length over width as it falls, from the moment on when it is `start`: time since then.
Measured falling_from(const std::vector<Pulled>& recovery, double start) {
  Measured out;
  for (std::size_t i = 0; i + 1 < recovery.size(); ++i) {
    const double here = recovery[i].axial / recovery[i].transverse, next = recovery[i + 1].axial / recovery[i + 1].transverse;
    if (out.time.empty()) {
      if (!(here >= start && next < start)) continue;
      out.time.push_back(recovery[i].time + (recovery[i + 1].time - recovery[i].time) * (here - start) / (here - next));
      out.ratio.push_back(start);
    }
    out.time.push_back(recovery[i + 1].time);
    out.ratio.push_back(next);
  }
  if (!out.time.empty()) {
    const double zero = out.time.front();
    for (double& t : out.time) t -= zero;
  }
  return out;
}

/// Squares and the largest difference of one measured cell from our curve with times multiplied by `scale`. Measured points after the end of our
/// curve make the squares NaN; the difference is NaN where they are more than half.
void compare(const std::vector<Pulled>& recovery, int cell, double scale, double& squares, double& largest) {
  const Measured data = measured_recovery(cell);
  const Measured ours = data.time.empty() ? Measured{} : falling_from(recovery, data.ratio.front());
  if (ours.time.size() < 3) {
    squares = largest = std::nan("");
    return;
  }
  std::size_t compared = 0;
  for (std::size_t i = 0; i < data.time.size(); ++i) {
    const double here = interpolated(ours.time, ours.ratio, data.time[i] / scale);
    squares += std::pow(here - data.ratio[i], 2);
    const double difference = std::abs(here - data.ratio[i]);
    if (std::isnan(difference)) continue;
    ++compared;
    if (difference > largest) largest = difference;
  }
  if (2 * compared < data.time.size()) largest = std::nan("");
}

}  // namespace

RecoveryFit fit_recovery(const std::vector<Pulled>& recovery) {
  RecoveryFit out;
  double least = 1e300;
  for (int i = -60; i <= 60; ++i) {  // a tenth to ten times our viscosity
    const double scale = std::pow(10.0, i / 60.0);
    double squares = 0.0, unused = 0.0;
    compare(recovery, 1, scale, squares, unused);
    if (!(squares < least)) continue;
    least = squares;
    out.scale = scale;
  }
  if (out.scale == 0.0) return {std::nan(""), std::nan("")};
  double squares = 0.0;
  for (int cell = 1; cell <= kMeasuredCells; ++cell) compare(recovery, cell, out.scale, squares, out.largest);
  return out;
}

void judge_red_cell(const PulledCell& cell, const PulledCell* other_law, std::vector<Verdict>& out) {
  const std::string law = cell.hookean ? ", springs" : ", hardening membrane";
  const Curves c = rising(cell);
  if (c.force.empty()) return;
  Largest area;
  for (const Pulled& p : cell.at_rest) area.add(std::abs(p.area_change));
  const bool fine = cell.nodes >= 642;
  if (fine) {
    out.push_back(at_most("S2.2", ("axial diameter against the measured means, root mean square" + law).c_str(),
                          deviation(c.force, c.axial, "axial_diameter_um", 0.0), 1.2, "um"));
    out.push_back(at_most("S2.2", ("transverse diameter against the measured means, root mean square" + law).c_str(),
                          deviation(c.force, c.transverse, "transverse_diameter_um", 0.0), 0.8, "um"));
  }
  if (c.force.back() >= 1000.0 * kTop) {
    const double wider = fine ? 0.0 : 1.0;
    out.push_back(within("S2.3", ("axial diameter at 193 pN [um]" + law).c_str(), c.axial.back(), 13.0 - wider, 17.7 + wider));
    out.push_back(within("S2.3", ("transverse diameter at 193 pN [um]" + law).c_str(), c.transverse.back(), 3.4 - wider, 5.1 + wider));
  }
  out.push_back(at_most("S2.4", ("change of area, relative" + law).c_str(), area.value(), 0.01));
  if (cell.hookean)
    out.push_back(
        at_most("S2.4b", "axial diameter with springs against the static solution on the same mesh, relative", from_static(cell, c), 0.02));
  if (!cell.hookean && other_law != nullptr) {
    const Curves springs = rising(*other_law);
    out.push_back(at_most(
        "S2.4b", "axial deviation of the hardening membrane from the data above 130 pN, over that of springs",
        deviation(c.force, c.axial, "axial_diameter_um", 130.0) / deviation(springs.force, springs.axial, "axial_diameter_um", 130.0),
        1.0));
  }
  if (fine && cell.recovery.size() > 3)  // coarse meshes do not stretch far enough to begin where the measured cells do
    out.push_back(at_most("S2.5",
                          ("length over width in recovery against four measured cells, one viscosity fitted to the first" + law).c_str(),
                          fit_recovery(cell.recovery).largest, 0.15));
}

std::vector<NamedPlot> plot_red_cells(const std::vector<PulledCell>& cells) {
  CurvePlot stretch, recovery;
  stretch.title = "Red blood cell: diameters against force (points: Mills et al. 2004)";
  stretch.x = {"force at each end", "pN", false, 0.0, {}};
  stretch.y = {"diameter", "um", false, 0.0, {}};
  recovery.title = "Red blood cell: recovery (points: Hochmuth et al. 1979; one viscosity fitted)";
  recovery.x = {"time", "s", false, 0.0, 0.45};
  recovery.y = {"length/width", "", false, 1.0, {}};
  int color = 1;
  for (const PulledCell& cell : cells) {
    if (!cell.red_cell) continue;
    const std::string law = cell.hookean ? "springs" : "hardening membrane";
    const Curves c = rising(cell);
    stretch.curves.push_back({"axial and transverse, " + law, c.force, c.axial, CurveStyle::kLine, color});
    stretch.curves.push_back({"transverse, " + law, c.force, c.transverse, CurveStyle::kLine, color});
    const RecoveryFit fit = fit_recovery(cell.recovery);
    const Measured first = measured_recovery(1);
    Measured ours = falling_from(cell.recovery, first.ratio.empty() ? 2.0 : first.ratio.front());
    for (double& t : ours.time) t *= fit.scale;
    if (!ours.time.empty() && std::isfinite(fit.scale))
      recovery.curves.push_back({law, std::move(ours.time), std::move(ours.ratio), CurveStyle::kLine, color});
    ++color;
  }
  if (color == 1) return {};
  const ReferenceTable data = measured_stretch();
  stretch.curves.push_back({"measured", data.column("force_pN"), data.column("axial_diameter_um"), CurveStyle::kPoints, 0});
  stretch.curves.push_back(
      {"measured, transverse", data.column("force_pN"), data.column("transverse_diameter_um"), CurveStyle::kPoints, 0});
  for (int cell = 1; cell <= kMeasuredCells; ++cell) {
    Measured m = measured_recovery(cell);
    recovery.curves.push_back({"cell " + std::to_string(cell), std::move(m.time), std::move(m.ratio), CurveStyle::kPoints, 2 + cell});
  }
  return {{"red_cell", std::move(stretch)}, {"red_cell_recovery", std::move(recovery)}};
}

}  // namespace morula::scenarios
