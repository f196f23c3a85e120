// S3: cells sucked into pipettes; a fluid cortex against 2γ(1/Rp − 1/Rc), an elastic one.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "core/numbers/number_text.h"
#include "coupling/loads/loads.h"
#include "scenarios/library/single_cell_studies.h"
#include "scenarios/measures/shape_measures.h"
#include "scenarios/measures/single_cell.h"
#include "scenarios/measures/theory.h"
#include "scenarios/measures/verdicts.h"

namespace morula::scenarios {
namespace {

constexpr double kElasticSuction = 5.0;  // over the critical one of the tension: from here on the tension bears little of it

/// One cell at one hold of its suction.
struct Aspiration {
  std::string name;
  bool fluid = true;
  double tension = 0.0, modulus = 0.0;  ///< γ, Y [nN/µm]
  double pipette = 0.0;                 ///< inner radius [µm]
  double suction = 0.0;                 ///< [kPa]
  double critical = 0.0;                ///< of theory [kPa]
  double length = 0.0;                  ///< of the tongue beyond the narrowest place of the mouth [µm]
  double drawn = 0.0;                   ///< length less that without suction [µm]
  double rate = 0.0;                    ///< at which it still grows at the end of the hold [µm/s]
  double volume_change = 0.0;
  double sucked = 0.0, sucked_outside = 0.0;  ///< area under suction, and the part of it that is not inside the glass [µm²]
};

struct Mouth {
  double radius = 0.0, throat = 0.0;  ///< of the narrowest place [µm]; its distance from the plane of the mouth [µm]
  double lip = 0.0, edge = 0.0;  ///< radius of the circle that the glass begins with [µm]; its distance from the plane of the mouth [µm]
};

/// The obstacle around the axis of a load: the one whose nodes come nearest to it without lying on it.
Mouth mouth_of(const Model& model, const CellLoad& load) {
  const Vec3d axis = normalized(load.high_end - load.low_end);
  Mouth best;
  for (const ObstacleSpec& obstacle : model.obstacles) {
    Mouth here{1e300, 1e300};
    for (const Vec3d& x : obstacle.position) {
      const Vec3d from = x - load.low_end;
      const double along = dot(from, axis), radius = norm(from - axis * along);
      if (radius < here.radius - 1e-9) here = {radius, along};
      if (radius < here.radius + 1e-9) here.throat = std::min(here.throat, along);
    }
    if (best.radius != 0.0 && !(here.radius < best.radius)) continue;
    best = here;
    best.edge = 1e300;
    for (const Vec3d& x : obstacle.position) {
      const Vec3d from = x - load.low_end;
      const double along = dot(from, axis), radius = norm(from - axis * along);
      if (along > best.edge + 1e-9) continue;
      best.lip = along < best.edge - 1e-9 ? radius : std::min(best.lip, radius);
      best.edge = std::min(best.edge, along);
    }
  }
  return best;
}

/// Area of the faces that bear the suction, and of those of them that lie before the glass or beside its first circle (S3.5).
std::pair<double, double> sucked_area(const ShellView& shell, const CellLoad& load, const Mouth& mouth) {
  const Vec3d axis = normalized(load.high_end - load.low_end);
  double all = 0.0, outside = 0.0;
  for (const Triangle& t : shell.faces) {
    const Vec3d &a = shell.nodes[t[0]], &b = shell.nodes[t[1]], &c = shell.nodes[t[2]], at = (a + b + c) * (1.0 / 3.0);
    if (!lies_within(load, at)) continue;
    const double along = dot(at - load.low_end, axis), area = 0.5 * norm(cross(b - a, c - a));
    all += area;
    if (along < mouth.edge || norm(at - load.low_end - axis * along) > mouth.lip) outside += area;
  }
  return {all, outside};
}

double tongue(const ShellView& shell, const CellLoad& load, const Mouth& mouth) {
  const Vec3d axis = normalized(load.high_end - load.low_end);
  double tip = 0.0;
  for (const Vec3d& x : shell.nodes)
    if (lies_within(load, x)) tip = std::max(tip, dot(x - load.low_end, axis));
  return std::max(0.0, tip - mouth.throat);
}

Result<std::vector<Aspiration>> aspirations(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto snapshots, all_snapshots(run));
  std::vector<Aspiration> out;
  for (const CellLoad& load : study.model.loads) {
    if (load.what != pressure_load() || !load.within) continue;
    const CellType& type = study.model.types[load.type];
    const Mouth mouth = mouth_of(study.model, load);
    std::size_t done = 0;  // the hold at the end of a course may show the state of the one before
    for (const Hold& hold : holds_of(load.course, snapshots)) {
      if (hold.snapshot == done) continue;
      done = hold.snapshot;
      const auto now = shells_of(snapshots[hold.snapshot], load.type), start = shells_of(snapshots.front(), load.type);
      if (now.empty() || start.empty() || hold.snapshot == 0) continue;
      const auto before = shells_of(snapshots[hold.snapshot - 1], load.type);
      Aspiration a;
      a.name = type.name;
      a.tension = type.shell.tension;
      a.modulus = spring_modulus(type);
      a.fluid = is_fluid(a.modulus / a.tension);
      a.pipette = mouth.radius;
      a.suction = -load.size * hold.value;
      a.critical = theory::critical_aspiration(a.tension, mouth.radius, radius_of_volume(start[0].cell->volume));
      a.length = tongue(now[0], load, mouth);
      a.drawn = a.length - tongue(start[0], load, mouth);
      if (!before.empty())
        a.rate = (a.length - tongue(before[0], load, mouth)) / (snapshots[hold.snapshot].time - snapshots[hold.snapshot - 1].time);
      a.volume_change = now[0].cell->volume / start[0].cell->volume - 1.0;
      std::tie(a.sucked, a.sucked_outside) = sucked_area(now[0], load, mouth);
      out.push_back(std::move(a));
    }
  }
  return out;
}

bool same_cell(const Aspiration& a, const Aspiration& b) { return a.name == b.name; }

/// Half way between the largest suction with a tongue shorter than the pipette's radius and the smallest with a longer one, where these are
/// within a sixth of each other; else NaN.
double measured_critical(const std::vector<Aspiration>& all, const Aspiration& cell) {
  double low = std::nan(""), high = std::nan("");
  for (const Aspiration& a : all) {
    if (!same_cell(a, cell) || !(a.suction > 0.0)) continue;
    if (a.length < a.pipette) low = std::fmax(low, a.suction);
    if (a.length >= a.pipette) high = std::fmin(high, a.suction);
  }
  return high - low <= cell.critical / 6.0 ? 0.5 * (low + high) : std::nan("");
}

}  // namespace

