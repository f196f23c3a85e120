// S5: two cells, or a cell and a plane, pulled apart by grips: force against distance.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/numbers/number_text.h"
#include "results/series_reader.h"
#include "scenarios/library/single_cell_studies.h"
#include "scenarios/measures/shape_measures.h"
#include "scenarios/measures/single_cell.h"
#include "scenarios/measures/theory.h"
#include "scenarios/measures/verdicts.h"

namespace morula::scenarios {
namespace {

constexpr double kPi = std::numbers::pi;

enum class Cortex { kElastic, kFluid };

/// One pair that is pulled apart, or a cell and its plane.
struct Specimen {
  std::string name;
  Cortex cortex = Cortex::kElastic;
  bool on_plane = false;
  double adhesion = 0.0, tension = 0.0, friction = 0.0, speed = 0.0;  ///< W, γ [nN/µm]; γ_ext [nN·s/µm³]; of the retraction [µm/s]
  std::uint32_t nodes = 0;
  std::size_t plate = 0;                      ///< material that it is pulled off, when on_plane
  std::string holder;                         ///< grip of the cell that it is pulled off
  double range = 0.0;                         ///< c of the contact [µm]
  double radius = 0.0;                        ///< of the free cell [µm]
  std::vector<double> time, distance, force;  ///< while the grip goes back: [s], way since it turned [µm], pull on the contact [nN]
  double peak = 0.0, pressure = 0.0;          ///< F* [nN], pressure of the cell then [kPa]
  double last_radius = 0.0;                   ///< contact radius in the last snapshot before separation [µm]
  double left = 0.0;                          ///< force after separation over F*
  double sphericity = 0.0;                    ///< of the moving cell at the end

