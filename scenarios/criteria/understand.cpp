#include "scenarios/criteria/understand.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "core/numbers/decimal_number.h"
#include "results/series_reader.h"
#include "study/quantity_reader.h"
#include "study/read_section.h"

namespace morula::scenarios {
namespace {

/// The dimension of a measure, or of its slope over time.
struct Dimension {
  Quantity quantity = Quantity::kNumber;
  bool per_time = false;
};

std::string trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return std::string(text);
}

/// A number with a unit of this dimension; a slope has that of the measure over one of time: `2 um/h`.
std::optional<WrittenNumber> number_of(const std::string& text, Dimension of, const char* key, const Place& place,
                                       Diagnostics& diagnostics) {
  const UnitSystem units;
  const DecimalNumber decimal = read_decimal_number(text);
  WrittenNumber out;
  out.number = static_cast<double>(decimal.value);
  out.unit = trimmed(std::string_view(text).substr(decimal.length));
  std::string part = text;
  Quantity quantity = of.quantity;
  const bool plain = quantity == Quantity::kNumber || quantity == Quantity::kFraction;
  double over = 1.0;
  if (of.per_time && plain) {
    quantity = Quantity::kRate;
  } else if (of.per_time) {
    const std::size_t slash = out.unit.rfind('/');
    const auto time = units.factor(slash == std::string::npos ? "" : out.unit.substr(slash + 1), Quantity::kTime);
    if (!time.ok()) {
      diagnostics.error(203, place,
                        std::string("'") + key + "' is " + std::string(describe(quantity).name) + " per time, but '" + text + "' is not",
                        "for example `" + std::string(describe(quantity).example) + "/h`");
      return std::nullopt;
    }
    over = *time;
    part = text.substr(0, decimal.length) + " " + out.unit.substr(0, slash);
  }
  const auto value = read_quantity(units, part, quantity, key, "", place, diagnostics);
  if (!value) return std::nullopt;
  const std::string unit = of.per_time && !plain ? out.unit.substr(0, out.unit.rfind('/')) : out.unit;
  if (!unit.empty())
    if (const auto factor = units.factor(unit, quantity); factor.ok()) out.factor = *factor;
  out.factor /= over;
  out.internal = *value / over;
  return out;
}

/// Whether a text is a measure and not a number: `volume(left)`.
bool is_word(const std::string& text) { return !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) != 0; }

bool is_output(const Study& study, double time) {
  const double outputs = time / study.time.output;
  return time == study.time.end || (time <= study.time.end && std::abs(outputs - std::round(outputs)) < 1e-6);
}

std::optional<Moments> moments_of(const Study& study, const MeasuredMoments& m, Diagnostics& diagnostics) {
  Moments out;
  if (m.from.given || m.until.given) {
    if (m.at.given) {
      diagnostics.error(416, m.at.place, "'at' and 'from', 'until' say the same", "keep one of them");
      return std::nullopt;
    }
    out = {Moments::Kind::kBetween, m.from.value, m.until.given ? m.until.value : kNever};  // a run may be prolonged
    const double end = m.until.given ? m.until.value : study.time.end;
    if (out.from <= end && end <= study.time.end) return out;
    diagnostics.error(416, m.from.given ? m.from.place : m.until.place, "'from' is later than 'until', or 'until' than the run's end", "");
    return std::nullopt;
  }
  const std::string& at = m.at.value;
  if (at == "end") return out;
  if (at == "start") return Moments{Moments::Kind::kStart};
  if (at == "every") return Moments{Moments::Kind::kBetween, 0.0, kNever};
  const auto time = read_quantity(UnitSystem(), at, Quantity::kTime, "at", "6 h", m.at.place, diagnostics);
  if (!time) return std::nullopt;
  if (is_output(study, *time)) return Moments{Moments::Kind::kBetween, *time, *time};
  diagnostics.error(416, m.at.place, "the run writes nothing at " + at, "a multiple of `time.output` up to `time.end`");
  return std::nullopt;
}

