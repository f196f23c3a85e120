#include "scenarios/calibrate/relaxation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numbers/students_t.h"

namespace morula::calibrate {
namespace {

constexpr double kParts[] = {0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};
constexpr int kSteps = 400;  // of an integral over the way

/// Of t(δ) = medium + γ contact, up to a part of the way.
struct Integrals {
  double part = 0.0, medium = 0.0, contact = 0.0;
};

/// By the midpoint rule; F keeps its sign up to the rest.
std::vector<Integrals> integrals_of(const PairModel& law, double radius, double medium_friction, const std::vector<double>& parts) {
  const double rest = resting_overlap(law, radius);
  std::vector<Integrals> out;
  if (!(rest > 0.0)) return out;
  Integrals sum;
  double from = 0.0;
  for (const double part : parts) {
    const double step = (part * rest - from) / kSteps;
    for (int i = 0; i < kSteps; ++i) {
      const PairAnswer at = law(from + (i + 0.5) * step, 0.5 * radius);
      sum.medium += step * medium_friction / (-2.0 * at.force);
      sum.contact += step * at.area / -at.force;
    }
    from = part * rest;
    sum.part = part;
    out.push_back(sum);
  }
  return out;
}

/// A pair beside spheres: when it has come as far.
struct Compared {
  double time = 0.0, medium = 0.0, contact = 0.0;
};

/// γ ≥ 0 that makes Σ ln²((medium + γ contact)/time) least: where its derivative comes from below 0 to above it, found by halving.
double least_squares(const std::vector<Compared>& all) {
  const auto slope = [&](double friction) {
    double out = 0.0;
    for (const Compared& c : all) {
      const double t = c.medium + friction * c.contact;
      out += std::log(t / c.time) * c.contact / t;
    }
    return out;
  };
  const bool held_by_medium = std::ranges::all_of(all, [](const Compared& c) { return c.medium > 0.0; });
  if (held_by_medium && slope(0.0) >= 0.0) return 0.0;
  double low = 0.0, high = 1e-6;
  while (slope(high) < 0.0 && high < 1e12) low = high, high *= 4.0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (slope(middle) < 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

void add_interval(const std::vector<double>& singly, FittedFriction& out) {
  out.low = 0.0, out.high = std::numeric_limits<double>::infinity();
  const std::size_t n = singly.size();
  if (n < 2 || *std::ranges::min_element(singly) <= 0.0) return;
  double mean = 0.0, square = 0.0;
  for (const double one : singly) mean += std::log(one) / static_cast<double>(n);
  for (const double one : singly) square += std::pow(std::log(one) - mean, 2);
  const double half = students_t_95(static_cast<double>(n - 1)) * std::sqrt(square / static_cast<double>((n - 1) * n));
  out.low = out.friction * std::exp(-half), out.high = out.friction * std::exp(half);
}

Error no_fit(const char* what, const char* help = "") { return Error{ErrorKind::kInput, what, help}; }

}  // namespace

std::vector<Passage> passages_of(const Relaxation& pair) {
  std::vector<Passage> out;
  if (pair.overlap.empty() || !(pair.overlap.back() > 0.0)) return out;
  std::size_t i = 1;
  for (const double part : kParts) {
    const double wanted = part * pair.overlap.back();
    while (i < pair.overlap.size() && pair.overlap[i] < wanted) ++i;
    if (i == pair.overlap.size()) break;
    const double before = pair.overlap[i - 1], after = pair.overlap[i];
    const double between = after > before ? std::clamp((wanted - before) / (after - before), 0.0, 1.0) : 1.0;
    out.push_back({part, pair.time[i - 1] + between * (pair.time[i] - pair.time[i - 1])});
  }
  return out;
}

std::vector<Passage> passages_of_spheres(const PairModel& law, double radius, double medium_friction, double friction,
                                         const std::vector<double>& parts) {
  std::vector<Passage> out;
  for (const Integrals& one : integrals_of(law, radius, medium_friction, parts))
    out.push_back({one.part, one.medium + friction * one.contact});
  return out;
}

Result<FittedFriction> fit_approach_friction(const std::vector<Relaxation>& pairs, const PairModel& law) {
  if (pairs.empty()) return no_fit("no pair of cells came together by itself");
  std::vector<Compared> all;
  std::vector<double> singly;
  for (const Relaxation& pair : pairs) {
    if (!(pair.contact_friction > 0.0)) return no_fit("cells without friction in contact tell nothing about that of spheres");
    if (pair.contact_friction != pairs.front().contact_friction) return no_fit("pairs with different frictions in contact");
    const std::vector<Passage> passages = passages_of(pair);
    if (passages.empty()) return no_fit("a pair did not come together by itself");
    std::vector<double> parts;
    for (const Passage& one : passages) parts.push_back(one.part);
    const std::vector<Integrals> spheres = integrals_of(law, pair.radius, pair.medium_friction, parts);
    if (spheres.empty()) return no_fit("spheres of this law do not attract each other when they touch");
    std::vector<Compared> own;
    for (std::size_t k = 0; k < passages.size(); ++k)
      if (passages[k].time > 0.0) own.push_back({passages[k].time, spheres[k].medium, spheres[k].contact});
    if (own.empty()) return no_fit("a pair came together before its first output");
    singly.push_back(least_squares(own));
    all.insert(all.end(), own.begin(), own.end());
  }
  FittedFriction out;
  out.friction = least_squares(all);
  out.factor = out.friction / pairs.front().contact_friction;
  for (const Compared& c : all) out.misfit += std::pow(std::log((c.medium + out.friction * c.contact) / c.time), 2);
  out.misfit = std::sqrt(out.misfit / static_cast<double>(all.size()));
  add_interval(singly, out);
  return out;
}

}  // namespace morula::calibrate
