#include "study/declare.h"

namespace morula::scenarios {
namespace {

using Q = Quantity;

void declare_time(Section& s, draft::Time& time) {
  s.quantity({.name = "end",
              .doc = "Simulated time at which the run ends.",
              .quantity = Q::kTime,
              .required = true,
              .low = 0.0,
              .low_open = true,
              .example = "24 h"},
             time.end);
  s.quantity(
      {.name = "step",
       .doc = "Largest step of the simulation; `auto`: 60 s with the implicit integrator (120 s where no cell can be a shell), half of the "
              "stability limit "
              "with explicit Euler. The step itself follows from `numerics.max_displacement`.",
       .quantity = Q::kTime,
       .fallback = "auto",
       .low = 0.0,
       .low_open = true,
       .specials = {{"auto", 0.0}},
       .example = "60 s",
       .source = "measured: growing clusters against small steps"},
      time.step);
  s.quantity(
      {.name = "output",
       .doc = "Time between entries of the series and between snapshots. Steps land on these times, so that what is written is the state "
              "itself and not a value between two: like a limit of the step, and by no more than half the step would, the interval changes "
              "results. Keep it where runs are compared.",
       .quantity = Q::kTime,
       .fallback = "1 h",
       .low = 0.0,
       .low_open = true,
       .example = "30 min",
       .source = "chosen"},
      time.output);
  s.quantity({.name = "checkpoint",
              .doc = "Time between checkpoints; written at the first output time at which one is due.",
              .quantity = Q::kTime,
              .fallback = "6 h",
              .low = 0.0,
              .low_open = true,
              .example = "6 h",
              .source = "chosen"},
             time.checkpoint);
  s.quantity(
      {.name = "rest",
       .doc = "The run ends at the first output at which no point moves faster than this and nothing will still happen by itself "
              "(inflation, growth, dying cells, courses over time, exchanges of bodies that wait, fields that cells answer to); 0: only "
              "at `end`.",
       .quantity = Q::kSpeed,
       .fallback = "0 um/s",
       .low = 0.0,
       .example = "1e-5 um/s",
       .source = "chosen"},
      time.rest);
  s.word({.name = "integrator",
          .doc = "Implicit step (Newton on the incremental energy) or explicit Euler, which needs steps near 0.1 s.",
          .fallback = "implicit",
          .words = {"implicit", "explicit_euler"},
          .example = "implicit",
          .source = "chosen"},
         time.integrator);
}

void declare_numerics(Section& s, draft::Numerics& n) {
  s.whole({.name = "newton",
           .doc = "Newton iterations of a step, at most.",
           .fallback = "3",
           .low = 1,
           .high = 50,
           .example = "3",
           .source = "measured: clusters of shells need 1.9 on average"},
          n.newton);
  s.quantity({.name = "newton_stop",
              .doc = "Newton stops when the residual is below this part of the force; or below 2.5 times as much, where another iteration "
                     "would move points by less than 0.15 times this number in units of the contact range.",
              .fallback = "0.2",
              .low = 0.0,
              .high = 1.0,
              .low_open = true,
              .example = "0.2",
              .source = "measured"},
             n.step, &StepControl::newton_stop);
  s.quantity(
      {.name = "obstacle_stop",
       .doc = "While obstacles, grips or traps move, Newton goes on until the residual of the cells that they touch or hold is below this "
              "part of the forces there, for up to twelve iterations, or `newton` where that is more: these forces are read. 1: it does "
              "not.",
       .fallback = "0.01",
       .low = 0.0,
       .high = 1.0,
       .low_open = true,
       .example = "0.01",
       .source = "measured: plates and traps that go and come back (decisions 0082, 0094)"},
      n.step, &StepControl::obstacle_stop);
  s.quantity(
      {.name = "tolerance",
       .doc =
           "Relative residual of the first linear solve of a step. `auto`: 0.02 where cells are left to themselves, 0.01 where something "
           "from outside acts on them (obstacles, walls, loads, a box that changes, migration, protrusions), so that forces on it "
           "can be read. With `fluctuations` 1e-4 at most.",
       .fallback = "auto",
       .low = 0.0,
       .high = 0.5,
       .low_open = true,
       .specials = {{"auto", 0.0}},
       .example = "0.01",
       .source = "measured: growing clusters, and cells between plates"},
      n.tolerance);
  s.quantity({.name = "later_tolerance",
              .doc = "Relative residual of the later linear solves of a step.",
              .fallback = "0.1",
              .low = 0.0,
              .high = 0.5,
              .low_open = true,
              .example = "0.1",
              .source = "measured"},
             n.step, &StepControl::later_tolerance);
  s.quantity({.name = "max_displacement",
              .doc = "Allowed displacement of a cell in one step, in units of the contact range. Single points of a shell may go three "
                     "times as far, up to the range, and single spheres twice as far as points. What a thousand spheres and more do in "
                     "common, in open space and without obstacles, does not count.",
              .fallback = "0.3",
              .low = 0.0,
              .high = 2.0,
              .low_open = true,
              .example = "0.3",
              .source = "measured"},
             n.step, &StepControl::max_displacement);
  s.quantity({.name = "initial_step",
              .doc = "First step of the run.",
              .quantity = Q::kTime,
              .fallback = "1 s",
              .low = 0.0,
              .low_open = true,
              .example = "1 s",
              .source = "chosen"},
             n.initial_step);
  s.quantity({.name = "skin",
              .doc = "Extra distance of the candidate lists of contacts; changes speed, not results. `auto`: 0.5 um, and a fifth of the "
                     "largest radius, up to 1 um, "
                     "where no cell can be a shell.",
              .quantity = Q::kLength,
              .fallback = "auto",
              .low = 0.0,
              .low_open = true,
              .specials = {{"auto", 0.0}},
              .example = "0.5 um",
              .source = "measured"},
             n.skin);
  s.quantity(
      {.name = "start_cap",
       .doc = "Start from overlapping shells: the contact traction is held at that of this depth until the overlap is "
              "below 0.1 um. Too large a traction folds soft meshes; `auto` takes one that the softest cell type's tension and stiffness "
              "bear: cells 4 um deep in each other take some minutes to come out. 0: no cap. The check INV.4 counts the start too: "
              "`limits.overlap` must allow for it.",
       .quantity = Q::kLength,
       .fallback = "0 um",
       .low = 0.0,
       .high = 1.0,
       .specials = {{"auto", -1.0}},
       .example = "auto",
       .source = "chosen; `auto` measured: traction times edge over tension and stiffness is 10, meshes fold beyond 28"},
      n.start_cap);
  s.quantity({.name = "start_cap_within",
              .doc = "A capped start that has not ended by this time stops the run: some cells have no way out of each other.",
              .quantity = Q::kTime,
              .fallback = "30 min",
              .low = 0.0,
              .low_open = true,
              .example = "30 min",
              .source = "chosen: cells that start half a radius deep come apart within minutes"},
             n.start_cap_within);
}

void declare_volume_point(Section& s, draft::CoursePoint& point) {
  s.quantity({.name = "time", .doc = "When.", .quantity = Q::kTime, .required = true, .low = 0.0, .example = "10 s"}, point.time);
  s.quantity({.name = "volume",
              .doc = "Volume of the box at that time, in parts of the volume that `size` says.",
              .quantity = Q::kFraction,
              .required = true,
              .low = 0.3,
              .high = 3.0,
              .example = "0.85"},
             point.value);
}

void declare_domain(Section& s, draft::Domain& domain) {
  s.vector({.name = "size",
            .doc = "Edges of the box in which cells and fields live.",
            .quantity = Q::kLength,
            .required = true,
            .low = 0.0,
            .low_open = true,
            .example = "[400 um, 400 um, 400 um]"},
           domain.size);
  s.vector({.name = "center",
            .doc = "Centre of the box.",
            .quantity = Q::kLength,
            .fallback = "[0 um, 0 um, 0 um]",
            .example = "[0 um, 0 um, 0 um]",
            .source = "chosen"},
           domain.center);
  bool present = false;
  s.group({.name = "boundary",
           .doc = "What happens to cells at the faces of the box: one word for all, or words by axis or face.",
           .shorthand = "all",
           .example = "open"},
          present, [&domain](Section& b) {
            const auto face = [&b](const char* name, const char* doc, Given<std::string>& value, const char* fallback = nullptr) {
              b.word({.name = name,
                      .doc = doc,
                      .fallback = fallback,
                      .words = {"open", "wall", "periodic"},
                      .example = "wall",
                      .source = fallback ? "chosen" : ""},
                     value);
            };
            draft::DomainBoundary& d = domain.boundary;
            face("all", "All faces: open, a rigid wall without friction or adhesion (a `plane` of `geometry` has both), or periodic.",
                 d.all, "open");
            face("x", "Both faces across x.", d.x);
            face("y", "Both faces across y.", d.y);
            face("z", "Both faces across z.", d.z);
            face("x_low", "The face at the low end of x.", d.x_low);
            face("x_high", "The face at the high end of x.", d.x_high);
            face("y_low", "The face at the low end of y.", d.y_low);
            face("y_high", "The face at the high end of y.", d.y_high);
            face("z_low", "The face at the low end of z: a floor.", d.z_low);
            face("z_high", "The face at the high end of z.", d.z_high);
          });
  s.list(
      {.name = "course",
       .doc =
           "Volume of a box that is periodic along x, y and z over time: straight lines between these points, constant after the last. It "
           "begins with 1. The edges keep their ratios and the centre stays; all places go along with the box, and cells then find their "
           "shape. Steps land on the points.",
       .not_empty = true,
       .example = "[{time: 0 s, volume: 1}, {time: 1 h, volume: 0.85}]"},
      domain.course, &declare_volume_point);
}

void declare_output(Section& s, draft::Output& output) {
  s.words({.name = "series",
           .doc = "Observables in series.csv; an empty list: all of them.",
           .fallback = "[]",
           .example = "[cell_count, volume_error]",
           .source = "chosen"},
          output.series);
  s.words({.name = "formats",
           .doc = "Files beside the run's own: hdf5 is always written.",
           .fallback = "[hdf5]",
           .words = {"hdf5", "vtk"},
           .example = "[hdf5, vtk]",
           .source = "chosen"},
          output.formats);
  s.flag({.name = "report", .doc = "Write plots and report.html at the end.", .fallback = "true", .example = "true", .source = "chosen"},
         output.report);
}

void declare_limits(Section& s, draft::Limits& limits) {
  s.quantity({.name = "volume_error",
              .doc = "Largest relative difference of a shell's volume from its pressure law.",
              .quantity = Q::kFraction,
              .fallback = "2 %",
              .low = 0.0,
              .high = 1.0,
              .low_open = true,
              .example = "2 %",
              .source = "chosen"},
             limits.plain, &Limits::volume_error);
  s.quantity({.name = "overlap",
              .doc = "Deepest penetration between shells, of a shell and an obstacle, or of a nucleus and the cortex around it.",
              .quantity = Q::kLength,
              .fallback = "0.3 um",
              .low = 0.0,
              .low_open = true,
              .example = "0.3 um",
              .source = "chosen: a sixth of the mean edge at 162 nodes"},
             limits.overlap);
  s.quantity({.name = "field_balance",
              .doc = "Relative error of the balance of amounts of each field.",
              .fallback = "1e-6",
              .low = 0.0,
              .high = 1.0,
              .low_open = true,
              .example = "1e-6",
              .source = "chosen"},
             limits.plain, &Limits::field_balance);
}

}  // namespace

void declare_study(Section& s, draft::Study& study) {
  bool present = false;
  s.whole({.name = "schema", .doc = "Version of this file format.", .required = true, .low = 1, .high = 1, .example = "1"}, study.schema);
  s.text(
      {.name = "study",
       .doc = "Name of the study: a letter, then letters, digits, `_` and `-`, at most 64 characters. The run's folder is named after it.",
       .required = true,
       .example = "spheroid_core"},
      study.name);
  s.text(
      {.name = "title", .doc = "One line for people; shown in the report.", .fallback = "", .example = "Spheroid with a deformable core"},
      study.title);
  s.text(
      {.name = "scenario", .doc = "Library study that it was made from: told in its report.", .fallback = "", .example = "hybrid_spheroid"},
      study.scenario);
  s.list({.name = "criteria",
          .doc = "What the run is judged on at its end. One that finds nothing in the results has failed.",
          .example = "[{id: SIZE, measure: cell_count, above: 100}]"},
         study.criteria, &declare_criterion);
  s.list({.name = "plots",
          .doc = "Plots of measures, beside those that every run gets.",
          .example = "[{name: force_way, x: way(pull), y: force(pull)}]"},
         study.plots, &declare_study_plot);
  s.whole({.name = "seed",
           .doc = "Seed of all random numbers; the same seed gives the same bits.",
           .fallback = "1",
           .low = 0,
           .high = 4294967295.0,
           .example = "20261121",
           .source = "chosen"},
          study.seed);
  s.group({.name = "time", .doc = "How long, and how often something is written.", .required = true}, present,
          [&](Section& t) { declare_time(t, study.time); });
  s.group({.name = "numerics", .doc = "Settings of the solver; the defaults are measured and rarely need a change."}, present,
          [&](Section& n) { declare_numerics(n, study.numerics); });
  s.group({.name = "domain", .doc = "The box in which everything happens.", .required = true}, present,
          [&](Section& d) { declare_domain(d, study.domain); });
  s.named({.name = "cell_types", .doc = "The kinds of cells, by name.", .required = true}, study.cell_types, &declare_cell_type);
  s.group({.name = "contact", .doc = "The law between all surfaces in contact."}, present,
          [&](Section& c) { declare_contact(c, study.contact); });
  s.named({.name = "geometry", .doc = "Rigid obstacles, by name."}, study.geometry, &declare_obstacle);
  s.list({.name = "initial", .doc = "The cells at time 0.", .required = true}, study.initial, &declare_initial);
  s.named({.name = "loads", .doc = "Forces from outside on the cells of a type, by name."}, study.loads, &declare_load);
  s.named({.name = "marks", .doc = "Marks of faces, by name; any number of them. Regions of tension, cavities and springs refer to them."},
          study.marks, &declare_mark);
  s.named({.name = "lumens", .doc = "Cavities between shells whose fluid presses on the faces around it, by name."}, study.lumens,
          &declare_lumen);
  s.named({.name = "apical", .doc = "Springs that hold marked faces near their mean sphere, by name."}, study.apical,
          &declare_apical_spring);
  s.named({.name = "fields", .doc = "Diffusing concentrations, by name; any number of them. Obstacles do not hold them up."}, study.fields,
          &declare_field);
  s.group({.name = "coupling", .doc = "Which cells are spheres and which are shells, and when that changes."}, present,
          [&](Section& c) { declare_coupling(c, study.coupling); });
  s.group({.name = "output", .doc = "What a run writes."}, present, [&](Section& o) { declare_output(o, study.output); });
  s.group({.name = "limits", .doc = "Limits that stop a run, looked at at each output."}, present,
          [&](Section& l) { declare_limits(l, study.limits); });
}

}  // namespace morula::scenarios
