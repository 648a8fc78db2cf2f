// SPDX-License-Identifier: Apache-2.0
#include "heights/kriging.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

namespace plotscan::heights {
namespace {

// Prior standard deviation of the values' common level: wide against any ratio of heights.
constexpr double kLevel = 1;

// Known places whose errors say how wide errors are at another: enough for a root mean square to be
// within 15 %.
constexpr std::size_t kNeighbours = 25;

double square(double value) { return value * value; }

}  // namespace

Kriging::Kriging(Eigen::MatrixXd places, Eigen::VectorXd values, std::vector<double> noise,
                 const Covariance& covariance)
    : places_(std::move(places)),
      values_(std::move(values)),
      noise_(std::move(noise)),
      covariance_(covariance),
      center_(values_.mean()) {
  const Eigen::Index count = places_.rows();
  Eigen::MatrixXd matrix(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) matrix(i, j) = between(places_.row(i), places_.row(j));
    matrix(i, i) += square(noise_[static_cast<std::size_t>(i)]);
  }
  inverse_ =
      matrix.selfadjointView<Eigen::Lower>().llt().solve(Eigen::MatrixXd::Identity(count, count));
  weights_ = inverse_ * (values_.array() - center_).matrix();
}

double Kriging::between(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
  const auto numbers = static_cast<double>(a.size());
  return square(kLevel) + square(covariance_.linear) * a.dot(b) / numbers +
         square(covariance_.signal) *
             std::exp(-0.5 * (a - b).squaredNorm() / (numbers * square(covariance_.length)));
}

Prediction Kriging::at(const Eigen::VectorXd& place) const {
  Eigen::VectorXd covariances(places_.rows());
  for (Eigen::Index i = 0; i < places_.rows(); ++i) covariances(i) = between(places_.row(i), place);
  const double variance = between(place, place) - covariances.dot(inverse_ * covariances);
  return {.value = center_ + covariances.dot(weights_),
          .sd = std::sqrt(std::max(0.0, variance) + square(local_spread(place, noise_)))};
}

double Kriging::local_spread(const Eigen::VectorXd& place, std::span<const double> numbers) const {
  std::vector<std::pair<double, std::size_t>> nearest;
  for (Eigen::Index i = 0; i < places_.rows(); ++i)
    nearest.emplace_back((places_.row(i).transpose() - place).squaredNorm(),
                         static_cast<std::size_t>(i));
  std::ranges::sort(nearest);
  nearest.resize(std::min(nearest.size(), kNeighbours));
  double sum = 0;
  for (const auto& [distance, i] : nearest) sum += square(numbers[i]);
  return std::sqrt(sum / static_cast<double>(nearest.size()));
}

std::vector<Prediction> Kriging::without_own_group(std::span<const int> groups) const {
  std::vector<Prediction> predictions(groups.size());
  for (std::size_t first = 0; first < groups.size(); ++first) {
    std::vector<Eigen::Index> group;
    for (std::size_t i = 0; i < groups.size(); ++i)
      if (groups[i] == groups[first]) group.push_back(static_cast<Eigen::Index>(i));
    if (group.front() != static_cast<Eigen::Index>(first)) continue;
    const Eigen::MatrixXd own = inverse_(group, group);
    const Eigen::MatrixXd covariance =
        own.llt().solve(Eigen::MatrixXd::Identity(own.rows(), own.cols()));
    const Eigen::VectorXd shift = covariance * weights_(group);
    for (std::size_t k = 0; k < group.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      predictions[static_cast<std::size_t>(group[k])] = {
          .value = values_(group[k]) - shift(row),
          .sd = std::sqrt(std::max(0.0, covariance(row, row)))};
    }
  }
  return predictions;
}

}  // namespace plotscan::heights
