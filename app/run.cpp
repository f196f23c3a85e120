#include <algorithm>

#include "app/estimate_text.h"
#include "app/read_study.h"
#include "app/run_display.h"
#include "app/run_request.h"
#include "app/signals.h"
#include "app/verbs.h"
#include "results/file_io.h"

namespace morula::app {
namespace {

/// Cells that are named on the command line are a region before all others.
void add_region_of(const std::vector<std::string>& ids, const std::string& name, const std::string& body,
                   std::vector<std::string>& overrides) {
  if (ids.empty()) return;
  std::string list;
  for (const std::string& id : ids) list += (list.empty() ? "\"" : ", \"") + id + "\"";
  overrides.push_back("coupling.regions.+={name: " + name + ", shape: cells, ids: [" + list + "], as: " + body + "}");
}

}  // namespace

Status run(const RunOptions& options, const Context& context) {
  outlive_closed_pipes();
  std::vector<std::string> overrides = options.overrides;
  if (options.seed) overrides.push_back("seed=" + std::to_string(*options.seed));
  for (const std::string& id : options.promote)
    if (std::ranges::find(options.demote, id) != options.demote.end())
      return Error{ErrorKind::kInput, "cell " + id + " is named by --promote and by --demote", "name it by one of them"};
  add_region_of(options.demote, "demoted", "sphere", overrides);
  add_region_of(options.promote, "promoted", "shell", overrides);
  auto study = read_study_and_tell(options.study, overrides, false, context);
  MORULA_TRY(agree_on(study, options.study, context));
  scenarios::RunRequest request;
  request.out = options.out;
  MORULA_TRY(fill_request(options.limits, context, request));
  if (options.dry_run) {
    Status told;
    if (context.comm.is_root()) {
      auto text = estimate_text(*study, context.comm.size());
      if (text.ok())
        context.console.result(first_line(*study, options.limits.threads, context) + "\n" + *text);
      else
        told = text.error();
    }
    return scenarios::agree(std::move(told), context.comm);
  }
  RunDisplay display(context.console, first_line(*study, options.limits.threads, context));
  display.listen_to(request);
  MORULA_TRY_ASSIGN(const scenarios::RunSummary summary, scenarios::run(*study, request, context.comm));
  display.end(summary);
  return outcome_of(summary);
}

}  // namespace morula::app
