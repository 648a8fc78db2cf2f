// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "core/plot_box.h"
#include "plots/hints.h"

namespace plotscan::plots {

struct FoundPlot {
  int row = 0;            // from 1: rows follow each other along the plots' length
  int column = 0;         // from 1: columns follow each other along their width
  PlotBox box = {};       // in the points' frame
  double confidence = 0;  // 0 to 1
  bool cut_off = false;   // the box reaches over the edge of what was scanned
};

// A field's plots, or why it has none.
struct PlotField {
  std::vector<FoundPlot> plots = {};
  std::string nothing = {};  // why there is no lattice of plots here; "" when there is one
  nlohmann::json fit = nlohmann::json::object();  // what was assumed and how well it fits
};

// Finds the plots of a field from its points as (x, y, height above the ground), metres. noise_m is
// the sigma of the heights.
PlotField find_plots(std::span<const Eigen::Vector3f> points, double noise_m, const Hints& hints,
                     int threads);

}  // namespace plotscan::plots
