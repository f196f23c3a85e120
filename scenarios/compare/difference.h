#pragma once
#include <optional>
#include <string>
#include <vector>

namespace morula::scenarios {

/// Mean over the runs of a group, and their standard deviation (no number for a single run).
struct GroupValue {
  double mean = 0.0, spread = 0.0;
};

enum class ComparisonVerdict {
  kWithin,     ///< as near as was asked
  kBeyond,     ///< farther than was asked, and by more than seeds spread
  kUndecided,  ///< seeds spread by more than what was asked
  kSame,       ///< nothing was asked: no more than seeds spread
  kDiffers,    ///< nothing was asked: more than seeds spread
  kUnknown,    ///< nothing was asked, and one run each says nothing of the spread
};
/// "within", "beyond" and so on, for people and programs.
[[nodiscard]] std::string name_of(ComparisonVerdict verdict);

/// A column of one group against that of the first group.
struct ColumnDifference {
  std::string group{};
  GroupValue value;
  double time = 0.0;        ///< where it is judged [s]
  GroupValue reference;     ///< of the first group at that time
  double difference = 0.0;  ///< of the means
  double relative = 0.0;    ///< over the size of the reference; no number where that is 0 and the difference is not
  double interval = 0.0;    ///< half width of the 95 % interval of the difference, by Welch; no number where no group has two runs
  double in_spreads = 0.0;  ///< difference over the standard error; no number likewise
  ComparisonVerdict verdict = ComparisonVerdict::kUnknown;
};

/// The difference of two means and what can be said of it (Welch 1947, doi:10.1093/biomet/34.1-2.28). Where one group has a single run it is taken to spread
/// as the other does. `size`: what relative differences and `within` refer to.
ColumnDifference difference_of(const std::vector<double>& reference, const std::vector<double>& values, double size,
                               std::optional<double> within);

}  // namespace morula::scenarios