/// The columns of a file, in internal units. The unit of x is that of `x`, that of y of `y`.
bool read_data(const ExpectedValue& against, Quantity x, Quantity y, Expectation& out, Diagnostics& diagnostics) {
  const auto wrong = [&](const std::string& what, const std::string& help) {
    diagnostics.error(417, against.data.place, what, help);
    return false;
  };
  const auto table = read_series(against.data.value);
  if (!table.ok()) return wrong(table.error().message, table.error().help);
  if (!against.y.given) return wrong("'y' is missing: which column of the file is compared?", "");
  std::vector<std::string> names;
  for (const SeriesColumn& column : table->columns) names.push_back(column.name);
  const UnitSystem units;
  const auto take = [&](const Given<std::string>& name, Quantity quantity, std::vector<double>& into) {
    const SeriesColumn* const column = table->find(name.value);
    if (column == nullptr) return wrong("the file has no column '" + name.value + "'", suggest(name.value, names));
    const bool plain = quantity == Quantity::kNumber || quantity == Quantity::kFraction;
    double factor = 1.0;
    if (!plain || (!column->unit.empty() && column->unit != "1")) {
      const auto read = units.factor(column->unit, quantity);
      if (!read.ok())
        return wrong(
            "column '" + name.value + "' has the unit '" + column->unit + "', but is compared with " + std::string(describe(quantity).name),
            "the header gives each column as `name [unit]`");
      factor = *read;
    }
    for (const double value : column->values) into.push_back(value * factor);
    return true;
  };
  if (!take(against.x, x, out.xs) || !take(against.y, y, out.ys)) return false;
  if (!std::is_sorted(out.xs.begin(), out.xs.end()) || out.xs.empty())
    return wrong("column '" + against.x.value + "' does not increase", "");
  out.kind = Expectation::Kind::kData;
  out.text = against.source.given ? against.source.value : "data";
  return true;
}

bool find_theory_of(const Study& study, const Given<std::string>& name, const std::vector<const MeasureCall*>& calls, Expectation& out,
                    Diagnostics& diagnostics) {
  out.theory = find_theory(name.value);
  if (out.theory == nullptr) {
    diagnostics.error(411, name.place, "there is no theory '" + name.value + "'", suggest(name.value, theory_names()));
    return false;
  }
  out.kind = Expectation::Kind::kTheory;
  out.text = out.theory->title;
  for (const MeasureCall* call : calls) {
    if (!out.theory->is_about(call->measure.name)) {
      std::string known;
      for (const std::string& one : out.theory->predicts) known += (known.empty() ? "" : ", ") + one + (one.ends_with('_') ? "<name>" : "");
      diagnostics.error(413, name.place, "'" + name.value + "' says nothing about '" + call->measure.name + "'", "it predicts " + known);
      return false;
    }
    for (const Subject& subject : call->subjects)
      if (const Status fits = out.theory->fits(study, subject, call->measure.name); !fits.ok()) {
        diagnostics.error(413, name.place,
                          "'" + name.value + "' " + fits.error().message + (subject.text.empty() ? "" : " (here: " + subject.text + ")"),
                          fits.error().help);
        return false;
      }
  }
  return true;
}

/// A measure that others are compared with is of one thing, and of the same dimension.
std::optional<MeasureCall> compared_measure(const Study& study, const Given<std::string>& text, const Measure& with,
                                            Diagnostics& diagnostics) {
  auto call = find_call(study, text.value, text.place, nullptr, diagnostics);
  if (!call) return std::nullopt;
  if (call->measure.quantity != with.quantity) {
    diagnostics.error(203, text.place,
                      "'" + call->measure.name + "' is " + std::string(describe(call->measure.quantity).name) + ", but '" + with.name +
                          "' is " + std::string(describe(with.quantity).name),
                      "");
    return std::nullopt;
  }
  return call;
}

