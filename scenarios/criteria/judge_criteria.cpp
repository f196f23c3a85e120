#include "scenarios/criteria/judge_criteria.h"

#include <algorithm>
#include <cmath>

#include "core/numbers/joined.h"
#include "core/numbers/number_text.h"
#include "scenarios/measures/verdicts.h"

namespace morula::scenarios {
namespace {

using Kind = MeasureLimit::Kind;

std::string words_of(const std::string& over_time, const std::string& over_cells) {
  std::string out;
  if (over_cells == "mean") out += ", mean of the cells";
  if (over_cells == "sum") out += ", sum of the cells";
  if (over_cells == "min") out += ", least of the cells";
  if (over_cells == "max") out += ", largest of the cells";
  if (over_time == "min") out += ", least over time";
  if (over_time == "max") out += ", largest over time";
  if (over_time == "mean") out += ", mean over time";
  if (over_time == "rise") out += ", rise over time";
  if (over_time == "growth") out += ", growth over time";
  if (over_time == "slope") out += ", slope over time";
  if (over_time == "change") out += ", largest change over the first";
  if (over_time == "left") out += ", what is left over the largest";
  if (over_time == "rising" || over_time == "falling") out += ", " + over_time + " (1: yes)";
  if (over_time == "first" || over_time == "last") out += ", " + over_time;
  return out;
}

std::string words_of_curve(const Question& q) {
  const std::string over = q.curve.empty() ? "" : " over " + q.along->measure.title;
  if (q.curve == "r_squared") return ", R^2 of the straight line" + over;
  if (q.curve == "intercept") return ", straight line" + over + " at 0";
  if (q.curve == "relative_intercept") return ", straight line" + over + " at 0, over the largest";
  return q.curve == "rms" ? over + ", root mean square" : "";
}

std::string names_of(const std::vector<Subject>& things) { return joined(things, &Subject::text); }

/// What is asked, for people.
std::string quantity_text(const UnderstoodCriterion& c, const std::string& things) {
  const Question& q = c.question;
  std::string out = c.text.empty() ? q.measured.measure.title : c.text;
  if (c.text.empty()) {
    if (q.over.kind != Expectation::Kind::kNone) out += " over " + q.over.text;
    out += words_of_curve(q);
    if (c.limit.kind == Kind::kWithin) out += " against " + c.expected.text + (c.limit.relative ? ", relative" : "");
    if (c.limit.other)
      out += (c.limit.kind == Kind::kBelow ? " below " : c.limit.kind == Kind::kAbove ? " above " : ", as near as ") + c.limit.other->text;
    out += words_of(q.over_time, q.over_cells);
  }
  return out + (things.empty() ? "" : ", " + things);
}

/// The limit as it is printed.
std::string limit_text(const MeasureLimit& limit, double other) {
  const auto text = [](const WrittenNumber& number) { return with_unit(number.number, number.unit.c_str()); };
  const std::string of_other = limit.other ? with_unit(other, describe(limit.other->measure.quantity).internal_unit.data()) : "";
  switch (limit.kind) {
    case Kind::kWithin:
      return "<= " + (limit.other ? of_other : text(limit.high));
    case Kind::kBelow:
      return "<= " + (limit.other ? of_other : text(limit.high));
    case Kind::kAbove:
      return ">= " + (limit.other ? of_other : text(limit.low));
    case Kind::kBetween:
      return (limit.low.unit == limit.high.unit ? number_text("%g", limit.low.number) : text(limit.low)) + " to " + text(limit.high);
  }
  return "";
}

/// A value against its limit, both in the unit in which the limit is written. `excess`: how far it is beyond; not above 0: it passes.
struct Judged {
  double value = kNothing, excess = kNothing, other = kNothing;
};

Judged judged(const UnderstoodCriterion& c, double value, double expected) {
  const MeasureLimit& limit = c.limit;
  Judged out;
  out.other = expected;
  if (limit.kind == Kind::kWithin && limit.other) {
    out.value = value;
    out.excess = value - expected;
  } else if (limit.kind == Kind::kWithin) {
    out.value = (limit.relative ? std::abs(value / expected - 1.0) : std::abs(value - expected)) / limit.high.factor;
    out.excess = out.value - limit.high.number;
  } else if (limit.other) {
    out.value = value;
    out.excess = limit.kind == Kind::kBelow ? value - expected : expected - value;
  } else {
    const double factor = limit.kind == Kind::kAbove ? limit.low.factor : limit.high.factor;
    out.value = value / factor;
    const double above = value / limit.high.factor - limit.high.number, below = limit.low.number - value / limit.low.factor;
    out.excess = limit.kind == Kind::kBelow ? above : limit.kind == Kind::kAbove ? below : std::max(above, below);
  }
  if (!std::isfinite(out.value)) out.excess = kNothing;  // over nothing
  return out;
}

/// What the samples are held against: the expectation, or the measure that is the limit, in the same way.
Result<std::vector<double>> references(FinishedRun& run, const UnderstoodCriterion& c, const Subject& subject,
                                       const std::vector<Sample>& samples) {
  if (!c.limit.other) return expected_values(run, c.expected, c.question, subject, samples);
  const Question same = as_compared(c.question);
  MORULA_TRY_ASSIGN(const auto others, answers(run, same, *c.limit.other, c.limit.other->subjects, c.expected));
  const bool whatever_time = c.question.over_time != "each" || !c.question.curve.empty() || (samples.size() == 1 && others.size() == 1);
  std::vector<double> out;
  for (const Sample& one : samples) out.push_back(mean_at(others, one.time, whatever_time));
  return out;
}

/// The one of two that is furthest from passing; nothing to judge is further than anything.
const Judged& worse(const Judged& a, const Judged& b) { return std::isnan(a.excess) || a.excess >= b.excess ? a : b; }

/// What is furthest from passing of some things that are made into one value, or of one thing; nothing where there is nothing to measure.
Result<std::optional<Judged>> worst_of(FinishedRun& run, const UnderstoodCriterion& c, const std::vector<Subject>& things) {
  MORULA_TRY_ASSIGN(const std::vector<Sample> samples, answers(run, c.question, c.question.measured, things, c.expected));
  MORULA_TRY_ASSIGN(const std::vector<double> expected, references(run, c, things.front(), samples));
  if (samples.empty()) return std::optional<Judged>();
  Judged worst = judged(c, samples.front().value, expected.front());
  for (std::size_t i = 1; i < samples.size(); ++i) worst = worse(worst, judged(c, samples[i].value, expected[i]));
  return std::optional(worst);
}

Verdict verdict_of(const UnderstoodCriterion& c, const std::vector<Subject>& things, const Judged& worst) {
  const bool nothing = std::isnan(worst.excess);
  return {c.id, quantity_text(c, names_of(things)), nothing ? kNothing : worst.value, limit_text(c.limit, worst.other),
          worst.excess <= 0.0};
}

}  // namespace

Result<std::vector<Verdict>> judge_criterion(FinishedRun& run, const UnderstoodCriterion& c) {
  std::vector<Verdict> out;
  const std::vector<Subject>& things = c.question.measured.subjects;
  if (c.question.is_pooled()) {
    MORULA_TRY_ASSIGN(const auto worst, worst_of(run, c, things));
    return std::vector<Verdict>{verdict_of(c, things, worst.value_or(Judged{}))};
  }
  std::optional<Judged> all;
  for (const Subject& thing : things) {
    MORULA_TRY_ASSIGN(const auto worst, worst_of(run, c, {thing}));
    const Judged of_thing = worst.value_or(Judged{});
    all = all ? worse(*all, of_thing) : of_thing;
    if (!c.question.together) out.push_back(verdict_of(c, {thing}, of_thing));
  }
  if (c.question.together) out.push_back(verdict_of(c, things, all.value_or(Judged{})));
  return out;
}

Result<std::vector<Verdict>> judge_criteria(FinishedRun& run) {
  std::vector<Verdict> out;
  for (const Criterion& asked : run.study().criteria) {
    Diagnostics problems;
    const auto understood = understand(run.study(), asked, problems);
    if (!understood) {
      out.push_back({asked.id.value, "cannot be judged: " + problems.as_error().message, kNothing, "a measure that exists", false});
      continue;
    }
    MORULA_TRY_ASSIGN(std::vector<Verdict> found, judge_criterion(run, *understood));
    std::move(found.begin(), found.end(), std::back_inserter(out));
  }
  return out;
}

}  // namespace morula::scenarios
