// SPDX-License-Identifier: Apache-2.0
#include "heights/ratio_model.h"

#include <vector>

#include "core/statistics.h"

namespace plotscan::heights {
namespace {

// Farms whose errors say how wide errors are at a place: enough for a root mean square to be within
// 15 %.
constexpr std::size_t kNeighbours = 25;

// Crops less likely than this are left out of a mixture.
constexpr double kLeastLikely = 1e-3;

// Root mean square over some farms of one of their vectors.
Eigen::VectorXd spread_of(const Calibration& calibration, const std::vector<std::size_t>& farms,
                          Eigen::VectorXd CalibrationFarm::*numbers) {
  Eigen::VectorXd squares =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(calibration.heights.size()));
  for (const std::size_t farm : farms) squares += (calibration.farms[farm].*numbers).cwiseAbs2();
  return (squares / static_cast<double>(farms.size())).cwiseSqrt();
}

}  // namespace

RatioModel::RatioModel(const Calibration& calibration)
    : calibration_(calibration),
      kriging_(
          calibration.features_and_crops_of_farms() * calibration.like_ratios.weights.asDiagonal(),
          calibration.ratios(), calibration.noise(), calibration.like_ratios.covariance) {
  constexpr double kUsual = 0.95;
  std::vector<double> unlike;
  for (const CalibrationFarm& farm : calibration.farms) unlike.push_back(farm.unlike);
  usual_unlike_ = quantile(unlike, kUsual);
}

Eigen::VectorXd RatioModel::place(const Eigen::VectorXd& scaled, std::size_t crop) const {
  return calibration_.with_crop(scaled, crop).cwiseProduct(calibration_.like_ratios.weights);
}

Eigen::VectorXd RatioModel::likeliest_place(const Eigen::VectorXd& scaled,
                                            const Eigen::VectorXd& crops) const {
  Eigen::Index likeliest = 0;
  crops.maxCoeff(&likeliest);
  return place(scaled, static_cast<std::size_t>(likeliest));
}

Prediction RatioModel::mixture(const Eigen::VectorXd& scaled, double top_m,
                               const Eigen::VectorXd& crops) const {
  const auto heights = static_cast<Eigen::Index>(calibration_.heights.size());
  double sum = 0;
  Eigen::VectorXd values = Eigen::VectorXd::Zero(heights), squares = values;
  for (Eigen::Index crop = 0; crop < crops.size(); ++crop) {
    if (crops(crop) < kLeastLikely) continue;
    const Prediction of_crop =
        kriging_.at(place(scaled, static_cast<std::size_t>(crop)), relative_noise(top_m));
    sum += crops(crop);
    values += crops(crop) * of_crop.values;
    squares += crops(crop) * (of_crop.values.cwiseAbs2() + of_crop.sds.cwiseAbs2());
  }
  values /= sum;
  return {.values = values,
          .sds = (squares / sum - values.cwiseAbs2()).cwiseMax(0).cwiseSqrt(),
          .unlike = kriging_.unlike(likeliest_place(scaled, crops))};
}

FieldRatios RatioModel::at(const Eigen::VectorXd& scaled, double top_m,
                           const Eigen::VectorXd& crops, bool told) const {
  const Prediction ratios = mixture(scaled, top_m, crops);
  const std::vector<std::size_t> farms =
      kriging_.nearest(likeliest_place(scaled, crops), kNeighbours);
  const Eigen::VectorXd surprise = spread_of(
      calibration_, farms,
      told ? &CalibrationFarm::surprise_told_crop : &CalibrationFarm::surprise_given_crop);
  return {.values = ratios.values,
          .field_sds = ratios.sds.cwiseProduct(surprise),
          .within_sds = spread_of(calibration_, farms, &CalibrationFarm::within)};
}

double RatioModel::unlike(const Eigen::VectorXd& scaled, const Eigen::VectorXd& crops) const {
  return kriging_.unlike(likeliest_place(scaled, crops)) / usual_unlike_;
}

}  // namespace plotscan::heights
