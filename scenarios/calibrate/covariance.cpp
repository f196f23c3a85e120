#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "scenarios/calibrate/confidence.h"

namespace morula::calibrate {

Covariance covariance(const Data& data, const Fit& fit) {
  const LeastSquares loss = loss_of(data, fit);
  const std::vector<double> at = fit.parameters.logarithms();
  const std::vector<std::vector<double>> rows = jacobian(loss, at);
  std::vector<std::size_t> used;
  for (std::size_t k = 0; k < at.size(); ++k)
    if (k < 2 || at[k] > loss.low[k] + 1e-3) used.push_back(k);
  const auto n = static_cast<Eigen::Index>(used.size());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(n, n);
  for (const std::vector<double>& row : rows)
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j) information(i, j) += row[used[i]] * row[used[j]];
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(information);
  Covariance out;
  out.matrix.assign(at.size(), std::vector<double>(at.size(), 0.0));
  // Differences resolve 1e-10 of the largest value: directions below are not seen by the data.
  const double unseen = 1e-10 * std::max(solver.eigenvalues()(n - 1), 1e-300);
  for (Eigen::Index e = 0; e < n; ++e) {
    const double value = solver.eigenvalues()(e);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j) {
        const double share = solver.eigenvectors()(i, e) * solver.eigenvectors()(j, e);
        double& entry = out.matrix[used[i]][used[j]];
        if (value > unseen)
          entry += fit.dispersion() * share / value;
        else if (std::abs(share) > 1e-8)
          entry += share > 0.0 ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
      }
  }
  out.young_error = std::sqrt(out.matrix[0][0]);
  out.adhesion_error = std::sqrt(out.matrix[1][1]);
  const double both = out.young_error * out.adhesion_error;
  out.correlation = std::isfinite(both) && both > 0.0 ? out.matrix[0][1] / both : std::copysign(1.0, out.matrix[0][1]);
  return out;
}

}  // namespace morula::calibrate
