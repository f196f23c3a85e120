#include "app/run_request.h"

#include <omp.h>

#include "app/cores.h"
#include "app/signals.h"
#include "app/words.h"
#include "results/build_info.h"

namespace morula::app {

Status fill_request(const RunLimits& limits, const Context& context, scenarios::RunRequest& request) {
  if (!limits.until.empty()) {
    MORULA_TRY_ASSIGN(request.until, read_time("--until", limits.until));
  }
  if (!limits.max_wall.empty()) {
    MORULA_TRY_ASSIGN(request.max_wall, read_time("--max-wall", limits.max_wall));
  }
  request.command = context.command;
  request.threads = limits.threads;
  request.timings = limits.timings;
  request.stop = &watch_signals();
  omp_set_num_threads(limits.threads);
  if (const std::string crowded = crowded_cores(limits.threads, context.comm); !crowded.empty()) request.warnings.push_back(crowded);
  return {};
}

std::string first_line(const scenarios::Study& study, int threads, const Context& context) {
  return "morula " + scenarios::build_info().version + " · " + study.name + " · seed " + std::to_string(study.model.seed) + " · " +
         count_words(static_cast<std::uint64_t>(context.comm.size()), "rank", "ranks") + " × " +
         count_words(static_cast<std::uint64_t>(threads), "thread", "threads");
}

Status outcome_of(const scenarios::RunSummary& summary) {
  if (summary.stopped) return Error{*summary.stopped, "", ""};
  // What failed has been told; the results are whole.
  if (!summary.passed) return Error{ErrorKind::kVerification, "", ""};
  return {};
}

}  // namespace morula::app
