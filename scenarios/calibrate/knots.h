#pragma once
#include <span>
#include <vector>

#include "cbm/packing.h"
#include "scenarios/calibrate/data.h"
#include "scenarios/calibrate/pair_model.h"

namespace morula::calibrate {

/// What pairs leave to the packing at one point: (p − p_pairs)/(press of the packing).
struct MissingPressure {
  double packing = 0.0;   ///< φ
  double pressure = 0.0;  ///< p_c that this point alone asks for [kPa], of either sign
};
/// Of the packings and clusters that are not held out, by φ.
[[nodiscard]] std::vector<MissingPressure> missing_pressure(const Data& data, const PairModel& pair);

/// Packings φ at which the curve gets its knots: the onset, `onset` or, where that is 0, where the line through the first of those points from which on pressure is missing, a
/// thirtieth of the range of φ and the next, comes to 0, but not below the point before them; and from there to the largest φ with distances that grow like the square, since the curve bends
/// most at its onset; from an onset that is given, where a toe begins, like the power 3/2. Empty: nothing is missing anywhere, or fewer than three points tell.
[[nodiscard]] std::vector<double> place_knots(std::span<const MissingPressure> missing, int count, double onset = 0.0);

/// Knots at these φ with the missing pressure there, made to rise: where the search begins.
[[nodiscard]] std::vector<cbm::PackingKnot> first_curve(std::span<const MissingPressure> missing, std::span<const double> packing);

}  // namespace morula::calibrate
