#pragma once
#include <span>
#include <vector>

#include "cbm/packing.h"
#include "core/result.h"
#include "scenarios/calibrate/data.h"
#include "scenarios/calibrate/minimise.h"
#include "scenarios/calibrate/pair_model.h"

namespace morula::calibrate {

/// How much each residual counts (fields_and_coupling.md, E).
struct LossWeights {
  double force_floor = 0.02;        ///< σ_F as a part of the pull-off force of the data …
  double force_relative = 0.05;     ///< … and of |F|
  double area = 0.1;                ///< w_a
  double area_floor = 0.1;          ///< σ_A as a part of the area at zero load
  double packing = 1.0;             ///< w_p
  double pressure_floor = 0.005;    ///< σ_p [kPa] …
  double pressure_relative = 0.05;  ///< … and a part of |p|
  double distance = 0.01;           ///< σ of the distances in clusters at rest, over R
  double roughness = 1e-3;          ///< μ of the second differences of p_c over pressure_floor
  double overlap_limit = 0.3;       ///< largest δ/R of pairs that are fitted, R of the smaller cell
};

/// Scales that the data give, so that the weights do not change with the parameters that are looked for.
struct DataScales {
  double pull_off = 0.0;   ///< largest tension over R*, of the largest force where nothing pulls [nN/µm]
  double area = 0.0;       ///< area over R*² of the point with the least force; 0: no areas
  double stiffness = 0.0;  ///< largest |F| over the largest |δ|: how a pair beyond its break answers [nN/µm]
  bool pulls = false;      ///< whether some point shows a tension
};
[[nodiscard]] DataScales scales_of(const Data& data, const LossWeights& weights);

/// Natural units of the search, logarithms: E, W [nN, µm] and the increments of p_c from knot to knot.
struct Parameters {
  double young = 0.0;     ///< E [kPa]
  double adhesion = 0.0;  ///< W [nN/µm]
  std::vector<cbm::PackingKnot> knots;

  [[nodiscard]] std::vector<double> logarithms() const;
  /// The packing of the knots is taken from `knots`.
  [[nodiscard]] static Parameters of(std::span<const double> logarithms, std::span<const cbm::PackingKnot> knots);
};

/// Bounds of the search: E 1e-5 to 1e4 kPa, W 1e-7 to 1e2 nN/µm, increments of p_c 1e-9 to 1e3 kPa.
struct Bounds {
  static constexpr double kYoung[2] = {1e-5, 1e4}, kAdhesion[2] = {1e-7, 1e2}, kIncrement[2] = {1e-9, 1e3};
};

/// L = Σ [(F − F_JKR)/σ_F]² + w_a Σ [(A − πa²)/σ_A]² + w_p Σ [(p − p_law)/σ_p]² + w_p Σ [p_law/σ_c]² of clusters + μ Σ (second differences of p_c/σ)²,
/// over points that are not held out, as a least-squares problem in Parameters::logarithms(). σ_c is the pressure of the spheres in places that are wrong by σ of the
/// distances, of springs of `stiffness`. Packings and clusters are summed where there are knots. The problem owns what it needs.
[[nodiscard]] LeastSquares loss_of(const Data& data, double poisson, const LossWeights& weights, const DataScales& scales,
                                   std::span<const cbm::PackingKnot> knots);

/// The part of packings alone, for any law of pairs, in the logarithms of the increments of p_c.
[[nodiscard]] LeastSquares loss_of_curve(const Data& data, const PairModel& pair, const LossWeights& weights,
                                         std::span<const cbm::PackingKnot> knots);

/// Whether a pair point takes part in the fit.
[[nodiscard]] bool is_fitted(const PairPoint& point, const LossWeights& weights);

}  // namespace morula::calibrate