  /// The force at which a cell with a tension lets go: π γ² sin²θ/p at its pressure then (dcm.md §8).
  [[nodiscard]] double fluid_peak() const {
    const double angle = theory::cap_of_angle(1.0 - adhesion / ((on_plane ? 1.0 : 2.0) * tension)).angle;
    return kPi * tension * tension * std::pow(std::sin(angle), 2) / pressure;
  }
};

/// When a grip begins its last way in its direction, and when that ends.
std::pair<double, double> retraction(const TimeCourse& way) {
  for (std::size_t i = way.time.size(); i-- > 1;)
    if (way.value[i] > way.value[i - 1]) return {way.time[i - 1], way.time[i]};
  return {0.0, 0.0};
}

/// What the cell is pulled off: the cell that the nearest grip at rest holds, where one is within two diameters; else the obstacle that it
/// sticks to most.
void find_partner(const Model& model, const CellLoad& load, Specimen& s) {
  std::size_t partner = load.type;
  double nearest = 4.0 * model.types[load.type].radius.mean;
  for (const CellLoad& other : model.loads) {
    const double distance = norm(other.center - load.center);
    if (other.what != grip_load() || !other.way.empty() || other.type == load.type || distance > nearest) continue;
    nearest = distance;
    partner = other.type;
    s.holder = other.name;
  }
  for (std::size_t obstacle = model.types.size(); partner == load.type && obstacle < model.material_count(); ++obstacle) {
    const double adhesion = model.pair(load.type, obstacle).adhesion;
    if (!(adhesion > s.adhesion)) continue;
    s.adhesion = adhesion;
    s.plate = obstacle;
  }
  s.on_plane = partner == load.type;
  const ContactPair& pair = model.pair(load.type, s.on_plane ? s.plate : partner);
  s.adhesion = pair.adhesion;
  s.friction = pair.normal_friction;
  s.range = pair.range > 0.0 ? pair.range : model.contact.range;
}

/// The force of a pair is that of the grip at rest, which holds a cell that hardly moves: that of the moving one contains the drag of its
/// cell. Of a cell on a plate it is the moving grip's, less the drag of a ball at its speed.
void read_curve(const SeriesTable& series, const CellLoad& load, double drag_coefficient, Specimen& s) {
  const auto [from, until] = retraction(load.way);
  s.speed = until > from ? (load.way.at(until) - load.way.at(from)) / (until - from) : 0.0;
  const std::string& grip = s.on_plane ? load.name : s.holder;
  const SeriesColumn* time = series.find("time");
  const SeriesColumn* axis[3] = {series.find("grip_x_" + grip), series.find("grip_y_" + grip), series.find("grip_z_" + grip)};
  if (!time || !axis[0] || !axis[1] || !axis[2]) return;
  for (std::size_t i = 0; i < time->values.size(); ++i) {
    const double t = time->values[i];
    if (t < from || t > until) continue;
    const double along = dot(Vec3d{axis[0]->values[i], axis[1]->values[i], axis[2]->values[i]}, load.direction);
    s.time.push_back(t);
    s.distance.push_back(load.way.at(t) - load.way.at(from));
    s.force.push_back(s.on_plane ? along - drag_coefficient * s.speed : -along);
  }
}

void read_states(const std::vector<Snapshot>& snapshots, std::size_t type, Specimen& s) {
  std::size_t peak = 0;
  for (std::size_t i = 0; i < s.force.size(); ++i)
    if (s.force[i] > s.force[peak]) peak = i;
  if (s.force.empty()) return;
  s.peak = s.force[peak];
  Largest after;
  for (const Snapshot& snapshot : snapshots) {
    const auto cells = shells_of(snapshot, type);
    if (cells.empty() || snapshot.time < s.time.front()) continue;
    const Snapshot::Cell& cell = *cells[0].cell;
    if (std::abs(snapshot.time - s.time[peak]) < 1e-6) s.pressure = cell.inner_pressure;
    if (cell.contact_area > 0.0) s.last_radius = std::sqrt(cell.contact_area / kPi);
    s.sphericity = std::cbrt(kPi) * std::pow(6.0 * cell.volume, 2.0 / 3.0) / cell.area;
    s.radius = radius_of_volume(cell.volume);
  }
  for (std::size_t i = s.force.size() - std::min<std::size_t>(3, s.force.size()); i < s.force.size(); ++i) after.add(std::abs(s.force[i]));
  s.left = after.value() / s.peak;
}

Result<std::vector<Specimen>> specimens(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto snapshots, all_snapshots(run));
  MORULA_TRY_ASSIGN(const SeriesTable series, read_series(run / "series.csv"));
  std::vector<Specimen> out;
  for (const CellLoad& load : study.model.loads) {
    if (load.what != grip_load() || load.way.empty()) continue;
    const CellType& type = study.model.types[load.type];
    Specimen s;
    s.name = type.name;
    s.tension = type.shell.tension;
    s.cortex = is_fluid(spring_modulus(type) / type.shell.tension) ? Cortex::kFluid : Cortex::kElastic;
    s.nodes = type.shell_nodes;
    find_partner(study.model, load, s);
    const double size = type.radius.mean;
    read_curve(series, load, type.medium_friction * 4.0 * kPi * size * size, s);
    read_states(snapshots, load.type, s);
    if (s.force.size() > 3) out.push_back(std::move(s));
  }
  return out;
}

bool alike(const Specimen& a, const Specimen& b) {
  return a.cortex == b.cortex && a.on_plane == b.on_plane && a.adhesion == b.adhesion && a.tension == b.tension;
}
bool same_speed(const Specimen& a, const Specimen& b) { return std::abs(a.speed / b.speed - 1.0) < 0.01; }

/// Whether none of the same kind, mesh and friction is slower.
bool is_slowest(const std::vector<Specimen>& all, const Specimen& s) {
  return std::none_of(all.begin(), all.end(), [&](const Specimen& o) {
    return alike(o, s) && o.nodes == s.nodes && o.friction == s.friction && o.speed < 0.99 * s.speed;
  });
}

/// R² and intercept (over the largest F*) of F* against W: elastic pairs at the lowest speed, without the most friction, on one mesh.
void judge_line(const std::vector<Specimen>& all, std::vector<Verdict>& out) {
  const Specimen* first = nullptr;
  for (const Specimen& s : all)
    if (s.cortex == Cortex::kElastic && !s.on_plane && (!first || s.speed < 0.99 * first->speed)) first = &s;
  if (!first) return;
  double n = 0, sx = 0, sy = 0, sxx = 0, syy = 0, sxy = 0, largest = 0;
  for (const Specimen& s : all) {
    if (s.cortex != Cortex::kElastic || s.on_plane || !same_speed(s, *first) || s.friction != first->friction || s.nodes != first->nodes)
      continue;
    n += 1;
    sx += s.adhesion;
    sy += s.peak;
    sxx += s.adhesion * s.adhesion;
    syy += s.peak * s.peak;
    sxy += s.adhesion * s.peak;
    largest = std::max(largest, s.peak);
  }
  if (n < 3) return;
  const double cov = sxy - sx * sy / n, slope = cov / (sxx - sx * sx / n);
  out.push_back(at_least("S5.2", "R^2 of the pull-off force over the adhesion", slope * cov / (syy - sy * sy / n), 0.99));
  out.push_back(at_most("S5.2", "intercept of that line over the largest force", std::abs((sy - slope * sx) / n) / largest, 0.10));
}

/// F* at speed 0, on the line through it at the two lowest speeds; nothing with one speed only.
std::optional<double> force_at_rest(const std::vector<Specimen>& all, const Specimen& slowest) {
  const Specimen* next = nullptr;
  for (const Specimen& s : all)
    if (alike(s, slowest) && s.nodes == slowest.nodes && s.friction == slowest.friction && s.speed > 1.01 * slowest.speed &&
        (!next || s.speed < next->speed))
      next = &s;
  if (!next) return std::nullopt;
  return slowest.peak - slowest.speed * (next->peak - slowest.peak) / (next->speed - slowest.speed);
}

/// The theory of the largest force is for surfaces that attract at contact only. A range c raises the force in the first order of c, as the
/// cell pulls at the edge with an angle that the pressure over the height of the range has opened: with two ranges the force is that on the
/// line through both at c = 0, and judged once.
void judge_fluid(const std::vector<Specimen>& all, const Specimen& s, std::vector<Verdict>& out) {
  const double direct = s.peak / s.fluid_peak();
  const double limit = tolerance(s.nodes, 0.20, 0.05);
  const Specimen *wider = nullptr, *narrower = nullptr;
  for (const Specimen& o : all) {
    if (!alike(o, s) || o.nodes != s.nodes || o.friction != s.friction || !same_speed(o, s)) continue;
    if (o.range > 1.01 * s.range) wider = &o;
    if (o.range < 0.99 * s.range) narrower = &o;
  }
  if (!wider && !narrower)
    out.push_back(
        at_most("T8.2", ("pull-off force against pi gamma^2 sin^2(theta)/p, relative, " + s.name).c_str(), std::abs(direct - 1.0), limit));
  if (!wider || narrower) return;
  const double there = wider->peak / wider->fluid_peak();
  const double at_contact = direct - s.range * (there - direct) / (wider->range - s.range);
  out.push_back(at_most(
      "T8.2",
      ("pull-off force, range of the contact to 0, against pi gamma^2 sin^2(theta)/p, relative, " + s.name + " and " + wider->name).c_str(),
      std::abs(at_contact - 1.0), limit));
}

/// Pairs of specimens that differ in one thing.
void judge_pairs(const std::vector<Specimen>& all, std::vector<Verdict>& out) {
  for (const Specimen& a : all)
    for (const Specimen& b : all) {
      if (!alike(a, b)) continue;
      const bool speed = a.speed < 0.99 * b.speed, friction = a.friction < 0.99 * b.friction, nodes = a.nodes < b.nodes;
      const std::string names = ", " + b.name + " over " + a.name;
      if (speed && a.friction == b.friction && a.nodes == b.nodes && is_slowest(all, a))
        out.push_back(at_least(
            "S5.3",
            ("pull-off force at " + number_text("%g", b.speed) + " over that at " + number_text("%g", a.speed) + " um/s" + names).c_str(),
            b.peak / a.peak, 0.99));
      if (friction && a.nodes == b.nodes && is_slowest(all, a) && is_slowest(all, b))
        if (const auto without = force_at_rest(all, a), with = force_at_rest(all, b); without && with)
          out.push_back(within("S5.4", ("pull-off force at rest with contact friction over that without" + names).c_str(), *with / *without,
                               0.9, 1.1));
      if (nodes && same_speed(a, b) && a.friction == b.friction)
        out.push_back(
            within("S5.7", ("pull-off force of the finer mesh over that of the coarser" + names).c_str(), b.peak / a.peak, 0.85, 1.15));
    }
}

}  // namespace

