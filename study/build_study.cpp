#include <algorithm>
#include <cmath>

#include "coupling/changing_box.h"
#include "coupling/mechanics/contact_setup.h"
#include "coupling/regions/counts_from.h"
#include "study/build.h"
#include "study/read_section.h"

namespace morula::scenarios {
namespace {

/// Depth of a capped start that no cell type's mesh folds under [µm]. The traction p = k_r δ on a patch of one edge L pushes with p L²; over its rim the
/// tension and the stiffness in the plane S hold it with S L. Cells 4 µm deep in each other come out unfolded up to p L/S = 28 and, with some meshes,
/// 60; 10 leaves room for finer meshes and more neighbours (decision 0029).
double gentle_cap(const BuildContext& c) {
  constexpr double kGentle = 10.0, kMost = 0.1;  // µm, the overlap at which the capped start ends
  double cap = kMost;
  for (std::size_t i = 0; i < c.draft.cell_types.size() && i < c.study.model.types.size(); ++i) {
    const draft::CellType& t = c.draft.cell_types[i].content;
    const dcm::ShellParameters& p = c.study.model.types[i].shell;
    const double held = p.tension + p.shape_stiffness + p.spring_stiffness + dcm::sheet_strengths(p);
    const double edge = mean_edge(t.nodes.value) * t.radius.mean.value;
    if (edge > 0.0 && held > 0.0) cap = std::min(cap, kGentle * held / (edge * usual_repulsion(c.draft)));
  }
  return cap;
}

/// The course of the box; E518 where something keeps the box from changing.
void build_box_course(BuildContext& c) {
  const draft::Domain& d = c.draft.domain;
  if (d.course.empty()) return;
  const Place& place = d.course.front().place;
  const auto refuse = [&](const Place& where, const std::string& why, const std::string& help) {
    c.diagnostics.error(518, where, why, help);
  };
  if (!periodic_along_all_axes(c.study.model.space))
    refuse(place, "the box has a course, but is not periodic along x, y and z", "write `boundary: periodic`, or move obstacles");
  for (const auto& field : c.draft.fields)
    refuse(field.place, "the box has a course, and the voxels of the field '" + field.name + "' would not follow it",
           "leave the field out, or the course of the `domain`");
  for (const auto& obstacle : c.draft.geometry)
    refuse(obstacle.place, "the box has a course, and the obstacle '" + obstacle.name + "' would not follow it",
           "leave the obstacle out, or the course of the `domain`");
  c.study.model.box_volume = build_course(c, d.course);
  const Given<double>& first = d.course.front().content.value;
  if (first.known() && first.value != 1.0)
    refuse(first.place, "the course of the box begins with " + first.text + " of the volume that `size` says",
           "begin with `volume: 1`, and make `size` the box of time 0");
}

/// Of the lists of contacts where the study says none [µm]: spheres alone are so few in a micrometre more of reach that lists are better made less often (measured,
/// decision 0063).
double skin_of(const BuildContext& c) {
  constexpr double kMostOfSpheres = 1.0, kOfRadius = 0.2;
  const double usual = ContactNumerics().skin;
  if (may_have_shells(c)) return usual;
  double largest = 0.0;
  for (const auto& type : c.draft.cell_types) largest = std::max(largest, type.content.radius.mean.value);
  return std::clamp(kOfRadius * largest, usual, kMostOfSpheres);
}

}  // namespace

void build_time_and_numerics(BuildContext& c) {
  const draft::Time& time = c.draft.time;
  c.study.time = {time.end.value, time.output.value, time.checkpoint.value, c.draft.numerics.start_cap_within.value, time.rest.value};
  const auto check_interval = [&](const Given<double>& interval, const char* what) {
    if (interval.is_changed() && interval.known() && time.end.known() && interval.value > time.end.value)
      c.diagnostics.warning(508, interval.place,
                            std::string("the ") + what + " interval (" + interval.text + ") is longer than the run (" + time.end.text + ")",
                            std::string("make `") + what + "` at most `end`");
  };
  check_interval(time.output, "output");
  check_interval(time.checkpoint, "checkpoint");

  draft::Numerics& n = c.draft.numerics;
  StepControl& step = c.study.model.step;
  step.integrator = time.integrator.value == "explicit_euler" ? Integrator::kExplicitEuler : Integrator::kImplicit;
  step.initial_step = n.initial_step.value;
  n.step.write_to(step);
  step.max_newton = static_cast<int>(n.newton.value);
  step.start_cap = n.start_cap.value >= 0.0 ? n.start_cap.value : gentle_cap(c);
  constexpr double kMaxStep = 60.0;            // growing clusters of shells: the error at 60 s is below that of the mesh (measured)
  constexpr double kMaxStepOfSpheres = 120.0;  // growing spheres: the error at 120 s is below what single cells scatter (decision 0063)
  const double implicit_max_step = may_have_shells(c) ? kMaxStep : kMaxStepOfSpheres;
  step.max_step = time.step.value > 0.0 ? time.step.value : implicit_max_step;
  if (step.integrator == Integrator::kExplicitEuler) {
    const double limit = explicit_step_limit(c);
    if (time.step.value == 0.0) step.max_step = std::min(implicit_max_step, 0.5 * limit);
    if (time.step.known() && time.step.value > limit)
      c.diagnostics.error(
          507, time.step.place,
          "explicit Euler is unstable with a step of " + time.step.text + ": the limit is near " + short_number(limit) + " s",
          "use `step: auto`, a smaller step, or `integrator: implicit`");
  }
  if (step.initial_step > step.max_step) {
    if (n.initial_step.given && n.initial_step.known() && time.step.value > 0.0)
      c.diagnostics.warning(510, n.initial_step.place, "the first step (" + n.initial_step.text + ") is larger than the largest step",
                            "make `numerics.initial_step` at most `time.step`");
    if (!n.initial_step.given) n.initial_step.text.clear();  // no part of the resolved study, which says nothing that is not so
    step.initial_step = step.max_step;
  }
  ContactNumerics& contact = c.study.model.contact;
  contact = {c.draft.contact.range.value, usual_repulsion(c.draft), static_cast<int>(c.draft.contact.points.value),
             n.skin.value > 0.0 ? n.skin.value : skin_of(c), c.draft.contact.friction.value == "objective"};
  const draft::Limits& limits = c.draft.limits;
  limits.plain.write_to(c.study.model.limits);
  c.study.model.limits.overlap = limits.overlap.value;
  c.study.model.seed = static_cast<std::uint32_t>(c.draft.seed.value);
}

namespace {

/// Whether something acts on cells that is no cell, and whose forces somebody may want to know.
bool is_acted_on_from_outside(const Model& model) {
  const auto is_active = [](const CellType& type) { return type.migration.speed > 0.0 || type.protrusion.force > 0.0; };
  return contact_obstacle_count(model) > 0 || !model.loads.empty() || !model.apical_springs.empty() || !model.box_volume.empty() ||
         std::ranges::any_of(model.types, is_active);
}

}  // namespace

void build_tolerance(BuildContext& c) {
  constexpr double kOfOutside = 0.01, kOfCells = 0.02, kOfFluctuations = 1e-4;
  Model& model = c.study.model;
  const double given = c.draft.numerics.tolerance.value;
  double& tolerance = model.step.first_tolerance;
  tolerance = given > 0.0 ? given : is_acted_on_from_outside(model) ? kOfOutside : kOfCells;
  // The rigid motion of a cell is what the linear solver resolves last; with random forces nothing makes up for what it leaves.
  if (std::ranges::any_of(model.types, [](const CellType& type) { return type.fluctuations.energy > 0.0; }))
    tolerance = std::min(tolerance, kOfFluctuations);
}

void build_domain(BuildContext& c) {
  const draft::Domain& d = c.draft.domain;
  Space& space = c.study.model.space;
  space.box = {d.center.value - d.size.value * 0.5, d.center.value + d.size.value * 0.5};
  const auto kind = [](const std::string& word) {
    return word == "periodic" ? BoundaryKind::kPeriodic : word == "wall" ? BoundaryKind::kWall : BoundaryKind::kOpen;
  };
  const draft::DomainBoundary& b = d.boundary;
  const Given<std::string>* axes[3] = {&b.x, &b.y, &b.z};
  const Given<std::string>* faces[3][2] = {{&b.x_low, &b.x_high}, {&b.y_low, &b.y_high}, {&b.z_low, &b.z_high}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t side = 0; side < 2; ++side) {
      const Given<std::string>& word = faces[axis][side]->known() ? *faces[axis][side] : axes[axis]->known() ? *axes[axis] : b.all;
      space.boundary[axis][side] = kind(word.value);
    }
    const bool low = space.boundary[axis][0] == BoundaryKind::kPeriodic, high = space.boundary[axis][1] == BoundaryKind::kPeriodic;
    if (low != high) {
      const char name[2] = {"xyz"[axis], 0};
      const Given<std::string>& at = faces[axis][low ? 0 : 1]->known() ? *faces[axis][low ? 0 : 1] : *faces[axis][low ? 1 : 0];
      c.diagnostics.error(510, at.place, std::string("only one of the faces across ") + name + " is periodic",
                          std::string("write `") + name + ": periodic`");
    }
  }
  build_box_course(c);
}

