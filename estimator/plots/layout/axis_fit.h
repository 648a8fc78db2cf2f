// SPDX-License-Identifier: Apache-2.0
#pragma once

// Plots, or their drill rows, along one axis of a field.

#include <limits>
#include <optional>
#include <vector>

#include "plots/layout/segments.h"

namespace plotscan::plots {

inline constexpr double kLeastRow_m = 0.2;  // of a drill row's leaves
// Maize stands in rows up to 1.02 m (40 in) apart; leaves move what is seen of two rows by up to a
// tenth.
inline constexpr double kMostSpacing_m = 1.12;

// What is assumed of a line of plots.
enum class LineModel {
  free_ends,  // anything may stand before the first and after the last plot
  even_ends,  // ground stands there, or a canopy of one level
  touching,   // the same, and plots may touch where the user gave their side or their number
};

// What is known of the plots along an axis.
struct AxisHint {
  std::optional<double> side_m = std::nullopt;  // of a plot
  std::optional<int> count = std::nullopt;      // of plots that follow each other
  LineModel model = LineModel::free_ends;
  double least_m = kLeastRow_m;  // narrower bands are not sought
};

// How well bands of one shape explain what is seen along an axis.
struct AxisFit {
  BandShape shape;
  std::vector<std::vector<int>> begins = {};  // by profile; one list where they share it
  double misfit = std::numeric_limits<double>::infinity();
  double parameters = 0;
  std::optional<double> touching = std::nullopt;  // side of plots without gaps between them, cells
  double row_spacing = 0;  // in cells, of drill rows that were put together; 0 for none
  int band_size = 0;       // of the bands before that

  double cost(double price) const { return misfit + price * parameters; }
};

// A line's profiles, and the price of a parameter by Schwarz's criterion.
struct Line {
  double cell_m = 0;
  AxisHint hint = {};
  std::vector<ProfileSums> profiles = {};
  double price = 0;
  double independent = 0;
};

// A profile along the view's r for each list of bands of c.
Line line_of(const RowView& view, const std::vector<std::vector<Band>>& strips,
             const AxisHint& hint);

// The bands that explain the line best, among those that are plots or drill rows of plots. With
// `shared` all profiles have the same bands, else each its own. The misfit is infinite where there
// are none.
AxisFit fit_axis(const Line& line, bool shared);

// The fit with bands that are whole plots, where they were drill rows or other parts of plots.
AxisFit put_together(const Line& line, AxisFit fit);

// Plots that touch (touching_plots.h). Their misfit is not that of bands, and is not given.
std::optional<AxisFit> fit_touching(const Line& line);

std::vector<Band> bands_of(const AxisFit& fit, std::size_t profile);

}  // namespace plotscan::plots
