#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/ball.h"
#include "core/mesh/renewal/own_mesh.h"
#include "coupling/behaviours/balanced_growth.h"
#include "coupling/mechanics/contact_setup.h"
#include "coupling/observables/observable.h"
#include "dcm/derived_parameters.h"
#include "study/build.h"
#include "study/build_meshes.h"
#include "study/layer_words.h"
#include "study/read_section.h"

namespace morula::scenarios {

double mean_edge(std::uint64_t nodes) {
  struct Level {
    std::uint64_t nodes;
    double edge, volume;  ///< with nodes on the unit sphere: mean edge, part of the sphere's volume
  };
  static constexpr Level kLevels[] = {{42, 0.5817, 0.873}, {162, 0.29933, 0.96616}, {642, 0.15073, 0.99139}, {2562, 0.0755, 0.99784}};
  for (const Level& level : kLevels)
    if (level.nodes == nodes) return level.edge / std::cbrt(level.volume);
  return 0.0;
}

namespace {

/// Most divisions one after the other from the start to the end of the study of cells that do not grow (founders may be old already); 0 of those that do.
int divisions_without_growth(const BuildContext& c, std::size_t type) {
  const CellType& cells = c.study.model.types[type];
  if (!cells.cycles || cells.cycle.growth->grows) return 0;
  const double cycles = population_growth_rate(cells) * c.study.time.end / std::numbers::ln2;
  return static_cast<int>(std::ceil(std::min(100.0, cycles) - 1e-6));
}

/// Cells that divide and do not grow have ever smaller meshes: W503 where the range fits those of the start alone.
void warn_of_shrinking_meshes(BuildContext& c, std::size_t type, double range, double finest, const Place& at) {
  const int divisions = divisions_without_growth(c, type);
  const double until = 3.0 * std::log2(0.56 * finest / range);  // edges go with 2^(−n/3)
  if (!(divisions > until)) return;
  const int first = static_cast<int>(until) + 1;
  c.diagnostics.warning(
      503, at,
      "cells of '" + c.draft.cell_types[type].name + "' divide without growing, up to " + std::to_string(divisions) + " times: from the " +
          std::to_string(first) +
          (first == 1   ? "st"
           : first == 2 ? "nd"
           : first == 3 ? "rd"
                        : "th") +
          " division on the contact range is more than half of the mean edge of a daughter, and contact areas are told too large",
      "a range that fits the smallest cells, with more `nodes`");
}

/// Whether a range fits the meshes of the types that it holds for; empty `names`: of all.
void check_range(BuildContext& c, const Given<double>& range, const std::vector<std::string>& names, const char* key) {
  if (!range.known()) return;
  for (std::size_t type = 0; type < c.draft.cell_types.size(); ++type) {
    const auto& [name, place, t] = c.draft.cell_types[type];
    if (!names.empty() && std::ranges::find(names, name) == names.end()) continue;
    if (!t.nodes.known() || !t.radius.mean.known() || only_from_meshes(c.study, type) || !may_be_shell(c, type)) continue;
    const double edge = mean_edge(t.nodes.value) * t.radius.mean.value;
    // Half an edge is where faces begin to feel more than their opposite; the rule is exact to how mean_edge rounds (0.55 L was measured good).
    // A mesh of its own is finer where the surface is curved.
    const double finest = t.own_mesh.value ? OwnMeshLimits{}.finest * edge : edge;
    const bool too_long = range.value > 0.56 * finest, too_short = range.value < 0.25 * edge;
    const Place at = range.given ? range.place : t.nodes.given ? t.nodes.place : place;
    if (!too_long) warn_of_shrinking_meshes(c, type, range.value, finest, at);
    if (!too_long && !too_short) continue;
    const bool of_own = too_long && t.own_mesh.value;
    const std::string what = "the contact range (" + range.text + ") is " + (too_long ? "more than half" : "less than a quarter") +
                             " of the " + (of_own ? "finest" : "mean") + " edge (" +
                             short_number(std::round((of_own ? finest : edge) * 100) / 100) + " um) of a shell of '" + name + "' with " +
                             t.nodes.text + " nodes" + (of_own ? " and `own_mesh`" : "");
    const std::string help = std::string("`") + key + "` between " + short_number(std::round(edge * 25) / 100) + " um and " +
                             short_number(std::floor(finest * 50) / 100) + " um fits this mesh";
    if (too_long)
      c.diagnostics.error(503, at, what, help);
    else
      c.diagnostics.warning(503, at, what, help);
  }
}

void check_contact_ranges(BuildContext& c) {
  if (!may_have_shells(c)) return;
  check_range(c, c.draft.contact.range, {}, "contact.range");
  for (const auto& pair : c.draft.contact.pairs)
    if (pair.content.range.given && pair.content.between.known()) check_range(c, pair.content.range, pair.content.between.value, "range");
}

/// Without friction across the surface that along it still holds a cell back.
bool moves_freely(const draft::CellType& t) {
  return t.friction_medium.known() && t.friction_medium.value == 0.0 && !(t.tangential_medium.value > 0.0);
}

void check_friction(BuildContext& c) {
  const auto without =
      static_cast<std::size_t>(std::ranges::count_if(c.draft.cell_types, [](const auto& type) { return moves_freely(type.content); }));
  for (const auto& [name, place, t] : c.draft.cell_types) {
    if (!moves_freely(t)) continue;
    const std::string help = "give `friction.medium` at least 1e5 N s/m^3";
    if (without == c.draft.cell_types.size())
      c.diagnostics.error(504, t.friction_medium.place,
                          "no cell has friction with the medium: the velocities of cells without contact are not determined", help);
    else
      c.diagnostics.warning(504, t.friction_medium.place,
                            "cells of '" + name + "' have no friction with the medium: alone, their velocity is not determined", help);
  }
}

/// A biconcave cell is thinner than any nucleus is wide.
void check_nuclei(BuildContext& c) {
  for (std::size_t i = 0; i < c.study.initial.size() && i < c.draft.initial.size(); ++i) {
    const InitialCells& block = c.study.initial[i];
    if (block.shape != CellShape::kBiconcave) continue;
    for (std::size_t t = 0; t < c.study.model.types.size(); ++t) {
      const CellType& type = c.study.model.types[t];
      if (!block.may_have(t) || !type.interior.has_nucleus()) continue;
      c.diagnostics.error(537, c.draft.initial[i].content.shape.place, "biconcave cells of '" + type.name + "' have no room for a nucleus",
                          "`nucleus: {kind: none}`, or spherical cells");
    }
  }
}

void check_periodic_size(BuildContext& c) {
  if (!c.draft.domain.size.known() || !c.draft.contact.range.known()) return;
  constexpr double kPressed =
      1.25;  // half the length of a shell that others press, over its radius (shells of mixed sizes at 0.88 of their volume)
  double radius = 0.0, reach = 0.0;
  // A dividing cell is 2^(1/3) times as wide as a newborn; a pair of such cells may not meet around the domain.
  for (std::size_t t = 0; t < c.draft.cell_types.size(); ++t) {
    const draft::CellType& type = c.draft.cell_types[t].content;
    const double one = (type.has_cycle ? std::cbrt(2.0) : 1.0) * type.radius.mean.value * (1.0 + 3.0 * type.radius.spread.value);
    radius = std::max(radius, one);
    reach = std::max(reach, (may_be_shell(c, t) ? kPressed : 1.0) * one);
  }
  double range = c.draft.contact.range.value;
  for (const auto& pair : c.draft.contact.pairs) range = std::max(range, pair.content.range.value);
  double smallest = 1.0;  // edge of the box at its smallest, in parts of that of time 0
  for (const double volume : c.study.model.box_volume.value) smallest = std::min(smallest, std::cbrt(volume));
  const double needed = 2.0 * (2.0 * radius + range) / smallest, safe = 2.0 * (2.0 * reach + range) / smallest;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double size = c.draft.domain.size.value[axis];
    if (!c.study.model.space.periodic(static_cast<int>(axis)) || size >= safe) continue;
    const std::string where = std::string("along ") + "xyz"[axis];
    if (size < needed)
      c.diagnostics.error(511, c.draft.domain.size.place,
                          "the domain is too small " + where + ": with periodic faces a cell would touch its own image",
                          "at least " + short_number(std::ceil(needed)) + " um, or a `wall`");
    else
      c.diagnostics.warning(
          511, c.draft.domain.size.place,
          "the domain is small " + where +
              ": shells that are pressed are longer than balls, and two that meet on both sides of a periodic face touch in one "
              "place only, with steps and overlaps that jump",
          "at least " + short_number(std::ceil(safe)) + " um where shells press each other");
  }
}

/// An obstacle as long as the domain, or one that cells live in, has no images (for_images()): cells that cross a periodic face leave it.
void check_periodic_obstacles(BuildContext& c) {
  if (!c.draft.domain.size.known()) return;
  double reach = 0.0;
  for (const CellType& type : c.study.model.types)
    reach = std::max(reach, std::cbrt(type.cycles ? 2.0 : 1.0) * type.radius.mean * (1.0 + 3.0 * type.radius.relative_spread));
  const Box& box = c.study.model.space.box;
  for (std::size_t i = 0; i < c.study.model.obstacles.size(); ++i) {
    const ObstacleSpec& obstacle = c.study.model.obstacles[i];
    Box of;
    for (const Vec3d& p : obstacle.position) of.include(p);
    for (std::size_t axis = 0; axis < 3 && !obstacle.position.empty(); ++axis) {
      if (!c.study.model.space.periodic(static_cast<int>(axis))) continue;
      const bool has_images = !obstacle.inside && of.size()[axis] < box.size()[axis];
      const bool within = of.low[axis] >= box.low[axis] + reach && of.high[axis] <= box.high[axis] - reach;
      const bool beyond = of.low[axis] <= box.low[axis] - reach && of.high[axis] >= box.high[axis] + reach;
      if (has_images || within || beyond) continue;
      const std::string across = std::string(" a periodic face across ") + "xyz"[axis];
      if (obstacle.inside && of.size()[axis] < box.size()[axis])
        c.diagnostics.warning(697, c.draft.geometry[i].place,
                              "obstacle '" + obstacle.name + "', in which cells live, ends near" + across +
                                  ": a cell that crosses this face comes in on the other side, which may lie outside the obstacle",
                              "keep it " + short_number(std::ceil(reach)) + " um from the face");
      else
        c.diagnostics.warning(697, c.draft.geometry[i].place,
                              "obstacle '" + obstacle.name + "' is as long as the domain and ends near" + across +
                                  ": so long a one has no images, and a cell at this face meets only what lies on its own side",
                              "let it reach " + short_number(std::ceil(reach)) + " um beyond the domain on both sides, or make it shorter" +
                                  (obstacle.faces.size() <= 12 ? "; a floor can be a `wall`" : ""));
    }
  }
}

/// Names of things make names of columns, which may be those of others: E112 at the thing.
void check_columns(BuildContext& c, const std::vector<std::string>& columns) {
  std::set<std::string> seen;
  const auto tell = [&c](const auto& things, const std::string& column) {
    for (const auto& thing : things)
      if (column.ends_with("_" + thing.name))
        c.diagnostics.error(112, thing.place, "'" + thing.name + "' would make a second column '" + column + "'", "take another name");
  };
  for (const std::string& column : columns) {
    if (seen.insert(column).second) continue;
    tell(c.draft.fields, column);
    tell(c.draft.cell_types, column);
    tell(c.draft.lumens, column);
    tell(c.draft.geometry, column);
  }
}

void check_names(BuildContext& c) {
  const auto check_reserved = [&c](const auto& things) {
    for (const auto& thing : things)
      if (thing.name == "others")
        c.diagnostics.error(112, thing.place, "'others' cannot be a name: in `adhesion` it means all that are not named",
                            "take another name");
  };
  check_reserved(c.draft.cell_types);
  check_reserved(c.draft.geometry);
  for (const auto& obstacle : c.draft.geometry)
    for (const auto& type : c.draft.cell_types)
      if (type.name == obstacle.name)
        c.diagnostics.error(112, obstacle.place, "'" + obstacle.name + "' is a cell type and an obstacle",
                            "give the obstacle another name");
  const auto check_name = [&](const Given<std::string>& name, const char* what) {
    if (name.known() && !is_name(name.value)) c.diagnostics.error(112, name.place, "'" + name.value + "' cannot be " + what, kNameHelp);
  };
  check_name(c.draft.name, "the name of a study");
  for (const auto& region : c.draft.coupling.regions) check_name(region.content.name, "the name of a region");
  const auto check_known = [&](const std::string& word, const Place& place, const std::vector<std::string>& known, const char* what) {
    if (!known.empty() && std::find(known.begin(), known.end(), word) == known.end())
      c.diagnostics.error(403, place, std::string("there is no ") + what + " '" + word + "'", suggest(word, known));
  };
  if (c.draft.scenario.known()) check_known(c.draft.scenario.value, c.draft.scenario.place, c.options.scenario_names, "library study");
  if (c.diagnostics.has_errors()) return;  // which observables there are depends on what the model has
  const auto& series = c.draft.output.series;
  const std::vector<std::string> known = observable_names(c.study.model, *c.options.laws);
  check_columns(c, known);
  std::set<std::string> named;
  for (const std::string& name : series.value) {
    check_known(name, series.place, known, "observable");
    if (!named.insert(name).second) c.diagnostics.error(102, series.place, "column '" + name + "' is named twice", "once is enough");
  }
}

/// What the laws of both layers of a shell say of their stiffness.
double layer_stiffness(const Laws& laws, const draft::ShellKeys& t, dcm::LayerWord::Of of, double node_area, double edge_square) {
  double out = 0.0;
  const auto add = [&](const auto& layer) {
    const bool elastic = of == dcm::LayerWord::Of::kElastic;
    const dcm::LayerWord* word = find_layer_word(laws, of, elastic ? layer.elastic.value : layer.bending_law.value);
    if (word != nullptr && word->stiffness != nullptr) out += word->stiffness(layer_values(layer, *word), node_area, edge_square);
  };
  add(t);
  if (t.has_membrane) add(t.membrane);
  return out;
}

/// Limit by the elasticity in the plane: springs at most 6 k, sheets 7.2 E h, an area modulus likewise, against the friction of a node (and
/// of its edges along themselves).
double in_plane_limit(const Laws& laws, const draft::ShellKeys& t, double node_friction) {
  const double stiffness = 7.2 * t.local_area.value + layer_stiffness(laws, t, dcm::LayerWord::Of::kElastic, 0.0, 0.0);
  return stiffness > 0.0 ? 2.0 * (node_friction + t.damping.value) / stiffness : 1e300;
}

/// Limit by tension, global area and bending (dcm.md §1): 7.5 γ/(γ_med L²), 4 K_G/(γ_med R²), 46 k_h/(γ_med a L²), 56 κ/(γ_med L⁴).
double surface_limit(const Laws& laws, const draft::ShellKeys& t, double friction, double node_area, double radius) {
  const double edge_square = std::pow(mean_edge(t.nodes.value) * radius, 2);
  const double rate = std::max({7.5 * t.tension.value / edge_square, 4.0 * t.global_area.value / (radius * radius),
                                layer_stiffness(laws, t, dcm::LayerWord::Of::kBending, node_area, edge_square)});
  return rate > 0.0 ? 2.0 * friction / rate : 1e300;
}

/// Stiffness of a cubic close packing's breath by the pressure of packing: each sphere's Ψ″/V (Σ |∂v/∂d|)² counts once at its centre and again at
/// its neighbours', 2 (12 · ½π a_g²)² Ψ″/V with a_g² = 0.1815 R² where cells fill space [nN/µm].
double packing_stiffness(const draft::CellType& t, double radius) {
  if (t.packing_law.value == "none") return 0.0;
  double steepest = 0.0;
  if (t.packing_law.value == "knots") {
    for (std::size_t k = 1; k < t.packing_knots.size(); ++k) {
      const auto &low = t.packing_knots[k - 1].content, &high = t.packing_knots[k].content;
      const double width = high.packing.value - low.packing.value;
      if (width > 0.0) steepest = std::max(steepest, 1.5 * (high.pressure.value - low.pressure.value) / width);
    }
  } else if (const auto knots = cbm::ideal_filled_cell(packing_modulus(t), t.sphere_young.value, t.sphere_poisson.value)) {
    if (const auto curve = cbm::PackingCurve::through(*knots)) steepest = curve->steepest();
  }
  const double slopes = 6.0 * std::numbers::pi * 0.1815;
  return 2.0 * slopes * slopes * steepest / (4.0 / 3.0 * std::numbers::pi) * radius;
}

/// Limit by what holds a nucleus against the little friction it has: its links, and the repulsion over a tenth of its cross-section.
double nucleus_limit(const Laws& laws, const draft::CellType& t, double repulsion) {
  const draft::Nucleus& n = t.nucleus;
  if (!n.present || n.kind.value == "none" || n.radius.given == n.volume_fraction.given) return 1e300;
  const double radius = n.radius.given ? n.radius.value : std::cbrt(n.volume_fraction.value) * t.radius.mean.value;
  const draft::Links& l = t.nucleus_links;
  const double links = l.present ? static_cast<double>(std::min(l.number.value, t.nodes.value)) : 0.0;
  const double friction = 6.0 * std::numbers::pi * n.viscosity.value * radius + links * l.damping.value / 3.0;
  double limit = 2.0 * friction / (links * l.stiffness.value / 3.0 + 0.1 * std::numbers::pi * radius * radius * repulsion);
  if (n.kind.value != "shell" || !(n.shell.nodes.value > 0)) return limit;
  // Of a nucleus that is a shell the modes of shells, each node with its share of the drag.
  const double area = ball_surface(radius), per_area = 6.0 * std::numbers::pi * n.viscosity.value * radius / area;
  const double node_area = area / static_cast<double>(n.shell.nodes.value);
  limit = std::min(limit, 2.0 * per_area * radius / (3.0 * std::max(n.shell.bulk_modulus.value, 1e-300)));
  return std::min({limit, in_plane_limit(laws, n.shell, per_area * node_area), surface_limit(laws, n.shell, per_area, node_area, radius)});
}

}  // namespace

