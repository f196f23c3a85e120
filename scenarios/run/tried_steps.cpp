#include "scenarios/run/tried_steps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace morula::scenarios {
namespace {

/// Steps of size d (τ/t)^(1 − q) from τ = t to `until`: ∫ dτ/Δt.
double steps_until(double t, double d, double q, double until) {
  return q < 1e-9 ? t / d * std::log(until / t) : t / d * (std::pow(until / t, q) - 1.0) / q;
}

/// Number of the steps that end by a time.
std::size_t ended_by(std::span<const TriedStep> steps, double time) {
  return static_cast<std::size_t>(std::ranges::count_if(steps, [&](const TriedStep& s) { return s.end <= time; }));
}

/// Index of the first step that ends in the later half of the time that was tried.
std::size_t first_late_step(std::span<const TriedStep> steps) { return ended_by(steps, 0.5 * steps.back().end); }

}  // namespace

double cost_of_late_step(std::span<const TriedStep> steps) {
  const std::size_t half = first_late_step(steps);
  return (steps.back().cost - (half > 0 ? steps[half - 1].cost : 0.0)) / static_cast<double>(steps.size() - half);
}

double cost_ahead(std::span<const TriedStep> steps, double end, double most) {
  if (steps.empty() || steps.back().end >= end) return 0.0;
  const double t = steps.back().end;
  const std::size_t half = first_late_step(steps), quarter = ended_by(steps, 0.25 * t);
  const double late = static_cast<double>(steps.size() - half), early = static_cast<double>(half - quarter);
  const double p = early > 0.0 ? std::clamp(1.0 + std::log2(early / late), 0.0, 1.0) : 1.0, q = 1.0 - p;
  // the late steps fill half of the time: n1 = (t/d)(1 − 2^(−q))/q
  const double size = q < 1e-9 ? t * std::log(2.0) / late : t * (1.0 - std::pow(0.5, q)) / (q * late);
  const double each = cost_of_late_step(steps);
  const double stay = (end - t) / std::min(size, most);
  if (size >= most || p <= 0.0) return each * stay;
  const double full = std::min(end, t * std::pow(most / size, 1.0 / p));  // from here the steps are as large as they may be
  const double grow = steps_until(t, size, q, full) + (end - full) / most;
  return each * std::sqrt(stay * grow);
}

}  // namespace morula::scenarios
