#include <numbers>

#include "study/declare.h"

namespace morula::scenarios {
namespace {

using Q = Quantity;

void declare_factor_point(Section& s, draft::CoursePoint& point) {
  s.quantity({.name = "time", .doc = "When.", .quantity = Q::kTime, .required = true, .low = 0.0, .example = "10 s"}, point.time);
  s.quantity({.name = "factor", .doc = "Part of the full value at that time.", .required = true, .low = 0.0, .high = 1e6, .example = "1"},
             point.value);
}

void course(Section& s, std::vector<Named<draft::CoursePoint>>& points, const char* doc) {
  s.list({.name = "course", .doc = doc, .not_empty = true, .example = "[{time: 0 s, factor: 0}, {time: 1 min, factor: 1}]"}, points,
         &declare_factor_point);
}

void declare_tension_region(Section& s, draft::TensionRegion& r) {
  s.quantity({.name = "tension",
              .doc = "Tension of the faces with this mark, in place of the cell's own.",
              .quantity = Q::kTension,
              .required = true,
              .low = 0.0,
              .high = 100.0,
              .example = "0.4 mN/m"},
             r.tension);
  course(s, r.course,
         "The tension over time, as parts of it: straight lines between these points, constant outside. Steps land on the points.");
  s.quantity({.name = "amplitude",
              .doc = "Of a modulation 1 + amplitude sin(2 pi t/period + phase).",
              .quantity = Q::kFraction,
              .fallback = "0 %",
              .low = 0.0,
              .high = 1.0,
              .example = "30 %",
              .source = "chosen: off"},
             r.amplitude);
  s.quantity({.name = "period",
              .doc = "Of the modulation; steps are at most a twentieth of it. `never`: no modulation.",
              .quantity = Q::kTime,
              .fallback = "never",
              .low = 0.0,
              .low_open = true,
              .specials = {{"never", 0.0}},
              .example = "80 s",
              .source = "chosen: off"},
             r.period);
  s.quantity({.name = "phase",
              .doc = "Of the modulation at time 0.",
              .quantity = Q::kAngle,
              .fallback = "0 rad",
              .low = -100.0,
              .high = 100.0,
              .example = "90 deg",
              .source = "chosen"},
             r.plain, &TensionRegion::phase);
}

void axis_key(Section& s, Given<Vec3d>& value, const char* doc) {
  s.vector({.name = "axis", .doc = doc, .fallback = "[0, 0, 1]", .example = "[0, 0, 1]", .source = "chosen"}, value);
}

void center_key(Section& s, Given<Vec3d>& value, const char* doc) {
  s.vector({.name = "center", .doc = doc, .quantity = Q::kLength, .required = true, .example = "[0 um, 0 um, 10 um]"}, value);
}

}  // namespace

void declare_tension_regions(Section& s, draft::CellType& t) {
  s.named(
      {.name = "regions",
       .doc = "Tension by part of the surface: names of `marks`, `lateral` (what is in contact with other cells) or `whole`. Of the marks "
              "that a face carries the first listed here holds; contact goes from that tension to the lateral one. In a cortex that is not "
              "elastic "
              "and has no marks here, surfaces adhere by the difference: cos of the contact angle is (lateral - W/2)/tension. An elastic "
              "cortex bears it, and its angle "
              "hardly changes."},
      t.tension_regions, &declare_tension_region);
  s.quantity(
      {.name = "lateral_easing",
       .doc =
           "Time in which a face that comes into contact takes the `lateral` tension (and gives it up again). Where surfaces adhere by the "
           "difference they do so at once.",
       .quantity = Q::kTime,
       .fallback = "60 s",
       .low = 0.0,
       .low_open = true,
       .example = "60 s",
       .source = "chosen: cortical turnover takes about a minute"},
      t.lateral_easing);
}

void declare_mark(Section& s, draft::Mark& m) {
  s.words({.name = "types", .doc = "Cell types whose shells carry the mark.", .required = true, .example = "[TE]"}, m.types);
  s.group({.name = "cone",
           .doc = "Faces whose direction from the cell's centre makes less than `angle` with an axis.",
           .optional_section = true,
           .example = "{axis: [0, 0, 1], angle: 60 deg}"},
          m.cone, [&m](Section& c) {
            c.vector({.name = "axis", .doc = "The axis, in the laboratory; or give `toward` or `polarity`.", .example = "[0, 0, 1]"},
                     m.cone_axis);
            c.vector({.name = "toward",
                      .doc = "In place of `axis`: the point that the axis points to, such as the middle of a cavity.",
                      .quantity = Q::kLength,
                      .example = "[0 um, 0 um, 0 um]"},
                     m.cone_toward);
            c.flag({.name = "polarity",
                    .doc = "In place of `axis`: the cell's polarity.",
                    .fallback = "false",
                    .example = "true",
                    .source = "chosen"},
                   m.cone_polarity);
            c.quantity({.name = "angle",
                        .doc = "Half angle of the cone.",
                        .quantity = Q::kAngle,
                        .required = true,
                        .low = 0.0,
                        .high = std::numbers::pi,
                        .low_open = true,
                        .example = "60 deg"},
                       m.angle);
          });
  s.group({.name = "band",
           .doc = "A ring: faces near the plane through the cell's centre across an axis.",
           .optional_section = true,
           .example = "{axis: [0, 0, 1], half_width: 1 um}"},
          m.band, [&m](Section& b) {
            axis_key(b, m.band_axis, "Across the plane.");
            b.quantity({.name = "half_width",
                        .doc = "Largest distance of a face's centre from the plane.",
                        .quantity = Q::kLength,
                        .required = true,
                        .low = 0.0,
                        .low_open = true,
                        .example = "1 um"},
                       m.half_width);
          });
  s.group({.name = "ball",
           .doc = "Faces in a ball of the laboratory.",
           .optional_section = true,
           .example = "{center: [0 um, 0 um, 0 um], radius: 20 um}"},
          m.ball, [&m](Section& b) {
            center_key(b, m.ball_center, "Centre of the ball.");
            b.quantity({.name = "radius",
                        .doc = "Of the ball.",
                        .quantity = Q::kLength,
                        .required = true,
                        .low = 0.0,
                        .low_open = true,
                        .example = "20 um"},
                       m.ball_radius);
          });
  s.group({.name = "box",
           .doc = "Faces in a box of the laboratory.",
           .optional_section = true,
           .example = "{center: [0 um, 0 um, 0 um], size: [20 um, 20 um, 5 um]}"},
          m.box, [&m](Section& b) {
            center_key(b, m.box_center, "Centre of the box.");
            b.vector({.name = "size",
                      .doc = "Edges.",
                      .quantity = Q::kLength,
                      .required = true,
                      .low = 0.0,
                      .low_open = true,
                      .example = "[20 um, 20 um, 5 um]"},
                     m.box_size);
          });
  s.group({.name = "touched_by",
           .doc = "Faces in contact with a cell type or obstacle.",
           .optional_section = true,
           .shorthand = "material",
           .example = "{material: plane, keep: true}"},
          m.touched, [&m](Section& t) {
            t.text({.name = "material", .doc = "The cell type or obstacle.", .required = true, .example = "plane"}, m.material);
            t.flag(
                {.name = "keep", .doc = "What was touched once stays marked.", .fallback = "false", .example = "true", .source = "chosen"},
                m.keep);
          });
  s.word({.name = "when",
          .doc = "start: given once, when the shell comes to be, and kept as it deforms; always: follows the cell from step to step. Marks "
                 "by touch always follow.",
          .fallback = "start",
          .words = {"start", "always"},
          .example = "start",
          .source = "chosen"},
         m.when);
}

void declare_lumen(Section& s, draft::Lumen& l) {
  center_key(s, l.center,
             "A point within the cavity. What can be seen from it bounds the cavity: faces of shells, spheres, obstacles. A cell that lies "
             "over it is left out. A cell that floats in the fluid is pushed from the side of this point alone.");
  s.text({.name = "faces",
          .doc = "seen: faces of shells in sight of `center`, found anew every now and then; or the name of a mark.",
          .fallback = "seen",
          .example = "apical",
          .source = "chosen"},
         l.faces);
  s.quantity({.name = "reach",
              .doc = "How far one sees from `center`.",
              .quantity = Q::kLength,
              .fallback = "100 um",
              .low = 0.0,
              .high = 1e5,
              .low_open = true,
              .example = "60 um",
              .source = "chosen"},
             l.plain, &Lumen::reach);
  s.quantity(
      {.name = "renewed",
       .doc = "Time after which the faces in sight are found anew; sooner where they leave open a twentieth of the walls that were seen.",
       .quantity = Q::kTime,
       .fallback = "5 min",
       .low = 0.0,
       .low_open = true,
       .example = "5 min",
       .source = "chosen"},
      l.plain, &Lumen::renewed);
  s.quantity({.name = "from",
              .doc = "Time from which the cavity is looked at.",
              .quantity = Q::kTime,
              .fallback = "0 s",
              .low = 0.0,
              .example = "30 min",
              .source = "chosen"},
             l.plain, &Lumen::from);
  s.quantity({.name = "pressure",
              .doc = "Pressure of the fluid above that of the medium; with `solute: kept`, that at the volume at which the cavity is first "
                     "seen. It is there as if holes were closed, until half of all directions are open; a run warns from a twentieth on.",
              .quantity = Q::kPressure,
              .required = true,
              .low = -100.0,
              .high = 100.0,
              .example = "20 Pa"},
             l.pressure);
  s.word(
      {.name = "solute",
       .doc = "free: the pressure is as given, whatever the volume (such a cavity may grow without end); kept: P = R T n/V with the amount "
              "n of the beginning, of solute beyond what the medium has: the cavity gives way like a gas of this pressure.",
       .fallback = "free",
       .words = {"free", "kept"},
       .example = "kept",
       .source = "chosen"},
      l.solute);
  course(s, l.course,
         "Factor of the pressure (of the amount of solute) over time: straight lines between these points, constant outside. Steps land on "
         "the "
         "points.");
}

void declare_apical_spring(Section& s, draft::ApicalSpring& a) {
  s.text({.name = "mark", .doc = "Mark of the faces that are held.", .required = true, .example = "apical"}, a.mark);
  s.quantity({.name = "stiffness",
              .doc = "k per marked area: restoring force per distance from the mean sphere of the marked faces.",
              .quantity = Q::kPressurePerLength,
              .required = true,
              .low = 0.0,
              .high = 1e4,
              .example = "10 Pa/um"},
             a.plain, &ApicalSpring::stiffness);
  s.quantity({.name = "friction",
              .doc = "mu per marked area: friction of marked faces against the common translation, rotation and growth of all of them.",
              .quantity = Q::kFrictionPerArea,
              .fallback = "0 N s/m^3",
              .low = 0.0,
              .high = 1e6,
              .example = "1e8 N s/m^3",
              .source = "chosen: off"},
             a.plain, &ApicalSpring::friction);
}

}  // namespace morula::scenarios
