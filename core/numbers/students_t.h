#pragma once

namespace morula {

/// How far −2 ln L rises from its least to the ends of an interval of 95 % of one parameter: the quantile of χ² with one degree of freedom.
inline constexpr double kRiseOf95 = 3.841459;

/// Half of the two-sided interval of 95 % of a mean, over its standard error: the 97.5 % quantile of Student's t (Boost.Math). Precondition: freedom > 0.
[[nodiscard]] double students_t_95(double freedom);

}  // namespace morula
