// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "heights/kriging.h"

namespace plotscan::heights {

// A farm that the calibration was fitted on. Vectors of heights are in the calibration's order.
struct CalibrationFarm {
  std::string library;  // of its plants
  double top_m = 0;     // median over its plots
  Eigen::VectorXd features;
  Eigen::VectorXd ratios;  // true heights over the canopy's top, the same
  Eigen::VectorXd within;  // sd of its plots' ratios about what is predicted
};

// The file that benchmarks/calibration writes (heights/calibration.json). A height's ratio to the
// canopy's top is kriged from the field's features and corrected by what the plot's differ from the
// field's.
struct Calibration {
  std::vector<std::string> features = {};
  std::vector<std::string> heights = {};
  Eigen::VectorXd center;  // features are shifted and divided by these
  Eigen::VectorXd scale;
  Eigen::VectorXd weights;  // of each feature in a farm's place: near farms have like ratios
  Covariance covariance;
  Eigen::MatrixXd within;  // a row a height: weights of the scaled differences
  std::vector<CalibrationFarm> farms = {};

  // Features scaled to a spread of 1, no farther than 4 from the middle.
  Eigen::VectorXd scaled(const Eigen::VectorXd& values) const;
  // Where the regression has a field or plot of these scaled features.
  Eigen::VectorXd place(const Eigen::VectorXd& scaled) const {
    return scaled.cwiseProduct(weights);
  }
  // A row a farm: their places, and their ratios.
  Eigen::MatrixXd places() const;
  Eigen::MatrixXd ratios() const;
  std::vector<double> noise() const;
};

nlohmann::json json_of(const Calibration& calibration);
Calibration calibration_of(const nlohmann::json& document);

// The library's own.
const Calibration& shipped_calibration();

// Median of each feature over a field's plots; `features` holds at least one.
Eigen::VectorXd field_features(std::span<const Eigen::VectorXd> features);

}  // namespace plotscan::heights
