#include "scenarios/calibrate/mixed_fit.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>

#include "scenarios/calibrate/minimise.h"

namespace morula::calibrate {
namespace {

constexpr std::size_t kParts = 8;   // of the places, for the jackknife
constexpr double kStudent = 2.365;  // 95 % of Student's t with kParts − 1 degrees of freedom

/// The terms of the polynomial: all up to the second order of what was varied.
std::vector<double> terms(const std::array<bool, 2>& varied, double x, double y) {
  std::vector<double> out{1.0};
  if (varied[0]) out.push_back(x), out.push_back(x * x);
  if (varied[1]) out.push_back(y), out.push_back(y * y);
  if (varied[0] && varied[1]) out.push_back(x * y);
  return out;
}

/// Forces at all places, and the way, as functions of the logarithms of both factors.
class Emulator {
 public:
  explicit Emulator(const MixedData& data) : data_(data) {
    for (const int k : {0, 1}) {
      const auto [least, most] = std::ranges::minmax(logarithms(k));
      low_[static_cast<std::size_t>(k)] = least, high_[static_cast<std::size_t>(k)] = most;
      varied_[static_cast<std::size_t>(k)] = most > least;
    }
    const auto rows = static_cast<Eigen::Index>(data.trials.size()), columns = static_cast<Eigen::Index>(terms(varied_, 0.0, 0.0).size());
    Eigen::MatrixXd design(rows, columns), answer(rows, static_cast<Eigen::Index>(data.wanted.size()) + 1);
    for (Eigen::Index t = 0; t < rows; ++t) {
      const MixedTrial& trial = data.trials[static_cast<std::size_t>(t)];
      const auto row = terms(varied_, std::log(trial.stiffness), std::log(trial.adhesion));
      for (Eigen::Index c = 0; c < columns; ++c) design(t, c) = row[static_cast<std::size_t>(c)];
      for (Eigen::Index p = 0; p + 1 < answer.cols(); ++p) answer(t, p) = trial.force[static_cast<std::size_t>(p)];
      answer(t, answer.cols() - 1) = trial.way;
    }
    coefficients_ = design.colPivHouseholderQr().solve(answer);
  }

  [[nodiscard]] std::size_t term_count() const { return static_cast<std::size_t>(coefficients_.rows()); }
  [[nodiscard]] const std::vector<double>& low() const { return low_; }
  [[nodiscard]] const std::vector<double>& high() const { return high_; }

  /// Where (F − wanted)/scale is least; `left_out`: part of the places that does not count, kParts: none.
  [[nodiscard]] Minimum best(std::size_t left_out) const {
    const auto residuals = [this, left_out](std::span<const double> at, std::vector<double>& out) {
      const auto row = terms(varied_, at[0], at[1]);
      const auto answer = [&](std::size_t column) {
        double sum = 0.0;
        for (std::size_t c = 0; c < row.size(); ++c)
          sum += row[c] * coefficients_(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(column));
        return sum;
      };
      const std::size_t places = data_.wanted.size();
      out.clear();
      for (std::size_t p = 0; p < places; ++p)
        if (p * kParts / places != left_out) out.push_back((answer(p) - data_.wanted[p]) / data_.scale);
      if (data_.way_scale > 0.0) out.push_back(answer(places) / data_.way_scale);
    };
    const LeastSquares problem{residuals, low_, high_};
    return minimise(problem, start());
  }

 private:
  [[nodiscard]] std::vector<double> logarithms(int which) const {
    std::vector<double> out;
    for (const MixedTrial& trial : data_.trials) out.push_back(std::log(which == 0 ? trial.stiffness : trial.adhesion));
    return out;
  }
  /// The trial that is nearest to what is wanted.
  [[nodiscard]] std::vector<double> start() const {
    const auto loss = [this](const MixedTrial& trial) {
      double out = 0.0;
      for (std::size_t p = 0; p < data_.wanted.size(); ++p) out += std::pow(trial.force[p] - data_.wanted[p], 2);
      return out;
    };
    const auto nearest = std::ranges::min_element(data_.trials, {}, loss);
    return {std::log(nearest->stiffness), std::log(nearest->adhesion)};
  }

  const MixedData& data_;
  std::array<bool, 2> varied_{};
  std::vector<double> low_ = {0.0, 0.0}, high_ = {0.0, 0.0};
  Eigen::MatrixXd coefficients_;  // by term and place, last of the way
};

Interval interval_around(double logarithm, const std::array<double, kParts>& without) {
  double mean = 0.0, variance = 0.0;
  for (const double one : without) mean += one / kParts;
  for (const double one : without) variance += (one - mean) * (one - mean) * (kParts - 1) / kParts;
  const double half = kStudent * std::sqrt(variance);
  return {std::exp(logarithm - half), std::exp(logarithm + half)};
}

}  // namespace

Result<MixedFit> fit_mixed(const MixedData& data) {
  const auto refused = [](std::string what) { return Error{ErrorKind::kInput, std::move(what), "more trials, with other factors"}; };
  if (data.trials.empty()) return refused("there is no trial of a sphere with a shell");
  if (data.wanted.size() < 2 * kParts)
    return refused("a sphere and a shell are compared at " + std::to_string(data.wanted.size()) + " places only");
  for (const MixedTrial& trial : data.trials)
    if (trial.force.size() != data.wanted.size()) return refused("a trial of a sphere with a shell has other places than wanted");
  const Emulator emulator(data);
  if (data.trials.size() <= emulator.term_count())
    return refused("there are " + std::to_string(data.trials.size()) + " trials of a sphere with a shell, too few for " +
                   std::to_string(emulator.term_count()) + " terms");
  const Minimum all = emulator.best(kParts);
  MixedFit out;
  out.stiffness = std::exp(all.parameters[0]), out.adhesion = std::exp(all.parameters[1]);
  std::array<double, kParts> without[2];
  for (std::size_t part = 0; part < kParts; ++part) {
    const Minimum one = emulator.best(part);
    without[0][part] = one.parameters[0], without[1][part] = one.parameters[1];
  }
  out.stiffness_interval = interval_around(all.parameters[0], without[0]);
  out.adhesion_interval = interval_around(all.parameters[1], without[1]);
  constexpr double kNear = 1e-3;
  for (std::size_t k = 0; k < 2; ++k)
    out.at_border |= emulator.high()[k] > emulator.low()[k] &&
                     (all.parameters[k] < emulator.low()[k] + kNear || all.parameters[k] > emulator.high()[k] - kNear);
  return out;
}

}  // namespace morula::calibrate
