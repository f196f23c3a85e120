#include "app/measures.h"

#include <ranges>

#include "app/words.h"
#include "core/numbers/joined.h"
#include "scenarios/measures/measures.h"
#include "scenarios/measures/theories.h"

namespace morula::app {
namespace {

using scenarios::Measure;
using scenarios::MeasureOf;
using scenarios::Theory;

const char* of_words(MeasureOf of) {
  switch (of) {
    case MeasureOf::kRun:
      return "the run as a whole";
    case MeasureOf::kCells:
      return "cells: `type`, or `cell` (an id, or `all`)";
    case MeasureOf::kField:
      return "cells and a field: `type` and `field`";
    case MeasureOf::kPair:
      return "two cells: `pair`, or one `type` with two cells";
    case MeasureOf::kContact:
      return "two cells: `pair`, or one `type` with two cells; or cells on an obstacle: `type` and `obstacle`";
    case MeasureOf::kLoad:
      return "a `load`";
    case MeasureOf::kObstacle:
      return "an `obstacle`";
  }
  return "";
}

std::string unit_of(const Measure& measure) {
  const std::string unit(describe(measure.quantity).internal_unit);
  return unit.empty() ? "1" : unit;
}

std::string text_of(const Measure& m) {
  std::string out = m.name + ": " + m.title + " [" + unit_of(m) + "]\n  " + m.doc + "\n  of:       " + of_words(m.of) + "\n";
  if (!m.formula.empty()) out += "  formula:  " + m.formula + "\n";
  if (!m.source.empty()) out += "  source:   " + m.source + "\n";
  const auto about = [&](const Theory& theory) { return theory.is_about(m.name); };
  const std::string known = joined(scenarios::theories() | std::views::filter(about), &Theory::name);
  if (!known.empty()) out += "  theories: " + known + "\n";
  return out;
}

std::string text_of(const Theory& t) {
  return t.name + ": " + t.title + "\n  " + t.doc + "\n  formula:  " + t.formula + "\n  source:   " + t.source +
         "\n  predicts: " + t.predictions() + "\n";
}

std::string in_cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.replace(at, 1, "\\|");
  return text;
}

}  // namespace

std::string explain_measure(const std::string& name) {
  std::string out;
  if (name == "measures") {
    std::vector<std::vector<std::string>> rows{{"measure", "unit", "what"}};
    for (const Measure& m : scenarios::measures()) rows.push_back({m.name, unit_of(m), m.title});
    return table_text(rows) + "and every column of series.csv: `morula explain output.series`\n";
  }
  if (name == "theories") {
    std::vector<std::vector<std::string>> rows{{"theory", "what", "predicts"}};
    for (const Theory& t : scenarios::theories()) rows.push_back({t.name, t.title, t.predictions()});
    return table_text(rows);
  }
  for (const Measure& m : scenarios::measures())
    if (m.name == name) out += text_of(m);
  if (const Theory* theory = scenarios::find_theory(name)) out += text_of(*theory);
  return out;
}

std::string measure_reference() {
  std::string out =
      "# Measures and theories\n\nGenerated from their declarations (`scenarios/measures/`); do not edit. How a study uses them: "
      "[criteria.md](criteria.md). Every column of series.csv is a measure, too, by its name.\n\n## Measures\n\n"
      "| measure | unit | what | formula | of |\n|---|---|---|---|---|\n";
  for (const Measure& m : scenarios::measures())
    out += "| `" + m.name + "` | " + unit_of(m) + " | " + in_cell(m.doc) + " | " + in_cell(m.formula) + " | " + of_words(m.of) + " |\n";
  out += "\n## Theories\n\n| theory | what | formula | predicts | source |\n|---|---|---|---|---|\n";
  for (const Theory& t : scenarios::theories())
    out += "| `" + t.name + "` | " + in_cell(t.doc) + " | " + in_cell(t.formula) + " | " + t.predictions() + " | " + in_cell(t.source) +
           " |\n";
  return out;
}

}  // namespace morula::app
