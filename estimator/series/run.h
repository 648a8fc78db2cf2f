// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "series/series.h"

namespace plotscan::series {

struct RunOptions {
  // Estimate folders, or GeoJSON files of plots with heights; two at least.
  std::vector<std::filesystem::path> estimates = {};
  // One for each estimate; else the day of the flight that its manifest states, else the date in
  // its folder's name, else that name.
  std::vector<std::string> dates = {};
  std::string height = "canopy_p95";  // that of the table by date, the map and the growth
  std::optional<JoinBy> join = {};    // else as joined_series chooses
  std::filesystem::path output = {};  // folder to write
  bool replace = false;               // an output folder that exists
};

// What one date, or one step between dates, has of a height.
struct DateSummary {
  std::string date;
  std::size_t plots = 0;  // with this height
  double median_m = 0;    // NaN without any
  // The median growth since the last date at which a plot has the height, and over how many plots.
  std::size_t grown = 0;
  double growth_m = 0;
};
std::vector<DateSummary> summary_of(const Series& series, const std::string& height);

nlohmann::json to_json(const Series& series, const std::string& height);

// Joins the estimates (joined_series) and writes the folder of docs/series.md. Throws InputError as
// estimate::read_estimate and joined_series do, on fewer than two estimates, on dates that are not
// as many as these, and where no plot has the height.
Series run(const RunOptions& options);

}  // namespace plotscan::series
