#pragma once
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/key_spec.h"

namespace morula {

/// One parameter of a law as a person meets it: what the law reference, `explain` and `methods.md` are made from.
///
/// Numbers are in the internal unit that `unit` names (µm, nN, s, amol and their products). Bounds are inclusive; no bound is ±infinity.
struct LawParameter {
  std::string name;                ///< key in a study file, snake_case: "young_modulus"
  std::string quantity;            ///< kind of quantity, one word: "pressure", "length", "tension", "number"
  std::string unit;                ///< internal unit as text: "kPa", "µm", "nN/µm", "1"
  std::optional<double> fallback;  ///< value when the study gives none; empty: the study must give it
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  std::string source;  ///< where the fallback comes from: author year, doi; or "choice of this project"
  std::string doc;     ///< one sentence

  /// It has the same value in every study.
  [[nodiscard]] bool is_fixed() const { return fallback && minimum == maximum; }
};

/// A parameter without a value of its own: the study gives it.
inline LawParameter given_by_study(const char* name, const char* quantity, const char* unit, const char* doc) {
  LawParameter out;
  out.name = name, out.quantity = quantity, out.unit = unit, out.doc = doc, out.source = "the study";
  return out;
}

/// A key of the study that a law reads, and the section of the study that it stands in.
struct LawKey {
  std::string section;  ///< "dcm.cortex"
  KeySpec spec;
};

/// Values that a law does not take together: the number of a message of the study reader, the key that it is about, and the text, in which `{}`
/// stands for the value as the study wrote it.
struct LawProblem {
  int code = 0;
  std::string key, what, help;
};

/// What there is to say about a law apart from its functions: plain data, filled in once, beside the law's functions.
struct LawInfo {
  std::string name;      ///< snake_case, unique within its folder: "jkr"
  std::string title;     ///< for people: "Johnson–Kendall–Roberts contact"
  std::string equation;  ///< in plain text with Unicode symbols
  std::string source;    ///< author year, doi
  /// The numbers that its functions take, as `methods.md` tells them.
  std::vector<LawParameter> parameters;
  /// The keys of the study that these follow from, with default, range and source.
  std::vector<LawKey> keys{};
};

}  // namespace morula
