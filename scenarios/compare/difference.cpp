#include "scenarios/compare/difference.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numbers/sample.h"
#include "core/numbers/students_t.h"

namespace morula::scenarios {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

GroupValue value_of(const std::vector<double>& values) { return {mean_of_sample(values), std::sqrt(variance_of_sample(values))}; }

struct StandardError {
  double error = kNone, freedom = kNone;
};

StandardError standard_error(const std::vector<double>& a, const std::vector<double>& b) {
  double var_a = variance_of_sample(a), var_b = variance_of_sample(b);
  if (std::isnan(var_a) && std::isnan(var_b)) return {};
  const double n_a = static_cast<double>(a.size()), n_b = static_cast<double>(b.size());
  if (std::isnan(var_a) || std::isnan(var_b)) {  // a single run: as the other group spreads
    const double variance = std::isnan(var_a) ? var_b : var_a;
    return {std::sqrt(variance / n_a + variance / n_b), std::max(n_a, n_b) - 1.0};
  }
  var_a /= n_a, var_b /= n_b;
  const double sum = var_a + var_b;
  if (sum == 0.0) return {0.0, n_a + n_b - 2.0};
  return {std::sqrt(sum), sum * sum / (var_a * var_a / (n_a - 1.0) + var_b * var_b / (n_b - 1.0))};
}

ComparisonVerdict judge(const ColumnDifference& d, double size, std::optional<double> within) {
  const double apart = std::abs(d.difference);
  if (!std::isfinite(apart)) return within ? ComparisonVerdict::kBeyond : ComparisonVerdict::kUnknown;  // nothing there
  const bool known = !std::isnan(d.interval);
  if (!within) {
    if (!known) return apart == 0.0 ? ComparisonVerdict::kSame : ComparisonVerdict::kUnknown;
    return apart <= d.interval ? ComparisonVerdict::kSame : ComparisonVerdict::kDiffers;
  }
  const double allowed = *within * size;
  if (known && d.interval > allowed && apart <= std::max(allowed, d.interval)) return ComparisonVerdict::kUndecided;
  return apart <= allowed ? ComparisonVerdict::kWithin : ComparisonVerdict::kBeyond;
}

}  // namespace

std::string name_of(ComparisonVerdict verdict) {
  switch (verdict) {
    case ComparisonVerdict::kWithin:
      return "within";
    case ComparisonVerdict::kBeyond:
      return "beyond";
    case ComparisonVerdict::kUndecided:
      return "undecided";
    case ComparisonVerdict::kSame:
      return "same";
    case ComparisonVerdict::kDiffers:
      return "differs";
    case ComparisonVerdict::kUnknown:
      return "unknown";
  }
  return "";
}

ColumnDifference difference_of(const std::vector<double>& reference, const std::vector<double>& values, double size,
                               std::optional<double> within) {
  ColumnDifference out;
  out.reference = value_of(reference), out.value = value_of(values);
  out.difference = out.value.mean - out.reference.mean;
  out.relative = out.difference == 0.0 ? 0.0 : size > 0.0 ? out.difference / size : kNone;
  const StandardError of = standard_error(reference, values);
  out.interval = kNone, out.in_spreads = kNone;
  if (of.error == 0.0) {
    out.interval = 0.0;
  } else if (!std::isnan(of.error)) {
    out.interval = of.error * students_t_95(of.freedom);
    out.in_spreads = out.difference / of.error;
  }
  out.verdict = judge(out, size, within);
  return out;
}

}  // namespace morula::scenarios
