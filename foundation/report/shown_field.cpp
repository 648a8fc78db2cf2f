// SPDX-License-Identifier: Apache-2.0
#include "report/shown_field.h"

#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "core/extent.h"
#include "report/decimals.h"
#include "report/internal/pack_cloud.h"
#include "report/internal/packed.h"

namespace plotscan::report {
namespace {

using nlohmann::json;

constexpr int kDecimals = 5;             // of metres
constexpr std::size_t kMostPath = 2000;  // most drone positions that are shown

json number(double value) {
  return std::isfinite(value) ? json(decimals(value, kDecimals)) : json();
}

json packed(const PlotBox& box) {
  return {number(box.center.x()), number(box.center.y()), number(box.width_m), number(box.length_m),
          decimals(degrees(box.heading_rad), kDecimals)};
}

const char* name_of(PlotState state) {
  if (state == PlotState::found) return "found";
  return state == PlotState::extra ? "extra" : "";
}

json packed(const ShownPlot& plot) {
  json heights = json::object();
  for (const auto& [name, height] : plot.heights)
    heights[name] = {number(height.value_m), number(height.standard_error_m),
                     number(height.low95_m), number(height.high95_m)};
  json truths = json::object();
  for (const auto& [name, truth_m] : plot.truths_m) truths[name] = number(truth_m);
  json document = {{"id", plot.id},         {"row", plot.row},
                   {"column", plot.column}, {"box", packed(plot.box)},
                   {"heights", heights},    {"flags", plot.flags},
                   {"truths", truths},      {"state", name_of(plot.state)}};
  if (plot.trial > 0) document["trial"] = plot.trial;
  if (plot.points) document["points"] = *plot.points;
  if (plot.confidence) document["confidence"] = number(*plot.confidence);
  return document;
}

json packed(const ShownGrid& grid) {
  constexpr double kHeightStep_m = 0.001;
  constexpr double kErrorStep_m = 0.0005;
  json document = {{"first", {number(grid.first.x()), number(grid.first.y())}},
                   {"cell", grid.cell_m},
                   {"columns", grid.columns},
                   {"rows", grid.rows},
                   {"z", packed_numbers(grid.z_m, kHeightStep_m)}};
  if (!grid.standard_error_m.empty())
    document["se"] = packed_numbers(grid.standard_error_m, kErrorStep_m);
  return document;
}

json packed(const std::vector<Eigen::Vector3d>& path) {
  json places = json::array();
  const std::size_t stride = path.size() / kMostPath + 1;
  for (std::size_t i = 0; i < path.size(); i += stride)
    places.push_back({number(path[i].x()), number(path[i].y()), number(path[i].z())});
  return places;
}

json packed(const ShownBox& box) {
  return {{"id", box.id}, {"box", packed(box.box)}, {"found", box.found}};
}

template <class Item>
json packed(const std::vector<Item>& items);

json packed(const ShownPlane& plane) {
  constexpr int kSlopeDecimals = 6;
  return {{"id", plane.id},
          {"box", packed(plane.box)},
          {"z", number(plane.z_m)},
          {"slope",
           {decimals(plane.slope.x(), kSlopeDecimals), decimals(plane.slope.y(), kSlopeDecimals)}},
          {"tolerance", number(plane.tolerance_m)}};
}

json packed(const ShownWorking& working) {
  return {{"method", working.method},
          {"clusters", packed<PlotBox>(working.clusters)},
          {"plots", packed<PlotBox>(working.plots)},
          {"planes", packed<ShownPlane>(working.planes)}};
}

template <class Item>
json packed(const std::vector<Item>& items) {
  json list = json::array();
  for (const Item& item : items) list.push_back(packed(item));
  return list;
}

// A sample of few points says nothing of it.
bool lies_elsewhere(const ShownField& field) {
  constexpr std::size_t kEnough = 1000;
  const std::vector<ShownPoint>& points = field.cloud->points;
  if (field.plots.empty() || (points.size() < kEnough && points.size() < field.cloud->read))
    return false;
  const Eigen::AlignedBox2d plots = extent_of(field.plots, &ShownPlot::box);
  return std::ranges::none_of(points, [&](const ShownPoint& point) {
    return plots.contains((field.cloud->origin + point.place.cast<double>()).head<2>());
  });
}

}  // namespace

void note_cloud_elsewhere(ShownField& field, const std::string& cloud) {
  if (!field.cloud || !lies_elsewhere(field)) return;
  field.notes.push_back("No point of the cloud " + cloud +
                        " lies among the plots: are both in the same coordinates?");
}

std::string shown_name(const std::filesystem::path& path) {
  const std::filesystem::path whole = std::filesystem::absolute(path).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

json packed_field(const ShownField& field) {
  json facts = json::array();
  for (const Fact& fact : field.facts) facts.push_back({fact.name, fact.value});
  json document = {{"name", field.name},
                   {"facts", facts},
                   {"notes", field.notes},
                   {"path", packed(field.path)},
                   {"plots", packed<ShownPlot>(field.plots)},
                   {"true_boxes", packed<ShownBox>(field.true_boxes)}};
  if (!field.workings.empty()) document["workings"] = packed<ShownWorking>(field.workings);
  if (field.cloud) document["cloud"] = packed_cloud(*field.cloud);
  if (field.ground) document["ground"] = packed(*field.ground);
  if (field.terrain) document["terrain"] = packed(*field.terrain);
  return document;
}

}  // namespace plotscan::report
