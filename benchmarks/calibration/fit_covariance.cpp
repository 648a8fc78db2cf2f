// SPDX-License-Identifier: Apache-2.0
#include "calibration/fit_covariance.h"

#include <cmath>

#include <Eigen/Cholesky>

namespace plotscan::calibration {
namespace {

// What is fitted, as logarithms: of the weight of each number compared over the common one, of that
// one's square, of the linear part and of the noise.
struct Parameters {
  Eigen::VectorXd logs;

  Eigen::Index features() const { return logs.size() - 3; }
  Eigen::VectorXd weights() const {
    return ((logs.head(features()).array() + logs(features())) / 2).exp();
  }
  heights::Covariance covariance() const {
    return {.linear = std::exp(logs(features() + 1)), .noise = std::exp(logs(features() + 2))};
  }
};

struct Farms {
  Eigen::MatrixXd compared;  // a row a farm
  Eigen::MatrixXd values;    // the same, about their mean
  Eigen::VectorXd noise;     // relative
};

struct Cost {
  double value = 0;
  Eigen::VectorXd gradient;
};

// sum over i, j of m_ij (x_ik - x_jk)^2 and of m_ij x_ik x_jk for each feature k, m symmetric.
Eigen::VectorXd sums_of_products(const Eigen::MatrixXd& m, const Eigen::MatrixXd& x) {
  return (m * x).cwiseProduct(x).colwise().sum();
}
Eigen::VectorXd sums_of_distances(const Eigen::MatrixXd& m, const Eigen::MatrixXd& x) {
  const Eigen::VectorXd rows = m.rowwise().sum();
  const Eigen::VectorXd own = (x.cwiseAbs2().transpose() * rows);
  return 2 * (own - sums_of_products(m, x));
}

// Negative logarithm of the likelihood and of the prior, and its gradient.
Cost cost_of(const Parameters& parameters, const Farms& farms) {
  const auto farm_count = static_cast<double>(farms.values.rows());
  const auto heights = static_cast<double>(farms.values.cols());
  const Eigen::Index count = parameters.features();
  const Eigen::VectorXd weights = parameters.weights();
  const heights::Covariance covariance = parameters.covariance();
  const Eigen::MatrixXd places = farms.compared * weights.asDiagonal();
  const Eigen::MatrixXd products = places * places.transpose();
  const Eigen::MatrixXd between = heights::covariances_of(places, covariance.linear);
  const Eigen::VectorXd noise = (covariance.noise * farms.noise).cwiseAbs2();
  const Eigen::LLT<Eigen::MatrixXd> factor(between + Eigen::MatrixXd(noise.asDiagonal()));
  const Eigen::MatrixXd inverse =
      factor.solve(Eigen::MatrixXd::Identity(between.rows(), between.cols()));
  const Eigen::MatrixXd solved = inverse * farms.values;
  const Eigen::VectorXd misfits = farms.values.cwiseProduct(solved).colwise().sum();
  const Eigen::VectorXd logs = parameters.logs.head(count);

  Cost cost{.value = heights * factor.matrixLLT().diagonal().array().log().sum() +
                     0.5 * farm_count * misfits.array().log().sum() + 0.5 * logs.squaredNorm(),
            .gradient = Eigen::VectorXd(parameters.logs.size())};
  const Eigen::MatrixXd slope = 0.5 * heights * inverse - 0.5 * farm_count * solved *
                                                              misfits.cwiseInverse().asDiagonal() *
                                                              solved.transpose();
  const double linear = covariance.linear * covariance.linear;
  const Eigen::MatrixXd near = slope.cwiseProduct(heights::squared_exponentials_of(places));
  const Eigen::VectorXd by_weight =
      linear * sums_of_products(slope, places) - 0.5 * sums_of_distances(near, places);
  cost.gradient.head(count) = by_weight + logs;
  cost.gradient(count) = by_weight.sum();
  cost.gradient(count + 1) = 2 * linear * slope.cwiseProduct(products).sum();
  cost.gradient(count + 2) = 2 * slope.diagonal().dot(noise);
  return cost;
}

// Resilient propagation (Riedmiller and Braun 1993) in its variant iRPROP- (Igel and Huesken 2000):
// each parameter takes steps of its own length against its slope's sign, 1.2 times as long while
// the sign stays, half as long where it turns, and there it rests for a step. First and longest
// step are our choice.
Parameters least_cost(Parameters parameters, const Farms& farms) {
  constexpr int kSteps = 120;
  constexpr double kLonger = 1.2;
  constexpr double kShorter = 0.5;
  constexpr double kFirst = 0.1;
  constexpr double kLongest = 0.5;
  Eigen::VectorXd steps = Eigen::VectorXd::Constant(parameters.logs.size(), kFirst);
  Eigen::VectorXd last = Eigen::VectorXd::Zero(parameters.logs.size());
  Parameters best = parameters;
  double least = INFINITY;
  for (int step = 0; step < kSteps; ++step) {
    const Cost cost = cost_of(parameters, farms);
    if (cost.value < least) {
      least = cost.value;
      best = parameters;
    }
    for (Eigen::Index k = 0; k < steps.size(); ++k) {
      const double turn = cost.gradient(k) * last(k);
      if (turn > 0) steps(k) = std::min(kLongest, kLonger * steps(k));
      if (turn < 0) steps(k) *= kShorter;
      last(k) = turn < 0 ? 0 : cost.gradient(k);
      if (last(k) != 0) parameters.logs(k) -= std::copysign(steps(k), last(k));
    }
  }
  return best;
}

}  // namespace

heights::Kernel fit_kernel(const Eigen::MatrixXd& compared, const Eigen::MatrixXd& values,
                           const std::vector<double>& noise) {
  const Farms farms{.compared = compared,
                    .values = values.rowwise() - values.colwise().mean(),
                    .noise = Eigen::Map<const Eigen::VectorXd>(
                        noise.data(), static_cast<Eigen::Index>(noise.size()))};
  const Eigen::Index count = farms.compared.cols();
  constexpr heights::Covariance kFirst{};
  Parameters first{.logs = Eigen::VectorXd::Zero(count + 3)};
  first.logs(count) = -std::log(static_cast<double>(count));
  first.logs(count + 1) = std::log(kFirst.linear);
  first.logs(count + 2) = std::log(kFirst.noise);
  const Parameters fitted = least_cost(first, farms);
  return {.weights = fitted.weights(), .covariance = fitted.covariance()};
}

}  // namespace plotscan::calibration
