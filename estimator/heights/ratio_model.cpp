// SPDX-License-Identifier: Apache-2.0
#include "heights/ratio_model.h"

#include <numeric>

namespace plotscan::heights {

RatioModel::RatioModel(const Calibration& calibration, const std::string& height)
    : kriging_(calibration.scaled_farms(), calibration.ratios_of(height),
               calibration.noise_of(height), calibration.models.at(height).covariance) {
  std::vector<int> each_alone(calibration.farms.size());
  std::iota(each_alone.begin(), each_alone.end(), 0);
  const std::vector<Prediction> by_others = kriging_.without_own_group(each_alone);
  for (std::size_t i = 0; i < calibration.farms.size(); ++i) {
    const CalibrationFarm& farm = calibration.farms[i];
    surprises_.push_back((farm.ratios.at(height) - by_others[i].value) / by_others[i].sd);
    within_.push_back(farm.within.at(height));
  }
}

FieldRatio RatioModel::at(const Eigen::VectorXd& place) const {
  const Prediction ratio = kriging_.at(place);
  return {.value = ratio.value,
          .field_sd = ratio.sd * kriging_.local_spread(place, surprises_),
          .within_sd = kriging_.local_spread(place, within_)};
}

}  // namespace plotscan::heights
