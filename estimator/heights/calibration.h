// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "heights/kriging.h"

namespace plotscan::heights {

// How a farm is predicted from farms that are less like it: those of other plant libraries, or of
// other crops.
struct FromOthers {
  double novelty = 0;            // how little they know of its canopy (CropModel::novelty)
  Eigen::VectorXd standardised;  // errors / standard deviations, the crop not given
};

// Half of a 95 % interval in standard errors: Student's t with the 24 degrees of freedom that a
// standard deviation from 25 farms has.
inline constexpr double kIntervalErrors = 2.064;

// A farm that the calibration was fitted on. Vectors of heights are in the calibration's order.
struct CalibrationFarm {
  std::string library;  // of its plants
  std::string crop;
  double top_m = 0;  // median over its plots
  Eigen::VectorXd features;
  Eigen::VectorXd ratios;  // true heights over the canopy's top, the same
  Eigen::VectorXd within;  // sd of its plots' ratios about what is predicted
  FromOthers from_libraries, from_crops;
  Eigen::VectorXd standardised_given_crop;  // from_libraries' with its crop given
  double novelty = 0;                       // Prediction::novelty by the other farms
};

// How similar two fields are: the weights of the compared features, and the covariance between the
// places (points) that the weighted features form.
struct Kernel {
  Eigen::VectorXd weights;  // of each number that is compared
  Covariance covariance;
};

// The file that benchmarks/calibration writes (heights/calibration.json). A height's ratio to the
// canopy's top is kriged from the field's features, for each crop by itself, and corrected by the
// difference between the plot's features and the field's.
struct Calibration {
  std::vector<std::string> features = {};
  std::vector<std::string> heights = {};
  Eigen::VectorXd center;  // features are shifted and divided by these
  Eigen::VectorXd scale;
  std::vector<std::string> crops = {};
  Kernel crop_kernel;                      // by features: fields of one crop are alike
  double crop_sharpness = 1;               // of what they tell of the crop
  std::vector<Kernel> ratio_kernels = {};  // by features, for each of `crops`
  Eigen::MatrixXd within;                  // a row a height: weights of the scaled differences
  std::vector<CalibrationFarm> farms = {};

  // Features scaled to a spread of 1, no farther than 4 from the middle.
  Eigen::VectorXd scaled(const Eigen::VectorXd& values) const;
  // The crop's place in `crops`. Throws InputError on one that is not there.
  std::size_t index_of(const std::string& crop) const;
  // In the order of `crops`: 1 for this one, 0 for the others. Throws as index_of does.
  Eigen::VectorXd indicators_of(const std::string& crop) const;
  // A row a farm: its scaled features, and its ratios.
  Eigen::MatrixXd features_of_farms() const;
  Eigen::MatrixXd ratios() const;
  std::vector<double> noise() const;
  // The calibration with fewer farms: without those left out, only the crop's, every second one.
  Calibration without(std::span<const std::size_t> farms_left_out) const;
  Calibration of_crop(const std::string& crop) const;
  Calibration halved() const;
};

nlohmann::json json_of(const Calibration& calibration);
Calibration calibration_of(const nlohmann::json& document);

// The calibration that is built into the library.
const Calibration& shipped_calibration();

// Median of each feature over a field's plots; `features` holds at least one.
Eigen::VectorXd field_features(std::span<const Eigen::VectorXd> features);

}  // namespace plotscan::heights
