#include "scenarios/experiments/budget.h"

#include <algorithm>
#include <cmath>

#include "scenarios/run/cost_model.h"

namespace morula::scenarios {
namespace {

// CPU time, measured [s]: of a run with its hundred outputs, written and read again, and of a node and a simulated second of an experiment. Of the spheres that are
// pressed in the place of a cluster of shells, with each friction that the fit tries, twice; and of those that come to rest in a random packing, in each turn
// of the fit.
constexpr double kSecondsOfRun = 1.0, kSecondsPerWork = 4e-7, kSecondsOfPressed = 11.0, kSecondsOfPacked = 9.0;

double all_seconds(const std::vector<Experiment>& experiments, std::uint32_t nodes) {
  double out = 0.0;
  for (const Experiment& one : experiments) out += expected_seconds(one, nodes);
  return out;
}

/// Rounded up, so that it suffices as a budget.
std::string enough(double seconds) { return duration_text(seconds < 90.0 ? std::ceil(seconds) : 60.0 * std::ceil(seconds / 60.0)); }

}  // namespace

double expected_seconds(const Experiment& experiment, std::uint32_t nodes) {
  double out = kSecondsOfRun + kSecondsPerWork * experiment.work * static_cast<double>(nodes);
  if (experiment.kind == Experiment::Kind::kPressed) out += kSecondsOfPressed;
  if (experiment.kind == Experiment::Kind::kPacking && experiment.arrangement == calibrate::Arrangement::kRandom && !experiment.held_out)
    out += kSecondsOfPacked;
  return out;
}

Result<Shortened> within_budget(std::vector<Experiment> experiments, std::uint32_t nodes, double budget) {
  Shortened out{.kept = std::move(experiments), .left_out = {}, .seconds = 0.0};
  while ((out.seconds = all_seconds(out.kept, nodes)) > budget) {
    const int most = std::ranges::max(out.kept, {}, &Experiment::dispensable).dispensable;
    if (most == 0)
      return Error{ErrorKind::kInput,
                   "the budget is too small for any fit: two cells at two rates alone take about " + enough(out.seconds) + " of one core",
                   "give more time, or shells of fewer nodes"};
    std::erase_if(out.kept, [&](const Experiment& one) {
      if (one.dispensable == most) out.left_out.push_back(one.name);
      return one.dispensable == most;
    });
  }
  return out;
}

}  // namespace morula::scenarios
