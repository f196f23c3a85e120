#include "app/laws.h"
#include "app/measures.h"
#include "app/verbs.h"
#include "coupling/observables/observable.h"
#include "scenarios/criteria/run_checks.h"
#include "scenarios/measures/measures.h"
#include "scenarios/measures/theories.h"
#include "study/catalogue.h"
#include "study/diagnostics.h"

namespace morula::app {
namespace {

/// What is known of a check that every run undergoes, by its id; empty for any other.
std::string explain_check(const std::string& id) {
  for (const scenarios::RunCheck& check : scenarios::run_checks())
    if (id == check.id) return id + ": " + check.quantity + "\n  limit: " + check.limit + "\n  " + check.doc + "\n";
  return {};
}

}  // namespace

Status explain(const ExplainOptions& options, const Context& context) {
  if (options.markdown == "laws") {
    context.console.result(law_reference(*context.laws));
    return {};
  }
  if (options.markdown == "study") {
    context.console.result(scenarios::study_reference(*context.laws));
    return {};
  }
  if (options.markdown == "measures") {
    context.console.result(measure_reference());
    return {};
  }
  std::string text = explain_measure(options.id) + explain_check(options.id);
  for (const ListedLaw& law : laws_named(*context.laws, options.id)) text += law_text(law);
  if (const auto found = scenarios::explain_study(options.id, *context.laws)) text += *found;
  if (text.empty()) {
    std::vector<std::string> known = law_names(*context.laws);
    for (const scenarios::RunCheck& check : scenarios::run_checks()) known.emplace_back(check.id);
    for (const scenarios::Measure& measure : scenarios::measures()) known.push_back(measure.name);
    for (std::string& name : scenarios::theory_names()) known.push_back(std::move(name));
    for (std::string& path : scenarios::study_key_paths(*context.laws)) {
      const std::size_t dot = path.rfind('.');
      if (dot != std::string::npos) known.push_back(path.substr(dot + 1));
      if (path.ends_with(".<name>")) known.push_back(path.substr(0, dot));  // of things with names the section
      known.push_back(std::move(path));
    }
    for (std::string& name : observable_names({}, *context.laws)) known.push_back(std::move(name));
    const std::string near = scenarios::suggest(options.id, known);
    const bool suggestion = near.rfind("did you mean", 0) == 0;
    return Error{
        ErrorKind::kInput, "nothing is known of '" + options.id + "'",
        suggestion
            ? near
            : "a key such as `time.end`, a law such as `jkr`, or a code such as `E203`; `morula explain --markdown study` lists all keys"};
  }
  context.console.result(text);
  return {};
}

}  // namespace morula::app