/// `calls`: the measures that are compared, all of one quantity. `x`: what data lie along.
std::optional<Expectation> expectation_of(const Study& study, const ExpectedValue& against, const std::vector<const MeasureCall*>& calls,
                                          Dimension dimension, Quantity x, const Place& place, Diagnostics& diagnostics) {
  Expectation out;
  if (!against.present) return out;
  const int given = against.value.given + against.theory.given + against.measure.given + against.data.given;
  if (given != 1) {
    diagnostics.error(414, place, given == 0 ? "`against` names nothing" : "`against` names several things",
                      "one of `value`, `theory`, `measure`, `data`");
    return std::nullopt;
  }
  if (against.value.given) {
    const auto number = number_of(against.value.value, dimension, "against", against.value.place, diagnostics);
    if (!number) return std::nullopt;
    out.kind = Expectation::Kind::kValue;
    out.value = *number;
    out.text = against.value.value;
    return out;
  }
  if (against.theory.given) return find_theory_of(study, against.theory, calls, out, diagnostics) ? std::optional(out) : std::nullopt;
  if (against.data.given) return read_data(against, x, dimension.quantity, out, diagnostics) ? std::optional(out) : std::nullopt;
  out.measure = compared_measure(study, against.measure, calls.front()->measure, diagnostics);
  out.kind = Expectation::Kind::kMeasure;
  out.text = against.measure.value;
  return out.measure ? std::optional(out) : std::nullopt;
}

/// A percentage is relative, whatever the measure is.
bool is_relative(const std::string& text) { return text.ends_with('%'); }

std::optional<MeasureLimit> limit_of(const Study& study, const Criterion& c, const Measure& measure, Dimension dimension,
                                     Diagnostics& diagnostics) {
  const int given = c.within.given + c.below.given + c.above.given + c.between.given;
  if (given != 1 || c.within.given != c.against.present) {
    const bool alone = c.within.given != c.against.present && given <= 1;
    diagnostics.error(
        414, c.id.place,
        alone ? "criterion '" + c.id.value + "' has " + (c.within.given ? "`within` without `against`" : "`against` without `within`")
        : given == 0 ? "criterion '" + c.id.value + "' has no limit"
                     : "criterion '" + c.id.value + "' has more than one limit",
        "`against` with `within`, or `below`, `above` or `between`");
    return std::nullopt;
  }
  MeasureLimit out;
  const auto read = [&](const Given<std::string>& text, const char* key, WrittenNumber& into) {
    if (is_word(text.value)) return static_cast<bool>(out.other = compared_measure(study, text, measure, diagnostics));
    const auto number = number_of(text.value, dimension, key, text.place, diagnostics);
    if (number) into = *number;
    return number.has_value();
  };
  if (c.within.given) {
    out.kind = MeasureLimit::Kind::kWithin;
    out.relative = is_relative(c.within.value);
    const auto number =
        number_of(c.within.value, out.relative ? Dimension{Quantity::kFraction, false} : dimension, "within", c.within.place, diagnostics);
    if (!number) return std::nullopt;
    out.high = *number;
    if (out.relative) out.high = {number->internal, number->internal, 1.0, ""};
    return out;
  }
  if (c.between.given) {
    out.kind = MeasureLimit::Kind::kBetween;
    if (c.between.value.size() != 2) {
      diagnostics.error(303, c.between.place, "'between' has " + std::to_string(c.between.value.size()) + " numbers, but needs 2", "");
      return std::nullopt;
    }
    const auto low = number_of(c.between.value[0], dimension, "between", c.between.place, diagnostics);
    const auto high = number_of(c.between.value[1], dimension, "between", c.between.place, diagnostics);
    if (!low || !high) return std::nullopt;
    if (low->internal > high->internal) {
      diagnostics.error(414, c.between.place, "the first number of 'between' is the larger one", "");
      return std::nullopt;
    }
    out.low = *low;
    out.high = *high;
    return out;
  }
  out.kind = c.below.given ? MeasureLimit::Kind::kBelow : MeasureLimit::Kind::kAbove;
  const bool good = c.below.given ? read(c.below, "below", out.high) : read(c.above, "above", out.low);
  return good ? std::optional(out) : std::nullopt;
}

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
std::string question_of(const Criterion& c) {
  std::string out = c.id.value;
  for (const auto* one : {&c.of.type, &c.of.load, &c.of.obstacle, &c.of.field, &c.of.pair}) out += "|" + one->text;
  for (const auto* one : {&c.measure, &c.of.cell, &c.moments.at, &c.moments.over_time, &c.moments.over_cells, &c.against.theory,
                          &c.against.value, &c.against.measure, &c.against.data})
    out += "|" + one->text;
  for (const auto* limit : {&c.below, &c.above})
    out += std::string("|") + (!limit->given ? "" : is_word(limit->value) ? limit->value : "a number");
  return out + "|" + c.moments.from.text + "|" + c.moments.until.text;
}

}  // namespace

