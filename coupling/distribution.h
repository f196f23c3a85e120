#pragma once

namespace morula {

/// A number that varies from cell to cell: Gaussian, truncated at ±3 standard deviations.
struct Distribution {
  double mean = 0.0;
  double relative_spread = 0.0;
  double correlation = 0.0;  ///< of a daughter's with her mother's, −1 to 1
};

}  // namespace morula
