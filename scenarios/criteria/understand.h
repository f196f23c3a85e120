#pragma once
#include <optional>
#include <string>
#include <vector>

#include "scenarios/measures/theories.h"
#include "study/diagnostics.h"
#include "study/study.h"

namespace morula::scenarios {

/// A measure with the things that it is taken of: each by itself.
struct MeasureCall {
  Measure measure;
  std::vector<Subject> subjects;
  std::string text;  ///< as the study names it: "volume(left)"
};

/// Moments as a study names them.
struct AskedMoments {
  Moments moments;
  bool of_thing = false;  ///< the holds of the load or obstacle that is measured

  /// Those of one thing.
  [[nodiscard]] Moments of(const Study& study, const Subject& subject) const;
};

/// A number as a study writes it, with its unit.
struct WrittenNumber {
  double internal = 0.0;
  double number = 0.0, factor = 1.0;  ///< internal = number factor
  std::string unit;
};

/// What a measure is held against.
struct Expectation {
  enum class Kind { kNone, kValue, kTheory, kMeasure, kData } kind = Kind::kNone;
  WrittenNumber value;
  const Theory* theory = nullptr;
  std::optional<MeasureCall> measure;
  std::vector<double> xs, ys;  ///< of data, in internal units
  std::string text;            ///< for people: "Young's law"
};

/// How far a measure may go.
struct MeasureLimit {
  enum class Kind { kWithin, kBelow, kAbove, kBetween } kind = Kind::kBelow;
  bool relative = false;             ///< of kWithin: to what is expected
  WrittenNumber low, high;           ///< kWithin and kBelow: `high`; kAbove: `low`
  std::optional<MeasureCall> other;  ///< the limit is what this measure finds; of kWithin: how near this one is
};

/// What is asked of a measure: one value for each thing, cell and moment that are not made into one.
struct Question {
  MeasureCall measured;
  bool together = false;  ///< all things count as one: the worst of them is told
  AskedMoments moments;
  std::string over_time, over_cells;
  std::optional<MeasureCall> along;  ///< what the measure is a curve over; none: time
  bool along_of_thing = false;       ///< of the same things as the measure
  std::string curve;                 ///< what is made of the curve; empty: nothing
  Expectation over;                  ///< what it is divided by

  /// Whether all things are made into one value before it is judged: by a curve, or by what is made of all their cells together.
  [[nodiscard]] bool is_pooled() const { return !curve.empty() || (together && over_cells != "each"); }
};

/// A criterion of a study whose words are found: what judge_criterion() needs.
struct UnderstoodCriterion {
  std::string id, text;
  Question question;
  Expectation expected;
  MeasureLimit limit;
};

struct UnderstoodPlot {
  std::string name, title, source;
  std::optional<MeasureCall> x;  ///< none: time
  std::vector<MeasureCall> y;
  AskedMoments moments;
  std::string over_cells;
  Expectation expected;
};

/// What a criterion asks. Errors (E201–E205, E303, E401, E402, E410–E417) stand where the words do; then there is nothing.
std::optional<UnderstoodCriterion> understand(const Study& study, const Criterion& criterion, Diagnostics& diagnostics);
std::optional<UnderstoodPlot> understand(const Study& study, const StudyPlot& plot, Diagnostics& diagnostics);

/// Whether all criteria and plots of a study can be judged and drawn, each id asks one question once (E415), and no two columns of series.csv have one name (E112):
/// what ReadOptions::check_criteria asks.
void check_criteria(const Study& study, Diagnostics& diagnostics);

/// Columns of series.csv that its criteria and plots read: a run writes them, whatever `output.series` says.
std::vector<std::string> series_columns(const Study& study);

/// `measure(thing, thing)` and `of`, found in the study. E410, E412, E401, E402. `place`: of the text.
std::optional<MeasureCall> find_call(const Study& study, const std::string& text, const Place& place, const MeasuredThings* of,
                                     Diagnostics& diagnostics);

}  // namespace morula::scenarios
