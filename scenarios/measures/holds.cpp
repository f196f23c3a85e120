#include "scenarios/measures/holds.h"

#include "coupling/regions/region.h"

namespace morula::scenarios {

std::vector<Hold> holds_of(const TimeCourse& course, const std::vector<double>& times) {
  std::vector<Hold> out;
  const auto add = [&](double value, double from, double until, bool same_hold) {
    for (std::size_t i = times.size(); i-- > 0;) {
      if (times[i] > until * (1.0 + 1e-12)) continue;
      if (!(times[i] > from)) return;
      if (same_hold && !out.empty() && out.back().value == value) out.pop_back();
      out.push_back({value, times[i], i});
      return;
    }
  };
  if (course.empty()) {
    add(1.0, 0.0, kNever, false);
    return out;
  }
  bool rests = course.time.front() > 0.0;  // up to the point that is looked at: before the first it has that value
  if (rests) add(course.value.front(), 0.0, course.time.front(), false);
  for (std::size_t i = 1; i < course.time.size(); ++i) {
    const bool goes_on = course.value[i] == course.value[i - 1];
    if (goes_on) add(course.value[i], course.time[i - 1], course.time[i], rests);
    rests = goes_on;
  }
  add(course.value.back(), course.time.back(), kNever, rests);
  return out;
}

const TimeCourse& course_of(const CellLoad& load) { return load.what == grip_load() || !load.way.empty() ? load.way : load.course; }

}  // namespace morula::scenarios
