#pragma once
#include <functional>
#include <string>
#include <vector>

#include "scenarios/measures/measure.h"

namespace morula::scenarios {

/// A theory that says what a measure should find. Declared in a file of its own, one line in theories().
struct Theory {
  std::string name;   ///< "youngs_law"
  std::string title;  ///< for people: "Young's law"
  std::string doc;    ///< what it is about and what it assumes, in one sentence
  std::string formula, source;
  std::vector<std::string> predicts;  ///< names of measures; `count_` at the end of a name stands for all that begin so
  /// What the things must have for it, as the message of an error: "needs a cortical tension".
  std::function<Status(const Study&, const Subject&, const std::string& measure)> fits;
  /// What it expects in the place of a value that was measured, in internal units. Errors: kFile.
  std::function<Result<double>(FinishedRun&, const Subject&, const std::string& measure, const Sample&)> value;
  /// What there is beside all that it knows, as the message of a warning: "knows no elastic cortex"; empty: nothing.
  std::function<std::string(const Study&, const Subject&)> doubt{};

  [[nodiscard]] bool is_about(const std::string& measure) const;
  /// What it predicts, for people.
  [[nodiscard]] std::string predictions() const;
};

/// All named theories. To add one: its file, and its line in theories.cpp.
const std::vector<Theory>& theories();
/// The theory of this name, or null.
const Theory* find_theory(const std::string& name);
std::vector<std::string> theory_names();

Theory youngs_law();
Theory elastic_cap_theory();
Theory laplace_law();
Theory jkr_pull_off();
Theory filled_box();
Theory fluid_pull_off();
Theory critical_suction();
Theory stretched_sphere_theory();
Theory hull_volume();
Theory exponential_growth();
Theory pressed_drop_theory();

}  // namespace morula::scenarios
