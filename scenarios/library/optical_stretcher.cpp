// S1: spheres under the traction s0 cos²θ, against the closed form for small strains.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/numbers/number_text.h"
#include "scenarios/library/reference_table.h"
#include "scenarios/library/single_cell_studies.h"
#include "scenarios/measures/shape_measures.h"
#include "scenarios/measures/single_cell.h"
#include "scenarios/measures/theory.h"
#include "scenarios/measures/verdicts.h"

namespace morula::scenarios {
namespace {

constexpr double kSmallStress = 0.5e-3;  // up to here a shell without tension does not wrinkle [kPa]

/// One cell at one hold.
struct Stretching {
  double stress = 0.0;   ///< s0 [kPa]
  double tension = 0.0;  ///< [nN/µm]
  double modulus = 0.0;  ///< in the plane [nN/µm]
  bool bends = true;     ///< something resists bending
  bool last = false;     ///< the load stays until the end
  std::uint32_t nodes = 0;
  SecondMode measured;
  theory::Stretch expected;
  double volume_change = 0.0;  ///< relative to the unloaded cell
};

/// All cells at all holds; those of stress 0 after a load are what is left after the release.
Result<std::vector<Stretching>> stretchings(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto snapshots, all_snapshots(run));
  std::vector<Stretching> out;
  for (const CellLoad& load : study.model.loads) {
    if (load.what != traction_load()) continue;
    const CellType& type = study.model.types[load.type];
    const auto holds = holds_of(load.course, snapshots);
    if (holds.empty() || holds.front().value != 0.0) continue;  // no unloaded state to measure from
    const auto before = shells_of(snapshots[holds.front().snapshot], load.type);
    for (std::size_t h = 1; h < holds.size(); ++h) {
      const auto after = shells_of(snapshots[holds[h].snapshot], load.type);
      for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i) {
        const double stress = load.size * holds[h].value;
        out.push_back({stress, type.shell.tension, spring_modulus(type),
                       type.shell.hinge_stiffness > 0.0 || type.shell.helfrich_rigidity > 0.0, h + 1 == holds.size(), type.shell_nodes,
                       fit_second_mode(before[i], after[i], load.axis),
                       theory::stretched_sphere(stress, radius_of_volume(before[i].cell->volume), spring_modulus(type), 1.0 / 3.0,
                                                type.shell.tension, type.shell.bulk_modulus),
                       after[i].cell->volume / before[i].cell->volume - 1.0});
      }
    }
  }
  return out;
}

/// How one cell went back after the light was off.
struct Recovery {
  double friction = 0.0;  ///< of the medium [nN·s/µm³]
  double time = 0.0;      ///< until the strain was 1/e of that at the release [s]
  double left = 0.0;      ///< strain after eight such times, over that at the release
};

/// Of every cell whose recovery was seen in steps shorter than its time constant.
Result<std::vector<Recovery>> recoveries(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto snapshots, all_snapshots(run));
  std::vector<Recovery> out;
  for (const CellLoad& load : study.model.loads) {
    if (load.what != traction_load() || load.course.empty() || load.course.value.back() != 0.0) continue;
    const auto before = shells_of(snapshots.front(), load.type);
    Recovery r{study.model.types[load.type].medium_friction, 0.0, std::nan("")};
    double first_time = 0.0, first = 0.0, last_time = 0.0, last = 0.0;
    for (const Snapshot& snapshot : snapshots) {
      const auto now = shells_of(snapshot, load.type);
      if (snapshot.time < load.course.time.back() * (1.0 - 1e-12) || now.empty() || before.empty()) continue;
      const double strain = fit_second_mode(before[0], now[0], load.axis).axial;
      if (first == 0.0) {
        first_time = snapshot.time;
        first = strain;
      } else if (r.time == 0.0 && strain < first / std::numbers::e) {
        // straight in the logarithm between the two snapshots
        const double part = std::log(last * std::numbers::e / first) / std::log(last / std::max(strain, 1e-6 * first));
        r.time = last_time + part * (snapshot.time - last_time) - first_time;
        if (last == first) break;  // not resolved
      }
      if (r.time > 0.0 && std::isnan(r.left) && snapshot.time - first_time >= 8.0 * r.time) r.left = std::abs(strain / first);
      last_time = snapshot.time;
      last = strain;
    }
    if (std::isfinite(r.left)) out.push_back(r);
  }
  return out;
}