double explicit_step_limit(const BuildContext& c) {
  const Laws& laws = *c.options.laws;
  const draft::Study& study = c.draft;
  double limit = 1e300;
  for (std::size_t type = 0; type < study.cell_types.size(); ++type) {
    const draft::CellType& t = study.cell_types[type].content;
    const double friction = t.friction_medium.value, radius = t.radius.mean.value;
    if (!(friction > 0.0) || !(radius > 0.0)) continue;
    if (may_be_shell(c, type) && t.bulk_modulus.value > 0.0 && mean_edge(t.nodes.value) > 0.0) {
      // Fastest modes of a free shell of N nodes: the volume, stiffness K A²/(V N) against γ A/N for each node; the membrane; tension and
      // bending; the repulsion, k_r against the contact friction.
      const double node_area = ball_surface(radius) / std::max(1.0, static_cast<double>(t.nodes.value));
      limit = std::min(limit, 2.0 * friction * radius / (3.0 * t.bulk_modulus.value));
      limit = std::min({limit, in_plane_limit(laws, t, friction * node_area), surface_limit(laws, t, friction, node_area, radius)});
      limit = std::min(limit, nucleus_limit(laws, t, c.study.model.contact.repulsion));
      limit = std::min(limit, 2.0 * std::max(friction, t.friction_cell_cell.value) / stiffest_repulsion(c.study.model));
    }
    // A sphere with 12 neighbours at contact radius R/2: stiffness 2 E* a each, E* = E/(2 (1 − ν²)).
    double contact = 12.0 * t.sphere_young.value / (1.0 - t.sphere_poisson.value * t.sphere_poisson.value) * 0.5 * radius;
    contact += packing_stiffness(t, radius);
    if (contact > 0.0) limit = std::min(limit, 2.0 * friction * 4.0 * std::numbers::pi * radius * radius / contact);
  }
  return limit;
}

void check_whole(BuildContext& c) {
  check_names(c);
  check_contact_ranges(c);
  check_friction(c);
  check_periodic_size(c);
  check_periodic_obstacles(c);
  check_nuclei(c);
  check_resolution(c);
  check_bodies(c);
  if (c.diagnostics.has_errors()) return;
  check_rules(c);
  check_unused(c);
}

}  // namespace morula::scenarios
