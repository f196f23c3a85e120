#pragma once
#include <span>
#include <vector>

#include "core/mesh/mark_sets.h"

namespace morula {

/// Adhesion of two materials where their faces carry certain marks.
struct AdhesionRule {
  int mark_a = -1;        ///< that a face of the first material must carry; −1: any face
  int mark_b = -1;        ///< likewise of the second
  double adhesion = 0.0;  ///< W of such faces [nN/µm]
};

/// Adhesion energy W of two materials by the marks on the faces in contact: that of the first rule which both faces follow, else that of the pair.
class RegionalAdhesion {
 public:
  /// `otherwise`: W of faces that no rule is for [nN/µm]; `marks`: how many marks there are. With up to eight, W of two sets is looked up.
  RegionalAdhesion(double otherwise, std::span<const AdhesionRule> rules, int marks)
      : otherwise_(otherwise), rules_(rules.begin(), rules.end()), shift_(marks) {
    if (marks > 8) return;
    const std::size_t sets = std::size_t{1} << marks;
    table_.resize(sets * sets);
    for (std::size_t a = 0; a < sets; ++a)
      for (std::size_t b = 0; b < sets; ++b) {
        const auto of_a = static_cast<std::uint8_t>(a), of_b = static_cast<std::uint8_t>(b);
        table_[a << shift_ | b] = by_rules({&of_a, 1}, {&of_b, 1});
      }
  }

  /// W of a face of the first material and one of the second, by their sets of marks [nN/µm].
  [[nodiscard]] double between(MarkSet a, MarkSet b) const {
    if (table_.empty()) return by_rules(a, b);
    return table_[std::size_t{a.empty() ? std::uint8_t{0} : a[0]} << shift_ | (b.empty() ? std::uint8_t{0} : b[0])];
  }

 private:
  [[nodiscard]] double by_rules(MarkSet a, MarkSet b) const {
    for (const AdhesionRule& rule : rules_)
      if ((rule.mark_a < 0 || has_mark(a, rule.mark_a)) && (rule.mark_b < 0 || has_mark(b, rule.mark_b))) return rule.adhesion;
    return otherwise_;
  }

  double otherwise_;
  std::vector<AdhesionRule> rules_;
  int shift_;
  std::vector<double> table_;
};

}  // namespace morula
