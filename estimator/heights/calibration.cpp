// SPDX-License-Identifier: Apache-2.0
#include "heights/calibration.h"

#include <algorithm>

#include "core/error.h"
#include "core/statistics.h"
#include "core/text.h"
#include "heights/internal/calibration_files.h"

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

json kernel_json(const Kernel& kernel) {
  return {{"weights", numbers_of(kernel.weights)},
          {"linear", kernel.covariance.linear},
          {"noise", kernel.covariance.noise}};
}

Kernel kernel_of(const json& document) {
  return {.weights = vector_of(document.at("weights")),
          .covariance = {.linear = document.at("linear"), .noise = document.at("noise")}};
}

json from_others_json(const FromOthers& from) {
  return {{"novelty", from.novelty}, {"standardised", numbers_of(from.standardised)}};
}

FromOthers from_others_of(const json& document) {
  return {.novelty = document.at("novelty"),
          .standardised = vector_of(document.at("standardised"))};
}

// The calibration with only the farms whose index `is_kept` accepts.
Calibration with_farms(const Calibration& calibration, auto&& is_kept) {
  Calibration fewer = calibration;
  fewer.farms.clear();
  for (std::size_t i = 0; i < calibration.farms.size(); ++i)
    if (is_kept(i)) fewer.farms.push_back(calibration.farms[i]);
  return fewer;
}

}  // namespace

Eigen::VectorXd Calibration::scaled(const Eigen::VectorXd& values) const {
  constexpr double kFarthest = 4;
  return (values - center).cwiseQuotient(scale).cwiseMax(-kFarthest).cwiseMin(kFarthest);
}

std::size_t Calibration::index_of(const std::string& crop) const {
  const auto known = std::ranges::find(crops, crop);
  if (known == crops.end())
    throw InputError("there is no crop \"" + crop + "\" in the calibration; there is " +
                     joined(crops, ", "));
  return static_cast<std::size_t>(known - crops.begin());
}

Eigen::VectorXd Calibration::indicators_of(const std::string& crop) const {
  return Eigen::VectorXd::Unit(static_cast<Eigen::Index>(crops.size()),
                               static_cast<Eigen::Index>(index_of(crop)));
}

Eigen::MatrixXd Calibration::features_of_farms() const {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(farms.size()), center.size());
  for (std::size_t i = 0; i < farms.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) = scaled(farms[i].features);
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

Calibration Calibration::without(std::span<const std::size_t> farms_left_out) const {
  return with_farms(*this, [&](std::size_t i) {
    return std::ranges::find(farms_left_out, i) == farms_left_out.end();
  });
}

Calibration Calibration::of_crop(const std::string& crop) const {
  return with_farms(*this, [&](std::size_t i) { return farms[i].crop == crop; });
}

Calibration Calibration::halved() const {
  return with_farms(*this, [](std::size_t i) { return i % 2 == 0; });
}

json json_of(const Calibration& calibration) {
  json farms = json::array();
  for (const CalibrationFarm& farm : calibration.farms) {
    farms.push_back({{"library", farm.library},
                     {"crop", farm.crop},
                     {"top_m", farm.top_m},
                     {"features", numbers_of(farm.features)},
                     {"ratios", numbers_of(farm.ratios)},
                     {"within", numbers_of(farm.within)},
                     {"from_libraries", from_others_json(farm.from_libraries)},
                     {"from_crops", from_others_json(farm.from_crops)},
                     {"standardised_given_crop", numbers_of(farm.standardised_given_crop)},
                     {"novelty", farm.novelty}});
  }
  json ratio_kernels = json::array();
  for (const Kernel& kernel : calibration.ratio_kernels)
    ratio_kernels.push_back(kernel_json(kernel));
  json within = json::array();
  for (const auto& row : calibration.within.rowwise()) within.push_back(numbers_of(row));
  return {{"features", calibration.features},
          {"heights", calibration.heights},
          {"center", numbers_of(calibration.center)},
          {"scale", numbers_of(calibration.scale)},
          {"crops", calibration.crops},
          {"crop_kernel", kernel_json(calibration.crop_kernel)},
          {"crop_sharpness", calibration.crop_sharpness},
          {"ratio_kernels", ratio_kernels},
          {"within", within},
          {"farms", farms}};
}

Calibration calibration_of(const json& document) {
  Calibration calibration{.features = document.at("features"),
                          .heights = document.at("heights"),
                          .center = vector_of(document.at("center")),
                          .scale = vector_of(document.at("scale")),
                          .crops = document.at("crops"),
                          .crop_kernel = kernel_of(document.at("crop_kernel")),
                          .crop_sharpness = document.at("crop_sharpness"),
                          .within = {}};
  for (const json& kernel : document.at("ratio_kernels"))
    calibration.ratio_kernels.push_back(kernel_of(kernel));
  calibration.within.resize(static_cast<Eigen::Index>(calibration.heights.size()),
                            calibration.center.size());
  for (Eigen::Index row = 0; row < calibration.within.rows(); ++row)
    calibration.within.row(row) = vector_of(document.at("within").at(row));
  for (const json& farm : document.at("farms")) {
    calibration.farms.push_back(
        {.library = farm.at("library"),
         .crop = farm.at("crop"),
         .top_m = farm.at("top_m"),
         .features = vector_of(farm.at("features")),
         .ratios = vector_of(farm.at("ratios")),
         .within = vector_of(farm.at("within")),
         .from_libraries = from_others_of(farm.at("from_libraries")),
         .from_crops = from_others_of(farm.at("from_crops")),
         .standardised_given_crop = vector_of(farm.at("standardised_given_crop")),
         .novelty = farm.at("novelty")});
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
