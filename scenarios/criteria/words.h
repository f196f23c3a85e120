#pragma once
#include <optional>
#include <string>
#include <vector>

#include "scenarios/criteria/understand.h"

namespace morula::scenarios {

/// The dimension of a measure, or of its slope over time.
struct Dimension {
  Quantity quantity = Quantity::kNumber;
  bool per_time = false;
};

/// A number with a unit of this dimension; a slope has that of the measure over one of time: `2 um/h`. E201–E205.
std::optional<WrittenNumber> number_of(const std::string& text, Dimension of, const char* key, const Place& place,
                                       Diagnostics& diagnostics);

/// Whether a text is a measure and not a number: `volume(left)`.
bool is_word(const std::string& text);

/// The outputs that are meant. E412, E416.
std::optional<AskedMoments> moments_of(const Study& study, const MeasuredMoments& m, Diagnostics& diagnostics);

/// A measure that another is compared with or divided by: of the same dimension, and of one thing, where not `several`. E203, E410, E412.
std::optional<MeasureCall> compared_measure(const Study& study, const Given<std::string>& text, Quantity quantity, bool several,
                                            Diagnostics& diagnostics);

/// What a measure is held against or divided by.
struct Comparison {
  std::vector<const MeasureCall*> measures;  ///< those that are compared, all of one quantity
  Dimension dimension;                       ///< of what is compared
  Quantity along = Quantity::kTime;          ///< what data lie along
  bool several = false;                      ///< a measure of several things may be named
  const char* key = "against";               ///< for messages
  std::optional<Quantity> of_data{};         ///< of data, where what is compared is made of several of their values; none: of `dimension`
};
/// E201–E205, E410–E414, E417.
std::optional<Expectation> expectation_of(const Study& study, const ExpectedValue& against, const Comparison& comparison,
                                          const Place& place, Diagnostics& diagnostics);

/// The limit of a criterion whose values have this dimension. E201–E205, E303, E414.
std::optional<MeasureLimit> limit_of(const Study& study, const Criterion& criterion, Dimension dimension, Diagnostics& diagnostics);

}  // namespace morula::scenarios
