// SPDX-License-Identifier: Apache-2.0
#include "heights/kriging.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"

namespace plotscan::heights {
namespace {

// Prior variance of the values' common level: wide against what values vary by.
constexpr double kLevelVariance = 10;

double square(double value) { return value * value; }

}  // namespace

Eigen::MatrixXd squared_exponentials_of(const Eigen::MatrixXd& places) {
  Eigen::MatrixXd result = places * places.transpose();
  const Eigen::VectorXd squares = result.diagonal();
  for (Eigen::Index j = 0; j < result.cols(); ++j) {
    const Eigen::ArrayXd distances =
        (squares.array() + squares(j) - 2 * result.col(j).array()).max(0);
    result.col(j) = (-0.5 * distances).exp();
  }
  return result;
}

Eigen::MatrixXd covariances_of(const Eigen::MatrixXd& places, double linear) {
  return (squared_exponentials_of(places) + square(linear) * places * places.transpose()).array() +
         kLevelVariance;
}

double relative_noise(double top_m) {
  constexpr double kHalfway_m = 0.5;
  return std::hypot(1, kHalfway_m / top_m);
}

Kriging::Kriging(Eigen::MatrixXd places, const Eigen::MatrixXd& values, std::vector<double> noise,
                 const Covariance& covariance)
    : places_(std::move(places)),
      values_(values),
      noise_(std::move(noise)),
      covariance_(covariance),
      center_(values.colwise().mean()) {
  Eigen::MatrixXd matrix = covariances_of(places_, covariance_.linear);
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    matrix(i, i) += noise_variance(noise_[static_cast<std::size_t>(i)]);
  factor_.compute(matrix);
  check(factor_.info() == Eigen::Success, "the covariance of the places is positive definite");
  const Eigen::MatrixXd centred = values_.rowwise() - center_;
  weights_ = factor_.solve(centred);
  scales_ = (centred.cwiseProduct(weights_).colwise().sum() / static_cast<double>(centred.rows()))
                .cwiseSqrt();
}

double Kriging::noise_variance(double noise) const { return square(noise * covariance_.noise); }

Eigen::VectorXd Kriging::squared_distances(const Eigen::VectorXd& place) const {
  return (places_.rowwise() - place.transpose()).rowwise().squaredNorm();
}

Eigen::VectorXd Kriging::covariances(const Eigen::VectorXd& place) const {
  return ((-0.5 * squared_distances(place).array()).exp() +
          square(covariance_.linear) * (places_ * place).array() + kLevelVariance)
      .matrix();
}

double Kriging::novelty(const Eigen::VectorXd& place) const {
  const Eigen::VectorXd known = factor_.matrixL().solve(covariances(place));
  const double own = 1 + square(covariance_.linear) * place.squaredNorm() + kLevelVariance;
  return std::sqrt(std::max(0.0, own - known.squaredNorm()));
}

Eigen::VectorXd Kriging::values_at(const Eigen::VectorXd& place) const {
  return center_.transpose() + weights_.transpose() * covariances(place);
}

Prediction Kriging::at(const Eigen::VectorXd& place, double noise) const {
  Prediction prediction{.values = values_at(place), .sds = {}, .novelty = novelty(place)};
  prediction.sds = scales_ * std::sqrt(square(prediction.novelty) + noise_variance(noise));
  return prediction;
}

}  // namespace plotscan::heights
