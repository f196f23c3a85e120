#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/parallel/comm.h"
#include "core/result.h"
#include "scenarios/experiments/experiment.h"
#include "scenarios/run/driver.h"

namespace morula::scenarios {

/// Where and how experiments are run.
struct ExperimentRequest {
  std::filesystem::path folder;                     ///< each experiment has a folder of its name in it
  int threads = 1;                                  ///< of each rank: they share its experiments
  bool packings = true;                             ///< of a calibration: packings, too
  std::optional<double> budget;                     ///< of a calibration: computing time of one core [s] (budget.h)
  const std::atomic<int>* stop = nullptr;           ///< a StopWish
  std::function<void(const std::string&)> on_note;  ///< on any rank, one at a time, when an experiment begins or ends
};

/// How an experiment ended.
struct ExperimentOutcome {
  bool done = false;
  std::string problem;  ///< of one that is not: why
  std::filesystem::path run;
};

/// Runs experiments, each on one thread of one rank: the ranks share the list, and the threads of each its part, the longest first. One that is done is not run again, one that was broken off goes
/// on from its checkpoint; one whose study is another than that in its folder begins anew. The results do not depend on how many ran at once. An
/// experiment that fails is told and does not stop the others. Errors: kInterrupted, kStoppedEarly; kFile. Collective.
Result<std::vector<ExperimentOutcome>> run_experiments(std::span<const Experiment> experiments, const ExperimentRequest& request,
                                                       const Comm& comm);

}  // namespace morula::scenarios
