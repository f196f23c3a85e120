#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "scenarios/verify/suites.h"

namespace morula::scenarios {

/// One line of what a verification found.
struct VerifiedRow {
  std::string id, quantity;
  std::optional<double> reference;  ///< none for a criterion of a study that has only a limit
  double value = 0.0;
  std::string tolerance;  ///< largest difference, or the limit of a criterion
  bool passed = false;
  std::string source;
};

/// The numbers of a suite that are to be found, without ours.
std::vector<VerifiedRow> rows_of(const VerifySuite& suite);
/// The numbers of a suite, each found and compared; those with one of these ids where any are given.
std::vector<VerifiedRow> verify(const VerifySuite& suite, const std::vector<std::string>& only = {});

/// The single-cell experiments of the library in their quick version, run below `folder`, one row for each of their criteria; `tell` is
/// called with the name of each study before it runs. Takes about half a minute.
Result<std::vector<VerifiedRow>> verify_single_cell_studies(const std::filesystem::path& folder,
                                                            const std::function<void(const std::string&)>& tell);

}  // namespace morula::scenarios
