// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "series/series.h"

namespace plotscan::series {

// A plot of 1.5 x 4 m, its length to the north.
inline estimate::PlotEstimate plot_at(std::uint64_t id, double x, double y, double height_m,
                                      double error_m = 0.01) {
  return {.id = id,
          .box = {.center = {x, y}, .width_m = 1.5, .length_m = 4, .heading_rad = 1.5707963267949},
          .heights_m = {{"canopy_p95", height_m}, {"mean", height_m - 0.1}},
          .errors = {{"canopy_p95", {error_m, height_m - 2 * error_m, height_m + 2 * error_m}}}};
}

// What a flight found: plots that are numbered in their order.
inline DatedEstimate found(const std::string& date, std::vector<estimate::PlotEstimate> plots) {
  return {.folder = "of_" + date,
          .date = date,
          .estimate = {.method = "lattice", .plots = std::move(plots)}};
}

// The same in boxes of a map.
inline DatedEstimate given(const std::string& date, std::vector<estimate::PlotEstimate> plots) {
  DatedEstimate result = found(date, std::move(plots));
  result.ids_are_given = true;
  return result;
}

}  // namespace plotscan::series
