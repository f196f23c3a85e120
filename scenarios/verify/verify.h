#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"

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

/// The reference numbers of physics/ (reference_numbers.h).
std::vector<VerifiedRow> verify_physics();

/// The single-cell experiments of the library in their quick version, run below `folder`, one row for each of their criteria; `tell` is
/// called with the name of each study before it runs. Takes about half a minute.
Result<std::vector<VerifiedRow>> verify_single_cell_studies(const std::filesystem::path& folder,
                                                            const std::function<void(const std::string&)>& tell);

}  // namespace morula::scenarios
