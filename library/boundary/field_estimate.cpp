// SPDX-License-Identifier: Apache-2.0
#include "boundary/field_estimate.h"

#include <cmath>

#include "boundary/values.h"

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

// Bytes that are no UTF-8 are replaced.
std::string text_of(const nlohmann::json& document, int indent) {
  return document.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

FieldEstimate outer(const estimate::Estimate& estimate) {
  FieldEstimate made{.method = estimate.method};
  for (const estimate::PlotEstimate& plot : estimate.plots) made.plots.push_back(outer_plot(plot));
  made.why_no_plots = estimate.diagnostics.why_no_plots;
  if (estimate.ground) made.ground = outer_ground(*estimate.ground);
  made.crs = estimate.crs;
  made.geojson =
      text_of(plot_collection(features_of(estimate), estimate.crs, estimate.units), 1) + "\n";
  made.diagnostics = text_of(to_json(estimate.diagnostics), -1);
  return made;
}

estimate::Estimate inner(const FieldEstimate& estimate) {
  estimate::Estimate made{.method = estimate.method};
  for (const Plot& plot : estimate.plots) made.plots.push_back(inner_plot(plot));
  return made;
}

}  // namespace plotscan::boundary