Result<std::vector<Verdict>> judge_pull_off(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto all, specimens(study, run));
  std::vector<Verdict> out;
  out.push_back(at_least("S5.0", "pairs that were pulled apart", static_cast<double>(all.size()), 1.0));
  for (const Specimen& s : all) {
    const std::string at = ", " + s.name;
    const bool rubs = std::any_of(all.begin(), all.end(), [&](const Specimen& o) { return alike(o, s) && o.friction < s.friction; });
    if (s.cortex == Cortex::kElastic && !s.on_plane && !rubs && is_slowest(all, s))
      out.push_back(
          within("S5.1", ("pull-off force of an elastic pair over W R" + at).c_str(), s.peak / (s.adhesion * s.radius), 2.0, 3.6));
    if (s.cortex == Cortex::kFluid) judge_fluid(all, s, out);
    out.push_back(at_most("S5.5", ("force after separation over the pull-off force" + at).c_str(), s.left, 0.05));
    out.push_back(at_least("S5.5", ("sphericity of the cell after separation" + at).c_str(), s.sphericity, 0.98));
    out.push_back(at_least("S5.6", ("contact radius in the last picture before separation" + at).c_str(), s.last_radius, 0.05, "um"));
  }
  judge_line(all, out);
  judge_pairs(all, out);
  return out;
}

