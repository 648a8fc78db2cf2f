// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "estimate/estimate.h"

namespace plotscan::estimate {

// An estimate as tables (CSV, RFC 4180), a header line and a line a plot; heights in metres, empty
// where not measured, each followed by its standard error and 95 % interval where it has them.
// Throws WriteError where they cannot be written.

// heights.csv of an estimate folder (docs/estimate-format.md): id, place in the grid, box, points,
// heights, confidence, flags, attributes.
void write_heights(const std::filesystem::path& path, const Estimate& estimate);

// For a breeding database: observationunit_name (the first column of Breedbase's phenotype
// uploads), the plot's id; place in the grid; attributes; heights; flags.
void write_traits(const std::filesystem::path& path, const Estimate& estimate);

// A plot as it was at one date.
struct DatedPlot {
  std::string date;
  PlotEstimate plot;
};

// Plots at several dates, a line for each of both: plot_id, date, place in the grid, heights,
// flags.
void write_dated(const std::filesystem::path& path, const std::vector<DatedPlot>& plots);

// Numbers of plots, one for each plot; NaN is empty.
struct NumberColumn {
  std::string name;
  std::vector<double> values;
};

// A line a plot: plot_id, place in the grid, these columns, the attributes.
void write_numbers(const std::filesystem::path& path, std::vector<PlotEstimate> plots,
                   const std::vector<NumberColumn>& numbers);

}  // namespace plotscan::estimate
