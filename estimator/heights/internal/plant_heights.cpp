// SPDX-License-Identifier: Apache-2.0
#include "heights/internal/plant_heights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/statistics.h"

namespace plotscan::heights {
namespace {

// Neighbours in the wrong order get their mean, until all are in order (pool adjacent violators,
// Ayer et al. 1955): the nearest ordered values in the sense of least squares.
void put_in_order(std::span<Height* const> heights) {
  struct Pool {
    double sum;
    std::size_t count;
    double mean() const { return sum / static_cast<double>(count); }
  };
  std::vector<Pool> pools;
  for (const Height* height : heights) {
    pools.push_back({.sum = height->value_m, .count = 1});
    while (pools.size() > 1 && pools[pools.size() - 2].mean() > pools.back().mean()) {
      pools[pools.size() - 2].sum += pools.back().sum;
      pools[pools.size() - 2].count += pools.back().count;
      pools.pop_back();
    }
  }
  std::size_t next = 0;
  for (const Pool& pool : pools) {
    for (std::size_t i = 0; i < pool.count; ++i, ++next)
      *heights[next] = height_of(pool.mean(), heights[next]->standard_error_m);
  }
}

// Restores the order that heights have by definition: no percentile exceeds a higher percentile or
// the tallest plant, and the mean does not exceed the tallest.
void put_in_order(std::map<std::string, Height>& heights) {
  const std::array plants = {&heights.at("p50"), &heights.at("p90"), &heights.at("p95"),
                             &heights.at("p99"), &heights.at("max")};
  put_in_order(plants);
  const std::array canopy = {&heights.at("canopy_p95"), &heights.at("canopy_p99")};
  put_in_order(canopy);
  Height& mean = heights.at("mean");
  mean = height_of(std::min(mean.value_m, heights.at("max").value_m), mean.standard_error_m);
}

CropEvidence crop_evidence(const CalibratedModels& models, const Eigen::VectorXd& scaled,
                           const std::optional<std::string>& crop) {
  return {.probabilities =
              crop ? models.calibration.indicators_of(*crop) : models.crops.probabilities(scaled),
          .novelty = models.crops.novelty(scaled),
          .given = crop.has_value()};
}

// The plots that show the field's crop: all, if all are bare.
std::vector<const PlotCanopy*> with_crop(std::span<const PlotCanopy> field) {
  const bool all = std::ranges::all_of(field, &PlotCanopy::bare);
  std::vector<const PlotCanopy*> plots;
  for (const PlotCanopy& plot : field)
    if (all || !plot.bare) plots.push_back(&plot);
  return plots;
}

// The crop of a field: medians over its plots.
struct FieldCanopy {
  Eigen::VectorXd scaled;  // features
  double top_m = 0;
};

FieldCanopy field_canopy(std::span<const PlotCanopy> field, const Calibration& calibration) {
  std::vector<Eigen::VectorXd> features;
  std::vector<double> tops;
  for (const PlotCanopy* plot : with_crop(field)) {
    features.push_back(plot->features);
    tops.push_back(plot->top_m);
  }
  return {.scaled = calibration.scaled(field_features(features)),
          .top_m = quantile(std::move(tops), 0.5)};
}

}  // namespace

Height height_of(double value_m, double standard_error_m) {
  return {.value_m = value_m,
          .standard_error_m = standard_error_m,
          .low95_m = value_m - kIntervalErrors * standard_error_m,
          .high95_m = value_m + kIntervalErrors * standard_error_m};
}

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

FieldPlants quantile_heights(std::span<const PlotCanopy> field) {
  FieldPlants plants{.plots = std::vector<PlantHeights>(field.size())};
  for (std::size_t i = 0; i < field.size(); ++i) {
    for (const auto& [name, quantile] : canopy_quantiles()) {
      plants.plots[i].heights[name] =
          height_of(field[i].quantiles_m.at(name),
                    std::hypot(quantile.relative_sd * field[i].top_m, field[i].ground_error_m,
                               field[i].sampling_m.at(name)));
    }
  }
  return plants;
}

CalibratedModels::CalibratedModels(const Calibration& its_calibration)
    : calibration(its_calibration), crops(its_calibration), ratios(its_calibration) {}

FieldPlants calibrated_heights(std::span<const PlotCanopy> field, const CalibratedModels& models,
                               const std::optional<std::string>& crop) {
  const Calibration& calibration = models.calibration;
  FieldPlants plants{.plots = std::vector<PlantHeights>(field.size())};
  if (field.empty()) return plants;
  const FieldCanopy middle = field_canopy(field, calibration);
  const CropEvidence crops = crop_evidence(models, middle.scaled, crop);
  for (std::size_t i = 0; i < calibration.crops.size(); ++i)
    plants.crops[calibration.crops[i]] = crops.probabilities(static_cast<Eigen::Index>(i));
  const FieldRatios ratios = models.ratios.at(middle.scaled, middle.top_m, crops);
  for (std::size_t i = 0; i < field.size(); ++i) {
    const Eigen::VectorXd scaled = calibration.scaled(field[i].features);
    const Eigen::VectorXd values = ratios.values + calibration.within * (scaled - middle.scaled);
    Eigen::VectorXd sds = ratios.field_sds.cwiseAbs2() + ratios.within_sds.cwiseAbs2();
    PlantHeights& plot = plants.plots[i];
    plot.novelty = models.ratios.novelty(scaled, crops.probabilities);
    if (plot.novelty > 1) {
      const FieldRatios own = models.ratios.at(scaled, field[i].top_m, crops);
      sds = sds.cwiseMax(own.field_sds.cwiseAbs2() + own.within_sds.cwiseAbs2());
    }
    for (std::size_t k = 0; k < calibration.heights.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      plot.heights[calibration.heights[k]] =
          height_of(values(row) * field[i].top_m,
                    std::hypot(std::sqrt(sds(row)) * field[i].top_m, field[i].ground_error_m));
    }
    put_in_order(plot.heights);
  }
  return plants;
}

}  // namespace plotscan::heights
