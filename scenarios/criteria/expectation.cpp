// What measures are held against, and within which limits.
#include <algorithm>
#include <cmath>

#include "results/series_reader.h"
#include "scenarios/criteria/words.h"

namespace morula::scenarios {
namespace {

/// Rows of a table that lack one of both values are left out.
void leave_out_empty(Expectation& data) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < data.xs.size(); ++i) {
    if (std::isnan(data.xs[i]) || std::isnan(data.ys[i])) continue;
    data.xs[kept] = data.xs[i];
    data.ys[kept++] = data.ys[i];
  }
  data.xs.resize(kept);
  data.ys.resize(kept);
}

/// The columns of a file, in internal units. The unit of x is that of `x`, that of y of `y`.
bool read_data(const ExpectedValue& against, Quantity x, Quantity y, Expectation& out, Diagnostics& diagnostics) {
  const auto wrong = [&](const std::string& what, const std::string& help) {
    diagnostics.error(417, against.data.place, what, help);
    return false;
  };
  const auto table = read_series(against.data.value, LastLine::kWhole);
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
  leave_out_empty(out);
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
      diagnostics.error(413, name.place, "'" + name.value + "' says nothing about '" + call->measure.name + "'",
                        "it predicts " + out.theory->predictions());
      return false;
    }
    for (const Subject& subject : call->subjects) {
      const std::string here = subject.text.empty() ? "" : " (here: " + subject.text + ")";
      if (const Status fits = out.theory->fits(study, subject, call->measure.name); !fits.ok()) {
        diagnostics.error(413, name.place, "'" + name.value + "' " + fits.error().message + here, fits.error().help);
        return false;
      }
      if (const std::string doubt = out.theory->doubt ? out.theory->doubt(study, subject) : ""; !doubt.empty())
        diagnostics.warning(413, name.place, "'" + name.value + "' " + doubt + here, "");
    }
  }
  return true;
}

/// A percentage is relative, whatever the measure is.
bool is_relative(const std::string& text) { return text.ends_with('%'); }

}  // namespace

std::optional<MeasureCall> compared_measure(const Study& study, const Given<std::string>& text, Quantity quantity, bool several,
                                            Diagnostics& diagnostics) {
  auto call = find_call(study, text.value, text.place, nullptr, diagnostics);
  if (!call) return std::nullopt;
  if (call->measure.quantity != quantity) {
    diagnostics.error(203, text.place,
                      "'" + call->measure.name + "' is " + std::string(describe(call->measure.quantity).name) +
                          ", but it is compared with " + std::string(describe(quantity).name),
                      "");
    return std::nullopt;
  }
  if (call->subjects.size() > 1 && !several) {
    diagnostics.error(412, text.place, "'" + text.value + "' is of several things, but one is compared with", "name one thing");
    return std::nullopt;
  }
  return call;
}

std::optional<Expectation> expectation_of(const Study& study, const ExpectedValue& against, const Comparison& comparison,
                                          const Place& place, Diagnostics& diagnostics) {
  Expectation out;
  if (!against.present) return out;
  const int given = against.value.given + against.theory.given + against.measure.given + against.data.given;
  if (given != 1) {
    diagnostics.error(414, place, given == 0 ? "nothing is named to compare with" : "several things are named to compare with",
                      "one of `value`, `theory`, `measure`, `data`");
    return std::nullopt;
  }
  if (against.value.given) {
    const auto number = number_of(against.value.value, comparison.dimension, comparison.key, against.value.place, diagnostics);
    if (!number) return std::nullopt;
    out.kind = Expectation::Kind::kValue;
    out.value = *number;
    out.text = against.value.value;
    return out;
  }
  if (against.theory.given)
    return find_theory_of(study, against.theory, comparison.measures, out, diagnostics) ? std::optional(out) : std::nullopt;
  if (against.data.given)
    return read_data(against, comparison.along, comparison.of_data.value_or(comparison.dimension.quantity), out, diagnostics)
               ? std::optional(out)
               : std::nullopt;
  out.measure = compared_measure(study, against.measure, comparison.dimension.quantity, comparison.several, diagnostics);
  out.kind = Expectation::Kind::kMeasure;
  out.text = against.measure.value;
  return out.measure ? std::optional(out) : std::nullopt;
}

std::optional<MeasureLimit> limit_of(const Study& study, const Criterion& c, Dimension dimension, Diagnostics& diagnostics) {
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
    if (is_word(text.value)) return static_cast<bool>(out.other = compared_measure(study, text, dimension.quantity, false, diagnostics));
    const auto number = number_of(text.value, dimension, key, text.place, diagnostics);
    if (number) into = *number;
    return number.has_value();
  };
  if (c.within.given) {
    out.kind = MeasureLimit::Kind::kWithin;
    if (is_word(c.within.value)) return read(c.within, "within", out.high) ? std::optional(out) : std::nullopt;
    out.relative = is_relative(c.within.value);
    const auto number =
        number_of(c.within.value, out.relative ? Dimension{Quantity::kFraction, false} : dimension, "within", c.within.place, diagnostics);
    if (!number) return std::nullopt;
    if (number->internal < 0.0) {
      diagnostics.error(414, c.within.place, "'within' is " + c.within.value + ": nothing is as near as that",
                        "give it as a distance, 0 or more");
      return std::nullopt;
    }
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

}  // namespace morula::scenarios
