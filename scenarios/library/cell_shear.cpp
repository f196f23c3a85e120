// S4.6, S6.5, T9: cells that rub on a plane and on each other, held by grips; and one that slides freely.
#include <algorithm>
#include <cmath>

#include "core/numbers/number_text.h"
#include "results/series_reader.h"
#include "scenarios/library/bearing_area.h"
#include "scenarios/library/single_cell_studies.h"
#include "scenarios/measures/elastic_cap.h"
#include "scenarios/measures/shape_measures.h"
#include "scenarios/measures/single_cell.h"
#include "scenarios/measures/verdicts.h"

namespace morula::scenarios {
namespace {

constexpr double kTable1 = 50.0;  // friction of two cells [nN·s/µm³] (Van Liedekerke et al., Table 1)

/// A held cell and what rubs along it.
struct Rubbing {
  std::string name;
  bool on_plane = true;
  double friction = 0.0;                      ///< tangential, of the pair [nN·s/µm³]
  double from = 0.0;                          ///< judged from here to the end, on average [s]
  double nominal = 0.0;                       ///< γ A v with the friction of Table 1 [nN]
  std::vector<double> time, force, expected;  ///< [s]; along the motion, less the drag of the medium on what moves; and γ A v [nN]

  [[nodiscard]] double mean(const std::vector<double>& values) const {
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < time.size(); ++i)
      if (time[i] >= from) sum += values[i], ++count;
    return count > 0 ? sum / count : std::nan("");
  }
};

double rate_of(const TimeCourse& way, double time) {
  for (std::size_t i = 1; i < way.time.size(); ++i)
    if (time > way.time[i - 1] && time <= way.time[i]) return (way.value[i] - way.value[i - 1]) / (way.time[i] - way.time[i - 1]);
  return 0.0;
}

/// Whatever the cell sticks to.
std::size_t partner_of(const Model& model, std::size_t type) {
  std::size_t best = type;
  double adhesion = 0.0;
  for (std::size_t other = 0; other < model.material_count(); ++other)
    if (other != type && model.pair(type, other).adhesion > adhesion) {
      adhesion = model.pair(type, other).adhesion;
      best = other;
    }
  return best;
}

Result<std::vector<Rubbing>> rubbings(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto snapshots, all_snapshots(run));
  MORULA_TRY_ASSIGN(const SeriesTable series, read_series(run / "series.csv"));
  const Model& model = study.model;
  const SeriesColumn* time = series.find("time");
  std::vector<Rubbing> out;
  for (const CellLoad& load : model.loads) {
    if (load.what != grip_load() || !time) continue;
    const std::size_t partner = partner_of(model, load.type);
    const bool on_plane = partner >= model.types.size();
    const TimeCourse& way = on_plane ? model.obstacles[partner - model.types.size()].distance : load.way;
    if (partner == load.type || way.empty()) continue;
    Rubbing r;
    r.name = model.types[load.type].name;
    r.on_plane = on_plane;
    r.friction = model.pair(load.type, partner).tangential_friction;
    // Friction pulls the cells along before they slide: the last fifth of the way counts.
    const double start = way.time[way.time.size() - 2], whole = way.time.back() - start;
    r.from = start + 0.8 * whole;
    const SeriesColumn* force = series.find("grip_x_" + load.name);
    const double range = range_of(model, load.type, partner);
    double height = -1e300;  // of a plane that looks towards z and moves within itself
    if (on_plane)
      for (const Vec3d& x : model.obstacles[partner - model.types.size()].position) height = std::max(height, x.z);
    for (const Snapshot& snapshot : snapshots) {
      const auto cells = shells_of(snapshot, load.type), others = on_plane ? cells : shells_of(snapshot, partner);
      if (others.empty()) continue;
      for (std::size_t i = 0; force && !cells.empty() && i < time->values.size(); ++i) {
        if (std::abs(time->values[i] - snapshot.time) > 1e-6) continue;
        r.time.push_back(snapshot.time);
        const double speed = rate_of(way, snapshot.time);
        const double drag = model.types[load.type].medium_friction * cells[0].cell->area * speed;
        r.force.push_back(on_plane ? -force->values[i] : force->values[i] - drag);
        const double bearing = on_plane ? bearing_area_on_plane(cells[0], height, range) : bearing_area_between(cells[0], others[0], range);
        r.expected.push_back(r.friction * bearing * speed);
        r.nominal = kTable1 * bearing * speed;
      }
    }
    out.push_back(std::move(r));
  }
  return out;
}

/// Speed of a cell that a body force pushes over the last half of the run, over that of its drag in the medium alone.
Result<std::vector<std::pair<std::string, double>>> sliders(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto snapshots, all_snapshots(run));
  std::vector<std::pair<std::string, double>> out;
  for (const CellLoad& load : study.model.loads) {
    if (load.what != body_force_load()) continue;
    const auto middle = shells_of(snapshots[snapshots.size() / 2], load.type), end = shells_of(snapshots.back(), load.type);
    if (middle.empty() || end.empty()) continue;
    const Vec3d along = normalized(load.force);
    const double speed =
        dot(end[0].cell->centroid - middle[0].cell->centroid, along) / (snapshots.back().time - snapshots[snapshots.size() / 2].time);
    const double drag = study.model.types[load.type].medium_friction * end[0].cell->area;
    out.emplace_back(study.model.types[load.type].name, speed * drag / norm(load.force));
  }
  return out;
}

}  // namespace

Result<std::vector<Verdict>> judge_cell_shear(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto all, rubbings(study, run));
  MORULA_TRY_ASSIGN(const auto free, sliders(study, run));
  std::vector<Verdict> out;
  out.push_back(at_least("SHEAR.0", "held cells that something rubs along", static_cast<double>(all.size()), 2.0));
  for (const Rubbing& r : all)
    for (const Rubbing& control : all) {
      if (!(r.friction > 0.0) || control.friction > 0.0 || control.on_plane != r.on_plane) continue;
      const char* id = r.on_plane ? "S4.6" : "S6.5";
      // A is the area that bears friction, by the geometry of the meshes. scenarios.md (S4.6) allows 5 % for the contact's three points by face; between
      // cells 8 %, since the meshes lock (README).
      out.push_back(at_most(id, ("force against gamma A v, relative, " + r.name).c_str(),
                            std::abs(r.mean(r.force) / r.mean(r.expected) - 1.0), r.on_plane ? 0.05 : 0.08));
      out.push_back(at_most(id, ("force without friction over that with the friction of Table 1, " + control.name).c_str(),
                            std::abs(control.mean(control.force) / control.nominal), 0.02));
    }
  for (const auto& [name, ratio] : free)
    out.push_back(within("T9.6", ("speed of a cell that sticks without friction over that of its drag in the medium, " + name).c_str(),
                         ratio, 0.95, 1.05));
  return out;
}

Result<std::vector<NamedPlot>> plot_cell_shear(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto all, rubbings(study, run));
  CurvePlot plot;
  plot.title = "Shear: force on the grip (dashes of points: friction times contact area times speed)";
  plot.x = {"time", "s", false, 0.0, {}};
  plot.y = {"force", "nN", false, {}, {}};
  int color = 0;
  for (const Rubbing& r : all) {
    plot.curves.push_back({r.name, r.time, r.force, CurveStyle::kLine, color});
    if (r.friction > 0.0) plot.curves.push_back({r.name + ", gamma A v", r.time, r.expected, CurveStyle::kPoints, color});
    ++color;
  }
  return std::vector<NamedPlot>{{"shear", std::move(plot)}};
}

}  // namespace morula::scenarios
