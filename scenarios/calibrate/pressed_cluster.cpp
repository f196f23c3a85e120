#include "scenarios/calibrate/pressed_cluster.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/numbers/students_t.h"

namespace morula::calibrate {
namespace {

constexpr int kParts = 16;              // of the way, by which clusters are compared
constexpr int kLeast = -10, kMost = 2;  // powers of two that are tried as factors

double part_of(int k) { return (k + 1.0) / kParts; }

double work_at(const PressedCluster& cluster, double part) {
  const auto after = std::ranges::lower_bound(cluster.part, part);
  if (after == cluster.part.end()) return cluster.work.back();
  const auto i = static_cast<std::size_t>(after - cluster.part.begin());
  if (i == 0) return cluster.work.front();
  const double share = (part - cluster.part[i - 1]) / (cluster.part[i] - cluster.part[i - 1]);
  return cluster.work[i - 1] + share * (cluster.work[i] - cluster.work[i - 1]);
}

/// Work on each cluster at each part of the way.
using Works = std::vector<std::vector<double>>;

Works works_of(const std::vector<PressedCluster>& clusters) {
  Works out;
  for (const PressedCluster& cluster : clusters) {
    std::vector<double>& work = out.emplace_back();
    for (int k = 0; k < kParts; ++k) work.push_back(work_at(cluster, part_of(k)));
  }
  return out;
}

/// Mean over the clusters, by part of the way.
std::vector<double> mean_of(const Works& works, double unit) {
  std::vector<double> out(kParts, 0.0);
  for (const auto& work : works)
    for (std::size_t k = 0; k < out.size(); ++k) out[k] += work[k] / (unit * static_cast<double>(works.size()));
  return out;
}

/// Difference of the means over all clusters but `left_out` (−1: all), by part of the way.
std::vector<double> difference(const Works& a, const Works& b, int left_out) {
  std::vector<double> out(kParts, 0.0);
  const double count = static_cast<double>(a.size()) - (left_out < 0 ? 0.0 : 1.0);
  for (std::size_t c = 0; c < a.size(); ++c)
    for (std::size_t k = 0; k < out.size() && static_cast<int>(c) != left_out; ++k) out[k] += (a[c][k] - b[c][k]) / count;
  return out;
}

double inner_product(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// log2 of the factor with the least squares, from the differences by power of two, which are taken as straight in between.
double best_of(const std::vector<std::vector<double>>& differences) {
  double at = kLeast, least = inner_product(differences.front(), differences.front());
  for (std::size_t k = 0; k + 1 < differences.size(); ++k) {
    const std::vector<double>&here = differences[k], &next = differences[k + 1];
    std::vector<double> step(here.size());
    for (std::size_t i = 0; i < step.size(); ++i) step[i] = next[i] - here[i];
    const double squares = inner_product(step, step);
    const double part = squares > 0.0 ? std::clamp(-inner_product(here, step) / squares, 0.0, 1.0) : 0.0;
    const double loss = inner_product(here, here) + 2.0 * part * inner_product(here, step) + part * part * squares;
    if (!(loss < least)) continue;
    least = loss;
    at = kLeast + static_cast<double>(k) + part;
  }
  return at;
}

Error no_fit(const char* what) { return Error{ErrorKind::kInput, what, ""}; }

/// Of the jackknife over n estimates, each without one cluster: half of the interval of 95 %.
double half_interval(const std::vector<double>& estimates) {
  const auto n = static_cast<double>(estimates.size());
  if (n < 2.0) return std::numeric_limits<double>::infinity();
  double mean = 0.0, square = 0.0;
  for (const double one : estimates) mean += one / n;
  for (const double one : estimates) square += std::pow(one - mean, 2);
  return students_t_95(n - 1.0) * std::sqrt((n - 1.0) / n * square);
}

}  // namespace

PressedCluster pressed_cluster(std::vector<double> part, const std::vector<double>& force, double way) {
  PressedCluster out{.part = std::move(part), .work = {}};
  double work = 0.0;
  for (std::size_t i = 0; i < out.part.size(); ++i) {
    if (i > 0) work += (force[i] + force[i - 1]) * way * (out.part[i] - out.part[i - 1]);
    out.work.push_back(work);
  }
  return out;
}

Result<FittedAlong> fit_friction_along(const std::vector<PressedCluster>& shells, double friction, const ClustersOfSpheres& spheres) {
  if (shells.empty()) return no_fit("no cluster of cells was pressed");
  if (!(friction > 0.0)) return no_fit("cells without friction along their contact tell nothing about that of spheres");
  const Works of_shells = works_of(shells);
  const double whole = mean_of(of_shells, 1.0).back();
  if (!(whole > 0.0)) return no_fit("clusters of cells did not resist the plates");

  std::vector<Works> tried;
  for (int k = kLeast; k <= kMost; ++k) {
    MORULA_TRY_ASSIGN(const auto clusters, spheres(std::exp2(k)));
    tried.push_back(works_of(clusters));
  }
  const auto best_without = [&](int left_out) {
    std::vector<std::vector<double>> differences;
    for (const Works& one : tried) differences.push_back(difference(one, of_shells, left_out));
    return best_of(differences);
  };
  FittedAlong out;
  const double best = best_without(-1);
  if (best <= kLeast) return no_fit("balls of spheres with next to none resist more than balls of shells: their work does not tell it");
  if (best >= kMost)
    return no_fit("balls of spheres with four times that of the shells yield more than balls of shells: their work does not tell it");
  out.factor = std::exp2(best);
  out.friction = out.factor * friction;
  std::vector<double> estimates;
  for (int k = 0; k < static_cast<int>(shells.size()) && shells.size() > 1; ++k) estimates.push_back(std::log(2.0) * best_without(k));
  const double half = half_interval(estimates);
  out.low = out.friction * std::exp(-half), out.high = out.friction * std::exp(half);
  MORULA_TRY_ASSIGN(const auto fitted, spheres(out.factor));
  const Works of_fitted = works_of(fitted);
  const std::vector<double> left = difference(of_fitted, of_shells, -1);
  out.misfit = std::sqrt(inner_product(left, left) / kParts) / whole;
  for (int k = 0; k < kParts; ++k) out.part.push_back(part_of(k));
  out.shells = mean_of(of_shells, whole), out.fitted = mean_of(of_fitted, whole), out.unfitted = mean_of(tried[-kLeast], whole);
  return out;
}

}  // namespace morula::calibrate
