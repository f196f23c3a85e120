// S4: cells on a rigid plane; a fluid cortex against Young's law, an elastic one against the static reference solution.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/numbers/number_text.h"
#include "scenarios/library/cap_criteria.h"
#include "scenarios/library/shape_measures.h"
#include "scenarios/library/single_cell.h"
#include "scenarios/library/theory.h"
#include "scenarios/library/verdicts.h"

namespace morula::scenarios {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct Spread : ReachedAngle {
  double time = 0.0, modulus = 0.0;  ///< [s], Y/γ
  double r0 = 0.0;                   ///< radius of a ball of the cell's volume [µm]
  theory::Cap expected;
  double contact_radius = 0.0, height = 0.0, pressure = 0.0;  ///< in the units of theory::Cap
  double contact_area = 0.0;                                  ///< as it is told [µm²]
  std::size_t type = 0, obstacle = 0;
};

/// The plane that cells sit on: the top of an obstacle, seen along the third axis.
double top_of(const ObstacleSpec& obstacle) {
  double top = -1e300;
  for (const Vec3d& x : obstacle.position) top = std::max(top, x.z);
  return top;
}

std::vector<Spread> spreads(const Study& study, const Snapshot& snapshot) {
  std::vector<Spread> out;
  const Model& model = study.model;
  const Vec3d normal{0, 0, 1};
  for (std::size_t type = 0; type < model.types.size(); ++type) {
    const CellType& t = model.types[type];
    std::size_t under = 0;  // the obstacle that the cells of this type stick to
    for (std::size_t o = 1; o < model.obstacles.size(); ++o)
      if (model.pair(type, model.types.size() + o).adhesion > model.pair(type, model.types.size() + under).adhesion) under = o;
    if (under >= model.obstacles.size()) continue;
    const Vec3d point{0, 0, top_of(model.obstacles[under])};
    const double adhesion = model.pair(type, model.types.size() + under).adhesion, tension = tension_at(t, snapshot.time);
    if (!(tension > 0.0) || adhesion > 2.0 * tension) continue;
    for (const ShellView& shell : shells_of(snapshot, type)) {
      const auto cap = fit_cap(shell, point, normal);
      if (!cap) continue;
      const double r0 = radius_of_volume(shell.cell->volume);
      Spread one;
      one.ratio = adhesion / tension;
      one.range = range_of(model, type, model.types.size() + under);
      one.nodes = t.shell_nodes;
      one.came_back = tension_at(t, 0.0) < tension;
      one.angle = cap->angle;
      one.time = snapshot.time;
      one.modulus = spring_modulus(t) / tension;
      one.r0 = r0;
      one.expected = theory::on_plane(adhesion, tension);
      one.contact_radius = cap->contact_radius / r0;
      one.height = cap->height / r0;
      one.pressure = shell.cell->pressure * r0 / tension;
      one.contact_area = shell.cell->contact_area;
      one.type = type;
      one.obstacle = under;
      out.push_back(one);
    }
  }
  return out;
}

/// A cell on a plane, with or without tension.
struct Sitting {
  double adhesion = 0.0, tension = 0.0, modulus = 0.0;  ///< W, γ, Y [nN/µm]
  std::uint32_t nodes = 0;
  double contact_area = 0.0;  ///< as it is told [µm²]
  double touching = 0.0;      ///< what is told of a ball that touches: half the range counts, π R c [µm²]
};

std::vector<Sitting> sitting(const Study& study, const Snapshot& snapshot) {
  std::vector<Sitting> out;
  const Model& model = study.model;
  for (std::size_t type = 0; type < model.types.size(); ++type) {
    const CellType& t = model.types[type];
    double adhesion = 0.0, range = 0.0;
    for (std::size_t o = model.types.size(); o < model.types.size() + model.obstacles.size(); ++o)
      if (model.pair(type, o).adhesion > adhesion) adhesion = model.pair(type, o).adhesion, range = range_of(model, type, o);
    if (adhesion == 0.0) continue;
    for (const ShellView& shell : shells_of(snapshot, type))
      out.push_back({adhesion, tension_at(t, snapshot.time), spring_modulus(t), t.shell_nodes, shell.cell->contact_area,
                     std::numbers::pi * radius_of_volume(shell.cell->volume) * range});
  }
  return out;
}

/// Of cells that differ in nothing else, the contact area must rise with W, and fall with the modulus where the contact is more than touching.
void judge_order(const std::vector<Sitting>& cells, std::vector<Verdict>& out) {
  bool with_adhesion = true, with_modulus = true;
  int pairs_w = 0, pairs_e = 0;
  for (const Sitting& a : cells)
    for (const Sitting& b : cells) {
      if (a.tension != b.tension || a.nodes != b.nodes) continue;
      if (a.modulus == b.modulus && a.adhesion < b.adhesion) {
        ++pairs_w;
        with_adhesion = with_adhesion && a.contact_area < b.contact_area;
      }
      if (a.adhesion == b.adhesion && a.modulus < b.modulus && b.contact_area > b.touching) {
        ++pairs_e;
        with_modulus = with_modulus && a.contact_area > b.contact_area;
      }
    }
  if (pairs_w > 0) out.push_back(at_least("S4.4", "contact area rises with the adhesion (1: yes)", with_adhesion, 1.0));
  if (pairs_e > 0) out.push_back(at_least("S4.4", "contact area falls with the modulus of the cortex (1: yes)", with_modulus, 1.0));
}

/// Limits of the shape (S4.1, dcm.md §8).
CapTolerance limits_of(const Spread& s) {
  const CapTolerance study{tolerance(s.nodes, 10.0, 5.0), tolerance(s.nodes, 0.10, 0.06), tolerance(s.nodes, 0.10, 0.05)};
  return cap_tolerance(study, s.expected.angle, s.nodes, s.range, s.r0);
}

}  // namespace

