// SPDX-License-Identifier: Apache-2.0
// The fitted covariance against the likelihood itself, computed densely, and against a known one.
#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "calibration/fit_covariance.h"
#include "core/random.h"

namespace plotscan::calibration {
namespace {

struct Drawn {
  Eigen::MatrixXd features;
  Eigen::MatrixXd values;
  std::vector<double> noise = {};
};

// The covariance of farms' values, noise included, summed pair by pair.
Eigen::MatrixXd covariance(const Drawn& farms, const heights::Kernel& kernel) {
  const Eigen::Index count = farms.features.rows();
  const double linear = std::pow(kernel.covariance.linear, 2);
  Eigen::MatrixXd sum(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::VectorXd a = farms.features.row(i).transpose().cwiseProduct(kernel.weights);
    for (Eigen::Index j = 0; j < count; ++j) {
      const Eigen::VectorXd b = farms.features.row(j).transpose().cwiseProduct(kernel.weights);
      sum(i, j) = std::exp(-(a - b).squaredNorm() / 2) + linear * a.dot(b) + 10;
    }
    sum(i, i) += std::pow(kernel.covariance.noise * farms.noise[static_cast<std::size_t>(i)], 2);
  }
  return sum;
}

// Values of two heights, one ten times as large, drawn from a covariance of which the second
// feature counts a quarter of the first, and the third nothing.
const heights::Kernel kTrue{.weights = Eigen::Vector3d(1.2, 0.3, 0),
                            .covariance = {.linear = 0.5, .noise = 0.2}};

Drawn drawn_farms(Eigen::Index count) {
  RandomStream random(3, random_purpose("test/fit_covariance"), 0);
  Drawn farms{.features = Eigen::MatrixXd(count, 3), .values = Eigen::MatrixXd(count, 2)};
  for (double& feature : farms.features.reshaped()) feature = random.normal();
  for (Eigen::Index i = 0; i < count; ++i) farms.noise.push_back(i % 2 == 0 ? 1 : 2);
  const Eigen::MatrixXd root = covariance(farms, kTrue).llt().matrixL();
  for (double& value : farms.values.reshaped()) value = random.normal();
  farms.values = root * farms.values;
  farms.values.col(1) *= 10;
  return farms;
}

// Minus the logarithm of the likelihood, each height with the scale that is best for it (Rasmussen
// and Williams 2006, equation 5.8), and of the prior: the logarithms of the squared weights are
// normal about their mean.
double cost(const Drawn& farms, const heights::Kernel& kernel) {
  const Eigen::MatrixXd matrix = covariance(farms, kernel);
  const Eigen::PartialPivLU<Eigen::MatrixXd> solver(matrix);
  const double log_determinant = solver.matrixLU().diagonal().array().abs().log().sum();
  const auto count = static_cast<double>(farms.values.rows());
  double sum = 0;
  for (Eigen::Index k = 0; k < farms.values.cols(); ++k) {
    const Eigen::VectorXd centred = farms.values.col(k).array() - farms.values.col(k).mean();
    sum += 0.5 * log_determinant + 0.5 * count * std::log(centred.dot(solver.solve(centred)));
  }
  const Eigen::ArrayXd logs = 2 * kernel.weights.array().log();
  return sum + 0.5 * (logs - logs.mean()).square().sum();
}

TEST(FitKernel, NothingNearIsMoreLikely) {
  const Drawn farms = drawn_farms(60);
  const heights::Kernel fitted = fit_kernel(farms.features, farms.values, farms.noise);
  const double least = cost(farms, fitted);
  for (const double factor : {0.9, 1 / 0.9}) {
    for (Eigen::Index k = 0; k < fitted.weights.size(); ++k) {
      heights::Kernel other = fitted;
      other.weights(k) *= factor;
      EXPECT_GT(cost(farms, other), least) << "weight " << k << " times " << factor;
    }
    heights::Kernel other = fitted;
    other.covariance.linear *= factor;
    EXPECT_GT(cost(farms, other), least) << "linear part times " << factor;
    other = fitted;
    other.covariance.noise *= factor;
    EXPECT_GT(cost(farms, other), least) << "noise times " << factor;
  }
}

TEST(FitKernel, FindsTheCovarianceThatValuesWereDrawnFrom) {
  const Drawn farms = drawn_farms(200);
  const heights::Kernel fitted = fit_kernel(farms.features, farms.values, farms.noise);
  EXPECT_NEAR(fitted.weights(0) / kTrue.weights(0), 1, 0.2);
  EXPECT_NEAR(fitted.weights(1) / kTrue.weights(1), 1, 0.3);
  EXPECT_LT(fitted.weights(2), 0.2) << "the prior keeps it from 0";
  const Eigen::VectorXd values = farms.values.col(0).array() - farms.values.col(0).mean();
  const double variance = values.dot(covariance(farms, fitted).inverse() * values) / 200;
  EXPECT_NEAR(std::sqrt(variance) * fitted.covariance.noise / kTrue.covariance.noise, 1, 0.15);
}

}  // namespace
}  // namespace plotscan::calibration
