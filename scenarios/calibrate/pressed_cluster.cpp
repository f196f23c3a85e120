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
constexpr int kBetween = 64;            // places from one to the next
constexpr double kFromApproach = 4.0;   // by what factor it may differ from that of approach: a standard deviation (decision 0077)
constexpr double kResolved = 1e-3;      // of the work, by integration over the outputs of a run

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

double inner_product(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// a + part (b − a), by cluster and part of the way.
Works between(const Works& a, const Works& b, double part) {
  Works out = a;
  for (std::size_t c = 0; c < a.size(); ++c)
    for (std::size_t k = 0; k < kParts; ++k) out[c][k] += part * (b[c][k] - a[c][k]);
  return out;
}

/// How spheres differ from shells, mean squares over the parts of the way, in parts of the work on a cluster of shells.
struct Misfit {
  double mean = 0.0;     ///< of the mean over the clusters
  double scatter = 0.0;  ///< variance of single clusters around it
};
Misfit misfit_of(const Works& spheres, const Works& shells, double whole) {
  const auto count = static_cast<double>(shells.size());
  Works difference = spheres;
  for (std::size_t c = 0; c < shells.size(); ++c)
    for (std::size_t k = 0; k < kParts; ++k) difference[c][k] = (spheres[c][k] - shells[c][k]) / whole;
  const std::vector<double> mean = mean_of(difference, 1.0);
  Misfit out{.mean = inner_product(mean, mean) / kParts, .scatter = 0.0};
  double all = 0.0;
  for (const auto& one : difference) all += inner_product(one, one) / kParts;
  if (count > 1.0) out.scatter = (all - count * out.mean) / (count - 1.0);
  return out;
}

/// What speaks against each factor: −2 ln of its likelihood, Student's t of the mean over the clusters, and what it is away from that of approach. The scatter is that where
/// the mean is nearest to shells, and what no friction takes away there: spheres that are wrong in another way tell less.
class Loss {
 public:
  Loss(const std::vector<Works>& tried, const Works& shells, double whole, double approach) : approach_(std::log2(approach)) {
    const auto last = static_cast<std::size_t>(kMost - kLeast) * kBetween;
    for (std::size_t i = 0; i <= last; ++i) {
      const std::size_t k = std::min(i / kBetween, tried.size() - 2);
      const double part = static_cast<double>(i) / kBetween - static_cast<double>(k);
      misfits_.push_back(misfit_of(between(tried[k], tried[k + 1], part), shells, whole));
    }
    count_ = static_cast<double>(shells.size());
    const Misfit& nearest = *std::ranges::min_element(misfits_, {}, &Misfit::mean);
    scatter_ = std::max(kResolved * kResolved, nearest.scatter + count_ * nearest.mean);
  }
  [[nodiscard]] std::size_t size() const { return misfits_.size(); }
  /// log2 of the factor at a place.
  static double exponent(std::size_t i) { return kLeast + static_cast<double>(i) / kBetween; }
  [[nodiscard]] double at(std::size_t i) const {
    const double away = (exponent(i) - approach_) / std::log2(kFromApproach);
    const double told = count_ > 1.0 ? count_ * std::log1p(count_ * misfits_[i].mean / ((count_ - 1.0) * scatter_)) : 0.0;
    return told + away * away;
  }

 private:
  double approach_, count_ = 0.0, scatter_ = 0.0;
  std::vector<Misfit> misfits_;
};

Error no_fit(const char* what) { return Error{ErrorKind::kInput, what, ""}; }

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

Result<FittedAlong> fit_friction_along(const std::vector<PressedCluster>& shells, double friction, double approach,
                                       const ClustersOfSpheres& spheres) {
  if (shells.empty()) return no_fit("no cluster of cells was pressed");
  if (!(friction > 0.0)) return no_fit("cells without friction along their contact tell nothing about that of spheres");
  const Works of_shells = works_of(shells);
  const double whole = mean_of(of_shells, 1.0).back();
  if (!(whole > 0.0)) return no_fit("clusters of cells did not resist the plates");

  std::vector<double> factors;
  for (int k = kLeast; k <= kMost; ++k) factors.push_back(std::exp2(k));
  MORULA_TRY_ASSIGN(const auto of_factors, spheres(factors));
  std::vector<Works> tried;
  for (const std::vector<PressedCluster>& clusters : of_factors) tried.push_back(works_of(clusters));
  const Loss loss(tried, of_shells, whole, std::clamp(approach, std::exp2(kLeast), std::exp2(kMost)));
  std::size_t best = 0;
  for (std::size_t i = 0; i < loss.size(); ++i)
    if (loss.at(i) < loss.at(best)) best = i;
  std::size_t low = best, high = best;
  const double limit = loss.at(best) + kRiseOf95;
  for (std::size_t i = 0; i < loss.size(); ++i)
    if (loss.at(i) <= limit) low = std::min(low, i), high = std::max(high, i);

  FittedAlong out;
  out.factor = std::exp2(Loss::exponent(best));
  out.friction = out.factor * friction;
  out.low = low == 0 ? 0.0 : friction * std::exp2(Loss::exponent(low));
  out.high = high + 1 == loss.size() ? std::numeric_limits<double>::infinity() : friction * std::exp2(Loss::exponent(high));
  MORULA_TRY_ASSIGN(const auto fitted, spheres(std::span(&out.factor, 1)));
  const Works of_fitted = works_of(fitted.front());
  out.misfit = std::sqrt(misfit_of(of_fitted, of_shells, whole).mean);
  for (int k = 0; k < kParts; ++k) out.part.push_back(part_of(k));
  out.shells = mean_of(of_shells, whole), out.fitted = mean_of(of_fitted, whole), out.unfitted = mean_of(tried[-kLeast], whole);
  return out;
}

}  // namespace morula::calibrate
