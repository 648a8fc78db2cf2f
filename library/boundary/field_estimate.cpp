// SPDX-License-Identifier: Apache-2.0
#include "boundary/field_estimate.h"

#include <cmath>

#include "boundary/values.h"
#include "core/json_text.h"
#include "core/list_of.h"
#include "core/plot_features.h"

namespace plotscan::boundary {
namespace {

Plot outer_plot(const estimate::PlotEstimate& plot) {
  Plot made{.id = plot.id.text(),
            .trial = plot.trial,
            .row = plot.row,
            .column = plot.column,
            .box = outer(plot.box),
            .box_error = {},
            .points = plot.points,
            .heights = {},
            .confidence = plot.confidence,
            .flags = plot.flags};
  if (plot.box_error) made.box_error = outer(*plot.box_error);
  for (const auto& [name, value_m] : plot.heights_m) made.heights[name].value_m = value_m;
  for (const auto& [name, error] : plot.errors) {
    made.heights[name].standard_error_m = error.standard_error_m;
    made.heights[name].low95_m = error.low95_m;
    made.heights[name].high95_m = error.high95_m;
  }
  return made;
}

estimate::PlotEstimate inner_plot(const Plot& plot) {
  estimate::PlotEstimate made{.id = PlotId(plot.id),
                              .trial = plot.trial,
                              .row = plot.row,
                              .column = plot.column,
                              .box = inner(plot.box),
                              .points = plot.points};
  if (plot.box_error) made.box_error = inner(*plot.box_error);
  for (const auto& [name, height] : plot.heights) {
    made.heights_m[name] = height.value_m;
    if (std::isnan(height.low95_m) || std::isnan(height.high95_m)) continue;
    made.errors[name] = {height.standard_error_m, height.low95_m, height.high95_m};
  }
  made.confidence = plot.confidence;
  made.flags = plot.flags;
  return made;
}

GroundGrid outer_ground(const ground::Surface& surface) {
  return {.x_m = surface.origin.x(),
          .y_m = surface.origin.y(),
          .cell_m = surface.cell_m,
          .columns = surface.columns,
          .rows = surface.rows,
          .z_m = surface.z_m,
          .sd_m = surface.sd_m};
}

}  // namespace

FieldEstimate outer(const estimate::Estimate& estimate) {
  FieldEstimate made{.method = estimate.method, .plots = list_of(estimate.plots, outer_plot)};
  made.why_no_plots = estimate.diagnostics.why_no_plots;
  if (estimate.ground) made.ground = outer_ground(*estimate.ground);
  made.crs = estimate.crs;
  made.geojson = json_lines(plot_collection(features_of(estimate), estimate.crs, estimate.units));
  // Bytes that are no UTF-8 are replaced.
  made.diagnostics =
      to_json(estimate.diagnostics).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return made;
}

estimate::Estimate inner(const FieldEstimate& estimate) {
  return {
      .method = estimate.method, .plots = list_of(estimate.plots, inner_plot), .crs = estimate.crs};
}

}  // namespace plotscan::boundary
