#pragma once
#include <cmath>
#include <limits>
#include <string>

#include "core/numbers/number_text.h"
#include "results/run_record.h"

namespace morula::scenarios {

/// A value that no limit accepts: what a criterion is judged on when it finds nothing.
inline constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// The largest of the values it was shown. kNothing when it was shown none, or one that is no number: a criterion that finds nothing fails.
class Largest {
 public:
  void add(double value) {
    if (!shown_ || std::isnan(value) || value > value_) value_ = std::isnan(value_) && shown_ ? value_ : value;
    shown_ = true;
  }
  [[nodiscard]] double value() const { return value_; }
  [[nodiscard]] bool shown() const { return shown_; }

 private:
  double value_ = kNothing;
  bool shown_ = false;
};

inline std::string with_unit(double limit, const char* unit) { return number_text("%g", limit) + (*unit ? " " : "") + unit; }

inline Verdict at_most(const char* id, const char* quantity, double value, double limit, const char* unit = "") {
  return {id, quantity, value, "<= " + with_unit(limit, unit), value <= limit};
}

}  // namespace morula::scenarios
