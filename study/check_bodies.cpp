// What a body cannot do yet, or can do only outside the range of its law.
#include <algorithm>
#include <cmath>

#include "cbm/contact_on.h"
#include "cbm/sphere_range.h"
#include "core/ball.h"
#include "core/cell_id_text.h"
#include "core/numbers/number_text.h"
#include "coupling/mechanics/workspace.h"
#include "coupling/regions/outside_law.h"
#include "dcm/drops.h"
#include "study/build.h"
#include "study/declare.h"
#include "study/read_section.h"

namespace morula::scenarios {
namespace {

/// Whether a cell of the type can reach its division volume before the run ends.
bool may_divide(const BuildContext& c, std::size_t type) {
  const CellType& of = c.study.model.types[type];
  if (!of.cycles) return false;
  const double shortest = of.cycle_duration.mean * (1.0 - 3.0 * of.cycle_duration.relative_spread);
  if (shortest < c.study.time.end) return true;
  return std::ranges::any_of(c.study.initial, [&](const InitialCells& block) {
    return (block.random_age || block.source == InitialCells::Source::kCsv) && block.may_have(type);
  });
}

void check_division_of_shells(BuildContext& c) {
  for (std::size_t i = 0; i < c.draft.cell_types.size(); ++i) {
    const auto& [name, place, t] = c.draft.cell_types[i];
    if (c.study.model.types[i].shells_divide || !may_be_shell(c, i) || !may_divide(c, i)) continue;
    const bool always = c.study.model.types[i].initial_body == BodyKind::kShell && c.study.model.swaps.regions.empty();
    c.diagnostics.warning(646, t.shells_divide.given ? t.shells_divide.place : place,
                          "cells of '" + name + "' have a cycle, but " + (always ? "are shells" : "may be shells") +
                              ", and `shells: wait`: at its division volume a shell stops growing and waits until it is a sphere",
                          "`cycle: {shells: cut}`, no `cycle`, or spheres for cells that divide");
  }
}

/// function(name, place, draft of the type, type) for the types whose shells may be cut in the run.
template <class F>
void for_types_that_are_cut(const BuildContext& c, F&& function) {
  for (std::size_t i = 0; i < c.draft.cell_types.size(); ++i) {
    const auto& [name, place, t] = c.draft.cell_types[i];
    const CellType& type = c.study.model.types[i];
    if (type.shells_divide && may_be_shell(c, i) && may_divide(c, i)) function(name, place, t, type);
  }
}

/// A shell of few nodes is cut once, and then no plane serves: a half of it has corners finer than its mesh (decision 0038).
void check_mesh_of_divisions(BuildContext& c) {
  static constexpr double kLongestEdge = 0.5;  // of the radius
  for_types_that_are_cut(c, [&c](const std::string& name, const Place& place, const draft::CellType& t, const CellType& type) {
    const double edge = mean_edge(type.shell_nodes);  // over the radius
    if (edge <= kLongestEdge) return;
    c.diagnostics.warning(650, t.nodes.given ? t.nodes.place : place,
                          "edges of " + std::to_string(type.shell_nodes) + " nodes are " + short_number(std::round(100.0 * edge) / 100.0) +
                              " of the radius: many cuts of such a shell of '" + name + "' leave no good mesh, and it waits",
                          "`nodes: 162`, whose edges are 0.3 of it, or `cycle: {shells: wait}`");
  });
}

/// A cut draws faces beside the new interface out, or together.
void check_sheets_of_divisions(BuildContext& c) {
  for_types_that_are_cut(c, [&c](const std::string& name, const Place& place, const draft::CellType& t, const CellType& type) {
    for (const dcm::Sheet& sheet : type.shell.sheets)
      if (sheet.law->excess != nullptr)
        c.diagnostics.warning(696, t.elastic.given ? t.elastic.place : place,
                              "shells of '" + name + "' divide, and a cut takes faces beyond the range of " + sheet.law->name +
                                  ": the run ends where a face " + sheet.law->limit,
                              "`elastic: neo_hooke` or `springs`, or `cycle: {shells: wait}`");
  });
}

std::uint64_t founders_of(const Study& study) {
  std::uint64_t out = 0;
  for (const InitialCells& block : study.initial) out += block.count;
  return out;
}

/// Tension and adhesion draw faces out where cells touch: a law of small stretches bears them while they are a small part of E h (eight cells lived at 0.1
/// of it, and ended at 0.25).
void check_sheets_under_tension(BuildContext& c) {
  constexpr double kMuch = 0.15;
  if (founders_of(c.study) < 2) return;
  for (std::size_t i = 0; i < c.study.model.types.size(); ++i) {
    const auto& [name, place, t] = c.draft.cell_types[i];
    const dcm::ShellParameters& shell = c.study.model.types[i].shell;
    const double adhesion = c.study.model.pair(i, i).adhesion, bears = t.young.value * t.thickness.value;
    const double pull = std::max(shell.tension, adhesion);
    if (!may_be_shell(c, i) || !(adhesion > 0.0) || !(pull > kMuch * bears)) continue;
    for (const dcm::Sheet& sheet : shell.sheets)
      if (sheet.law->excess != nullptr)
        c.diagnostics.warning(
            696, t.elastic.given ? t.elastic.place : place,
            "the tension or the adhesion of '" + name + "' is " + short_number(std::round(100.0 * pull / bears) / 100.0) +
                " of E h of its cortex: where its shells touch, faces leave the range of " + sheet.law->name,
            "`elastic: neo_hooke` or `springs`, or a `young` of " + short_number(std::ceil(pull / kMuch / t.thickness.value)) + " kPa");
  }
}

/// E406 for named cells whose founder the study has not.
void check_named_cells(BuildContext& c) {
  const std::uint64_t founders = founders_of(c.study);
  const auto check = [&](const std::string& text, const Place& place) {
    if (const auto id = cell_id_of(text); id && id->founder_number() > founders && founders > 0)
      c.diagnostics.error(406, place,
                          "there is no cell " + text + " and will be none: the study begins with " + std::to_string(founders) + " cells",
                          "founders have the numbers 1 to " + std::to_string(founders));
  };
  for (const auto& region : c.draft.coupling.regions)
    for (const auto& [key, ids] : region.content.own.lists)
      for (const std::string& text : ids.value) check(text, ids.place);
  for (const auto& criterion : c.draft.criteria) check(criterion.content.of.cell.value, criterion.content.of.cell.place);
  for (const auto& plot : c.draft.plots) check(plot.content.of.cell.value, plot.content.of.cell.place);
}

bool may_be_sphere(const BuildContext& c, std::size_t type) {
  const draft::Study& d = c.draft;
  if (std::ranges::any_of(d.coupling.regions, [](const auto& r) { return r.content.body.value == "sphere"; })) return true;
  for (const std::size_t origin : origins_of(d, type)) {
    if (origin != type && d.cell_types[type].content.body.value != "shell") return true;  // daughters take the body of their type
    const BodyKind usual = c.study.model.types[origin].initial_body;
    const auto begins_as_sphere = [&](const InitialCells& cells) { return cells.may_begin_as(origin, BodyKind::kSphere, usual); };
    if (std::ranges::any_of(c.study.initial, begins_as_sphere)) return true;
  }
  return false;
}

/// What spheres have not, and a cell differs from another by: E515.
void check_tension_of_spheres(BuildContext& c) {
  for (std::size_t i = 0; i < c.draft.cell_types.size(); ++i) {
    const auto& [name, place, t] = c.draft.cell_types[i];
    const Given<double>& spread = t.variation[number_of(Trait::kTension)].spread;
    if (spread.value > 0.0 && !may_be_shell(c, i))
      c.diagnostics.error(515, spread.place, "'spread' has no effect here",
                          "cells of '" + name + "' are always spheres, which have no tension: `body: shell`");
  }
}

/// A law that was found from shells has its own range, and its spheres rest like shells.
bool has_fitted_law(const BuildContext& c, std::size_t type) { return c.draft.cell_types[type].content.sphere_law.value == kFittedLaw; }

/// Where spheres adhere so much that their contacts are no small part of them. Of a type's pairs the worst is told.
void check_jkr_range(BuildContext& c) {
  const Model& model = c.study.model;
  for (std::size_t i = 0; i < model.types.size(); ++i) {
    if (!model.types[i].sphere.law->of_small_contacts || has_fitted_law(c, i) || !may_be_sphere(c, i)) continue;
    std::size_t worst = i;
    cbm::RestingContact most{};
    for (std::size_t j = i; j < model.types.size(); ++j) {
      if (model.types[j].sphere.law != model.types[i].sphere.law || !may_be_sphere(c, j)) continue;
      const cbm::RestingContact at = cbm::resting_contact(model.types[i].sphere, model.types[i].radius.mean, model.types[j].sphere,
                                                          model.types[j].radius.mean, model.pair(i, j).adhesion);
      if (at.radius_ratio > most.radius_ratio) most = at, worst = j;
    }
    if (!(most.radius_ratio > cbm::kJkrRange)) continue;
    const auto& [name, place, t] = c.draft.cell_types[i];
    const auto percent = [](double part) { return short_number(std::round(100.0 * part)) + " %"; };
    const cbm::SphereParameters &one = model.types[i].sphere, &other = model.types[worst].sphere;
    const double give = 1.0 - one.poisson * one.poisson, other_give = 1.0 - other.poisson * other.poisson;
    const double alike =
        (give + other_give) / (give / one.young + other_give / other.young);  // E of two types alike that give way as these do
    const double needed = alike * std::pow(most.radius_ratio / cbm::kJkrAsked, 3);
    c.diagnostics.warning(
        647, t.sphere_young.given ? t.sphere_young.place : place,
        "spheres of '" + name + "' and '" + model.types[worst].name + "' adhere beyond the range of JKR: at rest the contact radius is " +
            short_number(std::round(100.0 * most.radius_ratio) / 100.0) + " R (JKR asks for about 0.4), the overlap " +
            percent(most.overlap_ratio) + " of the distance, and twelve contacts would cover " + percent(most.covered) + " of the surface",
        "`cbm.young` of " + short_number(std::ceil(needed * 10.0) / 10.0) + " kPa" + (worst == i ? "" : " for both") +
            ", or adhesion weaker by " + short_number(std::ceil(10.0 * std::pow(most.radius_ratio / cbm::kJkrAsked, 3)) / 10.0) + " times");
  }
}

/// Where two spheres rest at another distance than two shells: neighbours move whenever a cell changes its body.
void check_rest_of_bodies(BuildContext& c) {
  constexpr double kMuch = 0.2;  // of the radius; the elasticity of a cortex keeps shells up to 0.2 R further apart than drops
  const Model& model = c.study.model;
  for (std::size_t i = 0; i < model.types.size(); ++i) {
    const CellType& type = model.types[i];
    if (!type.sphere.law->of_small_contacts || has_fitted_law(c, i) || !may_be_sphere(c, i) || !may_be_shell(c, i)) continue;
    const double adhesion = model.pair(i, i).adhesion;
    const double spheres = 2.0 * cbm::resting_contact(type.sphere, type.radius.mean, type.sphere, type.radius.mean, adhesion).overlap_ratio;
    const double drop = type.regional_tension.drop_in_contact(type.shell.tension, 0.0);
    const double shells = dcm::overlap_of_doublet(std::max(0.0, adhesion + 2.0 * drop), type.shell.tension);
    if (!(type.shell.tension > 0.0) || std::abs(shells - spheres) <= kMuch) continue;
    const auto& [name, place, t] = c.draft.cell_types[i];
    c.diagnostics.warning(
        651, t.sphere_young.given ? t.sphere_young.place : place,
        "two spheres of '" + name + "' rest " + number_text("%.2f", 2.0 - spheres) +
            " R apart, and two drops of the tension and adhesion of its shells " + number_text("%.2f", 2.0 - shells) +
            " R: where a cell changes its body, it and its neighbours move",
        "`morula calibrate jkr " + name + " STUDY` finds a law of spheres that rest like its shells (`cbm: {law: fitted}`)");
  }
}

/// A shell under pressure keeps its water; what presses a sphere takes it as if water could leave.
void check_water_of_bodies(BuildContext& c) {
  for (std::size_t i = 0; i < c.study.model.types.size(); ++i) {
    if (!c.study.model.types[i].osmosis.acts() || !may_be_sphere(c, i) || !may_be_shell(c, i)) continue;
    const auto& [name, place, t] = c.draft.cell_types[i];
    c.diagnostics.warning(704, place,
                          "shells of '" + name +
                              "' hold their water against what presses them, up to tens of kPa; spheres give way by their `bulk_modulus`, "
                              "as if it left: among cells that fill their room the two have different pressures and volumes",
                          "one body for all cells of this type where they press each other, or no `osmosis`");
  }
}

/// Spheres have no spin: with as much friction along their contacts as across they stay where they first touched, and what grows becomes a bush.
void note_spheres_that_do_not_roll(BuildContext& c) {
  constexpr double kMuch = 1.0;   // [nN s/µm³], a fiftieth of the default
  constexpr double kAlong = 0.1;  // of the friction across: laws that were fitted to shells have less
  for (std::size_t i = 0; i < c.draft.cell_types.size(); ++i) {
    const auto& [name, place, t] = c.draft.cell_types[i];
    const CellType& type = c.study.model.types[i];
    const ContactPair& pair = c.study.model.pair(i, i);
    const double along = pair.tangential_friction * type.sphere.along_factor;
    const bool rolls = along < std::max(kMuch, kAlong * pair.normal_friction) || has_fitted_law(c, i) || type.fluctuations.energy > 0.0 ||
                       type.migration.acts();
    if (rolls || !may_divide(c, i) || !may_be_sphere(c, i)) continue;
    c.study.notes.push_back(
        "spheres of '" + name +
        "' divide and rub much along their contacts: they do not roll over each other, and a cluster that grows from "
        "few cells branches (README of the study `spheroid`). `cbm: {friction: {along: 0.03}}` or a fitted law lets them");
  }
}

/// Fastest that an obstacle moves before the end of the study [µm/s].
double fastest_of(const ObstacleSpec& obstacle, double end) {
  double most = norm(obstacle.velocity);
  const std::vector<double>& corner = obstacle.distance.time;
  for (std::size_t i = 1; i < corner.size() && corner[i - 1] < end; ++i)
    most = std::max(most, norm(obstacle.way(corner[i - 1], corner[i])) / (corner[i] - corner[i - 1]));
  return most;
}

/// A plate that comes near pushes cells by the friction of their approach before it touches them any deeper, and its told force has no friction in it.
void note_obstacles_whose_friction_bears(BuildContext& c) {
  constexpr double kMuch = 0.03;  // [kPa]: the pressure of a drop with the default tension
  const Model& model = c.study.model;
  for (std::size_t o = 0; o < model.obstacles.size(); ++o) {
    if (!model.obstacles[o].moves()) continue;
    const double speed = fastest_of(model.obstacles[o], c.study.time.end);
    double friction = 0.0;
    for (std::size_t t = 0; t < model.types.size(); ++t)
      friction = std::max(friction, model.pair(t, model.types.size() + o).normal_friction);
    if (!(friction * speed > kMuch)) continue;
    const std::string& name = model.obstacles[o].name;
    c.study.notes.push_back("'" + name + "' moves by up to " + number_text("%.2g", 1e3 * speed) +
                            " nm/s: friction with cells that come near or part bears up to " + number_text("%.2g", friction * speed) +
                            " kPa, which `force_z_" + name + "` and the others leave out; `friction: {obstacle: " +
                            number_text("%.1e", 1e9 * 0.9 * kMuch / speed) + " N s/m^3}` or less where forces on it are read");
  }
}

/// A sphere gives way to any force: beyond that at which a plane comes to its middle, and two spheres alike to one place, nothing pushes it back.
void check_forces_on_spheres(BuildContext& c) {
  constexpr double kMuch = 0.5;  // of that force
  const Model& model = c.study.model;
  for (std::size_t k = 0; k < model.loads.size() && k < c.draft.loads.size(); ++k) {
    const CellLoad& load = model.loads[k];
    if (load.what->push_cell == nullptr || !may_be_sphere(c, load.type)) continue;
    const CellType& type = model.types[load.type];
    double strongest = load.course.empty() ? 1.0 : 0.0;
    for (const double factor : load.course.value) strongest = std::max(strongest, std::abs(factor));
    const double force = norm(load.what->push_cell(load, strongest)), radius = type.radius.mean;
    const double most = 4.0 / 3.0 * type.sphere.young / (1.0 - type.sphere.poisson * type.sphere.poisson) * radius * radius;
    if (!(force > kMuch * most)) continue;
    c.diagnostics.warning(707, c.draft.loads[k].place,
                          "a force of " + number_text("%.3g nN", force) + " on a sphere of '" + type.name +
                              "': its law of contact is one of small overlaps, and at " + number_text("%.3g nN", most) +
                              " it passes through what is in its way",
                          "forces below " + number_text("%.2g nN", 0.1 * most) + " for this `cbm.young`, or `body: shell`");
  }
}

/// Spheres sink deeper into walls than shells, of which more than half of those in a mould have one: they take more room by growing on than they bear the stop of growth
/// for (decision 0025), and at 0.4 of their modulus all moulds that were tried ended beyond the curve of packing.
void check_growth_in_moulds(BuildContext& c) {
  constexpr double kMost = 0.3;  // of the modulus
  const Model& model = c.study.model;
  const auto mould = std::ranges::find(c.draft.geometry, std::string("inside"), [](const auto& o) { return o.content.side.value; });
  const bool leave = std::ranges::any_of(model.swaps.triggers, [](const Trigger& t) { return t.value == outside_law_value(); });
  if (mould == c.draft.geometry.end() || leave) return;
  for (std::size_t i = 0; i < model.types.size(); ++i) {
    const auto& [name, place, t] = c.draft.cell_types[i];
    const double modulus = packing_modulus(t);
    if (!may_divide(c, i) || !may_be_sphere(c, i) || !(model.types[i].inhibit_pressure > kMost * modulus)) continue;
    c.diagnostics.warning(708, t.pressure_above.given ? t.pressure_above.place : mould->place,
                          "spheres of '" + name + "' grow until they bear " + t.pressure_above.text + ", and in a full mould ('" +
                              mould->name + "') they are packed beyond their law before: they sink into its wall, and the run may end",
                          "`inhibit_growth: {pressure_above: " + number_text("%.3g Pa", 1e3 * 0.2 * modulus) +
                              "}`, or shells where the law of spheres ends (`coupling: {triggers: [{outside_law: 1}]}`)");
  }
}

/// Radius of the hollow that cells of an obstacle are in; 0: none, or of another shape [µm].
double hollow_of(const draft::Obstacle& o) {
  if (o.pipette.present) return o.pipette.radius.value;
  if (o.side.value != "inside") return 0.0;
  for (const auto* shape : {&o.sphere, &o.cylinder, &o.capsule})
    if (shape->present) return shape->radius.value;
  return 0.0;
}

/// Hertz's contact is one of surfaces that hardly fit each other.
void note_hollows_that_fit_spheres(BuildContext& c) {
  for (std::size_t i = 0; i < c.study.model.types.size(); ++i)
    for (const auto& [name, place, o] : c.draft.geometry) {
      const double hollow = hollow_of(o), radius = c.study.model.types[i].radius.mean;
      if (!(hollow > radius) || !(hollow < cbm::kMostOfHollow * radius) || !may_be_sphere(c, i)) continue;
      c.study.notes.push_back("'" + name + "' is less than twice as wide as spheres of '" + c.draft.cell_types[i].name +
                              "', and bears them as one of twice their width does, more softly than Hertz's law: shells (`body: shell`) "
                              "where it matters");
    }
}

/// A trap gives cells that fluctuate a relaxation time, which steps may be too long for.
void note_traps_of_fluctuating_cells(BuildContext& c) {
  const Model& model = c.study.model;
  for (const CellLoad& load : model.loads) {
    if (load.what->hold_center == nullptr) continue;
    const CellType& type = model.types[load.type];
    if (!(type.fluctuations.energy > 0.0) || type.fluctuations.resolve > 0.0) continue;
    const double time = type.medium_friction * ball_surface(type.radius.mean) / load.size;
    const double part = 1.0 / (1.0 + model.step.max_step / (2.0 * time));
    if (part > 0.97) continue;
    c.study.notes.push_back("cells of '" + type.name + "' fluctuate in the trap '" + load.name + "' with a relaxation time of " +
                            number_text("%.2g s", time) + ", and steps may be " + number_text("%.2g s", model.step.max_step) +
                            ": their variance may come out as " + number_text("%.2g", part) +
                            " of k_B T/K. `fluctuations: {resolve: " + number_text("%.2g s", time) + "}` has it right within 3 %");
  }
}

/// Steps are chosen by ways on the scale of the range of contact, which is nothing to a cell of usual size and much to a small one.
void check_ways_of_spheres(BuildContext& c) {
  constexpr double kMuch = 0.5;  // of the radius, in one step
  const Model& model = c.study.model;
  const double way = allowed_ways(model).of_point / AllowedWays::kSphereCounts;
  for (std::size_t i = 0; i < model.types.size(); ++i) {
    const double radius = model.types[i].radius.mean;
    if (!(way > kMuch * radius) || !may_be_sphere(c, i)) continue;
    const auto& [name, place, t] = c.draft.cell_types[i];
    const double wanted = kMuch * radius / way * model.step.max_displacement;
    c.diagnostics.warning(648, t.radius.mean.given ? t.radius.mean.place : place,
                          "a sphere of '" + name + "' may go " + number_text("%.2g", way) +
                              " um in one step, more than half of its radius of " + number_text("%.2g um", radius),
                          "`numerics.max_displacement: " + number_text("%.1g", wanted) + "`, or a smaller `contact.range`");
  }
}

}  // namespace

void check_bodies(BuildContext& c) {
  check_named_cells(c);
  check_tension_of_spheres(c);
  if (c.diagnostics.has_errors()) return;  // what a wrong study would be like is not worth a warning
  check_division_of_shells(c);
  check_mesh_of_divisions(c);
  check_sheets_of_divisions(c);
  check_sheets_under_tension(c);
  check_jkr_range(c);
  check_rest_of_bodies(c);
  check_water_of_bodies(c);
  note_spheres_that_do_not_roll(c);
  note_obstacles_whose_friction_bears(c);
  check_ways_of_spheres(c);
  check_forces_on_spheres(c);
  check_growth_in_moulds(c);
  note_hollows_that_fit_spheres(c);
  note_traps_of_fluctuating_cells(c);
}

}  // namespace morula::scenarios
