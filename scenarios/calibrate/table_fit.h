#pragma once
#include "cbm/laws/table.h"
#include "scenarios/calibrate/fit.h"
#include "scenarios/calibrate/pair_model.h"

namespace morula::calibrate {

/// A table of force and area over δ/R* from pair points that are not held out, at any overlap. Points are scaled with R*, brought together where they
/// lie closer than a hundredth of their range, made to rise (averages of neighbours that fall) and thinned to `most` knots. The first knot is the point of
/// largest tension: points further apart, on the branch that a controlled force does not hold, are left out. Pairs become attached at δ = 0, or at the first
/// knot where that is later. The force is 0 where the pairs among the clusters rest, and points that pull though they are deeper are left out: contact lines that do not let go hold them. What a curve of packing adds to two cells is taken off first, so that
/// both together are the points. Errors (kInput): what PairTable::through refuses, with too few points in particular.
Result<cbm::PairTable> fit_table(const Data& data, const cbm::PackingCurve& packing = {}, int most = 24);

/// A table as a model of attached pairs; beyond its break nothing.
[[nodiscard]] PairModel table_model(cbm::PairTable table);

/// The packing curve that pairs by this law leave to the packings, as fit() finds it for JKR; empty where they ask for none.
[[nodiscard]] std::vector<cbm::PackingKnot> fit_curve(const Data& data, const PairModel& pair, const FitOptions& options);

/// How the force grows on the side that pushes: n of F ∝ (δ − δ_0)ⁿ, δ_0 the overlap at rest of the table, by least squares in logarithms. A solid has 3/2
/// (Hertz), a shell under tension about 1.
struct ForceExponent {
  double value = 0.0, error = 0.0;  ///< with its standard error; not numbers with fewer than three points
  int points = 0;                   ///< that push with more than a twentieth of the largest force
};
[[nodiscard]] ForceExponent force_exponent(const Data& data, const cbm::PairTable& table);

/// Part of the loss of the pairs that JKR leaves at its best and the σ of the loss does not explain, 1 − (N − 2)/L, 0 at least.
[[nodiscard]] double misfit_share(const Data& data, const Fit& fit);

}  // namespace morula::calibrate
