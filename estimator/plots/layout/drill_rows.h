// SPDX-License-Identifier: Apache-2.0
#pragma once

// Bands that are the drill rows of wider plots.

#include <optional>
#include <vector>

namespace plotscan::plots {

inline constexpr int kMostSownRows = 12;  // of a plot

// Plots of drill rows at one spacing; lengths in cells.
struct DrilledPlots {
  int rows = 0;                                  // of a plot
  double spacing = 0;                            // from row to row
  std::vector<std::vector<double>> begins = {};  // of the plots' sown widths, line by line
  double width() const { return rows * spacing; }
};

// The bands' middles on each line, in their order, as plots of equally many rows: steps within a
// plot are one spacing, those to the next plot are wider, by least_gap and by a share of the
// spacing at least. What is sown reaches half a spacing beyond the outer rows. Nothing where the
// bands are no such rows.
std::optional<DrilledPlots> drilled_plots(const std::vector<std::vector<double>>& middles,
                                          double most_spacing, double least_gap);

}  // namespace plotscan::plots
