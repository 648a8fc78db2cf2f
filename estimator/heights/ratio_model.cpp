// SPDX-License-Identifier: Apache-2.0
#include "heights/ratio_model.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/statistics.h"

namespace plotscan::heights {
namespace {

// Farms whose errors say how wide errors are at a place: enough for a root mean square to be within
// 15 %.
constexpr std::size_t kNeighbours = 25;

// Crops less likely than this are left out of a mixture.
constexpr double kLeastLikely = 1e-3;

// Numbers of a farm, and how far it is from a place.
struct Neighbour {
  double squared_distance;
  const Eigen::VectorXd* numbers;
};

// Root mean square of the nearest ones' numbers.
Eigen::VectorXd spread_of(std::vector<Neighbour> neighbours) {
  const std::size_t count = std::min(neighbours.size(), kNeighbours);
  std::ranges::partial_sort(neighbours, neighbours.begin() + static_cast<std::ptrdiff_t>(count), {},
                            &Neighbour::squared_distance);
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(neighbours.front().numbers->size());
  for (std::size_t i = 0; i < count; ++i) squares += neighbours[i].numbers->cwiseAbs2();
  return (squares / static_cast<double>(count)).cwiseSqrt();
}

// What is left within the farms at these distances.
Eigen::VectorXd spread_within(const Calibration& calibration,
                              const Eigen::VectorXd& squared_distances) {
  std::vector<Neighbour> neighbours;
  for (std::size_t i = 0; i < calibration.farms.size(); ++i)
    neighbours.push_back({.squared_distance = squared_distances(static_cast<Eigen::Index>(i)),
                          .numbers = &calibration.farms[i].within});
  return spread_of(std::move(neighbours));
}

// What predictions from others missed by, of canopies of which as little was known. A user's plants
// are of no library, and may be as unlike all of them as one crop is unlike the others: how little
// is known of them says how much of each.
Eigen::VectorXd surprise_from_others(const Calibration& calibration,
                                     const Eigen::VectorXd& squared_distances,
                                     const CropEvidence& crop) {
  constexpr double kWeight = 0.1;  // a factor e of `unlike` is as far as 0.3 in features
  std::vector<Neighbour> neighbours;
  for (std::size_t i = 0; i < calibration.farms.size(); ++i) {
    const CalibrationFarm& farm = calibration.farms[i];
    const auto add = [&](double unlike, const Eigen::VectorXd& surprise) {
      const double factor = std::log(crop.unlike / unlike);
      neighbours.push_back({.squared_distance = squared_distances(static_cast<Eigen::Index>(i)) +
                                                kWeight * factor * factor,
                            .numbers = &surprise});
    };
    add(farm.from_libraries.unlike,
        crop.given ? farm.surprise_given_crop : farm.from_libraries.surprise);
    add(farm.from_crops.unlike, farm.from_crops.surprise);
  }
  return spread_of(std::move(neighbours));
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
                           const CropEvidence& crop) const {
  const Prediction ratios = mixture(scaled, top_m, crop.probabilities);
  const Eigen::VectorXd distances =
      kriging_.squared_distances(likeliest_place(scaled, crop.probabilities));
  const Eigen::VectorXd surprise = surprise_from_others(calibration_, distances, crop);
  return {.values = ratios.values,
          .field_sds = ratios.sds.cwiseProduct(surprise),
          .within_sds = spread_within(calibration_, distances)};
}

double RatioModel::unlike(const Eigen::VectorXd& scaled, const Eigen::VectorXd& crops) const {
  return kriging_.unlike(likeliest_place(scaled, crops)) / usual_unlike_;
}

}  // namespace plotscan::heights
