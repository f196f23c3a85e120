#include "scenarios/calibrate/zero_rate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/numbers/number_text.h"

namespace morula::calibrate {

Result<AtRest> to_zero_rate(std::span<const RateSample> samples, double scale) {
  const auto refused = [](std::string what, std::string help) { return Error{ErrorKind::kInput, std::move(what), std::move(help)}; };
  if (samples.size() < 2)
    return refused("a value at rest needs runs at two rates at least, and there are " + std::to_string(samples.size()),
                   "run the experiment at half its rate, too");
  if (!(scale > 0.0) || !std::isfinite(scale)) return refused("the scale of the curve is not a positive number", "the largest force of it");
  std::vector<RateSample> slow(samples.begin(), samples.end());
  std::sort(slow.begin(), slow.end(), [](const RateSample& a, const RateSample& b) { return a.rate < b.rate; });
  for (std::size_t k = 0; k < slow.size(); ++k) {
    if (!(slow[k].rate > 0.0) || !std::isfinite(slow[k].rate) || !std::isfinite(slow[k].value))
      return refused("run at rate " + number_text("%.6g", slow[k].rate) + " gave " + number_text("%.6g", slow[k].value) +
                         ": rates must be positive, and values numbers",
                     "leave the run out, or run it again");
    if (k > 0 && slow[k].rate == slow[k - 1].rate)
      return refused("two runs have the rate " + number_text("%.6g", slow[k].rate), "one run for each rate");
  }
  AtRest out;
  out.slope = (slow[1].value - slow[0].value) / (slow[1].rate - slow[0].rate);
  out.value = slow[0].value - out.slope * slow[0].rate;
  out.remainder = std::numeric_limits<double>::infinity();
  if (slow.size() > 2) {
    // Newton's form: the parabola at 0 differs from the line at 0 by the second divided difference times v_1 v_2.
    const double outer = (slow[2].value - slow[1].value) / (slow[2].rate - slow[1].rate);
    const double bend = (outer - out.slope) / (slow[2].rate - slow[0].rate);
    out.remainder = std::abs(bend * slow[0].rate * slow[1].rate) / scale;
  }
  out.straight = out.remainder < kStraightEnough;
  return out;
}

}  // namespace morula::calibrate
