// SPDX-License-Identifier: Apache-2.0
#include "heights/crop_model.h"

#include <algorithm>
#include <vector>

namespace plotscan::heights {

Eigen::VectorXd softmax(const Eigen::VectorXd& scores, double sharpness) {
  const Eigen::ArrayXd shares = (sharpness * (scores.array() - scores.maxCoeff())).exp();
  return shares / shares.sum();
}

Eigen::MatrixXd crop_indicators(const Calibration& calibration) {
  Eigen::MatrixXd indicators(static_cast<Eigen::Index>(calibration.farms.size()),
                             static_cast<Eigen::Index>(calibration.crops.size()));
  for (std::size_t i = 0; i < calibration.farms.size(); ++i)
    indicators.row(static_cast<Eigen::Index>(i)) =
        calibration.indicators_of(calibration.farms[i].crop);
  return indicators;
}

Kriging indicators_kriged(const Calibration& calibration) {
  return {calibration.features_of_farms() * calibration.crop_kernel.weights.asDiagonal(),
          crop_indicators(calibration), std::vector<double>(calibration.farms.size(), 1),
          calibration.crop_kernel.covariance};
}

CropModel::CropModel(const Calibration& calibration)
    : weights_(calibration.crop_kernel.weights),
      sharpness_(calibration.crop_sharpness),
      indicators_(indicators_kriged(calibration.halved())) {}

Eigen::VectorXd CropModel::scores(const Eigen::VectorXd& scaled) const {
  return indicators_.values_at(scaled.cwiseProduct(weights_)) / novelty(scaled);
}

Eigen::VectorXd CropModel::probabilities(const Eigen::VectorXd& scaled) const {
  return softmax(scores(scaled), sharpness_);
}

double CropModel::novelty(const Eigen::VectorXd& scaled) const {
  constexpr double kLeast = 0.1;
  return std::max(kLeast, indicators_.novelty(scaled.cwiseProduct(weights_)));
}

}  // namespace plotscan::heights
