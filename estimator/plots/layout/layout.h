// SPDX-License-Identifier: Apache-2.0
#pragma once

// Rows of plots on a canopy raster.

#include <optional>
#include <vector>

#include "plots/hints.h"
#include "plots/layout/axis_fit.h"

namespace plotscan::plots {

struct Row {
  Band band;                     // across the row
  std::vector<Band> plots = {};  // along it
};

// Rows of equal plots, and how clearly the canopy shows them.
struct Layout {
  RowView view;
  BandShape r_shape = {}, c_shape = {};  // of a plot along r and along c
  int narrower_band = 0;   // of the bands that show along r and c: drill rows, or the plots
  double row_spacing = 0;  // in cells, of drill rows put together along c; 0 for none
  std::vector<Row> rows = {};
  // In cells, the side of plots that touch along r, along c.
  std::optional<double> r_touching = std::nullopt, c_touching = std::nullopt;
  bool aligned = true;  // columns run through all rows; else every row's plots lie by themselves
  double evidence = 0;  // by how much it explains the raster better than one level does, nats
  double evidence_in_outline = 0;  // the same of the layout's outline alone (layout_criterion.h)
};

// Whether plots that were searched row by row form columns through the rows nevertheless.
bool is_in_columns(const Layout& layout);

// The same rows with plots in the columns that most of them show; nothing where these overlap.
// Places without canopy are left out.
std::optional<Layout> in_columns(Layout layout);

// The direction of single rows of a crop, where the layout's plots are such rows; radians.
std::optional<double> heading_of_rows(const Layout& layout);

// The layout that explains the canopy along both axes best, for its number of parameters: bands
// over the whole field along either axis, or over the whole field along one and in each row by
// itself along the other. Where the user counted the plots, nothing else stands here, and the ends
// of lines are even. Where plots may touch, those that do must explain the canopy as well as
// plots between gaps, and along both axes clearly better than along one. Bands as narrow
// as drill rows may be pieces of plots between the tracks of wheels: without hints on the layout,
// wider ones are taken if they explain the canopy much more clearly. The result has no rows where
// nothing stands out, or nothing that agrees with the hints.
Layout best_layout(const CanopyRaster& raster, const Hints& hints = {},
                   LineModel model = LineModel::free_ends);

}  // namespace plotscan::plots
