#include "coupling/loads/load.h"
#include "study/declare.h"
#include "study/own_section.h"

namespace morula::scenarios {
using Q = Quantity;

void declare_distance_point(Section& s, draft::CoursePoint& point) {
  s.quantity({.name = "time", .doc = "When.", .quantity = Q::kTime, .required = true, .low = 0.0, .example = "10 s"}, point.time);
  s.quantity(
      {.name = "distance", .doc = "How far it is then from where it began.", .quantity = Q::kLength, .required = true, .example = "2 um"},
      point.value);
}

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
          .not_empty = true,
          .example = "[{time: 0 s, distance: 0 um}, {time: 5 min, distance: 2 um}]"},
         o.course, &declare_distance_point);
}

void declare_load(Section& s, draft::Load& load) {
  s.text({.name = "type", .doc = "Cell type that bears the load.", .required = true, .example = "hepatocyte"}, load.type);
  for (const auto& kind : s.laws().loads) {
    draft::OwnSection& own = load.kinds[kind->section.name];
    if (kind->bare) {
      declare_own_keys(s, kind->keys, own, false);
      continue;
    }
    KeySpec spec = kind->section;
    spec.optional_section = true;
    s.group(spec, own.present, [&](Section& inner) { declare_own_keys(inner, kind->keys, own, true); });
  }
  s.list(
      {.name = "course",
       .doc = "The load over time: straight lines between these points, constant before the first and after the last. Without it: the full "
              "load from time 0 on. Steps land on the points, and a force on whole cells changes by a fortieth in one of them at most.",
       .not_empty = true,
       .example = "[{time: 0 s, factor: 0}, {time: 1 s, factor: 1}]"},
      load.course, &declare_course_point);
}

}  // namespace morula::scenarios
