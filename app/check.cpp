#include "app/estimate_text.h"
#include "app/read_study.h"
#include "app/verbs.h"
#include "app/words.h"
#include "study/catalogue.h"

namespace morula::app {

Status check(const CheckOptions& options, const Context& context) {
  if (options.schema) context.console.result(scenarios::study_json_schema(*context.laws));
  Status outcome;
  for (const std::string& path : options.studies) {
    const auto study = read_study_and_tell(path, options.overrides, options.strict, context);
    if (!study.ok()) {
      if (outcome.ok() || study.error().kind != ErrorKind::kFile)
        outcome = study.error();  // a wrong study counts for more than a missing file
      continue;
    }
    const std::size_t warnings = study->warnings.warning_count();
    if (!options.schema)
      context.console.result(path + ": ok" + (warnings ? " (" + count_words(warnings, "warning", "warnings") + ")" : "") + "\n");
    if (options.estimate) {
      MORULA_TRY_ASSIGN(const std::string text, estimate_text(*study, context.comm.size()));
      context.console.result(text);
    }
  }
  return outcome;
}

}  // namespace morula::app
