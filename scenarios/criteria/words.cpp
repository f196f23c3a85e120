// Numbers and moments as studies write them.
#include "scenarios/criteria/words.h"

#include <cctype>
#include <cmath>

#include "core/numbers/decimal_number.h"
#include "scenarios/measures/holds.h"
#include "study/quantity_reader.h"

namespace morula::scenarios {
namespace {

std::string trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return std::string(text);
}

/// Whether the run writes anything from one time to another. [s]
bool has_output(const Study& study, double from, double until) {
  if (until >= study.time.end) return from <= study.time.end;
  constexpr double kRounding = 1e-6;  // of an interval
  return std::ceil(from / study.time.output - kRounding) * study.time.output <= until + kRounding * study.time.output;
}

/// Whether a text is `holds` or `holds(name)`.
bool asks_for_holds(const std::string& at) { return at == "holds" || (at.starts_with("holds(") && at.ends_with(')')); }

/// The outputs at which a load or obstacle rests.
std::optional<AskedMoments> holds_named(const Study& study, const MeasuredMoments& m, Diagnostics& diagnostics) {
  AskedMoments out{{Moments::Kind::kHolds, m.from.value, m.until.given ? m.until.value : kNever}, true};
  if (m.at.value == "holds") return out;
  out.of_thing = false;
  const std::string name = m.at.value.substr(6, m.at.value.size() - 7);
  std::vector<std::string> names;
  if (name == "domain" && !study.model.box_volume.empty()) return out.moments.course = study.model.box_volume, out;
  for (const CellLoad& load : study.model.loads) {
    names.push_back(load.name);
    if (load.name == name) return out.moments.course = course_of(load), out;
  }
  for (const ObstacleSpec& obstacle : study.model.obstacles) {
    names.push_back(obstacle.name);
    if (obstacle.name == name) return out.moments.course = obstacle.distance, out;
  }
  diagnostics.error(412, m.at.place, "there is no load or obstacle '" + name + "'",
                    names.empty() ? std::string("the study has none") : suggest(name, names));
  return std::nullopt;
}

}  // namespace

Moments AskedMoments::of(const Study& study, const Subject& subject) const {
  Moments out = moments;
  if (!of_thing) return out;
  if (subject.load >= 0) out.course = course_of(study.model.loads[static_cast<std::size_t>(subject.load)]);
  if (subject.obstacle >= 0) out.course = study.model.obstacles[static_cast<std::size_t>(subject.obstacle)].distance;
  return out;
}

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

bool is_word(const std::string& text) { return !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) != 0; }

std::optional<AskedMoments> moments_of(const Study& study, const MeasuredMoments& m, Diagnostics& diagnostics) {
  if (m.from.given || m.until.given) {
    const bool holds = asks_for_holds(m.at.value);
    if (m.at.given && !holds) {
      diagnostics.error(416, m.at.place, "'at' and 'from', 'until' say the same", "keep one of them");
      return std::nullopt;
    }
    const double end = m.until.given ? m.until.value : study.time.end;
    if (m.from.value <= end && end <= study.time.end) {
      if (!has_output(study, m.from.value, end)) {
        diagnostics.error(416, m.until.place, "the run writes nothing from " + m.from.text + " to " + m.until.text,
                          "a multiple of `time.output` between them");
        return std::nullopt;
      }
      if (holds) return holds_named(study, m, diagnostics);
      return AskedMoments{{Moments::Kind::kBetween, m.from.value, m.until.given ? m.until.value : kNever}};  // a run may be prolonged
    }
    diagnostics.error(416, m.from.given ? m.from.place : m.until.place, "'from' is later than 'until', or 'until' than the run's end", "");
    return std::nullopt;
  }
  const std::string& at = m.at.value;
  if (at == "end") return AskedMoments{};
  if (at == "start") return AskedMoments{{Moments::Kind::kStart}};
  if (at == "every") return AskedMoments{{Moments::Kind::kBetween, 0.0, kNever}};
  if (asks_for_holds(at)) return holds_named(study, m, diagnostics);
  const auto time = read_quantity(UnitSystem(), at, Quantity::kTime, "at", "6 h", m.at.place, diagnostics);
  if (!time) return std::nullopt;
  if (has_output(study, *time, *time)) return AskedMoments{{Moments::Kind::kBetween, *time, *time}};
  diagnostics.error(416, m.at.place, "the run writes nothing at " + at, "a multiple of `time.output` up to `time.end`");
  return std::nullopt;
}

}  // namespace morula::scenarios
