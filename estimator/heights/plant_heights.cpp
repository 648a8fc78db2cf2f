// SPDX-License-Identifier: Apache-2.0
#include "heights/plant_heights.h"

#include <cmath>

namespace plotscan::heights {
namespace {

constexpr double kNormal95 = 1.96;

Height height_of(double value_m, double sd_m) {
  return {.value_m = value_m,
          .standard_error_m = sd_m,
          .low95_m = value_m - kNormal95 * sd_m,
          .high95_m = value_m + kNormal95 * sd_m};
}

}  // namespace

const std::map<std::string, CanopyQuantile>& canopy_quantiles() {
  static const std::map<std::string, CanopyQuantile> quantiles = {
      {"mean", {.area_share = 0.9, .relative_sd = 0.1}},
      {"p50", {.area_share = 0.9, .relative_sd = 0.1}},
      {"p90", {.area_share = 0.98, .relative_sd = 0.08}},
      {"p95", {.area_share = 0.99, .relative_sd = 0.08}},
      {"p99", {.area_share = 0.997, .relative_sd = 0.08}},
      {"max", {.area_share = 0.999, .relative_sd = 0.08}},
      {"canopy_p95", {.area_share = 0.95, .relative_sd = 0.06}},
      {"canopy_p99", {.area_share = 0.99, .relative_sd = 0.03}}};
  return quantiles;
}

std::vector<std::map<std::string, Height>> quantile_heights(std::span<const PlotCanopy> field) {
  std::vector<std::map<std::string, Height>> heights(field.size());
  for (std::size_t i = 0; i < field.size(); ++i) {
    for (const auto& [name, quantile] : canopy_quantiles()) {
      heights[i][name] =
          height_of(field[i].quantiles_m.at(name),
                    std::hypot(quantile.relative_sd * field[i].top_m, field[i].ground_error_m));
    }
  }
  return heights;
}

std::vector<std::map<std::string, Height>> calibrated_heights(std::span<const PlotCanopy> field,
                                                              const Calibration& calibration) {
  std::vector<std::map<std::string, Height>> heights(field.size());
  if (field.empty()) return heights;
  std::vector<Eigen::VectorXd> features;
  for (const PlotCanopy& plot : field) features.push_back(plot.features);
  const Eigen::VectorXd place = calibration.scaled(field_features(features));
  const Eigen::MatrixXd farms = calibration.scaled_farms();
  for (const auto& [name, model] : calibration.models) {
    const Kriging kriging(farms, calibration.ratios_of(name), model.covariance);
    const Prediction ratio = kriging.at(place);
    for (std::size_t i = 0; i < field.size(); ++i) {
      const double own = model.within.dot(calibration.scaled(field[i].features) - place);
      const double sd_m = std::hypot(ratio.sd, model.within_sd) * field[i].top_m;
      heights[i][name] = height_of((ratio.value + own) * field[i].top_m,
                                   std::hypot(sd_m, field[i].ground_error_m));
    }
  }
  return heights;
}

}  // namespace plotscan::heights
