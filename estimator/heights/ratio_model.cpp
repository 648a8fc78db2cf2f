// SPDX-License-Identifier: Apache-2.0
#include "heights/ratio_model.h"

#include <algorithm>
#include <numeric>

#include "core/statistics.h"

namespace plotscan::heights {
namespace {

// Farms whose errors say how wide errors are at a place: enough for a root mean square to be within
// 15 %.
constexpr std::size_t kNeighbours = 25;

// Root mean square over some rows of a matrix.
Eigen::VectorXd spread_of(const Eigen::MatrixXd& numbers, const std::vector<std::size_t>& rows) {
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(numbers.cols());
  for (const std::size_t row : rows)
    squares += numbers.row(static_cast<Eigen::Index>(row)).transpose().cwiseAbs2();
  return (squares / static_cast<double>(rows.size())).cwiseSqrt();
}

}  // namespace

RatioModel::RatioModel(const Calibration& calibration)
    : kriging_(calibration.places(), calibration.ratios(), calibration.noise(),
               calibration.covariance),
      surprises_(calibration.farms.size(), calibration.heights.size()),
      within_(calibration.farms.size(), calibration.heights.size()) {
  std::vector<int> each_alone(calibration.farms.size());
  std::iota(each_alone.begin(), each_alone.end(), 0);
  const std::vector<Prediction> by_others = kriging_.without_own_group(each_alone);
  for (std::size_t i = 0; i < calibration.farms.size(); ++i) {
    const CalibrationFarm& farm = calibration.farms[i];
    const auto row = static_cast<Eigen::Index>(i);
    surprises_.row(row) = (farm.ratios - by_others[i].values).cwiseQuotient(by_others[i].sds);
    within_.row(row) = farm.within;
  }
  constexpr double kUsual = 0.95;
  std::vector<double> unlike;
  for (const Prediction& farm : by_others) unlike.push_back(farm.unlike);
  usual_unlike_ = quantile(unlike, kUsual);
}

FieldRatios RatioModel::at(const Eigen::VectorXd& place, double top_m) const {
  const Prediction ratios = kriging_.at(place, relative_noise(top_m));
  const std::vector<std::size_t> farms = kriging_.nearest(place, kNeighbours);
  return {.values = ratios.values,
          .field_sds = ratios.sds.cwiseProduct(spread_of(surprises_, farms)),
          .within_sds = spread_of(within_, farms)};
}

double RatioModel::unlike(const Eigen::VectorXd& place) const {
  return kriging_.unlike(place) / usual_unlike_;
}

}  // namespace plotscan::heights