std::string tension_text(double tension) { return "tension " + number_text("%g", 1000.0 * tension) + " uN/m"; }

/// A shell without tension wrinkles, the earlier the less it resists bending (S1.4). Wrinkles take minutes: judged where the load stays.
void judge_wrinkles(const std::vector<Stretching>& all, std::vector<Verdict>& out) {
  const auto left_over = [](const Stretching& s) { return s.measured.residual / s.measured.axial; };
  const auto is = [](double a, double b) { return std::abs(a - b) < 1e-9; };
  const std::string left = "what the second mode leaves over, relative to the axial strain, without tension at ";
  for (const Stretching& s : all) {
    if (s.nodes < 642 || s.tension != 0.0) continue;
    if (s.bends && (is(s.stress, kSmallStress) || is(s.stress, 1e-3)))
      out.push_back(at_most("S1.4", (left + number_text("%g", 1e3 * s.stress) + " Pa").c_str(), left_over(s), 0.05));
    if (s.bends && s.last && is(s.stress, 2e-3)) out.push_back(at_least("S1.4", (left + "2 Pa: wrinkles").c_str(), left_over(s), 0.1));
    if (!s.bends && s.last && is(s.stress, kSmallStress))
      out.push_back(at_least("S1.4", (left + "0.5 Pa and without bending: wrinkles").c_str(), left_over(s), 0.2));
    for (const Stretching& stiff : all)
      if (s.bends && stiff.bends && stiff.nodes == s.nodes && stiff.tension == 0.0 && is(stiff.modulus, 2.0 * s.modulus) &&
          is(s.stress, kSmallStress) && is(stiff.stress, s.stress))
        out.push_back(at_most("S1.4", "twice the strain of a cell of twice the modulus at 0.5 Pa, relative difference",
                              std::abs(2.0 * stiff.measured.axial / s.measured.axial - 1.0), 0.06));
  }
}

/// Axial strains of smooth cells against energy minimisation on the same meshes (stretcher_static_reference.csv). Up to 1 Pa: beyond, it matters that
/// the light here follows the surface, and wrinkles differ with their history.
void judge_against_minimum(const std::vector<Stretching>& all, std::vector<Verdict>& out) {
  const ReferenceTable table("optical_stretcher", "stretcher_static_reference.csv");
  const auto &nodes = table.column("points"), &bending = table.column("bending"), &tension = table.column("tension_N_per_m"),
             &stress = table.column("peak_stress_Pa"), &ratio = table.column("axial_over_closed_form");
  const double modulus = 0.2;  // of the table: 1 kPa · 200 nm
  Largest worst;
  for (const Stretching& s : all) {
    if (s.stress > 1e-3 || s.measured.residual > 0.1 * s.measured.axial) continue;
    for (std::size_t k = 0; k < table.rows(); ++k)
      if (s.nodes == nodes[k] && s.bends == (bending[k] > 0.0) && std::abs(s.modulus - modulus) < 1e-3 * modulus &&
          std::abs(s.tension - 1e3 * tension[k]) < 1e-9 && std::abs(s.stress - 1e-3 * stress[k]) < 1e-9)
        worst.add(std::abs(s.measured.axial / s.expected.axial - ratio[k]));
  }
  if (worst.shown())
    out.push_back(at_most("S1.1", "axial strain over the closed form against that of least energy, difference", worst.value(), 0.01));
}

}  // namespace

