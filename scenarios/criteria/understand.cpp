#include "scenarios/criteria/understand.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "results/observables/select_observables.h"
#include "scenarios/criteria/words.h"
#include "scenarios/measures/measures.h"
#include "study/read_section.h"

namespace morula::scenarios {
namespace {

/// A name for files from the words of measures: "force(pull)" -> "force_pull".
std::string file_name(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool good = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-';
    if (good)
      out += c;
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out;
}

/// Everything that makes two criteria of one id two questions.
std::string words_of(const Criterion& c) {
  std::string out = c.id.value;
  for (const auto* one : {&c.of.type, &c.of.load, &c.of.obstacle, &c.of.field, &c.of.pair}) out += "|" + one->text;
  for (const auto* one :
       {&c.measure, &c.of.cell, &c.moments.at, &c.moments.over_time, &c.moments.over_cells, &c.against.theory, &c.against.value,
        &c.against.measure, &c.against.data, &c.over.theory, &c.over.value, &c.over.measure, &c.along, &c.curve})
    out += "|" + one->text;
  for (const auto* limit : {&c.below, &c.above})
    out += std::string("|") + (!limit->given ? "" : is_word(limit->value) ? limit->value : "a number");
  return out + "|" + c.moments.from.text + "|" + c.moments.until.text;
}

/// Of what a question finds, after all that is made of it.
Dimension dimension_of(const Question& q) {
  static const std::set<std::string> numbers{"growth", "change", "left", "rising", "falling"};
  if (q.over.kind == Expectation::Kind::kMeasure || q.curve == "r_squared" || q.curve == "relative_intercept") return {};
  if (numbers.contains(q.over_time)) return {Quantity::kFraction, false};
  if (q.over.kind != Expectation::Kind::kNone) return {Quantity::kNumber, q.over_time == "slope"};
  return {q.measured.measure.quantity, q.over_time == "slope"};
}

/// What lies along, of the measured things where it names none. E410, E412.
bool find_along(const Study& study, const Criterion& c, Question& q, Diagnostics& diagnostics) {
  if (!c.along.given || c.along.value.empty()) {
    if (q.curve.empty()) return true;
    diagnostics.error(414, c.curve.place, "'curve' needs `along`: what is the measure a curve over?", "for example `along: force`");
    return false;
  }
  q.along_of_thing = c.along.value.find('(') == std::string::npos;
  const std::size_t things = c.measure.value.find('(');
  const auto along = find_measure(study, c.along.value);
  const bool take_over = q.along_of_thing && things != std::string::npos && along && along->of != MeasureOf::kRun;
  q.along = find_call(study, c.along.value + (take_over ? c.measure.value.substr(things) : ""), c.along.place,
                      q.along_of_thing && along && along->of != MeasureOf::kRun ? &c.of : nullptr, diagnostics);
  if (!q.along) return false;
  if (!q.along_of_thing || q.along->measure.of == MeasureOf::kRun || q.along->measure.of == q.measured.measure.of) return true;
  diagnostics.error(412, c.along.place, "'" + c.along.value + "' is not taken of the things that '" + c.measure.value + "' is of",
                    "name the thing: `measure(thing)`");
  return false;
}

std::optional<Question> twice_named(const Criterion& c, const Place& place, Diagnostics& diagnostics) {
  diagnostics.error(412, place, "'" + c.measure.value + "' says of what it is, and `of` says it once more", "keep one of them");
  return std::nullopt;
}

/// Whether nothing is asked that the question has no place for: what lies along where nothing is read there, several cells of what is none, and what is made of
/// a course where a curve takes it whole. E414.
bool has_a_place_for_all(const Criterion& c, const Question& q, Diagnostics& diagnostics) {
  const auto wrong = [&](const Place& place, const std::string& what, const std::string& help) {
    diagnostics.error(414, place, what, help);
    return false;
  };
  if (q.along && q.curve.empty() && !c.against.data.given)
    return wrong(c.along.place, "nothing is read along '" + c.along.value + "'", "`curve`, or `against: {data: ...}`; else leave it out");
  if (q.over_cells != "each" && q.measured.measure.of == MeasureOf::kRun)
    return wrong(c.moments.over_cells.place, "'" + c.measure.value + "' is of the run as a whole, not of cells", "leave `over_cells` out");
  for (const auto* made : {&c.moments.over_cells, &c.moments.over_time})
    if (made->value != "each" && !q.curve.empty())
      return wrong(made->place, "`curve: " + q.curve + "` is of all cells and moments: nothing else is made of them", "keep one of them");
  return true;
}

std::optional<Question> question_of(const Study& study, const Criterion& c, Diagnostics& diagnostics) {
  Question out;
  out.together = c.of.together.value;
  out.over_time = c.moments.over_time.value;
  out.over_cells = c.moments.over_cells.value;
  out.curve = c.curve.value;
  const bool for_along = c.along.given && c.along.value.find('(') == std::string::npos;
  const bool named = c.measure.value.find('(') != std::string::npos && !for_along;
  for (const auto* one : {&c.of.type, &c.of.load, &c.of.obstacle, &c.of.field, &c.of.pair})
    if (named && one->given) return twice_named(c, one->place, diagnostics);
  if (named && c.of.cell.given) return twice_named(c, c.of.cell.place, diagnostics);
  auto call = find_call(study, c.measure.value, c.measure.place, &c.of, diagnostics);
  const auto moments = moments_of(study, c.moments, diagnostics);
  if (!call || !moments) return std::nullopt;
  out.measured = std::move(*call);
  out.moments = *moments;
  const Subject& first = out.measured.subjects.front();
  if (out.moments.of_thing && first.load < 0 && first.obstacle < 0) {
    diagnostics.error(416, c.moments.at.place, "'" + c.measure.value + "' is of no load or obstacle that rests", "write `at: holds(load)`");
    return std::nullopt;
  }
  if (out.measured.measure.of_a_course && out.moments.moments.is_one()) {
    diagnostics.error(416, c.moments.at.given ? c.moments.at.place : c.measure.place,
                      "'" + c.measure.value + "' is found from the first to the last of several moments, and this is one",
                      "`at: every`, or `from` and `until`");
    return std::nullopt;
  }
  if (!find_along(study, c, out, diagnostics) || !has_a_place_for_all(c, out, diagnostics)) return std::nullopt;
  const Dimension own{out.measured.measure.quantity, false};
  auto over = expectation_of(study, c.over, {{&out.measured}, own, Quantity::kTime, true, "over"}, c.id.place, diagnostics);
  if (!over) return std::nullopt;
  if (over->kind == Expectation::Kind::kData) {
    diagnostics.error(414, c.over.data.place, "a measure is not divided by data", "hold it `against` them");
    return std::nullopt;
  }
  out.over = std::move(*over);
  return out;
}

}  // namespace

std::optional<UnderstoodCriterion> understand(const Study& study, const Criterion& c, Diagnostics& diagnostics) {
  UnderstoodCriterion out;
  out.id = c.id.value;
  out.text = c.text.value;
  auto question = question_of(study, c, diagnostics);
  if (!question) return std::nullopt;
  out.question = std::move(*question);
  const Dimension dimension = dimension_of(out.question);
  const Quantity along = out.question.along ? out.question.along->measure.quantity : Quantity::kTime;
  const auto limit = limit_of(study, c, dimension, diagnostics);
  Comparison comparison{{&out.question.measured}, dimension, along};
  if (out.question.over.kind == Expectation::Kind::kNone && out.question.curve.empty())
    comparison.of_data = out.question.measured.measure.quantity;
  const auto expected = expectation_of(study, c.against, comparison, c.id.place, diagnostics);
  if (!limit || !expected) return std::nullopt;
  out.limit = *limit;
  out.expected = *expected;
  const bool rms = out.question.curve == "rms";
  if (rms && (out.expected.kind != Expectation::Kind::kData || out.limit.relative)) {
    diagnostics.error(414, c.curve.place, "`curve: rms` is how near a curve is to data, in the unit of the measure",
                      "`against: {data: ...}`, and `within` with a unit");
    return std::nullopt;
  }
  if (out.limit.kind == MeasureLimit::Kind::kWithin && out.limit.other && !rms) {
    diagnostics.error(414, c.within.place, "`within` is another measure with `curve: rms` only: as near to the data as that one is",
                      "`within` as a number in the unit of the measure, or relative in %");
    return std::nullopt;
  }
  if (out.limit.relative && out.expected.kind == Expectation::Kind::kValue && out.expected.value.internal == 0.0) {
    diagnostics.error(414, c.within.place, "'" + c.within.value + "' of nothing is nothing: the criterion could not hold",
                      "`within` as a number in the unit of the measure");
    return std::nullopt;
  }
  if (out.question.is_pooled() && out.expected.kind == Expectation::Kind::kTheory && out.question.measured.subjects.size() > 1) {
    diagnostics.error(413, c.id.place, "a theory is about each thing by itself, and here several are made into one value",
                      "divide by it: `over`");
    return std::nullopt;
  }
  return out;
}

std::optional<UnderstoodPlot> understand(const Study& study, const StudyPlot& p, Diagnostics& diagnostics) {
  UnderstoodPlot out;
  out.title = p.title.value;
  out.source = p.against.source.value;
  out.over_cells = p.moments.over_cells.value;
  const auto moments = moments_of(study, p.moments, diagnostics);
  if (!moments) return std::nullopt;
  out.moments = *moments;
  if (p.x.value != "time") {
    out.x = find_call(study, p.x.value, p.x.place, &p.of, diagnostics);
    if (!out.x) return std::nullopt;
  }
  std::vector<const MeasureCall*> calls;
  std::string words;
  for (const std::string& text : p.y.value) {
    auto call = find_call(study, text, p.y.place, &p.of, diagnostics);
    if (!call) return std::nullopt;
    if (!out.y.empty() && call->measure.quantity != out.y.front().measure.quantity) {
      diagnostics.error(412, p.y.place, "'" + text + "' has another unit than '" + p.y.value.front() + "'", "make two plots of them");
      return std::nullopt;
    }
    words += (words.empty() ? "" : "_") + text;
    out.y.push_back(std::move(*call));
  }
  if (out.y.empty()) return std::nullopt;
  for (const MeasureCall& call : out.y) calls.push_back(&call);
  out.name = p.name.given ? p.name.value : file_name(out.x ? words + "_over_" + p.x.value : words);
  if (!is_name(out.name)) {
    diagnostics.error(112, p.name.given ? p.name.place : p.y.place, "'" + out.name + "' cannot be the name of a plot", kNameHelp);
    return std::nullopt;
  }
  const Quantity x = out.x ? out.x->measure.quantity : Quantity::kTime;
  const auto expected = expectation_of(study, p.against, {calls, {out.y.front().measure.quantity, false}, x}, p.y.place, diagnostics);
  if (!expected) return std::nullopt;
  out.expected = *expected;
  return out;
}

void check_criteria(const Study& study, Diagnostics& diagnostics) {
  if (const auto columns = select_observables(study.model, *study.laws, {}); !columns.ok())
    diagnostics.error(112, Place(), columns.error().message, columns.error().help);
  std::set<std::string> asked, plots;
  for (const Criterion& c : study.criteria) {
    if (!asked.insert(words_of(c)).second)
      diagnostics.error(415, c.id.place, "criterion '" + c.id.value + "' stands twice",
                        "give each question its own id, or measure different things under one");
    (void)understand(study, c, diagnostics);
  }
  for (const StudyPlot& p : study.plots) {
    const auto plot = understand(study, p, diagnostics);
    if (plot && !plots.insert(plot->name).second)
      diagnostics.error(415, p.name.given ? p.name.place : p.y.place, "two plots are called '" + plot->name + "'", "give each a `name`");
  }
}

std::vector<std::string> series_columns(const Study& study) {
  std::vector<std::string> out;
  Diagnostics ignored;
  const auto add = [&](const MeasureCall& call) {
    if (!call.measure.columns) return;
    for (const Subject& subject : call.subjects)
      for (const std::string& column : call.measure.columns(study, subject))
        if (std::find(out.begin(), out.end(), column) == out.end()) out.push_back(column);
  };
  for (const Criterion& c : study.criteria) {
    const auto found = understand(study, c, ignored);
    if (!found) continue;
    add(found->question.measured);
    if (found->question.along) add(*found->question.along);
    if (found->question.over.measure) add(*found->question.over.measure);
    if (found->expected.measure) add(*found->expected.measure);
    if (found->limit.other) add(*found->limit.other);
  }
  for (const StudyPlot& p : study.plots) {
    const auto found = understand(study, p, ignored);
    if (!found) continue;
    if (found->x) add(*found->x);
    for (const MeasureCall& call : found->y) add(call);
    if (found->expected.measure) add(*found->expected.measure);
  }
  return out;
}

}  // namespace morula::scenarios
