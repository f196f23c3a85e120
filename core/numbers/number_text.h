#pragma once
#include <string>

namespace morula {

/// The shortest text that reads back to the same bits; infinities and NaN as `inf`, `-inf`, `nan`.
[[nodiscard]] std::string shortest_text(double value);

/// printf for single numbers: number_text("%.3g s", 2.5).
[[nodiscard]] std::string number_text(const char* format, double value);

/// A text as a field of a CSV line (RFC 4180): quoted where it has a comma, a quote or a line break.
[[nodiscard]] std::string csv_field(const std::string& text);

}  // namespace morula
