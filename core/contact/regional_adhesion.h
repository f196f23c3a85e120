#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace morula {

/// Adhesion of two materials where their faces carry certain marks.
struct AdhesionRule {
  std::uint8_t marks_a = 0;  ///< marks that a face of the first material must carry, one bit each; 0: any face
  std::uint8_t marks_b = 0;  ///< likewise of the second
  double adhesion = 0.0;     ///< W of such faces [nN/µm]
};

/// Adhesion energy W of two materials by the marks on the faces in contact: that of the first rule which both faces follow, else that of the pair.
class RegionalAdhesion {
 public:
  /// `otherwise`: W of faces that no rule is for [nN/µm]; `marks`: how many marks there are, at most 8.
  RegionalAdhesion(double otherwise, std::span<const AdhesionRule> rules, int marks)
      : shift_(marks), table_(std::size_t{1} << (2 * marks)) {
    const std::size_t sets = std::size_t{1} << marks;
    for (std::size_t a = 0; a < sets; ++a)
      for (std::size_t b = 0; b < sets; ++b) {
        double adhesion = otherwise;
        for (const AdhesionRule& rule : rules) {
          if ((a & rule.marks_a) != rule.marks_a || (b & rule.marks_b) != rule.marks_b) continue;
          adhesion = rule.adhesion;
          break;
        }
        table_[a << shift_ | b] = adhesion;
      }
  }

  /// W of a face of the first material and one of the second, by their sets of marks [nN/µm].
  [[nodiscard]] double between(std::uint8_t marks_a, std::uint8_t marks_b) const {
    return table_[std::size_t{marks_a} << shift_ | marks_b];
  }

 private:
  int shift_;
  std::vector<double> table_;
};

}  // namespace morula