Result<std::vector<Verdict>> judge_micropipette(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto all, aspirations(study, run));
  std::vector<Verdict> out;
  Largest volume, outside, least_sucked;  // of the last the smallest is judged
  out.push_back(at_least("S3.0", "states under suction", static_cast<double>(all.size()), 2.0));
  bool rises = true;
  int pairs = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Aspiration& a = all[i];
    volume.add(std::abs(a.volume_change));
    outside.add(a.sucked_outside);
    if (a.suction > 0.0) least_sucked.add(-a.sucked / (std::numbers::pi * a.pipette * a.pipette));
    const std::string at = ", " + a.name + " at " + number_text("%.3g", 1000.0 * a.suction) + " Pa";
    if (a.fluid && a.suction > 0.0 && a.suction < 0.92 * a.critical) {
      out.push_back(
          at_most("S3.1", ("tongue below the critical suction over the pipette's radius" + at).c_str(), a.length / a.pipette, 1.0));
      out.push_back(at_most("S3.1", ("its growth in a second over the pipette's radius" + at).c_str(), a.rate / a.pipette, 2e-3));
    }
    if (a.fluid && a.suction > 1.10 * a.critical) {
      out.push_back(
          at_least("S3.1", ("tongue above the critical suction over the pipette's radius" + at).c_str(), a.length / a.pipette, 1.5));
      out.push_back(at_least("S3.1", ("its growth in a second over the pipette's radius" + at).c_str(), a.rate / a.pipette, 1e-4));
    }
    for (const Aspiration& b : all) {
      if (a.fluid || b.fluid || !same_cell(a, b) || !(a.suction < b.suction)) continue;
      ++pairs;
      rises = rises && a.length < b.length;
    }
  }
  std::vector<std::pair<const Aspiration*, double>> critical;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool first = i == 0 || !same_cell(all[i], all[i - 1]);
    if (!first || !all[i].fluid) continue;
    const double found = measured_critical(all, all[i]);
    if (!std::isfinite(found)) continue;
    critical.emplace_back(&all[i], found);
    out.push_back(at_most("S3.2", ("critical suction against 2 gamma (1/Rp - 1/Rc), relative, " + all[i].name).c_str(),
                          std::abs(found / all[i].critical - 1.0), 0.08));
  }
  for (std::size_t i = 0; i < critical.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Aspiration &a = *critical[i].first, &b = *critical[j].first;
      if (std::abs(a.pipette / b.pipette - 1.0) > 1e-6 || a.tension == b.tension) continue;
      out.push_back(at_most("S3.2", ("critical suction over tension, " + a.name + " against " + b.name + ", relative").c_str(),
                            std::abs(critical[i].second * b.tension / (critical[j].second * a.tension) - 1.0), 0.05));
    }
  if (pairs > 0) out.push_back(at_least("S3.3", "tongue of an elastic cell rises with the suction (1: yes)", rises, 1.0));
  for (const Aspiration& soft : all)
    for (const Aspiration& hard : all)
      if (!soft.fluid && !hard.fluid && std::abs(hard.modulus / soft.modulus - 2.0) < 1e-6 &&
          std::abs(hard.suction - soft.suction) < 1e-9 && soft.suction > kElasticSuction * soft.critical)
        out.push_back(
            within("S3.3",
                   ("what is drawn in at twice the modulus over that at once, " + number_text("%g", 1000.0 * soft.suction) + " Pa").c_str(),
                   hard.drawn / soft.drawn, 0.40, 0.65));
  out.push_back(at_most("S3.4", "change of volume, relative", volume.value(), 0.01));
  out.push_back(at_most("S3.5", "area under suction that is not inside the glass", outside.value(), 0.0, "um^2"));
  out.push_back(at_least("S3.5", "area under suction over the cross section of the pipette", -least_sucked.value(), 0.8));
  return out;
}