Result<std::vector<Verdict>> judge_spreading(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto snapshots, all_snapshots(run));
  std::vector<Verdict> out;
  const auto relative = [](double value, double expected) { return std::abs(value / expected - 1.0); };
  const auto ends = spreads(study, snapshots.back());
  std::vector<ReachedAngle> fluid;
  for (const Spread& s : ends)
    if (is_fluid(s.modulus)) fluid.push_back(s);
  judge_ways(fluid, out);
  for (const Spread& s : ends) {
    const std::string at = s.text();
    if (is_fluid(s.modulus)) {
      const CapTolerance limits = limits_of(s);
      out.push_back(at_most("S4.1", ("contact radius against Young's law, relative" + at).c_str(),
                            relative(s.contact_radius, s.expected.contact_radius), limits.contact_radius));
      out.push_back(at_most("S4.1", ("height, relative" + at).c_str(), relative(s.height, s.expected.height), limits.height));
      out.push_back(at_most("S4.1", ("contact angle" + at).c_str(), std::abs(s.angle - s.expected.angle) / kDegree, limits.angle, "deg"));
      out.push_back(
          at_most("S4.2", ("pressure, relative" + at).c_str(), relative(s.pressure, s.expected.pressure), tolerance(s.nodes, 0.10, 0.05)));
    } else if (const ElasticCap* r = elastic_cap(s.ratio, s.modulus, s.nodes)) {
      out.push_back(at_most("S4.4", ("contact radius of an elastic cortex, relative" + at).c_str(),
                            relative(s.contact_radius, r->contact_radius), 0.04));
      out.push_back(at_most("S4.4", ("height of an elastic cortex, relative" + at).c_str(), relative(s.height, r->height), 0.04));
    }
  }
  judge_order(sitting(study, snapshots.back()), out);
  for (const Spread& a : ends)
    for (const Spread& b : ends)
      if (a.obstacle < b.obstacle && a.ratio == b.ratio && a.modulus == b.modulus && a.nodes == b.nodes)
        out.push_back(at_most("S4.5", "contact area on a plane of small triangles against one of large triangles, relative",
                              std::abs(b.contact_area / a.contact_area - 1.0), 0.02));
  double fall = 0.0;  // of the contact area of the fluid cells from one output to the next, over the last one
  for (std::size_t k = 2; k < snapshots.size(); ++k) {
    const auto before = spreads(study, snapshots[k - 1]), after = spreads(study, snapshots[k]);
    for (std::size_t i = 0; i < std::min({before.size(), after.size(), ends.size()}); ++i)
      if (is_fluid(ends[i].modulus) && !ends[i].came_back)
        fall = std::max(fall, (before[i].contact_area - after[i].contact_area) / ends[i].contact_area);
  }
  out.push_back(at_most("S4.3", "fall of the contact area between outputs, relative to the last one", fall, 0.01));
  return out;
}

Result<std::vector<NamedPlot>> plot_spreading(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto snapshots, all_snapshots(run));
  CurvePlot shape, over_time;
  shape.title = "Spreading: shape (lines: Young's law)";
  shape.x = {"W/tension", "", false, 0.0, 2.0};
  shape.y = {"over R0", "", false, 0.0, {}};
  Curve a{"contact radius, Young's law", {}, {}, CurveStyle::kLine}, h{"height, Young's law", {}, {}, CurveStyle::kLine};
  for (int i = 0; i < 98; ++i) {
    const theory::Cap cap = theory::on_plane(0.02 * i, 1.0);
    a.x.push_back(0.02 * i);
    h.x.push_back(0.02 * i);
    a.y.push_back(cap.contact_radius);
    h.y.push_back(cap.height);
  }
  const auto ends = spreads(study, snapshots.back());
  for (const bool fluid : {true, false}) {
    const std::string who = fluid ? "fluid cortex" : "elastic cortex";
    Curve radius{"contact radius, " + who, {}, {}, CurveStyle::kPoints}, height{"height, " + who, {}, {}, CurveStyle::kPoints};
    for (const Spread& s : ends) {
      if (is_fluid(s.modulus) != fluid) continue;
      radius.x.push_back(s.ratio);
      height.x.push_back(s.ratio);
      radius.y.push_back(s.contact_radius);
      height.y.push_back(s.height);
    }
    if (radius.x.empty()) continue;
    radius.color = fluid ? 0 : 2;
    height.color = fluid ? 1 : 3;
    shape.curves.push_back(std::move(radius));
    shape.curves.push_back(std::move(height));
  }
  a.color = 0;
  h.color = 1;
  shape.curves.push_back(std::move(a));
  shape.curves.push_back(std::move(h));
  over_time.title = "Spreading: contact area over time";
  over_time.x = {"time", "min", false, {}, {}};
  over_time.y = {"contact area", "um^2", false, 0.0, {}};
  for (std::size_t i = 0; i < ends.size(); ++i) {
    Curve curve{
        "W/T = " + number_text("%g", ends[i].ratio) + (is_fluid(ends[i].modulus) ? ", fluid" : ", elastic"), {}, {}, CurveStyle::kLine};
    for (const Snapshot& snapshot : snapshots) {
      const auto cells = spreads(study, snapshot);
      if (i >= cells.size()) continue;
      curve.x.push_back(snapshot.time / 60.0);
      curve.y.push_back(cells[i].contact_area);
    }
    over_time.curves.push_back(std::move(curve));
  }
  return std::vector<NamedPlot>{{"spreading", std::move(shape)}, {"spreading_time", std::move(over_time)}};
}

}  // namespace morula::scenarios
