// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/range.h"
#include "planting/model_description.h"
#include "planting/plots_description.h"
#include "planting/trial_design.h"

namespace plotscan::planting {

// Range of a plant's size relative to its model.
inline constexpr Range kPlantScale{0.01, 100};

enum class PlantPattern { random, drilled };

// Heights of a cultivar's plants: a normal distribution, cut off three standard deviations from the
// mean.
struct HeightDescription {
  double mean_m = 0;
  double sd_m = 0;  // of the whole normal distribution
};

// Plants that are sown and do not come up.
struct MissingDescription {
  double rate = 0;           // share of single plants
  double gaps_per_plot = 0;  // mean number of gaps (Poisson)
  double gap_length_m = 0;   // along the plot's length
};

// Plots whose plants all lean in nearly one direction.
struct LodgingDescription {
  double plots_rate = 0;     // share of the plots
  double min_angle_rad = 0;  // from the vertical, uniform over the plots
  double max_angle_rad = 0;
  double spread_rad = 0;  // of a plant's lean and direction about its plot's: uniform within
  std::optional<double> direction_rad = {};  // counter-clockwise from east; absent: drawn
};

// What is sown into a plot.
struct CultivarDescription {
  std::string name;
  std::vector<std::uint32_t> models = {};  // places in FarmDescription::models
  std::uint32_t count = 0;                 // seeds a plot
  PlantPattern pattern = PlantPattern::random;
  std::uint32_t drill_rows = 1;  // drilled: rows along the plot's length
  double jitter_m = 0;           // drilled: uniform shift in [-jitter_m, jitter_m] along both axes
  bool yaw_of_row = false;       // drilled: x of a model along its row, either way; else any yaw
  double min_scale = 1;          // each axis' scale is uniform in [min_scale, max_scale]
  double max_scale = 1;
  std::optional<HeightDescription> height = {};  // then the z scale follows from the drawn height
  MissingDescription missing = {};
  std::optional<LodgingDescription> lodging = {};
};

// The `plants` section of farm.yaml (docs/farm-format.md): plants drawn at random into every plot.
struct PlantsDescription {
  std::vector<CultivarDescription> cultivars;  // one, farm::kNoAccession, where the file names none
  DesignDescription design = {};
};

// Not more seeds than this are sown into the grid: every plot counts as one of the cultivar with
// most.
std::uint64_t most_seeds(const PlotGridDescription& grid, const PlantsDescription& plants);

}  // namespace plotscan::planting
