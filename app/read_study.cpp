#include "app/read_study.h"

#include <set>

#include "app/machine_memory.h"
#include "app/words.h"
#include "results/file_io.h"
#include "scenarios/criteria/judge.h"
#include "scenarios/criteria/understand.h"
#include "scenarios/library/library.h"
#include "scenarios/run/cost_model.h"

namespace morula::app {

namespace {

/// W699 where one process would need more memory than this machine has.
void warn_of_memory(scenarios::Study& study, const std::string& path, const Context& context) {
  const double need = scenarios::memory_at_start(study), all = machine_memory();
  if (context.comm.size() > 1 || need <= all) return;
  scenarios::Place place;
  place.source = std::make_shared<const scenarios::SourceText>(path, "");
  study.warnings.warning(699, place,
                         "this study takes about " + bytes_words(need) + " from its start, and this machine has " + bytes_words(all),
                         "fewer cells, larger voxels, or ranks on several machines");
}

/// A key that two overrides set, where the last would win without a word. A list may grow by several (`+`).
Status set_once(const std::vector<std::string>& overrides) {
  std::set<std::string> seen;
  for (const std::string& one : overrides) {
    const std::string key = one.substr(0, one.find('='));
    if (!key.ends_with(".+") && !seen.insert(key).second)
      return Error{ErrorKind::kInput, "'" + key + "' is given twice on the command line", "once is enough"};
  }
  return {};
}

}  // namespace

Result<scenarios::Study> read_study_and_tell(const std::string& path, const std::vector<std::string>& overrides, bool strict,
                                             const Context& context, scenarios::ReadOptions options) {
  MORULA_TRY(set_once(overrides));
  options.laws = context.laws;
  options.overrides = overrides;
  options.scenario_names = scenarios::template_names();
  options.check_criteria = &scenarios::check_criteria;
  options.strict = strict;
  auto study = scenarios::read_study(path, options);
  if (study.ok()) warn_of_memory(*study, path, context);
  const scenarios::Diagnostics& told = study.ok() ? study->warnings : study.error();
  if (!told.empty()) context.console.message(told.text(context.console.colour()));
  if (study.ok()) {
    for (const std::string& note : study->notes) context.console.note(note);
    return std::move(study).value();
  }
  context.console.message(count_words(told.error_count(), "error", "errors") + " in '" + path + "'\n");
  return Error{told.kind(), "", ""};
}

Status agree_on(const Result<scenarios::Study>& study, const std::string& path, const Context& context) {
  const Status all = scenarios::agree(study.ok() ? Status{} : Status{study.error()}, context.comm);
  if (!all.ok() && study.ok())  // this rank has told nothing
    return Error{all.error().kind, "another rank cannot read '" + path + "' as this one does",
                 "the study and its files must be on a disk that all machines share"};
  return all;
}

}  // namespace morula::app
