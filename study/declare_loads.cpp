#include "study/declare.h"

namespace morula::scenarios {
namespace {

using Q = Quantity;

void axis(Section& s, Given<Vec3d>& value, const char* doc) {
  s.vector({.name = "axis", .doc = doc, .fallback = "[1, 0, 0]", .example = "[1, 0, 0]", .source = "chosen"}, value);
}

void part(Section& s, draft::LoadEnds& e, const char* fallback, const char* doc) {
  s.quantity({.name = "part",
              .doc = doc,
              .quantity = Q::kFraction,
              .fallback = fallback,
              .low = 0.0,
              .high = 1.0,
              .low_open = true,
              .example = "2 %",
              .source = "chosen"},
             e.part);
}

void ends(Section& s, draft::LoadEnds& e, const char* fallback, const char* doc) {
  part(s, e, fallback, doc);
  s.word({.name = "ends",
          .doc = "The nodes of the undeformed cell with the largest coordinate along the axis (`high`), the smallest (`low`), or both.",
          .fallback = "both",
          .words = {"both", "high", "low"},
          .example = "both",
          .source = "chosen"},
         e.ends);
}

void declare_distance_point(Section& s, draft::CoursePoint& point) {
  s.quantity({.name = "time", .doc = "When.", .quantity = Q::kTime, .required = true, .low = 0.0, .example = "10 s"}, point.time);
  s.quantity(
      {.name = "distance", .doc = "How far it is then from where it began.", .quantity = Q::kLength, .required = true, .example = "2 um"},
      point.value);
}

void declare_within(Section& s, draft::Shape& shape) {
  const auto end = [&s](const char* name, const char* doc, Given<Vec3d>& value) {
    s.vector({.name = name, .doc = doc, .quantity = Q::kLength, .required = true, .example = "[0 um, 0 um, 0 um]"}, value);
  };
  end("from", "Centre of one end of the cylinder.", shape.low_end);
  end("to", "Centre of the other end.", shape.high_end);
  s.quantity(
      {.name = "radius", .doc = "Radius.", .quantity = Q::kLength, .required = true, .low = 0.0, .low_open = true, .example = "3 um"},
      shape.radius);
}

void marked(Section& s, Given<std::string>& value, const char* doc) { s.text({.name = "marked", .doc = doc, .example = "apical"}, value); }

void declare_patch(Section& p, draft::Load& load) {
  p.vector(
      {.name = "force", .doc = "The force, in any direction.", .quantity = Q::kForce, .required = true, .example = "[0 nN, 0 nN, -1 nN]"},
      load.patch_force);
  p.vector({.name = "toward",
            .doc = "The side of the undeformed cell that bears it: direction from the centre.",
            .fallback = "[1, 0, 0]",
            .example = "[0, 0, 1]",
            .source = "chosen"},
           load.patch_ends.axis);
  part(p, load.patch_ends, "2 %",
       "Part of the nodes, those furthest to that side, in equal parts: a fixed set, ties taken in; one node, a point force, where that is "
       "less than one and a half.");
  marked(p, load.patch_mark,
         "In place of `toward` and `part`: the faces with this mark bear the force, each its share by area; none while no face has it.");
}

void declare_pressure(Section& p, draft::Load& load) {
  p.quantity({.name = "value", .doc = "The pressure.", .quantity = Q::kPressure, .required = true, .example = "10 Pa"},
             load.pressure_value);
  p.vector({.name = "gradient",
            .doc = "How the pressure changes in space; `value` is that at `origin`. The weight of a medium, the field of a flow.",
            .quantity = Q::kPressurePerLength,
            .fallback = "[0 Pa/um, 0 Pa/um, 0 Pa/um]",
            .example = "[0 Pa/um, 0 Pa/um, -1 Pa/um]",
            .source = "chosen"},
           load.pressure_gradient);
  p.vector({.name = "origin",
            .doc = "Where the pressure is `value`.",
            .quantity = Q::kLength,
            .fallback = "[0 um, 0 um, 0 um]",
            .example = "[0 um, 0 um, 0 um]",
            .source = "chosen"},
           load.pressure_origin);
  axis(p, load.pressure_ends.axis, "Axis that tells the ends.");
  ends(p, load.pressure_ends, "100 %", "Part of the nodes at each end; faces between such nodes bear the pressure.");
  marked(p, load.pressure_mark, "In place of `axis`, `part` and `ends`: faces with this mark bear the pressure.");
  p.group({.name = "within",
           .doc = "Only faces whose middle lies in this cylinder bear the pressure: suction in a pipette.",
           .optional_section = true,
           .example = "{from: [0 um, 0 um, 0 um], to: [0 um, 0 um, 15 um], radius: 2.75 um}"},
          load.pressure_within.present, [&load](Section& w) { declare_within(w, load.pressure_within); });
}

void declare_grip(Section& g, draft::Load& load) {
  g.quantity({.name = "stiffness",
              .doc = "Stiffness of the springs of one end together.",
              .quantity = Q::kTension,
              .fallback = "10 mN/m",
              .low = 0.0,
              .high = 1e6,
              .low_open = true,
              .example = "10 mN/m",
              .source = "chosen: 1 nN moves a grip by 0.1 um"},
             load.grip_stiffness);
  g.vector(
      {.name = "center",
       .doc = "Centre of the undeformed cell whose end nodes the grip holds; where the cell is placed, unless the grip shall push at once.",
       .quantity = Q::kLength,
       .required = true,
       .example = "[0 um, 0 um, 6 um]"},
      load.grip_center);
  axis(g, load.grip_ends.axis, "Axis that tells the ends.");
  ends(g, load.grip_ends, "10 %", "Part of the nodes at each end that are held: a fixed set, ties taken in.");
  g.vector({.name = "direction",
            .doc = "Direction of `way`; need not have length 1.",
            .fallback = "[0, 0, 1]",
            .example = "[0, 0, 1]",
            .source = "chosen"},
           load.grip_direction);
  g.list({.name = "way",
          .doc = "How far the grip has moved along `direction` over time: straight lines between these points, at rest before the first "
                 "and after "
                 "the last. Steps land on the points.",
          .example = "[{time: 0 s, distance: 0 um}, {time: 5 min, distance: 6 um}]"},
         load.way, &declare_distance_point);
}

}  // namespace

void declare_course_point(Section& s, draft::CoursePoint& point) {
  s.quantity({.name = "time", .doc = "When.", .quantity = Q::kTime, .required = true, .low = 0.0, .example = "10 s"}, point.time);
  s.quantity({.name = "factor", .doc = "Part of the full value at that time.", .required = true, .low = -1e6, .high = 1e6, .example = "1"},
             point.value);
}

void declare_motion_course(Section& s, draft::Obstacle& o) {
  s.vector({.name = "direction",
            .doc = "Direction of `course`; need not have length 1.",
            .fallback = "[0, 0, 1]",
            .example = "[0, 0, -1]",
            .source = "chosen"},
           o.direction);
  s.list({.name = "course",
          .doc = "Way along `direction` over time, beside the velocity: straight lines between these points, at rest before the first and "
                 "after the last. Steps land on the points.",
          .example = "[{time: 0 s, distance: 0 um}, {time: 5 min, distance: 2 um}]"},
         o.course, &declare_distance_point);
}

void declare_load(Section& s, draft::Load& load) {
  s.text({.name = "type", .doc = "Cell type that bears the load.", .required = true, .example = "hepatocyte"}, load.type);
  s.group({.name = "traction",
           .doc = "Traction s0 cos^2(theta) along the outward normal, theta from the axis through the cell's centre: an optical stretcher.",
           .optional_section = true,
           .example = "{peak: 1 Pa, axis: [1, 0, 0]}"},
          load.traction, [&load](Section& t) {
            t.quantity(
                {.name = "peak", .doc = "s0, the traction on the axis.", .quantity = Q::kPressure, .required = true, .example = "1 Pa"},
                load.peak);
            axis(t, load.traction_axis, "Axis of the beams.");
          });
  s.group({.name = "pull",
           .doc = "A force spread evenly over the nodes at the ends of an axis, outwards: beads, grips, tweezers.",
           .optional_section = true,
           .example = "{force: 100 pN, axis: [1, 0, 0], part: 2 %}"},
          load.pull, [&load](Section& p) {
            p.quantity(
                {.name = "force", .doc = "Force at each end, outwards.", .quantity = Q::kForce, .required = true, .example = "100 pN"},
                load.pull_force);
            axis(p, load.pull_ends.axis, "Axis along which the force acts.");
            ends(p, load.pull_ends, "2 %", "Part of the nodes at each end that bear the force: a fixed set, ties taken in.");
          });
  s.group({.name = "patch",
           .doc = "A force in any direction on one side of the cell, on a single node, or on marked faces: a needle, a bead, a cilium.",
           .optional_section = true,
           .example = "{force: [0 nN, 0 nN, -1 nN], toward: [0, 0, 1], part: 2 %}"},
          load.patch, [&load](Section& p) { declare_patch(p, load); });
  s.group(
      {.name = "pressure",
       .doc = "A pressure against the outward normal, on the whole surface, at the ends of an axis or on marked faces, uniform or with a "
              "gradient in space; negative: suction.",
       .optional_section = true,
       .example = "{value: 10 Pa}"},
      load.pressure, [&load](Section& p) { declare_pressure(p, load); });
  s.group(
      {.name = "grip",
       .doc = "Springs that hold the nodes at the ends of an axis where they are on an undeformed cell, and move them: a holding pipette, "
              "a glued bead. `course` is a factor of the stiffness.",
       .optional_section = true,
       .example = "{stiffness: 10 mN/m, center: [0 um, 0 um, 6 um], part: 10 %, ends: high}"},
      load.grip, [&load](Section& g) { declare_grip(g, load); });
  s.vector({.name = "body_force",
            .doc = "A force on the whole cell; on a shell spread over its surface.",
            .quantity = Q::kForce,
            .example = "[0 nN, 0 nN, -1 nN]"},
           load.body_force);
  s.list(
      {.name = "course",
       .doc = "The load over time: straight lines between these points, constant before the first and after the last. Without it: the full "
              "load from time 0 on. Steps land on the points.",
       .example = "[{time: 0 s, factor: 0}, {time: 1 s, factor: 1}]"},
      load.course, &declare_course_point);
}

}  // namespace morula::scenarios
