#include "scenarios/run/growth_forecast.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "coupling/behaviours/balanced_growth.h"

namespace morula::scenarios {
namespace {

constexpr double kMostExponent = 60.0;  // e^60 cells are more than any number here

// Shells cost ∝ n^1.25: each has more neighbours, and solves take more iterations (0.032, 0.042, 0.077 s per hour and 1000 nodes of 13, 55 and 1,000, bench/README.md; alone
// less than half of 13).
constexpr double kCostOfShells = 1.25;

/// ∫_0^τ e^{g t} dt
double exponential_integral(double growth, double duration) {
  const double exponent = std::min(growth * duration, kMostExponent);
  return growth > 0.0 && exponent > 1e-6 ? std::expm1(exponent) / growth : duration;
}

/// How the numbers of cells by type change, which divide at these rates: a division takes a cell of its type and gives two, of types by their fates.
std::vector<double> change_by_divisions(const Model& model, const std::vector<double>& rate, const std::vector<double>& cells) {
  std::vector<double> out(cells.size(), 0.0);
  for (std::size_t t = 0; t < cells.size(); ++t) {
    const double divisions = rate[t] * cells[t];
    double alike = 1.0;
    for (const Fate& fate : model.types[t].fates.all) {
      alike -= fate.share;
      for (const std::uint16_t to : fate.type) out[to] += fate.share * divisions;
    }
    out[t] += (2.0 * alike - 1.0) * divisions;
  }
  return out;
}

/// Logarithm of how many times as many cells come of these after a time, by the midpoint rule.
double growth_by_fates(const Model& model, const std::vector<double>& rate, std::vector<double> cells, double duration) {
  constexpr int kSteps = 400;
  const double step = duration / kSteps;
  double grown = -std::log(std::accumulate(cells.begin(), cells.end(), 0.0));
  const auto add = [](std::vector<double>& to, double times, const std::vector<double>& change) {
    for (std::size_t t = 0; t < to.size(); ++t) to[t] = std::max(0.0, to[t] + times * change[t]);
  };
  for (int k = 0; k < kSteps; ++k) {
    std::vector<double> middle = cells;
    add(middle, 0.5 * step, change_by_divisions(model, rate, cells));
    add(cells, step, change_by_divisions(model, rate, middle));
    const double sum = std::accumulate(cells.begin(), cells.end(), 0.0);  // numbers may go beyond those of a double
    grown += std::log(sum);
    for (double& n : cells) n /= sum;
  }
  return grown;
}

}  // namespace

double multiplied(double growth, double duration) { return std::exp(std::min(growth * duration, kMostExponent)); }

Load load_integral(const Load& load, double growth, double duration) {
  const double full =
      load.shells <= 0.0 || growth <= 0.0 ? duration : std::max(0.0, std::log(std::max(1.0, load.most_shells / load.shells)) / growth);
  const double filling = std::min(full, duration);
  const auto shells = [&](double power) {
    return exponential_integral(power * growth, filling) + multiplied(power * growth, filling) * (duration - filling);
  };
  const double cells = (load.spheres + load.shells) * exponential_integral(growth, duration);
  return {.spheres = cells - load.shells * shells(1.0), .nodes = load.nodes * (load.shells > 0.0 ? shells(kCostOfShells) : duration)};
}

Load load_after(const Load& load, double growth, double duration) {
  const double times = multiplied(growth, duration);
  const double shells = std::min(load.shells * times, std::max(load.shells, load.most_shells));
  Load out = load;
  out.spheres = (load.spheres + load.shells) * times - shells;
  out.shells = shells;
  if (load.shells > 0.0) out.nodes = load.nodes * shells / load.shells;
  return out;
}

double free_growth_rate(const Model& model, const std::vector<std::int64_t>& cells_of_type, double duration) {
  std::vector<double> rate, cells(cells_of_type.begin(), cells_of_type.end());
  for (const CellType& type : model.types) rate.push_back(type.cycles ? population_growth_rate(type) : 0.0);
  const double count = std::accumulate(cells.begin(), cells.end(), 0.0);
  if (!(count > 0.0)) return 0.0;
  const bool any_fates = std::ranges::any_of(model.types, [](const CellType& type) { return !type.fates.all.empty(); });
  if (any_fates && duration > 0.0) return growth_by_fates(model, rate, cells, duration) / duration;
  return std::inner_product(rate.begin(), rate.end(), cells.begin(), 0.0) / count;
}

}  // namespace morula::scenarios
