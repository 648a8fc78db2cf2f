// SPDX-License-Identifier: Apache-2.0
#include "heights/calibration.h"

#include "core/statistics.h"
#include "heights/calibration_files.h"

namespace plotscan::heights {
namespace {

using nlohmann::json;

Eigen::VectorXd vector_of(const json& numbers) {
  const auto values = numbers.get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

json numbers_of(const Eigen::VectorXd& values) {
  return std::vector<double>(values.begin(), values.end());
}

}  // namespace

Eigen::VectorXd Calibration::scaled(const Eigen::VectorXd& values) const {
  constexpr double kFarthest = 4;
  return (values - center).cwiseQuotient(scale).cwiseMax(-kFarthest).cwiseMin(kFarthest);
}

Eigen::MatrixXd Calibration::places() const {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(farms.size()), center.size());
  for (std::size_t i = 0; i < farms.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) = place(scaled(farms[i].features));
  return rows;
}

Eigen::MatrixXd Calibration::ratios() const {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(farms.size()),
                       static_cast<Eigen::Index>(heights.size()));
  for (std::size_t i = 0; i < farms.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) = farms[i].ratios;
  return rows;
}

std::vector<double> Calibration::noise() const {
  std::vector<double> noise;
  for (const CalibrationFarm& farm : farms) noise.push_back(relative_noise(farm.top_m));
  return noise;
}

json json_of(const Calibration& calibration) {
  json farms = json::array();
  for (const CalibrationFarm& farm : calibration.farms) {
    farms.push_back({{"library", farm.library},
                     {"top_m", farm.top_m},
                     {"features", numbers_of(farm.features)},
                     {"ratios", numbers_of(farm.ratios)},
                     {"within", numbers_of(farm.within)}});
  }
  json within = json::array();
  for (const auto& row : calibration.within.rowwise()) within.push_back(numbers_of(row));
  return {{"features", calibration.features},
          {"heights", calibration.heights},
          {"center", numbers_of(calibration.center)},
          {"scale", numbers_of(calibration.scale)},
          {"weights", numbers_of(calibration.weights)},
          {"linear", calibration.covariance.linear},
          {"noise", calibration.covariance.noise},
          {"within", within},
          {"farms", farms}};
}

Calibration calibration_of(const json& document) {
  Calibration calibration{
      .features = document.at("features"),
      .heights = document.at("heights"),
      .center = vector_of(document.at("center")),
      .scale = vector_of(document.at("scale")),
      .weights = vector_of(document.at("weights")),
      .covariance = {.linear = document.at("linear"), .noise = document.at("noise")},
      .within = {}};
  calibration.within.resize(static_cast<Eigen::Index>(calibration.heights.size()),
                            calibration.center.size());
  for (Eigen::Index row = 0; row < calibration.within.rows(); ++row)
    calibration.within.row(row) = vector_of(document.at("within").at(row));
  for (const json& farm : document.at("farms")) {
    calibration.farms.push_back({.library = farm.at("library"),
                                 .top_m = farm.at("top_m"),
                                 .features = vector_of(farm.at("features")),
                                 .ratios = vector_of(farm.at("ratios")),
                                 .within = vector_of(farm.at("within"))});
  }
  return calibration;
}

const Calibration& shipped_calibration() {
  static const Calibration calibration =
      calibration_of(json::parse(calibration_file("calibration")));
  return calibration;
}

Eigen::VectorXd field_features(std::span<const Eigen::VectorXd> features) {
  Eigen::VectorXd medians(features.front().size());
  for (Eigen::Index k = 0; k < medians.size(); ++k) {
    std::vector<double> values;
    for (const Eigen::VectorXd& plot : features) values.push_back(plot(k));
    medians(k) = quantile(values, 0.5);
  }
  return medians;
}

}  // namespace plotscan::heights
