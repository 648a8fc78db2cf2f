// SPDX-License-Identifier: Apache-2.0
#include "heights/plant_heights.h"

#include <cmath>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "heights/ratio_model.h"

namespace plotscan::heights {
namespace {

// Of Student's t with the 24 degrees of freedom that a standard deviation from 25 farms has.
constexpr double kQuantile95 = 2.064;

Height height_of(double value_m, double sd_m) {
  return {.value_m = value_m,
          .standard_error_m = sd_m,
          .low95_m = value_m - kQuantile95 * sd_m,
          .high95_m = value_m + kQuantile95 * sd_m};
}

std::map<std::string, FieldRatio> field_ratios(const Calibration& calibration,
                                               const Eigen::VectorXd& place, int threads) {
  std::vector<std::string> names;
  for (const auto& [name, model] : calibration.models) names.push_back(name);
  std::vector<FieldRatio> ratios(names.size());
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, names.size(), [&](std::size_t i) {
      ratios[i] = RatioModel(calibration, names[i]).at(place);
    });
  });
  std::map<std::string, FieldRatio> by_name;
  for (std::size_t i = 0; i < names.size(); ++i) by_name[names[i]] = ratios[i];
  return by_name;
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
                                                              const Calibration& calibration,
                                                              int threads) {
  std::vector<std::map<std::string, Height>> heights(field.size());
  if (field.empty()) return heights;
  std::vector<Eigen::VectorXd> features;
  for (const PlotCanopy& plot : field) features.push_back(plot.features);
  const Eigen::VectorXd place = calibration.scaled(field_features(features));
  for (const auto& [name, ratio] : field_ratios(calibration, place, threads)) {
    const Eigen::VectorXd& within = calibration.models.at(name).within;
    for (std::size_t i = 0; i < field.size(); ++i) {
      const double own = within.dot(calibration.scaled(field[i].features) - place);
      const double sd_m = std::hypot(ratio.field_sd, ratio.within_sd) * field[i].top_m;
      heights[i][name] = height_of((ratio.value + own) * field[i].top_m,
                                   std::hypot(sd_m, field[i].ground_error_m));
    }
  }
  return heights;
}

}  // namespace plotscan::heights
