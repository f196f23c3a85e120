#pragma once
#include <span>
#include <vector>

namespace morula::cbm {

/// Slopes at the knots of a cubic Hermite curve through values that do not fall: three-point differences, then shortened into the circle
/// α² + β² ≤ 9 in which a segment is monotone (Fritsch & Carlson 1980, doi:10.1137/0717021). Preconditions: three knots at least, x increasing.
std::vector<double> monotone_slopes(std::span<const double> x, std::span<const double> y);

}  // namespace morula::cbm
