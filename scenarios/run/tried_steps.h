#pragma once
#include <span>

namespace morula::scenarios {

/// One of the first steps of a run.
struct TriedStep {
  double end = 0.0;   ///< simulated time at its end [s]
  double cost = 0.0;  ///< CPU time of all steps so far [s]
};

/// CPU time of the steps from the last one tried to `end`, by how the steps have grown so far.
///
/// Tissues that start out of rest take small steps first, which grow with the time that has passed; where motion is imposed, or cells inflate, they stay. Whether
/// those that have grown will go on to do so cannot be seen, so that what is told is the geometric mean of both: steps stay as large as they are, and
/// Δt ∝ t^p up to `most`. p, between 0 and 1, is from the numbers n1 and n2 of steps in the last half of the time and in the quarter before it: of uniform
/// ones there are n1 = 2 n2, of those that grow with t as many, p = 1 + log2(n2/n1). Each costs what those of the last half did on average.
///
/// end, most [s]: of the run, largest step. 0 when nothing was tried.
double cost_ahead(std::span<const TriedStep> steps, double end, double most);

/// CPU time of one of the steps that end in the later half of the time that was tried [s]; there is one at least.
double cost_of_late_step(std::span<const TriedStep> steps);

}  // namespace morula::scenarios
