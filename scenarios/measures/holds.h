#pragma once
#include <cstddef>
#include <vector>

#include "core/numbers/time_course.h"
#include "coupling/loads/load.h"

namespace morula::scenarios {

/// A time during which a course does not change, and the last output in it.
struct Hold {
  double value = 0.0;  ///< of the course
  double time = 0.0;   ///< of the output [s]
  std::size_t output = 0;
};

/// The holds of a course in which a run wrote something, in the order of time; a course without points is one hold. `times`: of the outputs,
/// increasing [s]. The output of time 0 belongs to no hold.
std::vector<Hold> holds_of(const TimeCourse& course, const std::vector<double>& times);

/// The course of a load over time: the way of a grip, of others the factor on its size.
const TimeCourse& course_of(const CellLoad& load);

}  // namespace morula::scenarios