std::optional<UnderstoodCriterion> understand(const Study& study, const Criterion& c, Diagnostics& diagnostics) {
  UnderstoodCriterion out{c.id.value, c.text.value, {}, {}, c.moments.over_time.value, c.moments.over_cells.value, {}, {}};
  auto call = find_call(study, c.measure.value, c.measure.place, &c.of, diagnostics);
  const auto moments = moments_of(study, c.moments, diagnostics);
  if (!call || !moments) return std::nullopt;
  out.measured = std::move(*call);
  out.moments = *moments;
  const bool growth = out.over_time == "growth";  // a ratio, whatever is measured
  const Dimension dimension{growth ? Quantity::kFraction : out.measured.measure.quantity, out.over_time == "slope"};
  const auto limit = limit_of(study, c, out.measured.measure, dimension, diagnostics);
  const auto expected = expectation_of(study, c.against, {&out.measured}, dimension, Quantity::kTime, c.id.place, diagnostics);
  if (!limit || !expected) return std::nullopt;
  out.limit = *limit;
  out.expected = *expected;
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
    diagnostics.error(112, p.name.given ? p.name.place : p.y.place, "'" + out.name + "' cannot be the name of a plot",
                      "names begin with a letter and hold letters, digits, `_` and `-`");
    return std::nullopt;
  }
  const Quantity x = out.x ? out.x->measure.quantity : Quantity::kTime;
  const auto expected = expectation_of(study, p.against, calls, {out.y.front().measure.quantity, false}, x, p.y.place, diagnostics);
  if (!expected) return std::nullopt;
  out.expected = *expected;
  return out;
}

void check_criteria(const Study& study, Diagnostics& diagnostics) {
  std::set<std::string> asked, of_scenario, own, plots;
  for (const Criterion& c : study.criteria) (c.is_of_scenario() ? of_scenario : own).insert(c.id.value);
  for (const Criterion& c : study.criteria) {
    const bool known = !c.is_of_scenario() && of_scenario.contains(c.id.value);
    if (!asked.insert(question_of(c)).second || known)
      diagnostics.error(415, c.id.place,
                        "criterion '" + c.id.value + "' stands twice" + (known ? ": by its id alone it is one of the scenario" : ""),
                        "give each question its own id, or measure different things under one");
    if (!c.is_of_scenario()) {
      (void)understand(study, c, diagnostics);
    } else if (c.of.present || c.against.present || c.within.given || c.below.given || c.above.given || c.between.given) {
      diagnostics.error(414, c.id.place, "criterion '" + c.id.value + "' has no `measure`",
                        "say what is measured, or give the id alone for a criterion of the scenario");
    }
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
    const auto found = c.is_of_scenario() ? std::nullopt : understand(study, c, ignored);
    if (!found) continue;
    add(found->measured);
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