Result<std::vector<NamedPlot>> plot_micropipette(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto all, aspirations(study, run));
  MORULA_TRY_ASSIGN(const auto snapshots, all_snapshots(run));
  CurvePlot fluid, elastic, over_time;
  fluid.title = "Micropipette: tongue of cells with a fluid cortex (line: theory up to the critical suction)";
  fluid.x = {"suction over the critical one", "", false, 0.0, {}};
  fluid.y = {"tongue/pipette radius", "", false, 0.0, {}};
  elastic.title = "Micropipette: tongue of elastic cells";
  elastic.x = {"suction", "Pa", false, 0.0, {}};
  elastic.y = {"tongue/pipette radius", "", false, 0.0, {}};
  over_time.title = "Micropipette: tongue over time";
  over_time.x = {"time", "s", false, 0.0, {}};
  over_time.y = {"tongue", "um", false, 0.0, {}};
  const auto add = [&](CurvePlot& plot, const Aspiration& a, double x) {
    if (plot.curves.empty() || plot.curves.back().name != a.name) plot.curves.push_back({a.name, {}, {}, CurveStyle::kPoints});
    plot.curves.back().x.push_back(x);
    plot.curves.back().y.push_back(a.length / a.pipette);
  };
  for (const Aspiration& a : all)
    if (a.suction > 0.0) add(a.fluid ? fluid : elastic, a, a.fluid ? a.suction / a.critical : 1000.0 * a.suction);
  if (!fluid.curves.empty()) {
    Curve line{"critical", {1.0, 1.0}, {0.0, 2.0}, CurveStyle::kLine};
    fluid.curves.push_back(std::move(line));
  }
  for (const CellLoad& load : study.model.loads) {
    if (load.what != pressure_load() || !load.within) continue;
    const Mouth mouth = mouth_of(study.model, load);
    Curve curve{study.model.types[load.type].name, {}, {}, CurveStyle::kLine};
    for (const Snapshot& snapshot : snapshots) {
      const auto cells = shells_of(snapshot, load.type);
      if (cells.empty()) continue;
      curve.x.push_back(snapshot.time);
      curve.y.push_back(tongue(cells[0], load, mouth));
    }
    over_time.curves.push_back(std::move(curve));
  }
  std::vector<NamedPlot> out;
  if (!fluid.curves.empty()) out.push_back({"aspiration", std::move(fluid)});
  if (!elastic.curves.empty()) out.push_back({"aspiration_elastic", std::move(elastic)});
  out.push_back({"aspiration_time", std::move(over_time)});
  return out;
}

}  // namespace morula::scenarios
