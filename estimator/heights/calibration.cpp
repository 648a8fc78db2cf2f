// SPDX-License-Identifier: Apache-2.0
#include "heights/calibration.h"

#include <algorithm>

#include "core/contains.h"
#include "core/error.h"
#include "core/list_of.h"
#include "core/statistics.h"
#include "core/text.h"
#include "heights/internal/calibration_files.h"

using nlohmann::json;

// Vectors as arrays of numbers, matrices as arrays of their rows.
template <>
struct nlohmann::adl_serializer<Eigen::VectorXd> {
  static void to_json(json& document, const Eigen::VectorXd& values) {
    document = std::vector<double>(values.begin(), values.end());
  }
  static void from_json(const json& document, Eigen::VectorXd& values) {
    const auto numbers = document.get<std::vector<double>>();
    values = Eigen::VectorXd::Map(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
  }
};

template <>
struct nlohmann::adl_serializer<Eigen::MatrixXd> {
  static void to_json(json& document, const Eigen::MatrixXd& matrix) {
    document = json::array();
    for (const auto& row : matrix.rowwise()) document.push_back(Eigen::VectorXd(row));
  }
  static void from_json(const json& document, Eigen::MatrixXd& matrix) {
    matrix.resize(static_cast<Eigen::Index>(document.size()),
                  static_cast<Eigen::Index>(document.at(0).size()));
    for (Eigen::Index row = 0; row < matrix.rows(); ++row)
      matrix.row(row) = document.at(row).get<Eigen::VectorXd>();
  }
};

namespace plotscan::heights {

void to_json(json& document, const Kernel& kernel) {
  document = {{"weights", kernel.weights},
              {"linear", kernel.covariance.linear},
              {"noise", kernel.covariance.noise}};
}

void from_json(const json& document, Kernel& kernel) {
  kernel = {.weights = document.at("weights"),
            .covariance = {.linear = document.at("linear"), .noise = document.at("noise")}};
}

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FromOthers, novelty, standardised)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CalibrationFarm, library, crop, top_m, features, ratios, within,
                                   from_libraries, from_crops, standardised_given_crop, novelty)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Calibration, features, heights, center, scale, crops,
                                   crop_kernel, crop_sharpness, ratio_kernels, within, farms)

namespace {

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
  return list_of(farms, [](const auto& farm) { return relative_noise(farm.top_m); });
}

Calibration Calibration::without(std::span<const std::size_t> farms_left_out) const {
  return with_farms(*this, [&](std::size_t i) { return !contains(farms_left_out, i); });
}

Calibration Calibration::of_crop(const std::string& crop) const {
  return with_farms(*this, [&](std::size_t i) { return farms[i].crop == crop; });
}

Calibration Calibration::halved() const {
  return with_farms(*this, [](std::size_t i) { return i % 2 == 0; });
}

json json_of(const Calibration& calibration) { return calibration; }

Calibration calibration_of(const json& document) { return document.get<Calibration>(); }

const Calibration& shipped_calibration() {
  static const Calibration calibration =
      calibration_of(json::parse(calibration_file("calibration")));
  return calibration;
}

Eigen::VectorXd field_features(std::span<const Eigen::VectorXd> features) {
  Eigen::VectorXd medians(features.front().size());
  for (Eigen::Index k = 0; k < medians.size(); ++k)
    medians(k) = quantile(list_of(features, [k](const auto& plot) { return plot(k); }), 0.5);
  return medians;
}

}  // namespace plotscan::heights
