#pragma once
#include <cstdint>

#include "core/random/philox.h"
#include "coupling/model.h"

namespace morula {

/// A positive number from a Gaussian truncated at ±3 standard deviations, for one cell.
///
/// Candidates are rejected until one fits. `index` is the next unused draw of (stream, cell) and is moved on; nothing is drawn where the
/// spread is 0. Precondition: mean > 0.
double draw_truncated(const Distribution& distribution, const Random& random, CellId cell, std::uint64_t& index);

/// That of a daughter whose mother has `mothers`: μ + ρ (m − μ) + √(1 − ρ²) (x − μ), x from draw_truncated(), drawn again where that is not positive. The
/// variance and the mean of a population are those of the distribution in every generation.
double draw_inherited(const Distribution& distribution, double mothers, const Random& random, CellId cell, std::uint64_t& index);

/// Point in the cycle, 0 at birth and 1 at division, of a cell picked from a population in balanced growth with equal cycles: density
/// 2 ln2 2^(−a) (Powell 1956, doi:10.1099/00221287-15-3-492). u: uniform in (0, 1).
double balanced_growth_age(double u);

}  // namespace morula
