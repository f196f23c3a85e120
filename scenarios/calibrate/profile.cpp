#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/numbers/students_t.h"
#include "scenarios/calibrate/confidence.h"

namespace morula::calibrate {
namespace {

/// A walk along one parameter.
struct Walk {
  LeastSquares loss;
  std::size_t parameter = 0;
  double least = 0.0;
  double limit = 0.0;  ///< of the rise
  Profile out;

  /// The least loss with the parameter at a value, searched from a place nearby, which becomes that of the minimum.
  double at(double value, std::vector<double>& place) {
    LeastSquares fixed = loss;
    fixed.low[parameter] = fixed.high[parameter] = value;
    // Two ways on: the other of E and W as it was, and W/E, hence the lengths of the law, as they were.
    std::vector<double> same_length = place;
    same_length[1 - parameter] += value - place[parameter];
    place[parameter] = same_length[parameter] = value;
    Minimum found = minimise(fixed, place);
    if (Minimum other = minimise(fixed, same_length); other.loss < found.loss) found = std::move(other);
    place = found.parameters;
    out.points.push_back({std::exp(value), found.loss});
    if (found.loss < least * (1.0 - 1e-7) - 1e-9 && (out.better.empty() || found.loss < least)) out.better = found.parameters;
    return found.loss;
  }

  /// Whether the other of E and W has run to the end of its search, so that a rise of the loss is the bound's and not the data's. W at its lower
  /// bound is no end: bodies without adhesion.
  [[nodiscard]] bool other_is_unbounded(const std::vector<double>& place) const {
    const std::size_t other = 1 - parameter;
    return place[other] > loss.high[other] - 1e-3 || (other == 0 && place[other] < loss.low[other] + 1e-3);
  }

  /// Where the loss crosses the limit going from the best place by `step`, or an infinity.
  double crossing(const std::vector<double>& best, double step) {
    const double bound = step > 0.0 ? loss.high[parameter] : loss.low[parameter];
    std::vector<double> place = best;
    double inside = best[parameter], inside_rise = 0.0;
    while (true) {
      double outside = inside + step;
      if ((step > 0.0) == (outside > bound)) outside = bound;
      std::vector<double> next = place;
      const double rise = at(outside, next) - least;
      if (other_is_unbounded(next)) return std::copysign(std::numeric_limits<double>::infinity(), step);
      if (rise > limit) return between(inside, inside_rise, outside, rise, place);
      if (outside == bound) return std::copysign(std::numeric_limits<double>::infinity(), step);
      inside = outside, inside_rise = std::max(0.0, rise), place = next;
      step *= 1.6;
    }
  }

  /// False position in the square root of the rise, which is nearly a straight line.
  double between(double inside, double inside_rise, double outside, double outside_rise, std::vector<double>& place) {
    double a = std::sqrt(inside_rise) - std::sqrt(limit), b = std::sqrt(outside_rise) - std::sqrt(limit);
    double middle = outside;
    for (int k = 0; k < 40 && std::abs(outside - inside) > 1e-7; ++k) {
      // Every third time the middle, so that a bent curve cannot make it crawl.
      const double part = k % 3 == 2 ? 0.5 : std::clamp(a / (a - b), 0.02, 0.98);
      middle = inside + part * (outside - inside);
      const double f = std::sqrt(std::max(0.0, at(middle, place) - least)) - std::sqrt(limit);
      if (std::abs(f) < 1e-6) break;
      (f > 0.0 ? outside : inside) = middle;
      (f > 0.0 ? b : a) = f;
    }
    return middle;
  }
};

}  // namespace

double profile_rise(const Fit& fit) { return kRiseOf95 * fit.dispersion(); }

Profile profile(const Data& data, const Fit& fit, int parameter) {
  const std::vector<double> best = fit.parameters.logarithms();
  const Covariance errors = covariance(data, fit);
  const double error = parameter == 0 ? errors.young_error : errors.adhesion_error;
  const double step = std::isfinite(error) ? std::clamp(0.7 * error, 1e-6, 0.5) : 0.1;
  Walk walk{loss_of(data, fit), static_cast<std::size_t>(parameter), fit.loss, profile_rise(fit), {}};
  walk.out.points.push_back({std::exp(best[walk.parameter]), fit.loss});
  walk.out.interval.low = std::exp(walk.crossing(best, -step));
  walk.out.interval.high = std::exp(walk.crossing(best, step));
  std::sort(walk.out.points.begin(), walk.out.points.end(),
            [](const Profile::Point& a, const Profile::Point& b) { return a.value < b.value; });
  return walk.out;
}

}  // namespace morula::calibrate
