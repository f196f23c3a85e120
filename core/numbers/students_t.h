#pragma once

namespace morula {

/// Half of the two-sided interval of 95 % of a mean, over its standard error: the 97.5 % quantile of Student's t (Boost.Math). Precondition: freedom > 0.
[[nodiscard]] double students_t_95(double freedom);

}  // namespace morula