Result<std::vector<Verdict>> judge_optical_stretcher(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto all, stretchings(study, run));
  std::vector<Verdict> out;
  Largest worst, volume, left, most;
  double limit = 0.0, with = 0.0, without = 0.0;
  for (const Stretching& s : all) {
    const double error = s.stress > 0.0 ? std::abs(s.measured.axial / s.expected.axial - 1.0) : 0.0;
    most.add(s.measured.axial);
    volume.add(std::abs(s.volume_change));
    if (s.stress == 0.0) left.add(std::abs(s.measured.axial));
    if (s.tension >= 0.03 && s.stress > 0.0 && s.stress <= 3.0e-3) {
      worst.add(error);
      limit = tolerance(s.nodes, 0.06, 0.03);
    }
    if (std::abs(s.stress - kSmallStress) > 1e-9) continue;
    if (s.tension == 0.0 && s.bends) {
      without = s.measured.axial;
      out.push_back(at_most("S1.2", "axial strain without tension at 0.5 Pa against the closed form, relative", error,
                            tolerance(s.nodes, 0.08, 0.04)));
      out.push_back(within("S1.2", "axial over minus transverse strain without tension at 0.5 Pa",
                           -s.measured.axial / s.measured.transverse, 1.91, 2.11));
    }
    if (std::abs(s.tension - 0.03) < 1e-9) with = s.measured.axial;
  }
  if (limit > 0.0)
    out.insert(out.begin(), at_most("S1.1", "axial strain under tension against the closed form, relative", worst.value(), limit));
  if (with > 0.0 && without > 0.0)
    out.push_back(within("S1.3", "strain at 0.5 Pa: tension 30 uN/m over none", with / without, 0.516, 0.596));
  for (const Stretching& s : all) {
    if (s.nodes < 642 || s.tension < 0.029 || s.tension > 0.031 || std::abs(s.stress - 10e-3) > 1e-9) continue;
    out.push_back(within("S1.8", "axial strain at 10 Pa over the linear value", s.measured.axial / s.expected.axial, 0.95, 1.02));
    out.push_back(
        within("S1.8", "transverse strain at 10 Pa over the linear value", s.measured.transverse / s.expected.transverse, 0.90, 0.97));
  }
  judge_wrinkles(all, out);
  judge_against_minimum(all, out);
  MORULA_TRY_ASSIGN(const auto back, recoveries(study, run));
  for (std::size_t i = 0; i < back.size(); ++i) {
    out.push_back(at_most("S1.7", "strain left eight time constants after the release, relative", back[i].left, 0.02));
    if (i > 0)
      out.push_back(at_most("S1.7", "time constants of two cells against their friction, relative difference",
                            std::abs(back[i].time / back[i - 1].time / (back[i].friction / back[i - 1].friction) - 1.0), 0.05));
  }
  out.push_back(at_most("S1.5", "change of volume, relative", volume.value(), 0.01));
  if (left.shown())  // there was a release
    out.push_back(at_most("S1.7", "strain left after the release, relative to the largest", left.value() / most.value(), 0.02));
  return out;
}

Result<std::vector<NamedPlot>> plot_optical_stretcher(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto all, stretchings(study, run));
  CurvePlot plot;
  plot.title = "Optical stretcher: strain against stress (lines: theory)";
  plot.x = {"peak stress", "Pa", false, {}, {}};
  plot.y = {"strain along the axis", "%", false, {}, {}};
  std::vector<double> tensions;
  for (const Stretching& s : all)
    if (std::find(tensions.begin(), tensions.end(), s.tension) == tensions.end()) tensions.push_back(s.tension);
  for (const double tension : tensions) {
    Curve points{tension_text(tension), {}, {}, CurveStyle::kPoints},
        line{tension_text(tension) + ", theory", {0.0}, {0.0}, CurveStyle::kLine};
    for (const Stretching& s : all) {
      if (s.tension != tension || s.stress == 0.0) continue;
      points.x.push_back(1000.0 * s.stress);
      points.y.push_back(100.0 * s.measured.axial);
      line.x.push_back(1000.0 * s.stress);
      line.y.push_back(100.0 * s.expected.axial);
    }
    points.color = line.color = static_cast<int>(plot.curves.size() / 2);
    plot.curves.push_back(std::move(points));
    plot.curves.push_back(std::move(line));
  }
  return std::vector<NamedPlot>{{"stretch", std::move(plot)}};
}

}  // namespace morula::scenarios
