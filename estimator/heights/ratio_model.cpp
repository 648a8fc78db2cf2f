// SPDX-License-Identifier: Apache-2.0
#include "heights/ratio_model.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/list_of.h"
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

// Spread of the plots' ratios within a farm, from the farms nearest by these distances.
Eigen::VectorXd spread_within(std::span<const CalibrationFarm> farms,
                              const Eigen::VectorXd& squared_distances) {
  std::vector<Neighbour> neighbours;
  for (std::size_t i = 0; i < farms.size(); ++i)
    neighbours.push_back({.squared_distance = squared_distances(static_cast<Eigen::Index>(i)),
                          .numbers = &farms[i].within});
  return spread_of(std::move(neighbours));
}

// Standardised errors of predictions from other libraries and crops, of canopies that were as
// little known. A user's plants are of no library, and may differ from all as much as one crop
// differs from the others: their novelty says how much each kind of error counts.
Eigen::VectorXd standardised_from_others(std::span<const CalibrationFarm> farms,
                                         const Eigen::VectorXd& squared_distances,
                                         const CropEvidence& crop) {
  constexpr double kWeight = 1;  // a factor e of `novelty` is as far as 1 in features
  std::vector<Neighbour> neighbours;
  for (std::size_t i = 0; i < farms.size(); ++i) {
    const CalibrationFarm& farm = farms[i];
    const auto add = [&](double novelty, const Eigen::VectorXd& standardised) {
      const double factor = std::log(crop.novelty / novelty);
      neighbours.push_back({.squared_distance = squared_distances(static_cast<Eigen::Index>(i)) +
                                                kWeight * factor * factor,
                            .numbers = &standardised});
    };
    add(farm.from_libraries.novelty,
        crop.given ? farm.standardised_given_crop : farm.from_libraries.standardised);
    add(farm.from_crops.novelty, farm.from_crops.standardised);
  }
  return spread_of(std::move(neighbours));
}

double usual_novelty(std::span<const CalibrationFarm> farms) {
  constexpr double kUsual = 0.95;
  return quantile(list_of(farms, &CalibrationFarm::novelty), kUsual);
}

}  // namespace

RatioModel::OfCrop::OfCrop(Calibration own, Kernel kernel)
    : own_(std::move(own)),
      kernel_(std::move(kernel)),
      usual_novelty_(heights::usual_novelty(own_.farms)) {}

Eigen::VectorXd RatioModel::OfCrop::place(const Eigen::VectorXd& scaled) const {
  return scaled.cwiseProduct(kernel_.weights);
}

const Kriging& RatioModel::OfCrop::kriging() const {
  std::call_once(asked_, [this] {
    kriging_.emplace(own_.features_of_farms() * kernel_.weights.asDiagonal(), own_.ratios(),
                     own_.noise(), kernel_.covariance);
  });
  return *kriging_;
}

RatioModel::RatioModel(const Calibration& calibration) {
  for (std::size_t i = 0; i < calibration.crops.size(); ++i) {
    Calibration own = calibration.of_crop(calibration.crops[i]);
    if (own.farms.empty()) continue;
    crops_.try_emplace(static_cast<Eigen::Index>(i), std::move(own), calibration.ratio_kernels[i]);
  }
}

const RatioModel::OfCrop& RatioModel::likeliest(const Eigen::VectorXd& crops) const {
  Eigen::Index likeliest = 0;
  crops.maxCoeff(&likeliest);
  return crops_.at(likeliest);
}

Prediction RatioModel::mixture(const Eigen::VectorXd& scaled, double top_m,
                               const Eigen::VectorXd& crops) const {
  double sum = 0;
  Eigen::VectorXd values;
  Eigen::VectorXd squares;
  for (const auto& [i, crop] : crops_) {
    if (crops(i) < kLeastLikely) continue;
    const Prediction of_crop = crop.kriging().at(crop.place(scaled), relative_noise(top_m));
    if (sum == 0) values = squares = Eigen::VectorXd::Zero(of_crop.values.size());
    sum += crops(i);
    values += crops(i) * of_crop.values;
    squares += crops(i) * (of_crop.values.cwiseAbs2() + of_crop.sds.cwiseAbs2());
  }
  values /= sum;
  return {.values = values,
          .sds = (squares / sum - values.cwiseAbs2()).cwiseMax(0).cwiseSqrt(),
          .novelty = likeliest(crops).kriging().novelty(likeliest(crops).place(scaled))};
}

FieldRatios RatioModel::at(const Eigen::VectorXd& scaled, double top_m,
                           const CropEvidence& crop) const {
  const Prediction ratios = mixture(scaled, top_m, crop.probabilities);
  const OfCrop& likely = likeliest(crop.probabilities);
  const Eigen::VectorXd distances = likely.kriging().squared_distances(likely.place(scaled));
  const Eigen::VectorXd standardised = standardised_from_others(likely.farms(), distances, crop);
  return {.values = ratios.values,
          .field_sds = ratios.sds.cwiseProduct(standardised),
          .within_sds = spread_within(likely.farms(), distances)};
}

double RatioModel::novelty(const Eigen::VectorXd& scaled, const Eigen::VectorXd& crops) const {
  const OfCrop& likely = likeliest(crops);
  return likely.kriging().novelty(likely.place(scaled)) / likely.usual_novelty();
}

}  // namespace plotscan::heights