Result<std::vector<NamedPlot>> plot_pull_off(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto all, specimens(study, run));
  CurvePlot curves, peaks, speeds;
  curves.title = "Pull-off: force against the way of the grip";
  curves.x = {"way", "um", false, 0.0, {}};
  curves.y = {"force", "nN", false, {}, {}};
  peaks.title = "Pull-off force over adhesion (lines: 3/2 and 2 pi W R/2; fluid cortex: theory)";
  peaks.x = {"W", "mN/m", false, 0.0, {}};
  peaks.y = {"force", "nN", false, 0.0, {}};
  speeds.title = "Pull-off force over speed";
  speeds.x = {"speed", "um/s", true, {}, {}};
  speeds.y = {"force", "nN", false, 0.0, {}};
  Curve elastic{"elastic cortex", {}, {}, CurveStyle::kPoints, 0}, fluid{"fluid cortex", {}, {}, CurveStyle::kPoints, 1},
      jkr{"3/2 pi W R/2 (JKR)", {0.0}, {0.0}, CurveStyle::kLine, 3}, dmt{"2 pi W R/2", {0.0}, {0.0}, CurveStyle::kLine, 4};
  std::vector<Curve> expected;
  double most = 0.0, radius = 0.0;
  for (const Specimen& s : all) {
    curves.curves.push_back({s.name + ", " + number_text("%g", s.speed) + " um/s", s.distance, s.force, CurveStyle::kLine});
    Curve& mine = s.cortex == Cortex::kFluid ? fluid : elastic;
    mine.x.push_back(s.adhesion);
    mine.y.push_back(s.peak);
    most = std::max(most, s.adhesion);
    radius = s.radius;
    if (s.cortex != Cortex::kFluid) continue;
    Curve& theory = expected.emplace_back(Curve{"fluid cortex, theory", {}, {}, CurveStyle::kLine, 1});
    for (int i = 0; i <= 20; ++i) {
      Specimen other = s;
      other.adhesion = s.adhesion * i / 20.0;
      theory.x.push_back(other.adhesion);
      theory.y.push_back(other.fluid_peak());
    }
  }
  jkr.x.push_back(most);
  dmt.x.push_back(most);
  jkr.y.push_back(0.75 * kPi * most * radius);
  dmt.y.push_back(kPi * most * radius);
  for (Curve* curve : {&elastic, &fluid})
    if (!curve->x.empty()) peaks.curves.push_back(std::move(*curve));
  for (Curve& curve : expected) peaks.curves.push_back(std::move(curve));
  if (!all.empty()) {
    peaks.curves.push_back(std::move(jkr));
    peaks.curves.push_back(std::move(dmt));
  }
  for (const Specimen& s : all) {
    if (!is_slowest(all, s)) continue;
    std::vector<const Specimen*> row;
    for (const Specimen& o : all)
      if (alike(o, s) && o.nodes == s.nodes && o.friction == s.friction) row.push_back(&o);
    std::sort(row.begin(), row.end(), [](const Specimen* a, const Specimen* b) { return a->speed < b->speed; });
    Curve curve{s.name, {}, {}, CurveStyle::kPoints};
    for (const Specimen* o : row) curve.x.push_back(o->speed), curve.y.push_back(o->peak);
    speeds.curves.push_back(std::move(curve));
  }
  return std::vector<NamedPlot>{
      {"force_distance", std::move(curves)}, {"pull_off_force", std::move(peaks)}, {"pull_off_speed", std::move(speeds)}};
}

}  // namespace morula::scenarios
