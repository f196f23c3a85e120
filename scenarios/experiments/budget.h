#pragma once
#include <string>
#include <vector>

#include "core/result.h"
#include "scenarios/experiments/experiment.h"

namespace morula::scenarios {

/// A list of experiments that fits into a time.
struct Shortened {
  std::vector<Experiment> kept;
  std::vector<std::string> left_out;  ///< names, in the order in which they went
  double seconds = 0.0;               ///< that those kept are expected to take [s]
};

/// Computing time that an experiment with shells of so many nodes is expected to take on one core of a machine of 2026 [s], from its work alone: the same on
/// every machine, so that a list, and the fit of it, does not depend on where and on how many ranks it is made.
double expected_seconds(const Experiment& experiment, std::uint32_t nodes);

/// Leaves out experiments, all that are equally dispensable together and the most dispensable first, until the others are expected to take no more than
/// `budget` seconds of one core. Error (kInput): those that there is no fit without take longer; the message says how long.
Result<Shortened> within_budget(std::vector<Experiment> experiments, std::uint32_t nodes, double budget);

}  // namespace morula::scenarios
