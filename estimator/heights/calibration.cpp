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

Eigen::MatrixXd Calibration::scaled_farms() const {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(farms.size()), center.size());
  for (std::size_t i = 0; i < farms.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) = scaled(farms[i].features);
  return rows;
}

Eigen::VectorXd Calibration::ratios_of(const std::string& height) const {
  Eigen::VectorXd ratios(static_cast<Eigen::Index>(farms.size()));
  for (std::size_t i = 0; i < farms.size(); ++i)
    ratios(static_cast<Eigen::Index>(i)) = farms[i].ratios.at(height);
  return ratios;
}

std::vector<double> Calibration::noise_of(const std::string& height) const {
  std::vector<double> noise;
  for (const CalibrationFarm& farm : farms) noise.push_back(farm.noise.at(height));
  return noise;
}

json json_of(const Calibration& calibration) {
  json farms = json::array();
  for (const CalibrationFarm& farm : calibration.farms) {
    farms.push_back({{"library", farm.library},
                     {"features", numbers_of(farm.features)},
                     {"ratios", farm.ratios},
                     {"noise", farm.noise},
                     {"within", farm.within}});
  }
  json models = json::object();
  for (const auto& [height, model] : calibration.models) {
    models[height] = {{"signal", model.covariance.signal},
                      {"length", model.covariance.length},
                      {"linear", model.covariance.linear},
                      {"within", numbers_of(model.within)}};
  }
  return {{"features", calibration.features},
          {"center", numbers_of(calibration.center)},
          {"scale", numbers_of(calibration.scale)},
          {"heights", models},
          {"farms", farms}};
}

Calibration calibration_of(const json& document) {
  Calibration calibration{.features = document.at("features"),
                          .center = vector_of(document.at("center")),
                          .scale = vector_of(document.at("scale"))};
  for (const json& farm : document.at("farms")) {
    calibration.farms.push_back({.library = farm.at("library"),
                                 .features = vector_of(farm.at("features")),
                                 .ratios = farm.at("ratios"),
                                 .noise = farm.at("noise"),
                                 .within = farm.at("within")});
  }
  for (const auto& [height, model] : document.at("heights").items()) {
    calibration.models[height] = {.covariance = {.signal = model.at("signal"),
                                                 .length = model.at("length"),
                                                 .linear = model.at("linear")},
                                  .within = vector_of(model.at("within"))};
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
