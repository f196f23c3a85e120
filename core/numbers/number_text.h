#pragma once
#include <string>

namespace morula {

/// The shortest text that reads back to the same bits; infinities and NaN as `inf`, `-inf`, `nan`.
[[nodiscard]] std::string shortest_text(double value);

/// printf for single numbers: number_text("%.3g s", 2.5).
[[nodiscard]] std::string number_text(const char* format, double value);

}  // namespace morula
