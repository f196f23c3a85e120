#pragma once
#include <string>

#include "app/options.h"
#include "app/verbs.h"
#include "scenarios/run/driver.h"

namespace morula::app {

/// Fills in what `run` and `resume` have in common: threads, times, signals. kInput for a time that cannot be read. Collective.
Status fill_request(const RunLimits& limits, const Context& context, scenarios::RunRequest& request);

/// "morula 0.1.0 · spheroid_core · seed 20261121 · 2 ranks × 1 thread"
[[nodiscard]] std::string first_line(const scenarios::Study& study, int threads, const Context& context);

/// Success for a run that is done and passed its checks; else (a check failed, or it was stopped) an error without text, as all was told, whose kind
/// gives the exit code.
[[nodiscard]] Status outcome_of(const scenarios::RunSummary& summary);

}  // namespace morula::app
