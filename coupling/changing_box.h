#pragma once
#include "core/numbers/time_course.h"
#include "core/space/space.h"
#include "coupling/tissue.h"

namespace morula {

/// A periodic box whose volume follows a course (decision 0045). Its size is a function of time alone: no state has to remember it.
///
/// The box at a time [s]: `of_study`, about its centre, with its volume times the value of the course.
[[nodiscard]] Box box_at(const Box& of_study, const TimeCourse& volume, double time);

/// Only such a box can follow a course.
[[nodiscard]] inline bool periodic_along_all_axes(const Space& space) {
  return space.periodic(0) && space.periodic(1) && space.periodic(2);
}

/// Moves all places of a tissue with the affine map between two boxes about one centre, so that a place keeps its share of the box.
void carry(Tissue& tissue, const Box& from, const Box& to);

/// Longest step from `time` on [s] in which the course carries no surface of a cell of this radius [µm] further than `allowed` [µm] from its own
/// centre: strain times radius. `until` [s]: not beyond the next corner of the course. Infinity where the box stays.
[[nodiscard]] double longest_carried_step(const TimeCourse& volume, double time, double until, double radius, double allowed);

}  // namespace morula
