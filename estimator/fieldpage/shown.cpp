// SPDX-License-Identifier: Apache-2.0
#include "fieldpage/shown.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/extent.h"
#include "core/statistics.h"
#include "record/positions.h"
#include "report/shown_grid.h"

namespace plotscan::fieldpage {
namespace {

report::ShownPlot shown(const estimate::PlotEstimate& plot) {
  report::ShownPlot result{.id = plot.id.text(),
                           .trial = plot.trial,
                           .row = plot.row,
                           .column = plot.column,
                           .box = plot.box,
                           .points = plot.points,
                           .confidence = plot.confidence,
                           .flags = plot.flags};
  for (const auto& [name, height_m] : plot.heights_m) {
    const auto error = plot.errors.find(name);
    result.heights[name] = error == plot.errors.end()
                               ? report::ShownHeight{height_m, kNaN, kNaN, kNaN}
                               : report::ShownHeight{height_m, error->second.standard_error_m,
                                                     error->second.low95_m, error->second.high95_m};
  }
  return result;
}

// Nodes every half metre around the plots, farther apart where they would be too many.
report::ShownGrid grid_around(const report::ShownField& field) {
  constexpr double kFinest_m = 0.5;
  constexpr double kMostNodes = 1e6;
  constexpr double kAround_m = 3;
  const Eigen::AlignedBox2d bounds =
      extent_of(field.plots, &report::ShownPlot::box)
          .merged(extent_of(field.true_boxes, &report::ShownBox::box));
  const Eigen::Vector2d size = bounds.sizes().array() + 2 * kAround_m;
  const double cell_m =
      std::max({kFinest_m, std::sqrt(size.prod() / kMostNodes), size.maxCoeff() / kMostNodes});
  return {.first = bounds.min().array() - kAround_m,
          .cell_m = cell_m,
          .columns = static_cast<int>(size.x() / cell_m) + 2,
          .rows = static_cast<int>(size.y() / cell_m) + 2};
}

// The field's plots by their ids, which are all different.
std::map<std::string, report::ShownPlot*> plots_by_id(report::ShownField& field) {
  std::map<std::string, report::ShownPlot*> by_id;
  for (report::ShownPlot& plot : field.plots) by_id[plot.id] = &plot;
  return by_id;
}

report::ShownPoint shown(const Eigen::Vector3d& place) { return {.place = place.cast<float>()}; }

}  // namespace

void show_estimate(report::ShownField& field, const estimate::Estimate& estimate) {
  for (const estimate::PlotEstimate& plot : estimate.plots) field.plots.push_back(shown(plot));
  if (estimate.ground) field.ground = report::shown_grid(*estimate.ground, Eigen::Vector3d::Zero());
}

void show_working(report::ShownField& field, const estimate::Estimate& estimate) {
  report::ShownWorking working{.method = estimate.method, .clusters = estimate.clusters};
  for (const estimate::PlotEstimate& plot : estimate.plots) {
    working.plots.push_back(plot.box);
    if (!plot.ground) continue;
    working.planes.push_back({.id = plot.id.text(),
                              .box = plot.box,
                              .z_m = plot.ground->z_m,
                              .slope = plot.ground->slope,
                              .tolerance_m = plot.ground->tolerance_m});
  }
  if (!working.clusters.empty() || !working.planes.empty())
    field.workings.push_back(std::move(working));
}

void show_truth(report::ShownField& field, const estimate::Estimate& estimate,
                const std::vector<score::TruePlot>& truth) {
  const score::FieldScore scored = score::score_field(truth, estimate);
  const std::map<std::string, report::ShownPlot*> by_id = plots_by_id(field);
  for (const PlotId& id : scored.extra) by_id.at(id.text())->state = report::PlotState::extra;
  for (const score::PlotScore& plot : scored.plots) {
    field.true_boxes.push_back(
        {.id = plot.truth.id.text(), .box = plot.truth.box, .found = plot.found.has_value()});
    if (!plot.found) continue;
    report::ShownPlot& found = *by_id.at(plot.found->estimate.text());
    found.state = report::PlotState::found;
    found.truths_m = plot.truth.heights_m;
  }
}

std::size_t show_measured(report::ShownField& field, const score::MeasuredPlots& measured) {
  std::size_t shown = 0;
  const std::map<std::string, report::ShownPlot*> by_id = plots_by_id(field);
  for (const score::TruePlot& plot : measured.plots) {
    if (!plot.scored) continue;
    by_id.at(plot.id.text())->truths_m = plot.heights_m;
    ++shown;
  }
  return shown;
}

void show_terrain(report::ShownField& field, const terrain::Terrain& terrain) {
  if (!field.ground && field.plots.empty() && field.true_boxes.empty()) return;
  report::ShownGrid grid = field.ground ? *field.ground : grid_around(field);
  grid.standard_error_m.clear();
  grid.z_m.clear();
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const Eigen::Vector2d place = grid.first + grid.cell_m * Eigen::Vector2d(column, row);
      grid.z_m.push_back(static_cast<float>(terrain.height(place.x(), place.y()).value_or(kNaN)));
    }
  }
  field.terrain = std::move(grid);
}

report::ShownCloud read_shown_positions(const CloudFiles& cloud, std::size_t most,
                                        const ProgressReport& progress) {
  const double expected = std::max(1.0, record::expected_points(cloud));
  report::CloudSample sample(most);
  report::ShownCloud shown_cloud;
  record::read_positions(cloud,
                         [&](std::span<const Eigen::Vector3d> places) {
                           // Floats hold positions near a whole metre close by.
                           if (sample.read() == 0 && !places.empty())
                             shown_cloud.origin = places.front().array().round();
                           for (const Eigen::Vector3d& place : places)
                             sample.add(shown(place - shown_cloud.origin));
                           if (progress)
                             progress(std::min(1.0, static_cast<double>(sample.read()) / expected));
                         },
                         {.leave_out_marked = true});
  shown_cloud.read = sample.read();
  shown_cloud.points = sample.take();
  return shown_cloud;
}

}  // namespace plotscan::fieldpage
