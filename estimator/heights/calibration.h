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

// A farm that the calibration was fitted on.
struct CalibrationFarm {
  std::string library;                        // of its plants
  Eigen::VectorXd features;                   // median over its plots
  std::map<std::string, double> ratios = {};  // true height over the canopy's top, the same
  std::map<std::string, double> noise = {};   // sd of such ratios that features do not explain
  std::map<std::string, double> within = {};  // sd of its plots' ratios about what is predicted
};

// How one height follows from a canopy's features: its ratio to the canopy's top is kriged from the
// field's features and corrected by what the plot's differ from the field's.
struct HeightModel {
  Covariance covariance;
  Eigen::VectorXd within;  // weights of the scaled differences
};

// The file that benchmarks/calibration writes (heights/calibration.json).
struct Calibration {
  std::vector<std::string> features = {};
  Eigen::VectorXd center;  // features are shifted and divided by these
  Eigen::VectorXd scale;
  std::vector<CalibrationFarm> farms = {};
  std::map<std::string, HeightModel> models = {};

  Eigen::VectorXd scaled(const Eigen::VectorXd& values) const {
    return (values - center).cwiseQuotient(scale);
  }
  // A row a farm.
  Eigen::MatrixXd scaled_farms() const;
  Eigen::VectorXd ratios_of(const std::string& height) const;
  std::vector<double> noise_of(const std::string& height) const;
};

nlohmann::json json_of(const Calibration& calibration);
Calibration calibration_of(const nlohmann::json& document);

// The library's own.
const Calibration& shipped_calibration();

// Median of each feature over a field's plots; `features` holds at least one.
Eigen::VectorXd field_features(std::span<const Eigen::VectorXd> features);

}  // namespace plotscan::heights
