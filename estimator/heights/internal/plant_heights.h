// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "heights/calibration.h"
#include "heights/crop_model.h"
#include "heights/measure_heights.h"
#include "heights/ratio_model.h"

namespace plotscan::heights {

// What a plot's returns show.
struct PlotCanopy {
  double top_m = 0;          // height that 1 % of the area exceeds, without noise
  bool bare = false;         // no crop: it says nothing of the field's
  Eigen::VectorXd features;  // by feature_names()
  std::map<std::string, double> quantiles_m = {};  // what stands for a height without calibration
  std::map<std::string, double> sampling_m = {};   // their standard errors, of so few returns
  double ground_error_m = 0;                       // standard error of the ground under it
};

// The names of the heights, and what stands for each without calibration.
struct CanopyQuantile {
  double area_share = 0;   // of the area that lies below
  double relative_sd = 0;  // of the height's error, over crops (docs/plot-heights.md)
};
const std::map<std::string, CanopyQuantile>& canopy_quantiles();

// With its 95 % interval.
Height height_of(double value_m, double standard_error_m);

// A plot's heights by name.
struct PlantHeights {
  std::map<std::string, Height> heights = {};
  double novelty = 0;  // over 1: the canopy is unlike all that the calibration knows
};

// The heights of a field's plots, and how likely it is of each crop.
struct FieldPlants {
  std::vector<PlantHeights> plots = {};
  std::map<std::string, double> crops = {};
};

// Heights that are the canopies' own quantiles, whatever the crop.
FieldPlants quantile_heights(std::span<const PlotCanopy> field);

// What a calibration tells, factorised once for all fields.
struct CalibratedModels {
  explicit CalibratedModels(const Calibration& its_calibration);  // keeps a reference

  const Calibration& calibration;
  CropModel crops;
  RatioModel ratios;
};

// Heights by the calibration's farms. They are put in order: no percentile exceeds a higher
// percentile or the maximum. The crop is the given one, else derived from the canopies. Throws
// InputError on a given crop that the calibration does not know.
FieldPlants calibrated_heights(std::span<const PlotCanopy> field, const CalibratedModels& models,
                               const std::optional<std::string>& crop = {});

}  // namespace plotscan::heights