namespace {

/// Number of the one with this name among sections of the study, or −1 and an error with suggestions.
template <class T>
int find_named(BuildContext& c, int code, const char* what, const std::vector<Named<T>>& all, const char* section, const std::string& name,
               const Place& place) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].name == name) return static_cast<int>(i);
    names.push_back(all[i].name);
  }
  c.diagnostics.error(code, place, std::string("there is no ") + what + " '" + name + "'",
                      names.empty() ? std::string("declare it under `") + section + "`" : suggest(name, names));
  return -1;
}

}  // namespace

int find_type(BuildContext& c, const std::string& name, const Place& place) {
  return find_named(c, 401, "cell type", c.draft.cell_types, "cell_types", name, place);
}

int find_field(BuildContext& c, const std::string& name, const Place& place) {
  return find_named(c, 402, "field", c.draft.fields, "fields", name, place);
}

int find_obstacle(BuildContext& c, const std::string& name, const Place& place) {
  return find_named(c, 401, "obstacle", c.draft.geometry, "geometry", name, place);
}

int find_cells(BuildContext& c, const std::string& name, const Place& place) {
  const Model& model = c.study.model;
  if (counts_from(model, model.swaps.regions, name)) return 0;
  std::vector<std::string> names;
  for (const Region& region : model.swaps.regions) names.push_back(region.name);
  for (const CellType& type : model.types) names.push_back(type.name);
  for (const ObstacleSpec& obstacle : model.obstacles) names.push_back(obstacle.name);
  c.diagnostics.error(401, place, "there is no region before this one, cell type or obstacle '" + name + "'", suggest(name, names));
  return -1;
}

std::string add_input_file(BuildContext& c, Given<std::string>& written) {
  namespace fs = std::filesystem;
  fs::path path(written.value);
  if (path.is_relative()) path = c.folder / path;
  std::error_code ignored;
  const std::string absolute = fs::absolute(path, ignored).lexically_normal().string();
  for (const InputFile& file : c.study.input_files)
    if (file.path == absolute) {
      written.text = file.copy;
      return absolute;
    }
  const std::string stem = fs::path(absolute).stem().string(), extension = fs::path(absolute).extension().string();
  std::string copy = "inputs/" + stem + extension;
  const auto taken = [&](const std::string& name) {
    return std::any_of(c.study.input_files.begin(), c.study.input_files.end(), [&](const InputFile& f) { return f.copy == name; });
  };
  for (int i = 2; taken(copy); ++i) copy = "inputs/" + stem + "-" + std::to_string(i) + extension;
  c.study.input_files.push_back({absolute, copy});
  written.text = copy;
  return absolute;
}

}  // namespace morula::scenarios
