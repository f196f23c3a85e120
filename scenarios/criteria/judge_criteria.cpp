#include "scenarios/criteria/judge_criteria.h"

#include <algorithm>
#include <cmath>

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
  if (over_time == "first" || over_time == "last") out += ", " + over_time;
  return out;
}

/// What is asked, for people.
std::string quantity_text(const UnderstoodCriterion& c, const Subject& subject) {
  std::string out = c.text.empty() ? c.measured.measure.title : c.text;
  if (c.text.empty()) {
    if (c.limit.kind == Kind::kWithin) out += " against " + c.expected.text + (c.limit.relative ? ", relative" : "");
    if (c.limit.other) out += (c.limit.kind == Kind::kBelow ? " below " : " above ") + c.limit.other->text;
    out += words_of(c.over_time, c.over_cells);
  }
  return out + (subject.text.empty() ? "" : ", " + subject.text);
}

/// The limit as it is printed.
std::string limit_text(const MeasureLimit& limit, double other) {
  const auto text = [](const WrittenNumber& number) { return with_unit(number.number, number.unit.c_str()); };
  const std::string of_other = limit.other ? with_unit(other, describe(limit.other->measure.quantity).internal_unit.data()) : "";
  switch (limit.kind) {
    case Kind::kWithin:
      return "<= " + text(limit.high);
    case Kind::kBelow:
      return "<= " + (limit.other ? of_other : text(limit.high));
    case Kind::kAbove:
      return ">= " + (limit.other ? of_other : text(limit.low));
    case Kind::kBetween:
      return number_text("%g", limit.low.number) + " to " + text(limit.high);
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
  if (limit.kind == Kind::kWithin) {
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
  return out;
}

/// What the samples are held against: the expectation, or the measure that is the limit.
Result<std::vector<double>> references(FinishedRun& run, const UnderstoodCriterion& c, const Subject& subject,
                                       const std::vector<Sample>& samples) {
  if (!c.limit.other) return expected_values(run, c.expected, c.measured.measure, subject, samples, c.moments, c.over_time);
  Expectation other;
  other.kind = Expectation::Kind::kMeasure;
  other.measure = c.limit.other;
  return expected_values(run, other, c.measured.measure, subject, samples, c.moments, c.over_time);
}

}  // namespace

Result<std::vector<Verdict>> judge_criterion(FinishedRun& run, const UnderstoodCriterion& c) {
  std::vector<Verdict> out;
  for (const Subject& subject : c.measured.subjects) {
    MORULA_TRY_ASSIGN(const std::vector<Sample> samples, measured(run, c.measured.measure, subject, c.moments, c.over_cells, c.over_time));
    MORULA_TRY_ASSIGN(const std::vector<double> expected, references(run, c, subject, samples));
    Judged worst;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const Judged one = judged(c, samples[i].value, expected[i]);
      if (i == 0 || std::isnan(one.excess) || one.excess > worst.excess) worst = one;
      if (std::isnan(worst.excess)) break;  // nothing to judge at one moment: the criterion has failed
    }
    const bool nothing = std::isnan(worst.excess);
    out.push_back(
        {c.id, quantity_text(c, subject), nothing ? kNothing : worst.value, limit_text(c.limit, worst.other), worst.excess <= 0.0});
  }
  return out;
}

Result<std::vector<Verdict>> judge_criteria(FinishedRun& run) {
  std::vector<Verdict> out;
  for (const Criterion& asked : run.study().criteria) {
    if (asked.is_of_scenario()) continue;
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
