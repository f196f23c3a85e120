#pragma once
#include <filesystem>
#include <memory>

#include "coupling/laws.h"
#include "scenarios/compare/comparison.h"

namespace morula::scenarios {

/// A difference and what it is judged by, as texts for people: "3.21 ± 0.04", "+1.2 %".
[[nodiscard]] std::string value_words(const GroupValue& value);
[[nodiscard]] std::string relative_words(const ColumnDifference& difference);
[[nodiscard]] std::string verdict_words(const ColumnDifference& difference, const CompareRequest& request);

/// compare.html with the runs, what differs, what the groups' studies differ in, the last state of the first run of each group and all curves overlaid,
/// one colour a group; plots/*.svg with their numbers as CSV beside it. Replaces what is there; returns the path of the page.
Result<std::filesystem::path> write_comparison(const std::vector<RunGroup>& groups, const Comparison& comparison,
                                               const CompareRequest& request, const std::filesystem::path& folder,
                                               std::shared_ptr<const Laws> laws);

}  // namespace morula::scenarios
