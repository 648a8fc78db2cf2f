// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/plot_box.h"
#include "core/statistics.h"
#include "core/trial_layout.h"

namespace plotscan::plots {

struct FoundPlot {
  int row = 0;       // from 1: rows follow each other along the plots' length
  int column = 0;    // from 1: columns follow each other along their width
  PlotBox box = {};  // in the points' frame
  PlotBoxError box_error = {};
  double confidence = 0;  // 0 to 1
  bool cut_off = false;   // the box reaches over the edge of what was scanned
  // The canopy of its row or column does not end at one side of the boxes (without_edge in
  // lattice.h).
  bool without_edge = false;
};

// Signs that distinguish a field of plots from an orchard, parked cars, bushes or a room.
struct FieldSigns {
  std::size_t plots = 0;
  double held_share = 0;     // of the canopy, in the plots
  double filled_share = 0;   // of the rows' places from their first plot to their last
  double surface_share = 0;  // of what stands on the field: as smooth as walls and roofs
  double squareness = 0;     // misfit of ellipses over that of rectangles, as the plots' outlines
  double straightness = 0;   // the same of all canopy in and around them (plot_shape.h)
  double roughness = 0;      // scatter of the plots' upper returns about planes, over their height
  // Scatter of these returns in small patches, in sigmas of the noise (plot_shape.h); NaN: not
  // known.
  double patch_scatter = kNaN;
  double unevenness = 0;       // spread over mean of the canopy, a square metre at a time, in plots
  double mean_unevenness = 0;  // the same of the plots' mean
  double aspect = 0;           // length of a plot over its width and that width's standard error
  double pitch_m = 0;          // from one plot to the next along their width; 0: no other
  double passage = 0;          // gap between these, over the width
  double least_gap_m = 0;      // between plots, along their length or their width
  double gap_cover = 0;        // at most, of the gaps over that of the plots beside (plot_shape.h)
  // For a plot, over a canopy of one level in the plots' outline: Schwarz's criterion, nats.
  double evidence = 0;
};

// The rows of plants that every plot is sown in, along its length or across it.
struct SownRows {
  int rows = 0;  // of a plot
  double spacing_m = 0;
  bool across = false;  // they run across the plot's length

  double extent_m() const { return rows * spacing_m; }
};

// The layout of a field's plots, and how well it fits.
struct FieldFit {
  TrialLayout layout;
  bool columns_aligned = true;                           // else every row's plots lie by themselves
  double rms_along_length_m = 0, rms_along_width_m = 0;  // of the plots' centres about it
  double leaf_spread_m = 0;                              // sigma of the leaves over a plot's edges
  std::optional<SownRows> sown_rows = std::nullopt;      // where the canopy shows them
  double side_contrast = 0;  // canopy within a plot's sides less that beyond, a share of full cover
};

// A field's plots, or why it has none.
struct PlotField {
  std::vector<FoundPlot> plots = {};
  std::string why_none = {};  // why there are no plots here; "" when there are
  // The layout that the canopy shows more clearly than the user's; "" where there is none.
  std::string rival = {};
  // Why these would be no plots if the user had not told their layout; "" where they would be.
  std::string doubt = {};
  double others_m2 = 0;  // of canopy without gaps beside the plots, such as another crop: left out
  // Of the plots, or of what was taken for them and refused.
  std::optional<FieldFit> fit = std::nullopt;
  std::optional<FieldSigns> signs = std::nullopt;
};

}  // namespace plotscan::plots
